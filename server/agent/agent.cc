#include "server/agent/agent.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spdlog/common.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <random>
#include <utility>

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kSpawnRetry{1000};    // after a solver that did not start or died without work
constexpr milliseconds kStartLimit{30'000};  // for a solver to say that it is ready

// "agent-<pid>-<random>": unique among all agents that ever used the directory.
std::string NewOwner() {
  std::random_device random;
  char text[64];
  std::snprintf(text, sizeof text, "agent-%d-%08x%08x", static_cast<int>(getpid()), random(), random());
  return text;
}

// True once the other end is closed; nobody ever writes.
bool AtEnd(int fd) {
  if (fd < 0) return false;
  pollfd entry{fd, POLLIN, 0};
  if (poll(&entry, 1, 0) <= 0) return false;
  char byte;
  const ssize_t count = read(fd, &byte, 1);
  return count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN);
}

bool Readable(int fd) {
  pollfd entry{fd, POLLIN, 0};
  return fd >= 0 && poll(&entry, 1, 0) > 0;
}

Outcome<std::unique_ptr<RunningSolver>> StartProcess(const SolverProcess::Options& options) {
  Outcome<SolverProcess> process = SolverProcess::Spawn(options);
  if (!process.ok()) return process.error();
  return std::unique_ptr<RunningSolver>(std::make_unique<SolverProcess>(std::move(process).value()));
}

}  // namespace

Outcome<std::unique_ptr<Agent>> Agent::Create(const Options& options, const Surroundings& surroundings) {
  const DataDir directory{options.work_dir};
  if (mkdir(directory.AgentsDir().c_str(), 0700) != 0 && errno != EEXIST) {
    return Error{ErrorCode::kUnavailable, "cannot make " + directory.AgentsDir() + ": " + std::strerror(errno)};
  }
  std::string owner = options.owner.empty() ? NewOwner() : options.owner;
  Outcome<std::optional<FileLock>> lock = FileLock::TryAcquire(directory.AgentLock(owner));
  if (!lock.ok()) return lock.error();
  if (!lock.value()) return Error{ErrorCode::kInternal, directory.AgentLock(owner) + " is locked by another process"};
  const Outcome<Done> iterates = IterateFiles(directory.IteratesDir()).MakeDirectory();
  if (!iterates.ok()) return iterates.error();
  Outcome<Spool> spool = Spool::Open(options.work_dir + "/spool");
  if (!spool.ok()) return spool.error();
  return std::unique_ptr<Agent>(
      new Agent(options, surroundings, std::move(owner), std::move(*lock.value()), std::move(spool).value()));
}

Agent::Agent(const Options& options, const Surroundings& surroundings, std::string owner, FileLock lock, Spool spool)
    : options_(options),
      store_(surroundings.store),
      owner_(std::move(owner)),
      lock_(std::move(lock)),
      spool_(std::move(spool)),
      iterates_(DataDir{options.work_dir}.IteratesDir()),
      hints_(surroundings.hints),
      context_{.store = surroundings.store,
               .spool = spool_,
               .iterates = iterates_,
               .clock = surroundings.clock,
               .poke = [this](const std::string& id) { hints_.Send(id); },
               .kill_after = options.kill_after,
               .wall_grace = options.wall_grace,
               .lease = options.lease,
               .max_event_bytes = options.max_event_bytes,
               .cpu_limit_s = static_cast<double>(options.solver.cpu_limit_s),
               .journals = options.all_agents_here ? RunJournal::Elsewhere::kNowhere : RunJournal::Elsewhere::kInStore,
               .solver_fingerprint = options.solver_fingerprint},
      start_solver_(surroundings.start_solver ? surroundings.start_solver
                                              : [solver = options.solver] { return StartProcess(solver); }) {}

Agent::~Agent() {
  GiveUpAll();
  unlink(DataDir{options_.work_dir}.AgentDraining(owner_).c_str());
  lock_.ReleaseAndRemove();
}

void Agent::Run() {
  Start();
  while (Step(std::chrono::hours(1))) {
  }
}

void Agent::Start() {
  ReplayDead("");
  RemoveOldJournals();
  RemoveOldIterates();
}

bool Agent::Step(milliseconds at_most) {
  Wait(at_most);
  bool goes_on = Turn(std::chrono::steady_clock::now());
  while (goes_on && stopping_) {
    Wait(milliseconds(100));
    goes_on = Turn(std::chrono::steady_clock::now());
  }
  return goes_on;
}

bool Agent::Turn(SteadyTime now) {
  if (!stopping_ && Readable(options_.stop_fd)) Stop(now);
  if (stopping_) return GoOnStopping(now);
  if (!draining_ && AtEnd(options_.lifeline_fd)) {
    Drain();
  }
  if (!hints_.Drain().empty()) poked_ = true;
  const size_t before = runs_.size();
  ServiceRuns(now);
  if (draining_ && runs_.empty()) return false;
  if (!draining_ && now >= reclaim_at_) LookAfterOthers(now);
  if (poked_ || now >= look_at_ || runs_.size() < before) {
    poked_ = false;
    look_at_ = now + options_.look;
    LookForCancels();
    if (!draining_) ClaimWork(now);
  }
  if (!draining_) KeepIdleProcesses(now);
  return true;
}

// Solvers have a moment to keep what they have come to.
void Agent::Stop(SteadyTime now) {
  if (stopping_) return;
  stopping_ = true;
  idle_.clear();
  stop_end_ = now + options_.kill_after + milliseconds(1000);
  for (const auto& run : runs_) run->Stop();
}

bool Agent::GoOnStopping(SteadyTime now) {
  if (!runs_.empty() && now < stop_end_) ServiceRuns(now);
  if (!runs_.empty() && now < stop_end_) return true;
  GiveUpAll();
  return false;
}

void Agent::Drain() {
  LogEvent(spdlog::level::warn, "agent.drains", {{"reason", "rollgaitd has gone"}, {"running", runs_.size()}});
  draining_ = true;
  idle_.clear();
  const std::string mark = DataDir{options_.work_dir}.AgentDraining(owner_);
  const int fd = open(mark.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (fd < 0) {
    LogEvent(spdlog::level::warn, "agent.mark_failed",
             {{"path", mark}, {"reason", std::strerror(errno)}});  // the next agent may start more than its slots
  } else {
    close(fd);
  }
}

void Agent::Wait(milliseconds at_most) {
  std::vector<pollfd> entries;
  if (!stopping_) {
    entries = {{hints_.fd(), POLLIN, 0}, {options_.stop_fd, POLLIN, 0}};
    entries.push_back({draining_ ? -1 : options_.lifeline_fd, POLLIN, 0});
  }
  for (const auto& run : runs_) {
    const RunningSolver& process = run->process();
    const short writing = process.wants_to_write() ? POLLOUT : 0;
    // A stream that has ended stays readable: then NextDue sets the pace.
    entries.push_back({run->stream_ended() ? -1 : process.stream_fd(), static_cast<short>(POLLIN | writing), 0});
    entries.push_back({process.output_fd(), POLLIN, 0});
  }
  for (const IdleProcess& idle : idle_) entries.push_back({idle.process->stream_fd(), POLLIN, 0});
  const SteadyTime now = std::chrono::steady_clock::now();
  milliseconds timeout = std::chrono::ceil<milliseconds>(NextDue(now) - now);
  timeout = std::clamp(timeout, milliseconds(0), at_most);
  poll(entries.data(), entries.size(), static_cast<int>(timeout.count()));
}

SteadyTime Agent::NextDue(SteadyTime now) const {
  SteadyTime due = stopping_ ? stop_end_ : poked_ ? now : look_at_;
  if (!draining_ && !stopping_) {
    due = std::min(due, reclaim_at_);
    const size_t wanted = static_cast<size_t>(std::max(1, options_.slots - running()));
    if (idle_.size() < wanted) due = std::min(due, spawn_at_);
  }
  for (const auto& run : runs_) due = std::min(due, run->NextDue(now));
  return due;
}

void Agent::ServiceRuns(SteadyTime now) {
  for (const auto& run : runs_) run->Service(now);
  StoreEvents(now);
  const auto never_began = [](const auto& run) { return run->over() && run->never_began(); };
  // Who kills solvers that wait would kill the next one, too.
  if (std::any_of(runs_.begin(), runs_.end(), never_began)) spawn_at_ = std::max(spawn_at_, now + kSpawnRetry);
  std::erase_if(runs_, [](const auto& run) { return run->over(); });
}

// One transaction for all: every commit waits for the disk.
void Agent::StoreEvents(SteadyTime now) {
  const auto is_due = [now](const auto& run) { return run->events_due(now); };
  if (std::none_of(runs_.begin(), runs_.end(), is_due)) return;
  std::vector<SolveRun*> runs;
  std::vector<EventBatch> batches;
  for (const auto& run : runs_) {
    EventBatch batch = run->Events();
    if (batch.events.empty()) {
      run->NoEvents(now);
      continue;
    }
    runs.push_back(run.get());
    batches.push_back(std::move(batch));
  }
  if (batches.empty()) return;
  const Outcome<std::vector<Outcome<LeaseState>>> outcomes = store_.AppendAll(batches);
  for (size_t i = 0; i < runs.size(); ++i) {
    runs[i]->EventsStored(outcomes.ok() ? outcomes.value()[i] : Outcome<LeaseState>(outcomes.error()), now);
  }
}

void Agent::LookForCancels() {
  if (runs_.empty()) return;
  const Outcome<std::vector<std::string>> ids = store_.CancelRequests(owner_);
  if (!ids.ok()) {
    StoreFailed("cancellations", ids.error());
    return;
  }
  for (const auto& run : runs_) {
    if (std::find(ids.value().begin(), ids.value().end(), run->id()) != ids.value().end()) run->Cancel();
  }
}

// Notes who is ready and removes who has died.
void Agent::HearIdleProcesses(SteadyTime now) {
  const size_t before = idle_.size();
  std::erase_if(idle_, [&](IdleProcess& idle) {
    std::vector<std::string> payloads;
    idle.process->ReadOutput();
    const FrameStatus status = idle.process->Receive(&payloads);
    if (!payloads.empty() && !idle.ready) idle.ready = poked_ = true;
    if (idle.process->Reap()) {
      LogEvent(spdlog::level::err, "solver.died_idle", {{"reason", idle.process->LastOutput()}});
      return true;
    }
    if (status != FrameStatus::kNeedMore || (!idle.ready && now > idle.since + kStartLimit))
      idle.process->Kill(SIGKILL);
    return false;
  });
  if (idle_.size() < before) spawn_at_ = std::max(spawn_at_, now + kSpawnRetry);
}

void Agent::KeepIdleProcesses(SteadyTime now) {
  HearIdleProcesses(now);
  const size_t wanted = static_cast<size_t>(std::max(1, options_.slots - running()));
  while (idle_.size() < wanted && now >= spawn_at_) {
    Outcome<std::unique_ptr<RunningSolver>> process = start_solver_();
    if (!process.ok()) {
      LogEvent(spdlog::level::err, "solver.start_failed", {{"reason", process.error().message}});
      spawn_at_ = now + kSpawnRetry;
      return;
    }
    idle_.push_back({std::move(process).value(), now});
  }
}

void Agent::ClaimWork(SteadyTime now) {
  while (running() < options_.slots) {
    HearIdleProcesses(now);  // a claim is handed to nobody who is known to be dead
    const auto idle = std::find_if(idle_.begin(), idle_.end(), [](const IdleProcess& i) { return i.ready; });
    if (idle == idle_.end() || running() + RunByDrainingAgents() >= options_.slots) return;
    Outcome<std::optional<ClaimedSolve>> claimed = store_.ClaimNext(owner_, options_.lease);
    if (!claimed.ok()) {
      StoreFailed("a claim", claimed.error());
      return;
    }
    if (!claimed.value()) return;
    std::unique_ptr<RunningSolver> process = std::move(idle->process);
    idle_.erase(idle);
    runs_.push_back(std::make_unique<SolveRun>(context_, std::move(*claimed.value()), std::move(process), now));
    context_.poke(runs_.back()->id());
  }
}

void Agent::GiveUpAll() {
  for (const auto& run : runs_) run->GiveUp();
  runs_.clear();
  idle_.clear();
}

std::vector<pid_t> Agent::IdleProcesses() const {
  std::vector<pid_t> pids;
  for (const IdleProcess& idle : idle_) {
    if (idle.ready) pids.push_back(idle.process->pid());
  }
  return pids;
}

}  // namespace rollgait::server
