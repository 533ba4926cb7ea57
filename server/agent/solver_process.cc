#include "server/agent/solver_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "server/base/logging.h"
#include "server/base/process_limits.h"

extern char** environ;

namespace rollgait::server {
namespace {

constexpr int kChildStream = 3;
constexpr size_t kKeptOutput = 1024;

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Closes a descriptor at the end of the scope unless it was taken.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  int get() const { return fd_; }
  int Take() { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

// All that a solver sees of this process's environment, which may hold secrets (PGPASSWORD): where its libraries are
// and what sanitizers are told.
constexpr std::string_view kInherited[] = {
    "LD_LIBRARY_PATH=", "ASAN_OPTIONS=", "LSAN_OPTIONS=", "UBSAN_OPTIONS=", "TSAN_OPTIONS="};

std::vector<std::string> ChildEnvironment() {
  std::vector<std::string> variables(std::begin(kOneThreadVariables), std::end(kOneThreadVariables));
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view variable(*entry);
    for (const std::string_view name : kInherited) {
      if (variable.substr(0, name.size()) == name) variables.emplace_back(variable);
    }
  }
  return variables;
}

std::vector<char*> Pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// The return value of posix_spawn: 0 or an errno.
int SpawnChild(const SolverProcess::Options& options, int stream, int output, pid_t* pid) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&actions, stream, kChildStream);
  posix_spawn_file_actions_addclosefrom_np(&actions, kChildStream + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setpgroup(&attributes, 0);  // Ctrl-C on a terminal reaches the agent only
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);

  std::vector<std::string> arguments = {options.program,
                                        "--fd",
                                        std::to_string(kChildStream),
                                        "--memory-limit-mb",
                                        std::to_string(options.memory_limit_mb),
                                        "--cpu-limit-s",
                                        std::to_string(options.cpu_limit_s)};
  if (options.unconfined) arguments.push_back("--unconfined-solver");
  std::vector<std::string> environment = ChildEnvironment();
  const int failure = posix_spawn(pid, options.program.c_str(), &actions, &attributes, Pointers(arguments).data(),
                                  Pointers(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return failure;
}

Error Unavailable(const std::string& what, int reason) {
  return {ErrorCode::kUnavailable, what + ": " + std::strerror(reason)};
}

void SetNonBlocking(int fd) { fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) | O_NONBLOCK); }

}  // namespace

Outcome<SolverProcess> SolverProcess::Spawn(const Options& options) {
  std::array<int, 2> stream, output;
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, stream.data()) != 0) {
    return Unavailable("cannot make a socket pair for a solver", errno);
  }
  Descriptor stream_ours(stream[0]), stream_child(stream[1]);
  if (pipe2(output.data(), O_CLOEXEC) != 0) return Unavailable("cannot make a pipe for a solver", errno);
  Descriptor output_ours(output[0]), output_child(output[1]);
  SetNonBlocking(stream[0]);
  SetNonBlocking(output[0]);
  // dup2 onto a number that one of the two has already would close the other or clear nothing: move them out of the
  // way.
  Descriptor stream_high(fcntl(stream[1], F_DUPFD_CLOEXEC, 10)), output_high(fcntl(output[1], F_DUPFD_CLOEXEC, 10));
  if (stream_high.get() < 0 || output_high.get() < 0)
    return Unavailable("cannot copy a descriptor for a solver", errno);
  pid_t pid = 0;
  const int failure = SpawnChild(options, stream_high.get(), output_high.get(), &pid);
  if (failure != 0) return Unavailable("cannot start " + options.program, failure);
  return SolverProcess(pid, stream_ours.Take(), output_ours.Take());
}

SolverProcess::SolverProcess(SolverProcess&& other) noexcept : SolverProcess(0, -1, -1) { Swap(other); }

SolverProcess& SolverProcess::operator=(SolverProcess&& other) noexcept {
  SolverProcess taken(std::move(other));
  Swap(taken);  // what was here dies with `taken`
  return *this;
}

void SolverProcess::Swap(SolverProcess& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(stream_fd_, other.stream_fd_);
  std::swap(output_fd_, other.output_fd_);
  std::swap(parser_, other.parser_);
  std::swap(unsent_, other.unsent_);
  std::swap(output_, other.output_);
  std::swap(line_, other.line_);
  std::swap(logged_lines_, other.logged_lines_);
}

SolverProcess::~SolverProcess() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  if (stream_fd_ >= 0) close(stream_fd_);
  if (output_fd_ >= 0) close(output_fd_);
}

void SolverProcess::Send(std::string_view request) {
  unsent_ += EncodeFrame(request);
  Write();
}

void SolverProcess::Write() {
  while (!unsent_.empty()) {
    const ssize_t count = send(stream_fd_, unsent_.data(), unsent_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
    if (count < 0) {
      unsent_.clear();
      return;
    }
    unsent_.erase(0, static_cast<size_t>(count));
  }
}

FrameStatus SolverProcess::Receive(std::vector<std::string>* payloads) {
  size_t bytes = 0;
  while (bytes < kAtOnce) {
    const FrameStatus read = ReadAvailable(stream_fd_, &parser_);
    if (read != FrameStatus::kOk) return read;
    std::string payload;
    FrameStatus parsed = parser_.Next(&payload);
    while (parsed == FrameStatus::kOk) {
      bytes += payload.size() + 1;  // empty ones count too
      payloads->push_back(std::move(payload));
      payload.clear();
      parsed = parser_.Next(&payload);
    }
    if (parsed != FrameStatus::kNeedMore) return parsed;
  }
  return FrameStatus::kNeedMore;
}

void SolverProcess::ReadOutput() {
  std::array<char, 4096> buffer;
  while (output_fd_ >= 0) {
    const ssize_t count = read(output_fd_, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
    if (count <= 0) {  // the end: not to be polled any more
      close(output_fd_);
      output_fd_ = -1;
      return;
    }
    output_.append(buffer.data(), static_cast<size_t>(count));
    LogLines({buffer.data(), static_cast<size_t>(count)});
    if (output_.size() > kKeptOutput) output_.erase(0, output_.size() - kKeptOutput);
  }
}

void SolverProcess::LogLines(std::string_view text) {
  for (const char c : text) {
    if (c != '\n') {
      if (line_.size() < kKeptOutput) line_ += c;
      continue;
    }
    const std::string line = std::exchange(line_, std::string());
    if (line.empty() || logged_lines_ > kMaxLoggedLines) continue;
    const bool last = logged_lines_++ == kMaxLoggedLines;
    LogEvent(spdlog::level::warn, "solver.printed",
             {{"pid", pid_}, {"text", last ? std::string("more lines are not logged") : line}});
  }
}

std::string SolverProcess::LastOutput() const {
  constexpr size_t kLength = 300;
  std::string text = output_.size() > kLength ? output_.substr(output_.size() - kLength) : output_;
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  for (char& c : text) {
    if (c == '\n') c = ' ';
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

void SolverProcess::Kill(int signal) {
  if (pid_ > 0) kill(pid_, signal);
}

std::optional<ProcessEnd> SolverProcess::Reap() {
  if (pid_ <= 0) return std::nullopt;
  ProcessEnd end;
  rusage usage{};
  if (wait4(pid_, &end.wait_status, WNOHANG, &usage) != pid_) return std::nullopt;
  pid_ = 0;
  end.cpu_time_s = Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
  end.peak_memory_bytes = int64_t{1024} * usage.ru_maxrss;
  return end;
}

}  // namespace rollgait::server
