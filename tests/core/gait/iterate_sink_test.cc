#include "core/gait/iterate_sink.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "core/gait/optimizing_gait_solver.h"
#include "tests/support/ball_request.h"

namespace rollgait {
namespace {

// Keeps what it takes: of every iteration, or of none.
class Collector : public IterateSink {
 public:
  explicit Collector(bool wants = true) : wants_(wants) {}
  bool Wants() override {
    ++asked;
    return wants_;
  }
  void Take(const IterationInfo& iteration, const CoarseMotion& motion) override {
    iterations.push_back(iteration);
    motions.push_back(motion);
  }

  int asked = 0;
  std::vector<IterationInfo> iterations;
  std::vector<CoarseMotion> motions;

 private:
  const bool wants_;
};

// On the moon, where seconds of the solver are not those of the request.
GaitRequest Moon(int intervals) {
  GaitRequest request;
  request.body.model = "planar";
  request.gravity = 1.62;
  request.motion.speed = 0.5;
  request.starts = 1;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.discretization = {Scheme::kRadau2, intervals, 4};
  return request;
}

GaitSolution Solve(const GaitRequest& request, IterateSink* sink, std::vector<IterationInfo>* reported = nullptr) {
  SolveControl control;
  control.iterates = sink;
  if (reported != nullptr) control.observer = [reported](const IterationInfo& info) { reported->push_back(info); };
  return OptimizingGaitSolver().Solve(CheckRequest(request).value(), control);
}

TEST(IterateSink, TheLastIterateIsTheSolutionInSeconds) {
  Collector collector;
  std::vector<IterationInfo> reported;
  const GaitSolution solution = Solve(Moon(20), &collector, &reported);
  ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  ASSERT_EQ(collector.motions.size(), reported.size()) << "one an iteration";
  EXPECT_EQ(collector.iterations.back().index, reported.back().index);
  EXPECT_EQ(collector.iterations.back().mesh, reported.back().mesh);
  const Trajectory& trajectory = *solution.trajectory;
  const CoarseMotion& last = collector.motions.back();
  EXPECT_EQ(last.cycle, Cycle::kHalf);
  EXPECT_NEAR(last.duration, trajectory.duration, 1e-12);
  EXPECT_EQ(last.displacement, trajectory.displacement);
  ASSERT_EQ(last.phases.size(), trajectory.phases.size());
  for (size_t p = 0; p < last.phases.size(); ++p) {
    const CoarseMotion::Phase& phase = last.phases[p];
    const TrajectoryPhase& whole = trajectory.phases[p];
    EXPECT_EQ(phase.contacts, whole.contacts);
    EXPECT_NEAR(phase.start, whole.start, 1e-12);
    EXPECT_NEAR(phase.duration, whole.duration, 1e-12);
    ASSERT_EQ(phase.times.size(), std::min<size_t>(whole.node_times.size(), 16));
    ASSERT_EQ(phase.positions.cols(), static_cast<int>(phase.times.size()));
    EXPECT_NEAR(phase.times.front(), whole.node_times.front(), 1e-12);
    EXPECT_NEAR(phase.times.back(), whole.node_times.back(), 1e-12);
    int node = 0;
    for (size_t i = 0; i < phase.times.size(); ++i) {
      while (node < static_cast<int>(whole.node_times.size()) && whole.node_times[node] < phase.times[i] - 1e-9) ++node;
      ASSERT_NEAR(phase.times[i], whole.node_times[node], 1e-9) << "every time is one of a node";
      EXPECT_EQ(phase.positions.col(static_cast<int>(i)), whole.node_positions.col(node));
    }
  }
}

TEST(IterateSink, DoesNotChangeTheSolution) {
  Collector all, none(false);
  const GaitSolution watched = Solve(Moon(8), &all), unwatched = Solve(Moon(8), nullptr), asked = Solve(Moon(8), &none);
  ASSERT_TRUE(watched.trajectory && unwatched.trajectory && asked.trajectory);
  EXPECT_GT(all.motions.size(), 5u);
  EXPECT_TRUE(none.motions.empty());
  EXPECT_EQ(none.asked, all.asked);
  for (const GaitSolution* other : {&watched, &asked}) {
    EXPECT_EQ(other->objective, unwatched.objective);
    for (size_t p = 0; p < unwatched.trajectory->phases.size(); ++p) {
      EXPECT_EQ(other->trajectory->phases[p].point_efforts, unwatched.trajectory->phases[p].point_efforts);
      EXPECT_EQ(other->trajectory->phases[p].node_positions, unwatched.trajectory->phases[p].node_positions);
    }
  }
}

// Its joints are those of charts that change from program to program.
TEST(IterateSink, SeesNothingOfAManoeuvre) {
  Collector collector;
  std::vector<IterationInfo> reported;
  const GaitSolution solution = Solve(RollTo(1, 0.3, 2), &collector, &reported);
  EXPECT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  EXPECT_FALSE(reported.empty());
  EXPECT_EQ(collector.asked, 0);
}

}  // namespace
}  // namespace rollgait
