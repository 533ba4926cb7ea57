// How an agent begins, ends, and takes over from another one.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <fstream>
#include <iterator>

#include "server/agent/agent.h"
#include "tests/server/agent/agent_fixture.h"

namespace rollgait::server {
namespace {

class AgentLifeTest : public AgentFixture {};

bool Exists(pid_t pid) { return kill(pid, 0) == 0; }

// Of this thread, which the agents run in.
std::vector<pid_t> Children() {
  std::ifstream file("/proc/thread-self/children");
  return {std::istream_iterator<pid_t>(file), {}};
}

TEST_F(AgentLifeTest, KeepsIdleSolversReady) {
  const auto agent = MakeAgent();
  ASSERT_TRUE(StepUntil(*agent, [&] { return agent->IdleProcesses().size() == 2; }));
  // One that dies is replaced.
  const pid_t first = agent->IdleProcesses()[0];
  kill(first, SIGKILL);
  EXPECT_TRUE(StepUntil(*agent, [&] {
    const std::vector<pid_t> pids = agent->IdleProcesses();
    return pids.size() == 2 && std::find(pids.begin(), pids.end(), first) == pids.end();
  }));
}

TEST_F(AgentLifeTest, ASolverThatCannotStartIsNotTheFaultOfARequest) {
  const std::string id = Queue("result");
  Agent::Options options = Options();
  options.solver.program = "/bin/false";
  const auto agent = MakeAgent(options);
  for (int i = 0; i < 40; ++i) agent->Step(std::chrono::milliseconds(10));
  EXPECT_EQ(Get(id).state, SolveState::kQueued);
  EXPECT_EQ(Get(id).attempts, 0);
}

TEST_F(AgentLifeTest, ADeadSolverIsHandedNoRequest) {
  const auto agent = MakeAgent();
  ASSERT_TRUE(StepUntil(*agent, [&] { return agent->IdleProcesses().size() == 2; }));
  for (const pid_t pid : agent->IdleProcesses()) {
    kill(pid, SIGKILL);
    siginfo_t info;
    ASSERT_EQ(waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOWAIT), 0) << "it is dead, and not reaped";
  }
  const SolveRecord record = RunToEnd(*agent, Queue("iterations 1 result"));
  EXPECT_EQ(record.state, SolveState::kSucceeded);
  EXPECT_EQ(record.attempts, 1);
}

// It counts as no crash, however often: after the third crash the solve would have failed.
TEST_F(AgentLifeTest, ASolverKilledBeforeItHadTheRequestIsNotTheFaultOfTheRequest) {
  const std::string id = Queue("untaken");
  const auto agent = MakeAgent();
  for (int attempt = 1; attempt <= 3; ++attempt) {
    ASSERT_TRUE(StepUntil(*agent, [&] { return Get(id).attempts == attempt; })) << attempt;
    // The one with the request waits for ever; those without are idle.
    const std::vector<pid_t> idle = agent->IdleProcesses();
    for (const pid_t pid : Children()) {
      if (std::find(idle.begin(), idle.end(), pid) == idle.end()) kill(pid, SIGKILL);
    }
  }
  ASSERT_TRUE(StepUntil(*agent, [&] { return Get(id).attempts == 4; }));
  EXPECT_EQ(Get(id).crashes, 0);
}

TEST_F(AgentLifeTest, StopGivesTheSolvesBackAndLeavesNoProcess) {
  const std::string id = Queue("hang");
  auto agent = MakeAgent();
  ASSERT_TRUE(StepUntil(*agent, [&] { return CountIterations(id) == 1; }));
  ASSERT_TRUE(StepUntil(*agent, [&] { return agent->IdleProcesses().size() == 1; }));
  const std::vector<pid_t> idle = agent->IdleProcesses();
  ASSERT_EQ(write(stop_[1], "x", 1), 1);
  EXPECT_FALSE(agent->Step(std::chrono::seconds(5)));
  EXPECT_EQ(Get(id).state, SolveState::kQueued);
  EXPECT_EQ(Get(id).crashes, 0);
  for (const pid_t pid : idle) EXPECT_FALSE(Exists(pid));
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
  const std::string lock = DataDir{directory_}.AgentLock(agent->owner());
  EXPECT_TRUE(std::filesystem::exists(lock));
  agent.reset();
  EXPECT_FALSE(std::filesystem::exists(lock));
}

TEST_F(AgentLifeTest, WithoutRollgaitdItFinishesWhatRunsAndClaimsNothing) {
  const std::string running = Queue("iterations 1 sleep 200 iterations 1 result");
  const auto agent = MakeAgent();
  ASSERT_TRUE(StepUntil(*agent, [&] { return CountIterations(running) == 1; }));
  close(std::exchange(lifeline_[1], -1));
  agent->Step(std::chrono::milliseconds(0));
  const std::string queued = Queue("result");
  while (agent->Step(std::chrono::seconds(1))) {
  }
  EXPECT_EQ(Get(running).state, SolveState::kSucceeded);
  EXPECT_EQ(CountIterations(running), 2);
  EXPECT_EQ(Get(queued).state, SolveState::kQueued);
}

TEST_F(AgentLifeTest, AnIdleAgentWithoutRollgaitdGoesAtOnce) {
  const auto agent = MakeAgent();
  ASSERT_TRUE(StepUntil(*agent, [&] { return agent->IdleProcesses().size() == 2; }));
  close(std::exchange(lifeline_[1], -1));
  EXPECT_FALSE(agent->Step(std::chrono::seconds(5)));
}

TEST_F(AgentLifeTest, AgentsWorkBesideEachOtherWithTheirOwnSlots) {
  Agent::Options options = Options();
  options.slots = 1;
  const auto first = MakeAgent(options), second = MakeAgent(options);
  const std::string one = Queue("iterations 1 hang"), two = Queue("iterations 1 hang"), three = Queue("result");
  ASSERT_TRUE(StepUntil(*first, [&] { return CountIterations(one) >= 1; }));
  ASSERT_TRUE(StepUntil(*second, [&] { return CountIterations(two) >= 1; }));
  for (int i = 0; i < 20; ++i) second->Step(std::chrono::milliseconds(20));
  EXPECT_EQ(first->running(), 1);
  EXPECT_EQ(second->running(), 1);
  EXPECT_EQ(Get(three).state, SolveState::kQueued);
}

TEST_F(AgentLifeTest, WhatADrainingAgentRunsCountsAgainstTheSlotsOfTheNext) {
  Agent::Options options = Options();
  options.slots = 1;
  const std::string one = Queue("iterations 1 hang"), two = Queue("result");
  auto old = MakeAgent(options);
  ASSERT_TRUE(StepUntil(*old, [&] { return CountIterations(one) >= 1; }));
  close(std::exchange(lifeline_[1], -1));
  old->Step(std::chrono::milliseconds(0));
  options.lifeline_fd = -1;
  const auto next = MakeAgent(options);
  ASSERT_TRUE(StepUntil(*next, [&] { return next->IdleProcesses().size() == 1; }));
  for (int i = 0; i < 20; ++i) next->Step(std::chrono::milliseconds(20));
  EXPECT_EQ(next->running(), 0);
  ASSERT_TRUE(store_->RequestCancel(one).ok());
  while (old->Step(std::chrono::seconds(1))) {
  }
  old.reset();
  EXPECT_EQ(RunToEnd(*next, two).state, SolveState::kSucceeded);
  for (const auto& entry : std::filesystem::directory_iterator(DataDir{directory_}.AgentsDir())) {
    EXPECT_NE(entry.path().extension(), ".draining");
  }
}

TEST_F(AgentLifeTest, AnOwnerThatMayLiveElsewhereIsLeftToItsLease) {
  const std::string id = Queue("result");
  ASSERT_TRUE(store_->ClaimNext("agent-far-away", kLeaseDuration).value().has_value());
  Agent::Options options = Options();
  options.all_agents_here = false;
  const auto agent = MakeAgent(options);
  for (int i = 0; i < 20; ++i) agent->Step(std::chrono::milliseconds(10));
  EXPECT_EQ(Get(id).state, SolveState::kRunning);
  ASSERT_TRUE(std::filesystem::exists(DataDir{directory_}.AgentLock(agent->owner())));
  EXPECT_FALSE(std::filesystem::exists(DataDir{directory_}.AgentLock("agent-far-away")));
}

TEST_F(AgentLifeTest, AResultOfAnotherSolverIsNotReused) {
  Agent::Options options = Options();
  options.solver_fingerprint = "ours";
  const auto agent = MakeAgent(options);
  v1::SolveSpec spec;
  spec.mutable_model()->set_name("result");
  for (const std::string fingerprint : {"theirs", "ours"}) {
    NewSolve solve{"first-" + fingerprint, "", spec.SerializeAsString(), "key of " + fingerprint};
    solve.solver_fingerprint = fingerprint;
    ASSERT_TRUE(store_->Create(solve).ok());
    EXPECT_EQ(RunToEnd(*agent, solve.id).state, SolveState::kSucceeded);
    solve.id = "second-" + fingerprint;
    EXPECT_EQ(store_->Create(solve).value().record.from_cache, fingerprint == "ours");
  }
}

TEST_F(AgentLifeTest, TheSolvesOfADeadAgentAreRunAgain) {
  const std::string id = Queue("result");
  // An agent that was killed: it holds a lease and no lock.
  ASSERT_TRUE(store_->ClaimNext("agent-dead", kLeaseDuration).value().has_value());
  ASSERT_EQ(Get(id).state, SolveState::kRunning);
  const auto agent = MakeAgent();
  const SolveRecord record = RunToEnd(*agent, id);
  EXPECT_EQ(record.state, SolveState::kSucceeded);
  EXPECT_EQ(record.attempts, 2);
  EXPECT_EQ(record.crashes, 0) << "the request is not to blame";
}

TEST_F(AgentLifeTest, ALivingAgentKeepsItsSolves) {
  const std::string id = Queue("result");
  const auto lock = FileLock::TryAcquire(directory_ + "/ignored");
  ASSERT_TRUE(std::filesystem::create_directory(DataDir{directory_}.AgentsDir()));
  const auto alive = FileLock::TryAcquire(DataDir{directory_}.AgentLock("agent-alive"));
  ASSERT_TRUE(alive.ok() && alive.value());
  ASSERT_TRUE(store_->ClaimNext("agent-alive", kLeaseDuration).value().has_value());
  const auto agent = MakeAgent();
  for (int i = 0; i < 20; ++i) agent->Step(std::chrono::milliseconds(10));
  EXPECT_EQ(Get(id).state, SolveState::kRunning);
  EXPECT_EQ(Get(id).attempts, 1);
}

TEST_F(AgentLifeTest, AResultInTheSpoolOfADeadAgentIsCommittedAndNotComputedAgain) {
  const std::string id = Queue("crash");
  const ClaimedSolve claimed = *store_->ClaimNext("agent-dead", kLeaseDuration).value();
  v1::SolveResult result;
  result.set_objective(42);
  ASSERT_TRUE(Spool::Open(directory_ + "/spool")
                  .value()
                  .Put({claimed.lease, {}, {SolveState::kSucceeded, result.SerializeAsString(), "", true}})
                  .ok());
  const auto agent = MakeAgent();
  const SolveRecord record = RunToEnd(*agent, id);
  EXPECT_EQ(record.state, SolveState::kSucceeded);
  EXPECT_EQ(record.attempts, 1);
  EXPECT_EQ(ResultOf(record).objective(), 42);
  EXPECT_TRUE(std::filesystem::is_empty(directory_ + "/spool"));
}

TEST_F(AgentLifeTest, AnEndThatTheStoreHadAlreadyLeavesTheSpoolAtTheStart) {
  const std::string id = Queue("result");
  const ClaimedSolve claimed = *store_->ClaimNext("agent-dead", kLeaseDuration).value();
  const SolveEnd end{SolveState::kSucceeded, "", "", false};
  ASSERT_TRUE(store_->Finish(claimed.lease, {}, end).ok());
  ASSERT_TRUE(Spool::Open(directory_ + "/spool").value().Put({claimed.lease, {}, end}).ok());
  const auto agent = MakeAgent();
  ASSERT_EQ(write(stop_[1], "x", 1), 1);
  agent->Run();
  EXPECT_TRUE(std::filesystem::is_empty(directory_ + "/spool"));
  EXPECT_EQ(Get(id).state, SolveState::kSucceeded);
}

TEST_F(AgentLifeTest, ALostLeaseKillsTheSolverAndWritesNothing) {
  const std::string id = Queue("iterations 1 sleep 100 iterations 1 hang");
  const auto agent = MakeAgent();
  ASSERT_TRUE(StepUntil(*agent, [&] { return CountIterations(id) == 1; }));
  ASSERT_TRUE(store_->ReclaimOwner(agent->owner()).ok());
  ASSERT_TRUE(store_->ClaimNext("another", kLeaseDuration).value().has_value());
  EXPECT_TRUE(StepUntil(*agent, [&] { return agent->running() == 0; }));
  EXPECT_EQ(CountIterations(id), 1);
  EXPECT_EQ(Get(id).state, SolveState::kRunning) << "it is the other agent's now";
}

TEST_F(AgentLifeTest, PokesRollgaitd) {
  NotifyReceiver rollgaitd = std::move(NotifyReceiver::Create(directory_, kServerSocket)).value();
  const std::string id = Queue("result");
  const auto agent = MakeAgent();
  RunToEnd(*agent, id);
  EXPECT_THAT(rollgaitd.Drain(), ::testing::Contains(id));
}

}  // namespace
}  // namespace rollgait::server
