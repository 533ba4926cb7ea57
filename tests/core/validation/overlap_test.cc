// Overlap along trajectories: planted ones of known depth, at known times, and dips too short for any sample.
#include "core/validation/overlap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/contact/pair_separation.h"
#include "core/models/catalog.h"

namespace rollgait {
namespace {

class OverlapTest : public ::testing::Test {
 protected:
  static Scene Build(bool sagittal) {
    BodyRequest request;
    request.model = "human29";
    request.feet = FootShape::kTwoEllipsoids;
    request.sagittal = sagittal;
    return BuildScene(request).value();
  }

  // One phase of intervals of `length` s, through which every joint moves at its constant velocity.
  Trajectory Moving(const VectorX& start, const VectorX& velocity, int intervals, double length) const {
    const int n = scene_.model.size();
    Trajectory trajectory;
    trajectory.point_fractions = {1.0 / 3, 1};
    TrajectoryPhase phase;
    phase.duration = intervals * length;
    phase.node_positions.resize(n, intervals + 1);
    phase.node_velocities = velocity.replicate(1, intervals + 1);
    for (int k = 0; k <= intervals; ++k) {
      phase.node_times.push_back(k * length);
      phase.node_positions.col(k) = start + k * length * velocity;
    }
    phase.point_accelerations = MatrixX::Zero(n, 2 * intervals);
    phase.point_efforts = MatrixX::Zero(static_cast<int>(scene_.model.actuated().size()), 2 * intervals);
    phase.point_forces = MatrixX::Zero(0, 2 * intervals);
    trajectory.phases.push_back(phase);
    return trajectory;
  }

  int FindPair(const std::string& name) const {
    for (size_t p = 0; p < scene_.pairs.size(); ++p) {
      if (scene_.PairName(static_cast<int>(p)) == name) return static_cast<int>(p);
    }
    ADD_FAILURE() << name;
    return 0;
  }

  // By the project's other algorithm; with `all_ways` by the shortest way out that it knows.
  double Distance(int pair, const VectorX& q, bool all_ways = false) const {
    BodyDynamics::State state;
    dynamics_.ComputeState(q, VectorX::Zero(q.size()), &state);
    PosedSurface posed[2];
    for (int b = 0; b < 2; ++b) {
      const BodySurface& body = scene_.bodies[b == 0 ? scene_.pairs[pair].first : scene_.pairs[pair].second];
      const BodyDynamics::Link& link = state[body.joint];
      posed[b] = {&body.placed.surface, link.R_WL * body.placed.R_BE, link.p_WL + link.R_WL * body.placed.p_BE};
    }
    const Vector3 start = posed[1].p_WE - posed[0].p_WE;
    return FindSeparation(posed[0], posed[1], all_ways ? nullptr : &start).distance;
  }

  VectorX Posture(double adduction) const {
    VectorX q = VectorX::Zero(scene_.model.size());
    q(scene_.model.Find("hip_adduction_l")) = q(scene_.model.Find("hip_adduction_r")) = adduction;
    return q;
  }

  // The left leg swings past the right one at 6 rad/s, 0.4 s long, with both turned inwards.
  VectorX SwingStart(double adduction) const {
    VectorX q = Posture(adduction);
    q(scene_.model.Find("hip_l")) = -1.17;
    return q;
  }
  VectorX SwingVelocity() const {
    VectorX v = VectorX::Zero(scene_.model.size());
    v(scene_.model.Find("hip_l")) = 6;
    return v;
  }
  // Least distance of a pair during the swing, and when: by instants 1 ms apart, then 10 µs apart around the least.
  std::pair<double, double> Closest(int pair, double adduction) const {
    const VectorX start = SwingStart(adduction), v = SwingVelocity();
    std::pair<double, double> least(kInfinity, 0);
    const auto scan = [&](double from, double step, int steps) {
      for (int i = 0; i <= steps; ++i) {
        const double time = from + i * step;
        least = std::min(least, std::pair(Distance(pair, start + time * v), time));
      }
    };
    scan(0, 1e-3, 400);
    scan(least.second - 1e-3, 1e-5, 200);
    return least;
  }

  const Scene scene_ = Build(false);
  const BodyDynamics dynamics_{scene_.model};
};

TEST_F(OverlapTest, NoneInStanding) {
  const OverlapFindings found = MeasureOverlap(scene_, dynamics_, Moving(Posture(0), VectorX::Zero(29), 3, 0.02));
  EXPECT_EQ(found.worst.value, 0);
  EXPECT_EQ(found.worst.where, "");
  EXPECT_EQ(found.intervals, std::vector<double>(3, 0));
  EXPECT_EQ(found.pairs, std::vector<double>(scene_.pairs.size(), 0));
  EXPECT_TRUE(found.Deeper(0).empty());
}

// Somebody stands with the legs pressed into each other: every pair is as deep as the other algorithm says, in every
// interval.
TEST_F(OverlapTest, StandingInOneself) {
  const VectorX q = Posture(0.12);
  const OverlapFindings found = MeasureOverlap(scene_, dynamics_, Moving(q, VectorX::Zero(29), 2, 0.02));
  int deep = 0;
  double worst = 0;
  for (size_t p = 0; p < scene_.pairs.size(); ++p) {
    const double depth = std::max(0.0, -Distance(static_cast<int>(p), q, true));
    EXPECT_NEAR(found.pairs[p], depth, 1e-9) << scene_.PairName(static_cast<int>(p));
    deep += depth > 1e-4;
    worst = std::max(worst, depth);
  }
  EXPECT_GE(deep, 4);
  EXPECT_NEAR(found.worst.value, worst, 1e-9);
  EXPECT_EQ(found.intervals.size(), 2u);
  for (const double depth : found.intervals) EXPECT_NEAR(depth, worst, 1e-9);
  EXPECT_EQ(static_cast<int>(found.Deeper(1e-4).size()), deep);
}

// A swing through the other leg: depth, time, interval and pair.
TEST_F(OverlapTest, ASwingThroughTheOtherLeg) {
  const int shanks = FindPair("left_shank / right_shank");
  const auto [distance, time] = Closest(shanks, 0.1);
  ASSERT_LT(distance, -0.01);
  const OverlapFindings found = MeasureOverlap(scene_, dynamics_, Moving(SwingStart(0.1), SwingVelocity(), 20, 0.02));
  // The instant of the least scaled contact is not quite that of the greatest depth.
  EXPECT_NEAR(found.pairs[shanks], -distance, 0.01 * -distance);
  EXPECT_LT(found.pairs[shanks], -distance + 1e-9);
  const int interval = static_cast<int>(time / 0.02);
  EXPECT_NEAR(found.intervals[interval], found.worst.value, 1e-3);
  EXPECT_EQ(found.intervals.front(), 0);
  EXPECT_EQ(found.intervals.back(), 0);
  EXPECT_NEAR(found.worst.time, time, 0.02);
  EXPECT_EQ(found.worst.phase, 0);
}

// Legs graze each other by 1e-3 to 1e-6 m, for a few milliseconds in an interval of 0.4 s, of which samples are 33 ms
// apart.
TEST_F(OverlapTest, NoDipIsTooShort) {
  const int shanks = FindPair("left_shank / right_shank");
  for (const double depth : {1e-3, 1e-4, 1e-5, 1e-6}) {
    double low = 0, high = 0.15;  // adduction
    for (int i = 0; i < 25; ++i) (Closest(shanks, (low + high) / 2).first > -depth ? low : high) = (low + high) / 2;
    const auto [distance, time] = Closest(shanks, high);
    ASSERT_NEAR(distance, -depth, 1e-8);
    for (const int intervals : {1, 3}) {
      const OverlapFindings found =
          MeasureOverlap(scene_, dynamics_, Moving(SwingStart(high), SwingVelocity(), intervals, 0.4 / intervals));
      EXPECT_NEAR(found.pairs[shanks], depth, 1e-7 + 1e-3 * depth);
      // Flat minima of the distance in time: depth and time are related by the square.
      if (found.worst.where == scene_.PairName(shanks)) {
        EXPECT_NEAR(found.worst.time, time, 2e-3);
      }
    }
  }
}

// A posture that is not a number overlaps without limit.
TEST_F(OverlapTest, NothingHidesBehindNaN) {
  VectorX q = Posture(0);
  q(scene_.model.Find("hip_l")) = std::numeric_limits<double>::quiet_NaN();
  const OverlapFindings found = MeasureOverlap(scene_, dynamics_, Moving(q, VectorX::Zero(q.size()), 1, 0.02));
  EXPECT_EQ(found.worst.value, kInfinity);
}

TEST_F(OverlapTest, NothingToJudgeInThePlane) {
  const Scene planar = Build(true);
  const BodyDynamics dynamics(planar.model);
  Trajectory trajectory = Moving(Posture(0), VectorX::Zero(29), 2, 0.02);
  TrajectoryPhase& phase = trajectory.phases.front();
  phase.node_positions = phase.node_velocities = MatrixX::Zero(planar.model.size(), 3);
  phase.point_accelerations = MatrixX::Zero(planar.model.size(), 4);
  const OverlapFindings found = MeasureOverlap(planar, dynamics, trajectory);
  EXPECT_TRUE(found.pairs.empty());
  EXPECT_EQ(found.intervals, std::vector<double>(2, 0));
  EXPECT_EQ(found.worst.value, 0);
}

}  // namespace
}  // namespace rollgait
