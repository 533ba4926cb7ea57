// The program rollgait-solve with the solver in it, as the agent starts it.
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include "rollgait/v1/solve_spec.pb.h"
#include "server/agent/solver_process.h"
#include "server/base/cancel_signal.h"
#include "server/base/sanitized.h"
#include "server/base/wire.pb.h"

namespace rollgait::server {
namespace {

std::string Request(int intervals) {
  v1::SolveSpec spec;
  spec.mutable_model()->set_name("planar");
  spec.mutable_accuracy()->set_level(v1::Accuracy::LEVEL_DRAFT);
  spec.mutable_discretization()->set_single_support_intervals(intervals);
  return spec.SerializeAsString();
}

struct Answer {
  int iterations = 0;
  wire::SolverMessage last;
  ProcessEnd end;
};

// Solves in a process; `on_iteration` is called after each.
template <typename OnIteration>
Answer Ask(const SolverProcess::Options& options, const std::string& request, OnIteration on_iteration) {
  Answer answer;
  Outcome<SolverProcess> spawned = SolverProcess::Spawn(options);
  EXPECT_TRUE(spawned.ok());
  SolverProcess process = std::move(spawned).value();
  process.Send(request);
  process.Send("");  // the solve begins
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  FrameStatus status = FrameStatus::kNeedMore;
  while (std::chrono::steady_clock::now() < give_up) {
    pollfd entry{process.stream_fd(), POLLIN, 0};
    poll(&entry, 1, 10);
    std::vector<std::string> payloads;
    if (status == FrameStatus::kNeedMore) status = process.Receive(&payloads);
    for (const std::string& payload : payloads) {
      EXPECT_TRUE(answer.last.ParseFromString(payload));
      if (!answer.last.has_iteration()) continue;
      ++answer.iterations;
      on_iteration(process);
    }
    if (const auto end = process.Reap()) {
      answer.end = *end;
      return answer;
    }
  }
  ADD_FAILURE() << "the solver does not end";
  return answer;
}

SolverProcess::Options Options() { return {ROLLGAIT_SOLVE, 4096, 600}; }

TEST(SolveProgram, SolvesOneRequest) {
  const Answer answer = Ask(Options(), Request(4), [](SolverProcess&) {});
  EXPECT_GT(answer.iterations, 3);
  ASSERT_TRUE(answer.last.has_result()) << answer.last.DebugString();
  EXPECT_EQ(answer.last.result().termination(), v1::TERMINATION_OPTIMAL) << answer.last.result().message();
  EXPECT_TRUE(answer.last.result().has_accuracy());
  EXPECT_TRUE(WIFEXITED(answer.end.wait_status));
}

// The value of a line "Name:\tvalue" of /proc/PID/status.
std::string StatusOf(pid_t pid, const std::string& name) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(name + ":\t", 0) == 0) return line.substr(name.size() + 2);
  }
  return "";
}

TEST(SolveProgram, ItIsConfinedBeforeItReadsTheRequest) {
  for (const bool unconfined : {false, true}) {
    SolverProcess::Options options = Options();
    options.unconfined = unconfined;
    Outcome<SolverProcess> process = SolverProcess::Spawn(options);
    ASSERT_TRUE(process.ok());
    std::vector<std::string> payloads;
    while (payloads.empty()) {  // it says that it is ready
      pollfd entry{process.value().stream_fd(), POLLIN, 0};
      ASSERT_EQ(poll(&entry, 1, 120'000), 1);
      ASSERT_EQ(process.value().Receive(&payloads), FrameStatus::kNeedMore);
    }
    EXPECT_EQ(StatusOf(process.value().pid(), "Seccomp"), unconfined ? "0" : "2");
    EXPECT_EQ(StatusOf(process.value().pid(), "NoNewPrivs"), "1");
    EXPECT_EQ(StatusOf(process.value().pid(), "Threads"), "1");  // no library has started one
  }
}

TEST(SolveProgram, TheCancelSignalEndsItWithACancelledResult) {
  const Answer answer = Ask(Options(), Request(100), [](SolverProcess& process) { process.Kill(kCancelSignal); });
  ASSERT_TRUE(answer.last.has_result()) << answer.last.DebugString();
  EXPECT_EQ(answer.last.result().termination(), v1::TERMINATION_CANCELLED);
}

// A terminal, systemd and Slurm stop every process at once, agents and solvers alike.
TEST(SolveProgram, SignalsThatStopItsAgentChangeNothing) {
  const Answer answer = Ask(Options(), Request(16), [](SolverProcess& process) {
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) process.Kill(signal);
  });
  ASSERT_TRUE(answer.last.has_result()) << answer.last.DebugString();
  EXPECT_EQ(answer.last.result().termination(), v1::TERMINATION_OPTIMAL) << answer.last.result().message();
}

TEST(SolveProgram, TheMemoryLimitIsReported) {
  if (kSanitized) GTEST_SKIP() << "sanitizers need the address space";
  SolverProcess::Options options = Options();
  options.memory_limit_mb = 200;
  const Answer answer = Ask(options, Request(1000), [](SolverProcess&) {});
  ASSERT_TRUE(answer.last.has_error()) << answer.last.ShortDebugString().substr(0, 300);
  EXPECT_EQ(answer.last.error().kind(), v1::SolveError::KIND_MEMORY_LIMIT);
}

}  // namespace
}  // namespace rollgait::server
