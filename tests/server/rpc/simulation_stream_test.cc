// Simulate and FindPeriodicGait over a server in this process and the real rollgait-simulate.

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <thread>

#include "tests/server/rpc/rpc_bench.h"
#include "tests/server/shipped_scene.h"

namespace rollgait::server {
namespace {

RpcOptions WithSimulator(int slots = 2, const std::string& program = ROLLGAIT_SIMULATE) {
  RpcOptions options;
  options.simulation.program = program;
  options.simulation.slots = slots;
  return options;
}

struct Streamed {
  grpc::Status status;
  std::vector<v1::SimulationSample> samples;
  std::vector<v1::SimulationEvent> events;
  std::vector<v1::GaitIteration> iterations;
  std::optional<v1::SimulationReport> report;
  std::optional<v1::PeriodicGait> gait;
};

template <typename Reader>
Streamed ReadAll(Reader stream) {
  Streamed all;
  v1::SimulationMessage message;
  while (stream->Read(&message)) {
    for (const auto& sample : message.samples().samples()) all.samples.push_back(sample);
    if (message.has_event()) all.events.push_back(message.event());
    if (message.has_gait_iteration()) all.iterations.push_back(message.gait_iteration());
    if (message.has_report()) all.report = message.report();
    if (message.has_gait()) all.gait = message.gait();
  }
  all.status = stream->Finish();
  return all;
}

Streamed Simulate(RpcBench& bench, const v1::SimulateRequest& request) {
  grpc::ClientContext context;
  return ReadAll(bench.stub().Simulate(&context, request));
}

TEST(SimulationStream, StreamsSamplesEventsAndAReport) {
  RpcBench bench(WithSimulator());
  v1::SimulateRequest request;
  *request.mutable_scene() = ReadShipped("elliptic_foot_walker.json");
  request.mutable_scene()->set_duration_s(2);
  const Streamed all = Simulate(bench, request);
  ASSERT_TRUE(all.status.ok()) << all.status.error_message();
  ASSERT_EQ(all.samples.size(), 201u);
  for (size_t i = 1; i < all.samples.size(); ++i) EXPECT_GT(all.samples[i].time_s(), all.samples[i - 1].time_s());
  EXPECT_EQ(all.samples.back().time_s(), 2);
  ASSERT_EQ(all.events.size(), 2u);
  EXPECT_EQ(all.events[0].contact(), "foot_2");
  ASSERT_TRUE(all.report.has_value());
  EXPECT_EQ(all.report->end(), v1::SimulationReport::END_DURATION);
  EXPECT_EQ(all.report->impacts(), 2);
  EXPECT_GT(all.report->min_normal_force_n(), 0);
  EXPECT_GT(all.report->cpu_time_s(), 0);
  EXPECT_LE(all.report->cpu_time_s(), all.report->wall_time_s() + 0.01) << "one thread; the clocks are read in turn";
}

TEST(SimulationStream, FindsAPeriodicGait) {
  RpcBench bench(WithSimulator());
  v1::FindPeriodicGaitRequest request;
  *request.mutable_scene() = ReadShipped("elliptic_foot_walker.json");
  grpc::ClientContext context;
  const Streamed all = ReadAll(bench.stub().FindPeriodicGait(&context, request));
  ASSERT_TRUE(all.status.ok()) << all.status.error_message();
  EXPECT_GE(all.iterations.size(), 2u);
  ASSERT_TRUE(all.gait.has_value());
  EXPECT_TRUE(all.gait->converged());
  EXPECT_TRUE(all.gait->stable());
  EXPECT_NEAR(all.gait->positions(2), 0.23402060082734957, 1e-10);
}

TEST(SimulationStream, RefusesWithThePathOfTheField) {
  RpcBench bench(WithSimulator());
  v1::SimulateRequest request;
  EXPECT_EQ(ViolatedField(Simulate(bench, request).status), "scene");
  *request.mutable_scene() = ReadShipped("ball_flat.json");
  request.set_max_wall_time_s(-1);
  EXPECT_EQ(ViolatedField(Simulate(bench, request).status), "max_wall_time_s");
  request.clear_max_wall_time_s();
  request.mutable_scene()->mutable_joints(0)->set_mass_kg(-1);
  const Streamed massless = Simulate(bench, request);
  EXPECT_EQ(massless.status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(ViolatedField(massless.status), "scene.joints[0].mass_kg");
  EXPECT_TRUE(massless.samples.empty());
  // Also what only the state at t = 0 shows.
  request.mutable_scene()->mutable_joints(0)->set_mass_kg(1);
  request.mutable_scene()->clear_adjusted_joints();
  request.mutable_scene()->mutable_joints(0)->mutable_initial()->mutable_position_m()->set_z(0.2);
  request.set_validate_only(true);
  EXPECT_EQ(ViolatedField(Simulate(bench, request).status), "scene.contacts[0].active");
  request.mutable_scene()->add_adjusted_joints("body");
  const Streamed valid = Simulate(bench, request);
  EXPECT_TRUE(valid.status.ok());
  EXPECT_TRUE(valid.samples.empty());
}

v1::SimulateRequest Endless() {
  v1::SimulateRequest request;
  *request.mutable_scene() = ReadShipped("rattleback.json");
  request.mutable_scene()->set_duration_s(1e6);
  request.mutable_scene()->set_output_step_s(1);
  request.mutable_scene()->set_max_steps(1'000'000'000);
  return request;
}

TEST(SimulationStream, EndsAtItsWallTime) {
  RpcBench bench(WithSimulator());
  v1::SimulateRequest request = Endless();
  request.set_max_wall_time_s(0.3);
  EXPECT_EQ(Simulate(bench, request).status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
}

TEST(SimulationStream, AClientThatGoesAwayFreesItsSlot) {
  RpcBench bench(WithSimulator(1));
  {
    grpc::ClientContext context;
    const auto stream = bench.stub().Simulate(&context, Endless());
    v1::SimulationMessage message;
    ASSERT_TRUE(stream->Read(&message));
    v1::SimulateRequest other;
    *other.mutable_scene() = ReadShipped("ball_flat.json");
    const Streamed refused = Simulate(bench, other);
    EXPECT_EQ(refused.status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    context.TryCancel();
    EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
  }
  v1::SimulateRequest request;
  *request.mutable_scene() = ReadShipped("ball_flat.json");
  for (int i = 0; i < 500; ++i) {
    if (Simulate(bench, request).status.ok()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  FAIL() << "the slot was not freed";
}

TEST(SimulationStream, TheServerStopsWhileASimulationRuns) {
  RpcBench bench(WithSimulator(1));
  grpc::ClientContext context;
  const auto stream = bench.stub().Simulate(&context, Endless());
  v1::SimulationMessage message;
  ASSERT_TRUE(stream->Read(&message));
  bench.server().Stop(std::chrono::milliseconds(500));
  while (stream->Read(&message)) {
  }
  EXPECT_FALSE(stream->Finish().ok());
}

TEST(SimulationStream, AProcessThatDiesIsAnInternalErrorAndTheServerLives) {
  RpcBench bench(WithSimulator(2, "/bin/false"));
  v1::SimulateRequest request;
  *request.mutable_scene() = ReadShipped("ball_flat.json");
  for (int i = 0; i < 3; ++i) {
    const Streamed all = Simulate(bench, request);
    EXPECT_EQ(all.status.error_code(), grpc::StatusCode::INTERNAL);
    EXPECT_NE(all.status.error_message().find("exit code 1"), std::string::npos) << all.status.error_message();
  }
}

TEST(SimulationStream, WithoutAProgramTheCallIsUnavailable) {
  RpcBench bench;
  v1::SimulateRequest request;
  *request.mutable_scene() = ReadShipped("ball_flat.json");
  EXPECT_EQ(Simulate(bench, request).status.error_code(), grpc::StatusCode::UNAVAILABLE);
}

}  // namespace
}  // namespace rollgait::server
