#include "server/base/supervisor.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <spdlog/common.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "server/base/logging.h"

extern char** environ;

namespace rollgait::server {
namespace {

using SteadyClock = std::chrono::steady_clock;

// Attributes and file actions of posix_spawn, freed at the end.
struct SpawnPlan {
  SpawnPlan() {
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_init(&actions);
  }
  ~SpawnPlan() {
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;

  posix_spawnattr_t attributes;
  posix_spawn_file_actions_t actions;
};

}  // namespace

Outcome<std::unique_ptr<Supervisor>> Supervisor::Start(Options options) {
  ROLLGAIT_CHECK(!options.arguments.empty());
  int lifeline[2];
  if (pipe2(lifeline, O_CLOEXEC) != 0) {
    return Error{ErrorCode::kUnavailable, std::string("cannot make a pipe: ") + std::strerror(errno)};
  }
  std::unique_ptr<Supervisor> supervisor(new Supervisor(std::move(options), lifeline[0], lifeline[1]));
  const Outcome<pid_t> pid = supervisor->Spawn();
  if (!pid.ok()) return pid.error();
  supervisor->pid_ = pid.value();
  supervisor->thread_ = std::thread([raw = supervisor.get()] { raw->Loop(); });
  return supervisor;
}

Supervisor::Supervisor(Options options, int lifeline_read, int lifeline_write)
    : options_(std::move(options)), lifeline_read_(lifeline_read), lifeline_write_(lifeline_write) {}

Supervisor::~Supervisor() {
  if (thread_.joinable()) Stop(std::chrono::milliseconds(0));
  close(lifeline_read_);
  close(lifeline_write_);
}

Outcome<pid_t> Supervisor::Spawn() const {
  SpawnPlan plan;
  posix_spawnattr_setflags(&plan.attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  posix_spawnattr_setpgroup(&plan.attributes, 0);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&plan.attributes, &none);
  posix_spawnattr_setsigdefault(&plan.attributes, &all);
  posix_spawn_file_actions_adddup2(&plan.actions, lifeline_read_, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&plan.actions, STDERR_FILENO, STDOUT_FILENO);
  posix_spawn_file_actions_addclosefrom_np(&plan.actions, STDERR_FILENO + 1);
  std::vector<char*> arguments;
  for (const std::string& argument : options_.arguments) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  pid_t pid = 0;
  const int code = posix_spawn(&pid, arguments[0], &plan.actions, &plan.attributes, arguments.data(), environ);
  if (code != 0) {
    return Error{ErrorCode::kUnavailable, "cannot start " + options_.arguments[0] + ": " + std::strerror(code)};
  }
  LogEvent(spdlog::level::info, "child.started", {{"name", options_.name}, {"pid", pid}});
  return pid;
}

int Supervisor::Wait() {
  // Until it is reaped its number is not used again, so that Stop never signals a stranger.
  siginfo_t info;
  while (waitid(P_PID, static_cast<id_t>(pid()), &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = 0;
  changed_.notify_all();
  return status;
}

void Supervisor::Loop() {
  auto pause = options_.first_pause;
  while (true) {
    const SteadyClock::time_point start = SteadyClock::now();
    const int status = Wait();
    if (SteadyClock::now() - start >= options_.stable) pause = options_.first_pause;
    std::unique_lock<std::mutex> lock(mutex_);
    if (stopping_) return;
    LogEvent(spdlog::level::err, "child.died",
             {{"name", options_.name}, {"reason", DescribeWaitStatus(status)}, {"next_start_ms", pause.count()}});
    while (pid_ == 0) {
      if (changed_.wait_for(lock, pause, [this] { return stopping_; })) return;
      pause = std::min(2 * pause, options_.last_pause);
      const Outcome<pid_t> pid = Spawn();
      if (pid.ok()) {
        pid_ = pid.value();
      } else {
        LogEvent(spdlog::level::err, "child.start_failed",
                 {{"reason", pid.error().message}, {"next_start_ms", pause.count()}});
      }
    }
  }
}

void Supervisor::Stop(std::chrono::milliseconds grace) {
  {
    std::unique_lock<std::mutex> lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
    if (pid_ != 0) kill(pid_, SIGTERM);
    if (!changed_.wait_for(lock, grace, [this] { return pid_ == 0; })) {
      LogEvent(spdlog::level::err, "child.killed", {{"name", options_.name}, {"grace_ms", grace.count()}});
      kill(pid_, SIGKILL);
    }
  }
  thread_.join();
}

pid_t Supervisor::pid() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return pid_;
}

std::string DescribeWaitStatus(int status) {
  if (WIFEXITED(status)) return "exit code " + std::to_string(WEXITSTATUS(status));
  if (WIFSIGNALED(status)) {
    return "signal " + std::to_string(WTERMSIG(status)) + " (" + strsignal(WTERMSIG(status)) + ")";
  }
  return "wait status " + std::to_string(status);
}

}  // namespace rollgait::server
