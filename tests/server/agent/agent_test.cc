// What becomes of a solve, for every way in which its solver can end.
#include "server/agent/agent.h"

#include <gmock/gmock.h>

#include "tests/server/agent/agent_fixture.h"

namespace rollgait::server {
namespace {

using ::testing::HasSubstr;

class AgentTest : public AgentFixture {};

TEST_F(AgentTest, RelaysIterationsInOrderAndThenTheResult) {
  const std::string id = Queue("iterations 40 sleep 30 iterations 2 result");
  const auto agent = MakeAgent();
  const SolveRecord record = RunToEnd(*agent, id);
  EXPECT_EQ(record.state, SolveState::kSucceeded);
  EXPECT_EQ(record.attempts, 1);
  const v1::SolveResult result = ResultOf(record);
  EXPECT_EQ(result.termination(), v1::TERMINATION_OPTIMAL);
  EXPECT_GT(result.cpu_time_s(), 0);
  EXPECT_GT(result.peak_memory_bytes(), 100'000);
  EXPECT_THAT(result.solver_build(), HasSubstr("rollgait "));
  int next = 0;
  for (const v1::SolveEvent& event : Events(id)) {
    if (!event.has_iteration()) continue;
    EXPECT_EQ(event.iteration().index(), next < 40 ? next : next - 40);
    EXPECT_GT(event.time().seconds(), 0);
    ++next;
  }
  EXPECT_EQ(next, 42);
  EXPECT_TRUE(std::filesystem::is_empty(directory_ + "/spool"));
}

TEST_F(AgentTest, TellsEachSolutionAndKeepsTheNewest) {
  const std::string id = Queue("iterations 1 solutions 3 obey");
  const auto agent = MakeAgent();
  const auto told = [&] {
    std::vector<v1::Intermediate> all;
    for (const v1::SolveEvent& event : Events(id)) {
      if (event.has_intermediate()) all.push_back(event.intermediate());
    }
    return all;
  };
  ASSERT_TRUE(StepUntil(*agent, [&] { return told().size() == 3; }));
  EXPECT_EQ(told()[1].objective(), 2);
  EXPECT_EQ(told()[1].intervals(0), 20) << "of its own mesh, not of the one that its errors are estimated with";
  EXPECT_EQ(told()[1].verdict(), v1::VERDICT_EXCEEDED);
  EXPECT_EQ(ResultOf(Get(id)).objective(), 3) << "the newest one";
}

// A solve that is cancelled has what its solver ends with if that is a solution; killed, the newest that was stored.
TEST_F(AgentTest, ACancelledSolveKeepsItsSolution) {
  const std::string obeys = Queue("solutions 2 obey"), deaf = Queue("solutions 2 hang"), without = Queue("obey");
  Agent::Options options = Options();
  options.slots = 3;
  const auto agent = MakeAgent(options);
  ASSERT_TRUE(StepUntil(*agent, [&] {
    return CountIterations(obeys) == 1 && !Get(deaf).result.empty() && CountIterations(without) == 1;
  }));
  for (const std::string& id : {obeys, deaf, without}) ASSERT_TRUE(store_->RequestCancel(id, {}).ok());
  for (const std::string& id : {obeys, deaf, without}) EXPECT_EQ(RunToEnd(*agent, id).state, SolveState::kCancelled);
  EXPECT_EQ(ResultOf(Get(obeys)).termination(), v1::TERMINATION_CANCELLED);
  EXPECT_EQ(ResultOf(Get(deaf)).objective(), 2);
  EXPECT_EQ(Get(without).result, "");
  EXPECT_EQ(Error(Get(obeys)).kind(), v1::SolveError::KIND_CANCELLED);
}

TEST_F(AgentTest, AFailedSolveKeepsItsSolution) {
  const std::string id = Queue("solutions 2 memory");
  const auto agent = MakeAgent();
  const SolveRecord record = RunToEnd(*agent, id);
  EXPECT_EQ(record.state, SolveState::kFailed);
  EXPECT_EQ(ResultOf(record).objective(), 2);
}

TEST_F(AgentTest, TheFirstIterationDoesNotWaitForTheEnd) {
  const std::string id = Queue("iterations 1 obey");
  const auto agent = MakeAgent();
  EXPECT_TRUE(StepUntil(*agent, [&] { return CountIterations(id) >= 1; }));
  EXPECT_EQ(Get(id).state, SolveState::kRunning);
}

TEST_F(AgentTest, ASolverThatSendsTooMuchFillsNoStore) {
  Agent::Options options = Options();
  options.max_event_bytes = 100'000;
  const auto agent = MakeAgent(options);
  const std::string padded = Queue("flood 50 result"), many = Queue("iterations 20000 result");
  for (const std::string& id : {padded, many}) {
    EXPECT_EQ(RunToEnd(*agent, id).state, SolveState::kSucceeded);
    size_t bytes = 0;
    const EventPage page = store_->ReadEvents(id, 0, 100'000).value();
    for (const StoredEvent& event : page.events) bytes += event.payload.size();
    EXPECT_LT(bytes, 101'000u) << id;
  }
  EXPECT_EQ(CountIterations(padded), 50) << "what is not of an iteration is left out";
  EXPECT_GT(CountIterations(many), 1000);
}

TEST_F(AgentTest, KeepsTheNewestIterateWhileTheSolveRunsAndStoresNone) {
  std::string words;
  for (int i = 0; i < 40; ++i) words += "iterates 1 sleep 20 ";
  const std::string id = Queue(words + "obey");
  const auto agent = MakeAgent();
  const auto start = std::chrono::steady_clock::now();
  const IterateFiles files(DataDir{directory_}.IteratesDir());
  std::vector<v1::Iterate> kept;
  IterateFiles::Version version;
  const auto look = [&] {
    const std::optional<std::string> bytes = files.ReadNewer(id, &version);
    v1::Iterate iterate;
    if (bytes && iterate.ParseFromString(*bytes)) kept.push_back(iterate);
    return CountIterations(id) == 1;  // the solver obeys now
  };
  ASSERT_TRUE(StepUntil(*agent, look));
  ASSERT_GE(kept.size(), 2u);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start, pace = kIteratePause / 2;
  EXPECT_LE(static_cast<double>(kept.size()), 1 + elapsed / pace) << "those that come too fast are dropped";
  EXPECT_EQ(kept.front().joint_names(0), "hip");
  EXPECT_TRUE(store_->RequestCancel(id).ok());
  RunToEnd(*agent, id);
  EXPECT_TRUE(std::filesystem::is_empty(DataDir{directory_}.IteratesDir()));
  for (const v1::SolveEvent& event : Events(id)) EXPECT_FALSE(event.has_iterate());
}

TEST_F(AgentTest, AnIterateThatIsTooLongIsNotShownAndHarmsNothing) {
  const std::string id = Queue("long-iterate iterations 2 obey");
  const auto agent = MakeAgent();
  ASSERT_TRUE(StepUntil(*agent, [&] { return CountIterations(id) == 3; }));  // two, and that it obeys now
  EXPECT_TRUE(std::filesystem::is_empty(DataDir{directory_}.IteratesDir()));
  EXPECT_TRUE(store_->RequestCancel(id).ok());
  EXPECT_EQ(RunToEnd(*agent, id).state, SolveState::kCancelled);
}

TEST_F(AgentTest, IteratesOfSolvesThatRunNoMoreAreRemovedAtTheStart) {
  const IterateFiles files(DataDir{directory_}.IteratesDir());
  ASSERT_TRUE(files.MakeDirectory().ok());
  const std::string id = Queue("result");
  ASSERT_TRUE(files.Put(id, "left").ok());
  ASSERT_TRUE(files.Put("deleted", "left").ok());
  const auto agent = MakeAgent();
  close(std::exchange(lifeline_[1], -1));  // it claims nothing and goes
  agent->Run();
  EXPECT_TRUE(std::filesystem::is_empty(DataDir{directory_}.IteratesDir()));
}

TEST_F(AgentTest, ANumericalFailureIsAResult) {
  const auto agent = MakeAgent();
  const SolveRecord record = RunToEnd(*agent, Queue("infeasible"));
  EXPECT_EQ(record.state, SolveState::kSucceeded);
  EXPECT_EQ(record.attempts, 1);
  EXPECT_EQ(ResultOf(record).termination(), v1::TERMINATION_INFEASIBLE);
}

TEST_F(AgentTest, AResultCountsWhateverTheExitStatus) {
  const auto agent = MakeAgent();
  EXPECT_EQ(RunToEnd(*agent, Queue("result crash")).state, SolveState::kSucceeded);
}

TEST_F(AgentTest, ASolverThatDoesNotEndAfterItsResultIsKilled) {
  const auto agent = MakeAgent();
  EXPECT_EQ(RunToEnd(*agent, Queue("result hang")).state, SolveState::kSucceeded);
}

TEST_F(AgentTest, ACrashIsRetriedThreeTimesAndLeavesItsEvidence) {
  const std::string id = Queue("iterations 2 print out-of-cheese crash");
  const auto agent = MakeAgent();
  const SolveRecord record = RunToEnd(*agent, id);
  EXPECT_EQ(record.state, SolveState::kFailed);
  EXPECT_EQ(record.attempts, 3);
  EXPECT_EQ(Error(record).kind(), v1::SolveError::KIND_CRASH);
  EXPECT_THAT(Error(record).message(), HasSubstr("signal 11"));
  EXPECT_THAT(Error(record).message(), HasSubstr("out-of-cheese"));
}

TEST_F(AgentTest, ExitStatusZeroWithoutAResultIsACrash) {
  const auto agent = MakeAgent();
  const SolveRecord record = RunToEnd(*agent, Queue("iterations 3"));
  EXPECT_EQ(record.state, SolveState::kFailed);
  EXPECT_EQ(record.crashes, 3);
  EXPECT_THAT(Error(record).message(), HasSubstr("exit status 0 without a result"));
}

TEST_F(AgentTest, TheSecondAttemptMaySucceed) {
  const std::string id = Queue("iterations 2 once " + directory_ + "/died iterations 3 result");
  const auto agent = MakeAgent();
  const SolveRecord record = RunToEnd(*agent, id);
  EXPECT_EQ(record.state, SolveState::kSucceeded);
  EXPECT_EQ(record.attempts, 2);
  EXPECT_EQ(record.crashes, 1);
  EXPECT_GE(CountIterations(id), 5) << "numbers go on over attempts";
}

TEST_F(AgentTest, GarbageOnTheStreamIsACrash) {
  const auto agent = MakeAgent();
  const SolveRecord record = RunToEnd(*agent, Queue("garbage hang"));
  EXPECT_EQ(record.state, SolveState::kFailed);
  EXPECT_THAT(Error(record).message(), HasSubstr("not a frame"));
}

TEST_F(AgentTest, AClosedStreamIsACrash) {
  const auto agent = MakeAgent();
  EXPECT_EQ(Error(RunToEnd(*agent, Queue("close"))).kind(), v1::SolveError::KIND_CRASH);
}

TEST_F(AgentTest, MemoryAndTimeLimitsAreNotRetried) {
  const auto agent = MakeAgent();
  SolveRecord record = RunToEnd(*agent, Queue("memory"));
  EXPECT_EQ(Error(record).kind(), v1::SolveError::KIND_MEMORY_LIMIT);
  EXPECT_EQ(record.attempts, 1);
  record = RunToEnd(*agent, Queue("xcpu"));
  EXPECT_EQ(Error(record).kind(), v1::SolveError::KIND_TIME_LIMIT);
  EXPECT_EQ(record.attempts, 1);
}

TEST_F(AgentTest, ASolverThatIgnoresItsWallTimeIsKilled) {
  Agent::Options options = Options();
  options.wall_grace = std::chrono::milliseconds(50);
  const auto agent = MakeAgent(options);
  const SolveRecord record = RunToEnd(*agent, Queue("hang", 0.1));
  EXPECT_EQ(record.state, SolveState::kFailed);
  EXPECT_EQ(Error(record).kind(), v1::SolveError::KIND_TIME_LIMIT);
}

TEST_F(AgentTest, CancellingDropsThePartialResult) {
  const std::string id = Queue("obey");
  const auto agent = MakeAgent();
  ASSERT_TRUE(StepUntil(*agent, [&] { return CountIterations(id) == 1; }));
  ASSERT_TRUE(store_->RequestCancel(id).ok());
  const SolveRecord record = RunToEnd(*agent, id);
  EXPECT_EQ(record.state, SolveState::kCancelled);
  EXPECT_EQ(Error(record).kind(), v1::SolveError::KIND_CANCELLED);
  EXPECT_TRUE(record.result.empty());
}

TEST_F(AgentTest, ASolverThatIgnoresTheCancellationIsKilled) {
  const std::string id = Queue("hang");
  const auto agent = MakeAgent();
  ASSERT_TRUE(StepUntil(*agent, [&] { return CountIterations(id) == 1; }));
  ASSERT_TRUE(store_->RequestCancel(id).ok());
  EXPECT_EQ(RunToEnd(*agent, id).state, SolveState::kCancelled);
}

TEST_F(AgentTest, ManySolvesShareTheSlots) {
  std::vector<std::string> ids;
  // Long enough for two of them to be seen at once beside other work.
  for (int i = 0; i < 12; ++i) ids.push_back(Queue("iterations 5 sleep 200 result"));
  const auto agent = MakeAgent();
  int most = 0;
  EXPECT_TRUE(StepUntil(*agent, [&] {
    most = std::max(most, agent->running());
    return IsTerminal(Get(ids.back()).state) && agent->running() == 0;
  }));
  EXPECT_EQ(most, 2);
  for (const std::string& id : ids) {
    EXPECT_EQ(Get(id).state, SolveState::kSucceeded) << id;
    EXPECT_EQ(CountIterations(id), 5) << id;
  }
}

TEST_F(AgentTest, ALargeRequestGoesThroughTheSmallSocket) {
  const std::string id = Queue("iterations 1 result" + std::string(3'000'000, ' '));
  const auto agent = MakeAgent();
  EXPECT_EQ(RunToEnd(*agent, id).state, SolveState::kSucceeded);
}

}  // namespace
}  // namespace rollgait::server
