// The whole way of a simulation: rollgaitd, rollgait-simulate, a shipped scene with a known answer.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/e2e/daemon.h"
#include "tests/server/shipped_scene.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

// A server of its own, and a ball that is bowled.
class SimulateTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Daemon::Options options;
    options.data_dir = directory_.path() + "/data";
    options.solver = SLOW_SOLVER;  // the server wants one at its start; no solve is asked for
    daemon_ = std::make_unique<Daemon>(options);
    ASSERT_NE(daemon_->address(), "");
    stub_ = daemon_->NewStub();
    *request_.mutable_scene() = ReadShipped("ball_bowled.json");
  }

  const TemporaryDirectory directory_;
  std::unique_ptr<Daemon> daemon_;
  std::unique_ptr<v1::GaitService::Stub> stub_;
  grpc::ClientContext context_;
  v1::SimulateRequest request_;
};

TEST_F(SimulateTest, ABowledBallBeginsToRollWhenItShould) {
  const auto stream = stub_->Simulate(&context_, request_);
  std::vector<v1::SimulationEvent> events;
  std::vector<v1::SimulationSample> samples;
  v1::SimulationReport report;
  v1::SimulationMessage message;
  while (stream->Read(&message)) {
    for (const v1::SimulationSample& sample : message.samples().samples()) samples.push_back(sample);
    if (message.has_event()) events.push_back(message.event());
    if (message.has_report()) report = message.report();
  }
  const grpc::Status status = stream->Finish();
  ASSERT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(report.end(), v1::SimulationReport::END_DURATION);
  EXPECT_LT(report.max_energy_error_j(), 1e-9);
  ASSERT_EQ(samples.size(), 101u);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind(), v1::SimulationEvent::KIND_STUCK);
  EXPECT_EQ(events[0].contact(), "contact");
  // 2 v / (7 μ g), then 5/7 of the speed.
  const double begin = 2 * 3.5 / (7 * 0.2 * 9.81);
  EXPECT_NEAR(events[0].time_s(), begin, 1e-9);
  EXPECT_TRUE(samples[50].contacts(0).sliding());
  EXPECT_FALSE(samples[51].contacts(0).sliding());
  const double x = 0.5 * (3.5 + 2.5) * begin + 2.5 * (1 - begin);
  EXPECT_NEAR(samples.back().positions(4), x, 1e-9);
}

TEST_F(SimulateTest, ARefusalNamesTheField) {
  request_.mutable_scene()->mutable_contacts(0)->set_friction(-0.2);
  const auto stream = stub_->Simulate(&context_, request_);
  v1::SimulationMessage message;
  EXPECT_FALSE(stream->Read(&message));
  const grpc::Status status = stream->Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_NE(status.error_details().find("contacts[0].friction"), std::string::npos);
}

}  // namespace
}  // namespace rollgait::server
