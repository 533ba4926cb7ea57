#ifndef ROLLGAIT_TESTS_E2E_FAR_AGENT_H_
#define ROLLGAIT_TESTS_E2E_FAR_AGENT_H_

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <string>
#include <utility>
#include <vector>

#include "rollgait/v1/gait_service.grpc.pb.h"

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

// What a watcher has seen, over any number of servers.
struct Seen {
  int64_t last = 0;
  bool dense = true;
  int iterations = 0;
  std::vector<std::pair<int, int>> places = {};  // mesh and index of the iterations
  v1::Solve finished;
};

// Watches on; stops once so many iterations were seen (0: at the end).
inline grpc::Status WatchOn(v1::GaitService::Stub& stub, const std::string& name, Seen& seen, int enough = 0) {
  grpc::ClientContext context;
  v1::WatchSolveRequest request;
  request.set_name(name);
  request.set_after_sequence(seen.last);
  const auto stream = stub.WatchSolve(&context, request);
  v1::SolveEvent event;
  const auto is_enough = [&] { return enough > 0 && seen.iterations >= enough; };
  while (!is_enough() && stream->Read(&event)) {
    if (event.has_heartbeat()) continue;
    seen.dense = seen.dense && event.sequence() == seen.last + event.skipped_count() + 1;
    seen.last = event.sequence();
    seen.iterations += event.has_iteration() ? 1 + event.skipped_count() : 0;
    if (event.has_iteration()) seen.places.emplace_back(event.iteration().mesh(), event.iteration().index());
    if (event.has_finished()) seen.finished = event.finished();
  }
  if (is_enough()) context.TryCancel();
  return stream->Finish();
}

inline std::string CreateSolve(v1::GaitService::Stub& stub, const v1::SolveSpec& spec) {
  grpc::ClientContext context;
  v1::CreateSolveRequest request;
  *request.mutable_spec() = spec;
  v1::Solve solve;
  const grpc::Status status = stub.CreateSolve(&context, request, &solve);
  EXPECT_TRUE(status.ok()) << status.error_message();
  return solve.name();
}

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_E2E_FAR_AGENT_H_
