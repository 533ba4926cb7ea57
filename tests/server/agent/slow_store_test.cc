// What an agent does with time when its store answers slowly: turns whose times are far apart.
#include <signal.h>

#include <algorithm>

#include "server/base/cancel_signal.h"
#include "server/base/wire.pb.h"
#include "tests/server/agent/agent_fixture.h"

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;

// Is ready, and then deaf and silent.
class DeafSolver : public RunningSolver {
 public:
  explicit DeafSolver(std::vector<int>* signals) : signals_(*signals) {}
  pid_t pid() const override { return 0; }
  int stream_fd() const override { return -1; }
  int output_fd() const override { return -1; }
  bool wants_to_write() const override { return false; }
  void Send(std::string_view) override {}
  void Write() override {}
  FrameStatus Receive(std::vector<std::string>* payloads) override {
    if (was_ready_) return FrameStatus::kNeedMore;
    was_ready_ = true;
    wire::SolverMessage message;
    message.mutable_ready();
    payloads->push_back(message.SerializeAsString());
    return FrameStatus::kNeedMore;
  }
  void ReadOutput() override {}
  std::string LastOutput() const override { return ""; }
  void Kill(int signal) override { signals_.push_back(signal); }
  std::optional<ProcessEnd> Reap() override { return std::nullopt; }

 private:
  std::vector<int>& signals_;
  bool was_ready_ = false;
};

class SlowStoreTest : public AgentFixture {};

TEST_F(SlowStoreTest, ASolverHasItsTimeToStopFromTheTurnAfterTheSignal) {
  std::vector<int> signals;
  Agent::Options options = Options();
  options.slots = 1;
  options.kill_after = milliseconds(2000);
  const auto agent = MakeAgent(options, [&signals]() -> Outcome<std::unique_ptr<RunningSolver>> {
    return std::unique_ptr<RunningSolver>(std::make_unique<DeafSolver>(&signals));
  });
  const std::string id = Queue("deaf");
  SteadyTime now = std::chrono::steady_clock::now();
  agent->Start();
  for (int turn = 0; turn < 10 && Get(id).state != SolveState::kRunning; ++turn) {
    ASSERT_TRUE(agent->Turn(now));
    now += options.look;
  }
  ASSERT_EQ(Get(id).state, SolveState::kRunning);
  ASSERT_TRUE(store_->RequestCancel(id).ok());
  ASSERT_TRUE(agent->Turn(now));
  EXPECT_EQ(signals, std::vector<int>{kCancelSignal});
  // The store took three seconds to say who is cancelled, so that much later the next turn begins.
  now += milliseconds(3000);
  EXPECT_LE(agent->NextDue(now), now);
  ASSERT_TRUE(agent->Turn(now));
  EXPECT_EQ(signals, std::vector<int>{kCancelSignal});
  now += options.kill_after - milliseconds(1);
  ASSERT_TRUE(agent->Turn(now));
  EXPECT_EQ(signals, std::vector<int>{kCancelSignal});
  now += milliseconds(1);
  ASSERT_TRUE(agent->Turn(now));
  EXPECT_EQ(signals, (std::vector<int>{kCancelSignal, SIGKILL}));
}

}  // namespace
}  // namespace rollgait::server
