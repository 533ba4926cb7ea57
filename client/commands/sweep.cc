#include "client/commands/sweep.h"

#include <filesystem>

#include "client/commands/follow.h"
#include "client/output.h"
#include "client/sweep/batches.h"
#include "client/sweep/folder.h"
#include "client/sweep/grid.h"
#include "client/sweep/leave.h"
#include "client/sweep/request_digest.h"
#include "client/sweep/solve_group.h"
#include "client/sweep/sweep_table.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr char kLabel[] = "sweep";

// What the sweep asks for, a request a point.
std::vector<v1::CreateSolveRequest> Requests(const SweepGrid& grid, const SpecFlags& base, int priority,
                                             std::string* name) {
  std::vector<v1::CreateSolveRequest> requests;
  std::vector<std::string> specs;  // digests
  for (const SweepPoint& point : grid.points) {
    SpecFlags flags = base;
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

// The first exit code, in the order of the points, that is not success.
ExitCode FirstFailure(const std::vector<SweepRow>& rows) {
  for (const SweepRow& row : rows) {
    if (row.code != ExitCode::kSuccess) return row.code;
  }
  return ExitCode::kSuccess;
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
  if (!options.output.empty()) MakeFolder("--output", options.output);

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
    FollowAll(connection, solves, options.reconnect_s, leave, on_event,
              [&](const std::string& note) { progress.Note(note); });
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
