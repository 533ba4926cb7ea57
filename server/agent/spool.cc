#include "server/agent/spool.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "server/base/framing.h"
#include "server/base/journal_limits.h"
#include "server/base/logging.h"
#include "server/base/wire.pb.h"

namespace rollgait::server {
namespace {

constexpr const char* kSuffix = ".end";
constexpr const char* kJournalSuffix = ".journal";
constexpr const char* kTemporary = ".tmp";

Error Unavailable(const std::string& what) { return {ErrorCode::kUnavailable, what + ": " + std::strerror(errno)}; }

std::string Encode(const PendingEnd& pending) {
  wire::SpooledEnd spooled;
  spooled.set_solve_id(pending.lease.solve_id);
  spooled.set_owner(pending.lease.owner);
  spooled.set_epoch(pending.lease.epoch);
  spooled.set_state(static_cast<int>(pending.end.state));
  spooled.set_result(pending.end.result);
  spooled.set_error(pending.end.error);
  spooled.set_reusable(pending.end.reusable);
  for (const StoredEvent& event : pending.events) spooled.add_iterations(event.payload);
  if (!pending.events.empty()) spooled.set_first_sequence(pending.events.front().sequence);
  return spooled.SerializeAsString();
}

// False if the bytes are not an end.
bool Decode(const std::string& bytes, PendingEnd* pending) {
  wire::SpooledEnd spooled;
  if (!spooled.ParseFromString(bytes) || spooled.solve_id().empty()) return false;
  const auto state = static_cast<SolveState>(spooled.state());
  if (state != SolveState::kSucceeded && state != SolveState::kFailed && state != SolveState::kCancelled) return false;
  pending->lease = {spooled.solve_id(), spooled.owner(), spooled.epoch()};
  pending->end = {state, spooled.result(), spooled.error(), spooled.reusable()};
  int64_t sequence = spooled.first_sequence();
  for (const std::string& payload : spooled.iterations()) {
    pending->events.push_back({sequence, EventKind::kIteration, payload});
    if (sequence > 0) ++sequence;
  }
  return true;
}

// Reads one file written by Write: a frame and nothing after it.
bool ReadFile(const std::string& path, std::string* payload) {
  std::ifstream file(path, std::ios::binary);
  FrameParser parser;
  parser.Append(std::string(std::istreambuf_iterator<char>(file), {}));
  return parser.Next(payload) == FrameStatus::kOk && parser.AtBoundary();
}

bool ReadFile(const std::string& path, PendingEnd* pending) {
  std::string payload;
  return ReadFile(path, &payload) && Decode(payload, pending);
}

// A file that is too long is none of ours, and not worth its memory.
bool ReadFile(const std::string& path, wire::SpooledJournal* journal) {
  std::error_code failure;
  const auto size = std::filesystem::file_size(path, failure);
  std::string payload;
  return !failure && size <= kMaxJournalBytes + 65536 && ReadFile(path, &payload) && journal->ParseFromString(payload);
}

// Removes what an agent that died has left half written.
void RemoveIfLeft(const std::string& path) {
  const int fd = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (fd < 0) return;
  if (flock(fd, LOCK_EX | LOCK_NB) == 0) unlink(path.c_str());
  close(fd);
}

// Makes names in a directory durable.
bool SyncDirectory(const std::string& directory) {
  const int fd = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return false;
  const bool synced = fsync(fd) == 0;
  close(fd);
  return synced;
}

}  // namespace

Outcome<Spool> Spool::Open(const std::string& directory) {
  if (mkdir(directory.c_str(), 0700) != 0 && errno != EEXIST) return Unavailable("cannot make " + directory);
  return Spool(directory);
}

std::string Spool::Path(const Lease& lease, const char* suffix) const {
  return directory_ + "/" + lease.solve_id + "-" + std::to_string(lease.epoch) + suffix;
}

Outcome<Done> Spool::Put(const PendingEnd& pending) const {
  return Write(Path(pending.lease, kSuffix), Encode(pending), true);
}

Outcome<Done> Spool::Write(const std::string& path, const std::string& payload, bool durable) const {
  const std::string temporary = path + kTemporary;
  const int fd = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (fd < 0) return Unavailable("cannot make " + temporary);
  // Held while it is written: one that nobody holds was left by an agent that died (ReadAll).
  if (flock(fd, LOCK_EX) != 0) {
    const Error error = Unavailable("cannot lock " + temporary);
    close(fd);
    return error;
  }
  const bool written = WriteFrame(fd, payload) == FrameStatus::kOk && (!durable || fsync(fd) == 0);
  const int reason = errno;
  close(fd);
  errno = written ? errno : reason;
  if (!written || rename(temporary.c_str(), path.c_str()) != 0 || (durable && !SyncDirectory(directory_))) {
    const Error error = Unavailable("cannot write " + path);
    unlink(temporary.c_str());
    return error;
  }
  return Done{};
}

void Spool::Remove(const Lease& lease) const { unlink(Path(lease, kSuffix).c_str()); }

std::vector<PendingEnd> Spool::ReadAll() const {
  std::vector<PendingEnd> ends;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(directory_, failure)) {
    if (entry.path().extension() == kTemporary) RemoveIfLeft(entry.path().string());
    if (entry.path().extension() != kSuffix) continue;
    PendingEnd pending;
    if (ReadFile(entry.path().string(), &pending)) {
      ends.push_back(std::move(pending));
      continue;
    }
    const std::string aside = entry.path().string() + ".bad";
    spdlog::error("{} is damaged; renamed to {}", entry.path().string(), aside);
    rename(entry.path().c_str(), aside.c_str());
  }
  if (failure) spdlog::error("cannot list {}: {}", directory_, failure.message());
  return ends;
}

std::vector<Spool::JournalFile> Spool::JournalFiles() const {
  std::vector<JournalFile> files;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(directory_, failure)) {
    if (entry.path().extension() != kJournalSuffix) continue;
    const std::string stem = entry.path().stem().string();
    const size_t dash = stem.rfind('-');
    if (dash == std::string::npos) continue;
    JournalFile file{entry.path().string(), stem.substr(0, dash)};
    const char* end = stem.data() + stem.size();
    const auto parsed = std::from_chars(stem.data() + dash + 1, end, file.epoch);
    if (parsed.ec == std::errc() && parsed.ptr == end) files.push_back(std::move(file));
  }
  if (failure) spdlog::error("cannot list {}: {}", directory_, failure.message());
  return files;
}

Outcome<Done> Spool::PutJournal(const Lease& lease, const wire::SpooledJournal& journal) const {
  const std::string path = Path(lease, kJournalSuffix);
  const bool is_first = access(path.c_str(), F_OK) != 0;
  Outcome<Done> written = Write(path, journal.SerializeAsString(), false);
  if (!written.ok() || !is_first) return written;
  for (const JournalFile& file : JournalFiles()) {
    if (file.solve_id == lease.solve_id && file.epoch < lease.epoch) unlink(file.path.c_str());
  }
  return written;
}

std::optional<KeptJournal> Spool::NewestJournal(const std::string& solve_id) const {
  std::optional<KeptJournal> newest;
  for (const JournalFile& file : JournalFiles()) {
    if (file.solve_id != solve_id || (newest && file.epoch < newest->epoch)) continue;
    KeptJournal journal{file.epoch, {}};
    if (!ReadFile(file.path, &journal.content) || journal.content.solve_id() != solve_id) {
      LogEvent(spdlog::level::warn, "solve.journal_damaged", {{"path", file.path}});
      unlink(file.path.c_str());
      continue;
    }
    newest = std::move(journal);
  }
  return newest;
}

void Spool::RemoveJournals(const std::string& solve_id) const {
  for (const JournalFile& file : JournalFiles()) {
    if (file.solve_id == solve_id) unlink(file.path.c_str());
  }
}

std::vector<std::string> Spool::JournalOwners() const {
  std::vector<std::string> ids;
  for (const JournalFile& file : JournalFiles()) {
    if (std::find(ids.begin(), ids.end(), file.solve_id) == ids.end()) ids.push_back(file.solve_id);
  }
  return ids;
}

std::vector<std::string> ReplaySpool(const Spool& spool, SolveStore& store,
                                     const std::function<bool(const std::string& owner)>& is_dead) {
  std::vector<std::string> committed;
  for (const PendingEnd& pending : spool.ReadAll()) {
    if (!is_dead(pending.lease.owner)) continue;
    const Outcome<Done> finished = store.Finish(pending.lease, pending.events, pending.end);
    if (finished.ok()) {
      committed.push_back(pending.lease.solve_id);
    } else if (finished.error().code != ErrorCode::kLeaseLost) {
      LogEvent(spdlog::level::warn, "solve.end_stays_in_spool",
               {{"solve", pending.lease.solve_id}, {"reason", finished.error().message}});
      continue;
    }
    spool.Remove(pending.lease);
  }
  return committed;
}

}  // namespace rollgait::server
