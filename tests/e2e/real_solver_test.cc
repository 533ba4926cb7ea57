// The whole way with the real solver: rollgaitd, rollgait-agent, rollgait-solve.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <filesystem>

#include "tests/e2e/daemon.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

using Clock = std::chrono::steady_clock;

v1::RunSolveRequest Request(double slope) {
  v1::RunSolveRequest request;
  request.mutable_spec()->mutable_model()->set_name("planar");
  request.mutable_spec()->set_slope_rad(slope);
  request.mutable_spec()->mutable_accuracy()->set_level(v1::Accuracy::LEVEL_DRAFT);
  request.mutable_spec()->mutable_discretization()->set_single_support_intervals(8);
  return request;
}

struct Answer {
  bool dense = true;
  int iterations = 0;
  double first_iteration_ms = 0;
  v1::Solve solve;
  grpc::Status status;
};

Answer RunSolve(v1::GaitService::Stub& stub, const v1::RunSolveRequest& request) {
  Answer run;
  grpc::ClientContext context;
  const Clock::time_point start = Clock::now();
  const auto stream = stub.RunSolve(&context, request);
  v1::SolveEvent event;
  int64_t last = 0;
  while (stream->Read(&event)) {
    run.dense = run.dense && event.sequence() == last + event.skipped_count() + 1;
    last = event.sequence();
    if (event.has_iteration() && run.iterations++ == 0) {
      run.first_iteration_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    }
    if (event.has_finished()) run.solve = event.finished();
  }
  run.status = stream->Finish();
  return run;
}

TEST(RealSolverTest, AGaitComesBackWithItsAccuracy) {
  const TemporaryDirectory directory;
  Daemon::Options options;
  options.data_dir = directory.path() + "/data";
  const Daemon daemon(options);
  ASSERT_NE(daemon.address(), "");
  const auto stub = daemon.NewStub();
  for (const double slope : {0.0, 0.05}) {
    const Answer run = RunSolve(*stub, Request(slope));
    ASSERT_TRUE(run.status.ok()) << run.status.error_message();
    EXPECT_TRUE(run.dense);
    EXPECT_GT(run.iterations, 3);
    ASSERT_EQ(run.solve.state(), v1::SOLVE_STATE_SUCCEEDED) << run.solve.error().message();
    const v1::SolveResult& result = run.solve.result();
    EXPECT_EQ(result.termination(), v1::TERMINATION_OPTIMAL) << result.message();
    EXPECT_GT(result.trajectory().phases_size(), 0);
    EXPECT_LE(result.accuracy().kkt_error(), 1e-6);  // the default of Accuracy.kkt_tolerance
    EXPECT_NEAR(result.speed_m_s(), 1.3, 1e-6);      // the default of Motion.speed_m_s, to the constraint tolerance
    EXPECT_GT(result.cpu_time_s(), 0);
    EXPECT_NE(result.solver_build(), "");
    // Not a condition: it is the machine's as much as ours.
    std::printf("slope %g: first iteration after %.1f ms, %d iterations, %.0f ms in the solver\n", slope,
                run.first_iteration_ms, run.iterations, 1000 * result.wall_time_s());
  }
  const Answer again = RunSolve(*stub, Request(0.05));
  EXPECT_TRUE(again.solve.from_cache());
  EXPECT_EQ(again.iterations, 0);
  EXPECT_EQ(again.solve.result().termination(), v1::TERMINATION_OPTIMAL);
}

TEST(RealSolverTest, IteratesComeWhileTheSolverRunsToThoseWhoAsk) {
  const TemporaryDirectory directory;
  Daemon::Options options;
  options.data_dir = directory.path() + "/data";
  const Daemon daemon(options);
  ASSERT_NE(daemon.address(), "");
  const auto stub = daemon.NewStub();
  v1::CreateSolveRequest create;
  create.mutable_spec()->mutable_model()->set_name("human29");
  create.mutable_spec()->set_slope_rad(0.05);
  v1::Solve solve;
  grpc::ClientContext creating;
  const Clock::time_point start = Clock::now();
  ASSERT_TRUE(stub->CreateSolve(&creating, create, &solve).ok());
  v1::WatchSolveRequest watch;
  watch.set_name(solve.name());
  watch.set_iterates_per_second(4);
  grpc::ClientContext context;
  const auto stream = stub->WatchSolve(&context, watch);
  v1::SolveEvent event;
  int iterates = 0;
  while (stream->Read(&event)) {
    if (!event.has_iterate()) continue;
    const v1::Iterate& iterate = event.iterate();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (iterates++ == 0) {
      std::printf("first iterate after %.0f ms\n", 1000 * seconds);
      EXPECT_LT(seconds, 20) << "it need not wait for the end";
    }
    EXPECT_LE(iterates, 1 + 4 * seconds);
    EXPECT_LT(iterate.ByteSizeLong(), size_t{64} << 10);
    EXPECT_EQ(iterate.joint_names_size(), 29);
    EXPECT_GT(iterate.phases_size(), 0);
    for (const v1::Iterate::Phase& phase : iterate.phases()) {
      EXPECT_EQ(phase.positions_size(), 29 * phase.times_s_size());
    }
  }
  EXPECT_TRUE(stream->Finish().ok());
  EXPECT_GT(iterates, 0);
  ASSERT_TRUE(event.has_finished());
  EXPECT_EQ(event.finished().result().termination(), v1::TERMINATION_OPTIMAL);
  EXPECT_TRUE(std::filesystem::is_empty(options.data_dir + "/iterates"));
  watch.set_iterates_per_second(0);
  grpc::ClientContext again;
  const auto stored = stub->WatchSolve(&again, watch);
  while (stored->Read(&event)) EXPECT_FALSE(event.has_iterate());
  EXPECT_TRUE(stored->Finish().ok());
}

TEST(RealSolverTest, ANeighbourStartsFromAStoredSolve) {
  const TemporaryDirectory directory;
  Daemon::Options options;
  options.data_dir = directory.path() + "/data";
  const Daemon daemon(options);
  ASSERT_NE(daemon.address(), "");
  const auto stub = daemon.NewStub();
  const v1::Solve level = RunSolve(*stub, Request(0)).solve;
  ASSERT_EQ(level.result().termination(), v1::TERMINATION_OPTIMAL);
  v1::RunSolveRequest neighbour = Request(0.01);
  const Answer cold = RunSolve(*stub, neighbour);
  neighbour.mutable_spec()->set_warm_start(level.name());
  const Answer named = RunSolve(*stub, neighbour);
  EXPECT_FALSE(named.solve.from_cache());  // the cold result is no answer to it
  ASSERT_EQ(named.solve.result().termination(), v1::TERMINATION_OPTIMAL) << named.solve.error().message();
  EXPECT_LT(named.iterations, cold.iterations);
  EXPECT_EQ(named.solve.result().warm_started_from().name(), level.name());
  EXPECT_NEAR(named.solve.result().warm_started_from().slope_difference_rad(), 0.01, 1e-12);
  EXPECT_TRUE(named.solve.result().warm_started_from().used_multipliers());
  EXPECT_FALSE(cold.solve.result().has_warm_started_from());

  neighbour.mutable_spec()->set_warm_start("nearest");
  neighbour.mutable_spec()->set_slope_rad(-0.012);
  const Answer nearest = RunSolve(*stub, neighbour);
  ASSERT_EQ(nearest.solve.result().termination(), v1::TERMINATION_OPTIMAL);
  EXPECT_EQ(nearest.solve.result().warm_started_from().name(), level.name());
  EXPECT_TRUE(RunSolve(*stub,
                       [&] {
                         v1::RunSolveRequest again = neighbour;
                         again.mutable_spec()->set_warm_start(level.name());
                         return again;
                       }())
                  .solve.from_cache());  // the same start by its name

  neighbour.mutable_spec()->mutable_model()->set_name("human29");
  neighbour.mutable_spec()->set_warm_start(level.name());
  const Answer refused = RunSolve(*stub, neighbour);
  EXPECT_EQ(refused.status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_NE(refused.status.error_message().find("other joints"), std::string::npos) << refused.status.error_message();
}

v1::Solve SolveWith(const std::string& instruction_set, const std::string& data_dir) {
  Daemon::Options options;
  options.data_dir = data_dir;
  options.flags = {"--instruction-set", instruction_set};
  const Daemon daemon(options);
  if (daemon.address().empty()) return {};
  const auto stub = daemon.NewStub();
  v1::ServerInfo info;
  grpc::ClientContext context;
  EXPECT_TRUE(stub->GetServerInfo(&context, {}, &info).ok());
  const v1::Solve solve = RunSolve(*stub, Request(0)).solve;
  EXPECT_EQ(solve.result().solver_build(), info.solver_build());
  return solve;
}

TEST(RealSolverTest, EachInstructionSetHasItsProgramAndItsResults) {
  const TemporaryDirectory directory;
  const std::string data_dir = directory.path() + "/data";
  const v1::Solve baseline = SolveWith("baseline", data_dir), best = SolveWith("auto", data_dir);
  ASSERT_EQ(baseline.result().termination(), v1::TERMINATION_OPTIMAL);
  ASSERT_EQ(best.result().termination(), v1::TERMINATION_OPTIMAL);
  EXPECT_EQ(baseline.result().solver_build().find("x86-64-v3"), std::string::npos);
  if (best.result().solver_build() == baseline.result().solver_build()) {
    GTEST_SKIP() << "this build or this processor has the baseline only";
  }
  EXPECT_NE(best.result().solver_build().find("x86-64-v3"), std::string::npos);
  EXPECT_FALSE(best.from_cache());  // one solver's result is not the other's
  // Both meet the KKT tolerance of 1e-6; at a minimum the objective follows to its square, the barrier to a like
  // fraction.
  EXPECT_NEAR(best.result().objective(), baseline.result().objective(), 1e-5 * baseline.result().objective());
}

}  // namespace
}  // namespace rollgait::server
