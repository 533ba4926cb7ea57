#include "client/commands/sweep.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>

#include "client/commands/follow.h"
#include "client/interrupt.h"
#include "client/output.h"
#include "client/sweep/batches.h"
#include "client/sweep/grid.h"
#include "client/sweep/group_follower.h"
#include "client/sweep/sweep_table.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr char kLabel[] = "sweep";
constexpr int kMostAttempts = 100;  // of a point, with --again

std::string Digest(const std::string& bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1) {
    throw Failure(ExitCode::kInternal, "libcrypto computes no SHA-256");
  }
  constexpr unsigned kBytes = 12;
  std::string text;
  for (unsigned i = 0; i < kBytes; ++i) {
    for (const int digit : {digest[i] >> 4, digest[i] & 15}) text += "0123456789abcdef"[digit];
  }
  return text;
}

// Equal for equal requests: the entries of maps are in the order of their keys.
std::string BytesOf(const v1::SolveSpec& spec) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    if (!spec.SerializeToCodedStream(&coded)) throw Failure(ExitCode::kInternal, "a request cannot be serialized");
  }
  return bytes;
}

// What the sweep asks for, a request a point.
std::vector<v1::CreateSolveRequest> Requests(const SweepGrid& grid, SpecFlags flags, int priority, std::string* name) {
  std::vector<v1::CreateSolveRequest> requests;
  std::vector<std::string> specs;  // digests
  for (const SweepPoint& point : grid.points) {
    for (size_t k = 0; k < grid.axes.size(); ++k) flags.*grid.axes[k].value = point.values[k];
    *requests.emplace_back().mutable_spec() = BuildSpec(flags);
    specs.push_back(Digest(BytesOf(requests.back().spec())));
  }
  if (name->empty()) {
    std::string all;
    for (const std::string& spec : specs) all += spec;
    *name = Digest(all);
  }
  for (size_t i = 0; i < requests.size(); ++i) {
    (*requests[i].mutable_labels())[kLabel] = *name;
    requests[i].set_priority(priority);
    requests[i].set_request_id("sweep-" + Digest(*name + "\n" + specs[i]));
  }
  return requests;
}

bool EndedWithoutAnswer(const v1::Solve& solve) {
  return solve.state() == v1::SOLVE_STATE_FAILED || solve.state() == v1::SOLVE_STATE_CANCELLED;
}

// The same, and those that were attached to and had ended without an answer once more.
std::vector<v1::Solve> CreateAgain(Connection& connection, std::vector<v1::CreateSolveRequest> requests,
                                   const std::function<void(double seconds)>& wait) {
  std::vector<v1::Solve> solves = CreateInBatches(connection, requests, wait);
  for (int attempt = 2; attempt <= kMostAttempts; ++attempt) {
    std::vector<size_t> places;
    std::vector<v1::CreateSolveRequest> further;
    for (size_t i = 0; i < solves.size(); ++i) {
      if (!EndedWithoutAnswer(solves[i])) continue;
      places.push_back(i);
      further.push_back(requests[i]);
      further.back().set_request_id(requests[i].request_id() + "-" + std::to_string(attempt));
    }
    if (places.empty()) break;
    std::vector<v1::Solve> made = CreateInBatches(connection, further, wait);
    for (size_t i = 0; i < places.size(); ++i) solves[places[i]] = std::move(made[i]);
  }
  return solves;
}

// Ctrl-C leaves the solves alone; a second one ends the process. Made before the first gRPC object of the process.
class Leave {
 public:
  explicit Leave(Progress& progress) : progress_(progress), interrupt_([this](int count) { OnInterrupt(count); }) {}

  // Stops this one from now on, also for a Ctrl-C that has come already; nullptr: none.
  void Attach(GroupFollower* follower) {
    const std::lock_guard<std::mutex> lock(mutex_);
    follower_ = follower;
    if (interrupted_ && follower_ != nullptr) follower_->Stop();
  }
  // Throws Failure(kCancelled) at a Ctrl-C.
  void Wait(double seconds) {
    progress_.Note("the server asks to wait " + FormatDuration(seconds) + " before it makes the next solves");
    std::unique_lock<std::mutex> lock(mutex_);
    if (interrupts_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return interrupted_; })) {
      throw Failure(ExitCode::kCancelled, "");
    }
  }

 private:
  void OnInterrupt(int count) {
    if (count > 1) _exit(static_cast<int>(ExitCode::kCancelled));
    progress_.Note("leaving; the solves go on, and the same command goes on with them");
    const std::lock_guard<std::mutex> lock(mutex_);
    interrupted_ = true;
    interrupts_.notify_all();
    if (follower_ != nullptr) follower_->Stop();
  }

  Progress& progress_;
  std::condition_variable interrupts_;
  std::mutex mutex_;  // protects what follows
  GroupFollower* follower_ = nullptr;
  bool interrupted_ = false;
  Interrupt interrupt_;  // last: its thread uses the others
};

// The one progress display of a sweep.
class SweepProgress {
 public:
  SweepProgress(Progress& progress, const SweepGrid& grid) : progress_(progress), grid_(grid) {}

  void Show(size_t place, const v1::SolveEvent& event) {
    if (event.has_state_change()) running_ = PointText(place);
    if (!event.has_iteration() && !event.has_state_change()) return;
    std::string text = Count();
    if (!running_.empty()) text += "  " + running_;
    if (event.has_iteration()) {
      text = Count() + "  " + PointText(place) + ": iteration " + std::to_string(event.iteration().index());
    }
    progress_.ShowLine(text);
  }
  // On a rewritten line what succeeds makes no line of its own.
  void Finished(size_t place, const SweepRow& row) {
    ++done_;
    const std::string text = Count() + "  " + PointText(place) + ": " + EndOf(row);
    progress_.ShowLine(text);
    if (!progress_.live() || row.code != ExitCode::kSuccess) progress_.Note(text);
  }

 private:
  std::string Count() const { return std::to_string(done_) + "/" + std::to_string(grid_.points.size()); }
  std::string PointText(size_t place) const {
    std::string text;
    for (size_t k = 0; k < grid_.axes.size(); ++k) {
      text +=
          (k == 0 ? "" : ", ") + grid_.axes[k].flag.substr(2) + " " + FormatNumber(grid_.points[place].values[k], 12);
    }
    return text;
  }

  Progress& progress_;
  const SweepGrid& grid_;
  size_t done_ = 0;
  std::string running_;
};

void MakeFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw Failure(ExitCode::kUsage, "--output " + path + ": cannot be made a folder: " + error.message());
  if (access(path.c_str(), W_OK | X_OK) != 0) {
    throw Failure(ExitCode::kUsage, "--output " + path + ": cannot be written in: " + std::strerror(errno));
  }
}

// The first exit code, in the order of the points, that is not success.
ExitCode FirstFailure(const std::vector<SweepRow>& rows) {
  for (const SweepRow& row : rows) {
    if (row.code != ExitCode::kSuccess) return row.code;
  }
  return ExitCode::kSuccess;
}

// Follows the solves from solves[first] on, as many as one stream takes.
void FollowSome(Connection& connection, const std::vector<v1::Solve>& solves, size_t first, double reconnect_s,
                Leave& leave, const std::function<void(size_t, const v1::SolveEvent&)>& on_event,
                const std::function<void(const std::string&)>& on_note) {
  std::map<std::string, int64_t> after;
  std::multimap<std::string, size_t> places;
  for (size_t i = first; i < std::min(solves.size(), first + kMostAtOnce); ++i) {
    after[solves[i].name()] =
        std::max<int64_t>(solves[i].last_sequence() - 1, 0);  // its newest event, and what follows
    places.emplace(solves[i].name(), i);
  }
  GroupFollower follower(connection, std::move(after), reconnect_s);
  leave.Attach(&follower);
  try {
    follower.Follow(
        [&](const v1::SolveEvent& event) {
          const auto [begin, end] = places.equal_range(event.name());
          for (auto place = begin; place != end; ++place) on_event(place->second, event);
        },
        on_note);
  } catch (...) {
    leave.Attach(nullptr);
    throw;
  }
  leave.Attach(nullptr);
}

}  // namespace

ExitCode RunSweep(const SweepOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  if (options.spec.file == "-") {
    throw Failure(ExitCode::kUsage, "--spec -: a sweep reads the request once a point; name a file");
  }
  const SweepGrid grid = MakeGrid(options.values);
  std::string name = options.name;
  const std::vector<v1::CreateSolveRequest> requests = Requests(grid, options.spec, options.priority, &name);
  if (global.json && IsStandardOutput(options.csv)) {
    throw Failure(ExitCode::kUsage, "--csv - with --json: both write to standard output; leave one of the two out");
  }
  if (!options.output.empty()) MakeFolder(options.output);

  const bool silent = global.json || global.quiet;
  Progress progress(terminal, silent ? Progress::Style::kSilent : ProgressStyle(global, terminal));
  Leave leave(progress);
  Connection connection(global);
  const auto wait = [&leave](double seconds) { leave.Wait(seconds); };
  const std::vector<v1::Solve> solves =
      options.again ? CreateAgain(connection, requests, wait) : CreateInBatches(connection, requests, wait);
  progress.Note(std::to_string(solves.size()) + " solves, `rollgait list --label " + std::string(kLabel) + "=" + name +
                "` lists them");

  std::vector<SweepRow> rows(solves.size());
  SweepProgress display(progress, grid);
  const auto on_event = [&](size_t place, const v1::SolveEvent& event) {
    display.Show(place, event);
    if (!event.has_finished()) return;
    rows[place] = RowOf(event.finished());
    if (!options.output.empty()) {
      const auto path = std::filesystem::path(options.output) / (grid.points[place].name + ".json");
      WriteSolve(event.finished(), path.string(), terminal.out);
    }
    display.Finished(place, rows[place]);
  };
  try {
    for (size_t first = 0; first < solves.size(); first += kMostAtOnce) {
      FollowSome(connection, solves, first, options.reconnect_s, leave, on_event,
                 [&](const std::string& note) { progress.Note(note); });
    }
  } catch (...) {
    progress.End();
    throw;
  }
  progress.End();
  if (global.json) {
    terminal.out << SweepJson(name, grid, rows).dump() << std::endl;
  } else if (!global.quiet) {
    TextStream(options.csv, terminal) << SweepText(grid, rows) << std::flush;
  }
  if (!options.csv.empty()) WriteDocument(SweepCsv(grid, rows), options.csv, terminal.out);
  return FirstFailure(rows);
}

}  // namespace rollgait::client
