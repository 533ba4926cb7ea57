#ifndef ROLLGAIT_TESTS_E2E_FAR_AGENT_H_
#define ROLLGAIT_TESTS_E2E_FAR_AGENT_H_

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <string>
#include <vector>

extern char** environ;

namespace rollgait::server {

// A rollgait-agent as on another machine: the database is all that it has in common with the others.
class FarAgent {
 public:
  FarAgent(const std::string& url, const std::string& work_dir, const std::string& solver) {
    std::vector<std::string> arguments = {
        ROLLGAIT_AGENT, "--store", url,         "--work-dir", work_dir,      "--slots", "2",
        "--solver",     solver,    "--lease-s", "3",          "--log-level", "error"};
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    EXPECT_EQ(posix_spawn(&pid_, pointers[0], &actions, nullptr, pointers.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
  }
  ~FarAgent() {
    if (pid_ != 0) End(SIGKILL);
  }
  FarAgent(const FarAgent&) = delete;
  FarAgent& operator=(const FarAgent&) = delete;

  void Signal(int signal) { kill(pid_, signal); }
  // Sends a signal that ends it; returns its wait status.
  int End(int signal) {
    int status = 0;
    kill(pid_, signal);
    EXPECT_EQ(waitpid(pid_, &status, 0), pid_);
    pid_ = 0;
    return status;
  }

 private:
  pid_t pid_ = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_E2E_FAR_AGENT_H_
