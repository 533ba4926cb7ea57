#include "tests/client/client_process.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace rollgait::client {
namespace {

constexpr int kPatience_ms = 30000;

void Require(bool done, const char* what) {
  if (!done) throw std::runtime_error(what);
}

}  // namespace

ClientProcess::ClientProcess(const std::vector<std::string>& arguments, const Options& options) {
  int out[2], err[2];
  Require(pipe2(out, O_CLOEXEC) == 0, "pipe2");
  if (options.terminal) {
    winsize size{};
    size.ws_col = 60;
    size.ws_row = 20;
    Require(openpty(&err[0], &err[1], nullptr, nullptr, &size) == 0, "openpty");
    fcntl(err[0], F_SETFD, FD_CLOEXEC);
    fcntl(err[1], F_SETFD, FD_CLOEXEC);
  } else {
    Require(pipe2(err, O_CLOEXEC) == 0, "pipe2");
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);

  std::vector<std::string> words = {ROLLGAIT_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> environment = {"TERM=xterm"};
  bool configured = false;
  for (const std::string& variable : options.environment) {
    configured = configured || variable.rfind("ROLLGAIT_CONFIG=", 0) == 0 || variable.rfind("XDG_CONFIG_HOME=", 0) == 0;
  }
  if (!configured) environment.push_back("ROLLGAIT_CONFIG=");  // not that of whoever runs the test
  for (const char* const name : {"PATH", "HOME", "LD_LIBRARY_PATH", "ASAN_OPTIONS", "LSAN_OPTIONS", "UBSAN_OPTIONS"}) {
    if (const char* const value = std::getenv(name)) environment.push_back(std::string(name) + "=" + value);
  }
  environment.insert(environment.end(), options.environment.begin(), options.environment.end());
  const auto pointers = [](std::vector<std::string>& strings) {
    std::vector<char*> list;
    for (std::string& string : strings) list.push_back(string.data());
    list.push_back(nullptr);
    return list;
  };
  const int failed =
      posix_spawn(&pid_, ROLLGAIT_PROGRAM, &actions, nullptr, pointers(words).data(), pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  close(out[1]);
  close(err[1]);
  out_fd_ = out[0];
  err_fd_ = err[0];
  Require(failed == 0, "posix_spawn " ROLLGAIT_PROGRAM);
}

ClientProcess::~ClientProcess() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  if (out_fd_ >= 0) close(out_fd_);
  if (err_fd_ >= 0) close(err_fd_);
}

// Reads what there is; false when both streams are closed or nothing came in time.
bool ClientProcess::Read(int timeout_ms) {
  pollfd files[2] = {{out_fd_, POLLIN, 0}, {err_fd_, POLLIN, 0}};
  if ((out_fd_ < 0 && err_fd_ < 0) || poll(files, 2, timeout_ms) <= 0) return false;
  int* const descriptors[2] = {&out_fd_, &err_fd_};
  std::string* const texts[2] = {&out_, &err_};
  for (int i = 0; i < 2; ++i) {
    if (*descriptors[i] < 0 || files[i].revents == 0) continue;
    char buffer[4096];
    const ssize_t count = read(*descriptors[i], buffer, sizeof(buffer));
    if (count > 0) {
      texts[i]->append(buffer, static_cast<size_t>(count));
    } else {  // The end; a closed terminal says so with EIO.
      close(*descriptors[i]);
      *descriptors[i] = -1;
    }
  }
  return true;
}

bool ClientProcess::WaitForError(const std::string& text) {
  while (err_.find(text) == std::string::npos) {
    if (err_fd_ < 0 || !Read(kPatience_ms)) return false;
  }
  return true;
}

void ClientProcess::Signal(int signal) { kill(pid_, signal); }

int ClientProcess::Wait() {
  while (Read(kPatience_ms)) {
  }
  int status = 0;
  if (out_fd_ >= 0 || err_fd_ >= 0) kill(pid_, SIGKILL);  // It did not end in time.
  waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

Ended RunToEnd(const std::vector<std::string>& arguments) {
  ClientProcess client(arguments);
  const int code = client.Wait();
  return {code, client.out(), client.err()};
}

}  // namespace rollgait::client
