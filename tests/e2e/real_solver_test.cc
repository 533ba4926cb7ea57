// The whole way with the real solver: rollgaitd, rollgait-agent, rollgait-solve.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

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

}  // namespace
}  // namespace rollgait::server
