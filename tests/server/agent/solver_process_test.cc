#include "server/agent/solver_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <thread>

#include "rollgait/v1/solve_spec.pb.h"
#include "server/base/wire.pb.h"

namespace rollgait::server {
namespace {

std::string Request(const std::string& words) {
  v1::SolveSpec spec;
  spec.mutable_model()->set_name(words);
  return spec.SerializeAsString();
}

SolverProcess Spawn() {
  Outcome<SolverProcess> process = SolverProcess::Spawn({ROLLGAIT_TEST_SOLVER, 4096, 100});
  EXPECT_TRUE(process.ok());
  return std::move(process).value();
}

// Everything the solver sends, and its end; gives up after half a minute.
ProcessEnd Finish(SolverProcess& process, std::vector<std::string>* payloads) {
  for (int i = 0; i < 30000; ++i) {
    process.Write();
    process.ReadOutput();
    process.Receive(payloads);
    if (const std::optional<ProcessEnd> end = process.Reap()) return *end;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ADD_FAILURE() << "the solver does not end";
  return {};
}

TEST(SolverProcess, HandsOverTheRequestAndReceivesTheAnswer) {
  SolverProcess process = Spawn();
  process.Send(Request("iterations 3 print hello\tyou result"));
  std::vector<std::string> payloads;
  const ProcessEnd end = Finish(process, &payloads);
  EXPECT_TRUE(WIFEXITED(end.wait_status));
  EXPECT_EQ(WEXITSTATUS(end.wait_status), 0) << "9: descriptors or environment are not as promised";
  process.Receive(&payloads);
  ASSERT_EQ(payloads.size(), 6u) << "ready, taken, three iterations, the result";
  wire::SolverMessage last;
  ASSERT_TRUE(last.ParseFromString(payloads[5]));
  EXPECT_TRUE(last.has_result());
  EXPECT_EQ(process.LastOutput(), "hello");
  EXPECT_GT(end.peak_memory_bytes, 0);
}

TEST(SolverProcess, ReportsTheSignal) {
  SolverProcess process = Spawn();
  process.Send(Request("crash"));
  std::vector<std::string> payloads;
  const ProcessEnd end = Finish(process, &payloads);
  ASSERT_TRUE(WIFSIGNALED(end.wait_status));
  EXPECT_EQ(WTERMSIG(end.wait_status), SIGSEGV);
}

TEST(SolverProcess, KillsWhatItLeavesBehind) {
  pid_t pid = 0;
  {
    SolverProcess process = Spawn();
    pid = process.pid();
    EXPECT_EQ(kill(pid, 0), 0);
  }
  EXPECT_EQ(kill(pid, 0), -1);
}

TEST(SolverProcess, AssignmentKillsWhatWasThere) {
  SolverProcess process = Spawn();
  const pid_t first = process.pid();
  process = Spawn();
  EXPECT_NE(process.pid(), first);
  EXPECT_EQ(kill(first, 0), -1);
  EXPECT_EQ(kill(process.pid(), 0), 0);
}

TEST(SolverProcess, AMissingProgramIsAnError) {
  const Outcome<SolverProcess> process = SolverProcess::Spawn({"no-such-program", 4096, 100});
  ASSERT_FALSE(process.ok());
  EXPECT_THAT(process.error().message, ::testing::HasSubstr("no-such-program"));
}

TEST(SolverProcess, RequestsToADeadSolverAreNoSignal) {
  SolverProcess process = Spawn();
  process.Kill(SIGKILL);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  process.Send(std::string(1'000'000, 'x'));
  std::vector<std::string> payloads;
  const ProcessEnd end = Finish(process, &payloads);
  EXPECT_EQ(WTERMSIG(end.wait_status), SIGKILL);
}

}  // namespace
}  // namespace rollgait::server
