#ifndef ROLLGAIT_TESTS_SERVER_AGENT_AGENT_FIXTURE_H_
#define ROLLGAIT_TESTS_SERVER_AGENT_AGENT_FIXTURE_H_

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rollgait/v1/solve.pb.h"
#include "server/agent/agent.h"
#include "server/store/open_store.h"

namespace rollgait::server {

// A data directory with a real store, and agents that run the test solver (test_solver.cc).
class AgentFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "rollgait-agent-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    directory_ = pattern;
    store_ = std::move(OpenStore({DataDir{directory_}.Database()}, clock_)).value();
    ASSERT_EQ(pipe(stop_.data()), 0);
    ASSERT_EQ(pipe(lifeline_.data()), 0);
  }

  void TearDown() override {
    for (const int fd : {stop_[0], stop_[1], lifeline_[0], lifeline_[1]}) {
      if (fd >= 0) close(fd);
    }
    store_.reset();
    std::filesystem::remove_all(directory_);
  }

  Agent::Options Options() const {
    Agent::Options options;
    options.work_dir = directory_;
    options.slots = 2;
    options.solver.program = ROLLGAIT_TEST_SOLVER;
    options.stop_fd = stop_[0];
    options.lifeline_fd = lifeline_[0];
    options.kill_after = std::chrono::milliseconds(100);
    return options;
  }

  std::unique_ptr<Agent> MakeAgent() { return MakeAgent(Options()); }
  std::unique_ptr<Agent> MakeAgent(const Agent::Options& options,
                                   std::function<Outcome<std::unique_ptr<RunningSolver>>()> start_solver = {}) {
    channels_.push_back(SocketHints::Create(directory_, kAgentSocket, kServerSocket).value());
    Outcome<std::unique_ptr<Agent>> agent =
        Agent::Create(options, {*store_, *channels_.back(), clock_, std::move(start_solver)});
    EXPECT_TRUE(agent.ok());
    return std::move(agent).value();
  }

  // Queues a solve whose solver does what `words` say; see test_solver.cc.
  std::string Queue(const std::string& words, double max_wall_time_s = 600) {
    v1::SolveSpec spec;
    spec.mutable_model()->set_name(words);
    spec.mutable_solver_limits()->set_max_wall_time_s(max_wall_time_s);
    const std::string id = "s" + std::to_string(++count_);
    EXPECT_TRUE(store_->Create({.id = id, .request_id = "", .spec = spec.SerializeAsString(), .solve_key = ""}).ok());
    return id;
  }

  SolveRecord Get(const std::string& id) { return store_->Get(id).value(); }

  // Turns the agent's loop until `done`; false after half a minute.
  static bool StepUntil(Agent& agent, const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!done()) {
      if (std::chrono::steady_clock::now() > end) return false;
      agent.Step(std::chrono::milliseconds(20));
    }
    return true;
  }

  // The solve as it ended.
  SolveRecord RunToEnd(Agent& agent, const std::string& id) {
    EXPECT_TRUE(StepUntil(agent, [&] { return IsTerminal(Get(id).state); })) << "solve " << id << " does not end";
    return Get(id);
  }

  // The iterations stored for a solve, their sequence numbers checked to be dense.
  std::vector<v1::SolveEvent> Events(const std::string& id) {
    std::vector<v1::SolveEvent> events;
    const EventPage page = store_->ReadEvents(id, 0, 100000).value();
    for (size_t i = 0; i < page.events.size(); ++i) {
      EXPECT_EQ(page.events[i].sequence, static_cast<int64_t>(i) + 1);
      events.emplace_back();
      EXPECT_TRUE(events.back().ParseFromString(page.events[i].payload));
    }
    return events;
  }

  int CountIterations(const std::string& id) {
    int count = 0;
    for (const v1::SolveEvent& event : Events(id)) count += event.has_iteration() ? 1 : 0;
    return count;
  }

  static v1::SolveError Error(const SolveRecord& record) {
    v1::SolveError error;
    EXPECT_TRUE(error.ParseFromString(record.error));
    return error;
  }

  static v1::SolveResult ResultOf(const SolveRecord& record) {
    v1::SolveResult result;
    EXPECT_TRUE(result.ParseFromString(record.result));
    return result;
  }

  std::string directory_;
  SystemClock clock_;
  std::unique_ptr<SqlStore> store_;
  std::vector<std::unique_ptr<HintChannel>> channels_;  // one an agent
  std::array<int, 2> stop_ = {-1, -1}, lifeline_ = {-1, -1};
  int count_ = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SERVER_AGENT_AGENT_FIXTURE_H_
