// A cycle that is known, cut at every place and completed from its half, comes out the same.
#include "core/validation/gait_cycle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/models/planar_human.h"
#include "core/validation/normative.h"
#include "tests/support/prescribed_walk.h"

namespace rollgait {
namespace {

PrescribedWalk Walk() {
  PrescribedWalk walk;
  const auto wave = [](double size, double phase) {
    return [size, phase](double percent) { return size * std::sin(2 * std::numbers::pi * percent / 100 + phase); };
  };
  walk.angles = {{"hip", wave(0.4, 1.2)}, {"knee", wave(0.3, -0.4)}, {"ankle", wave(0.2, 2)}};
  walk.vertical = [](double percent) { return 500 + percent; };
  walk.forward = [](double percent) { return percent - 30; };
  walk.toe_off = 63;
  return walk;
}

class GaitCycleTest : public ::testing::TestWithParam<std::pair<Cycle, double>> {
 protected:
  Scene scene_ = PlanarHuman(Sex::kMale, 1.8, 80);
  PrescribedWalk walk_ = Walk();
  Trajectory trajectory_ = walk_.Make(scene_, GetParam().first, GetParam().second);
};

TEST_P(GaitCycleTest, ShareOfEveryPhase) {
  const auto cycle = GaitCycle::Of(scene_, trajectory_);
  ASSERT_TRUE(cycle);
  EXPECT_NEAR(cycle->duration(), 1.1, 1e-13);
  EXPECT_NEAR(cycle->displacement(), 1.4, 1e-13);
  // Both feet, right, both, left; a cut in the midst of one of them leaves no trace.
  const std::vector<GaitCycle::Span>& spans = cycle->spans();
  ASSERT_EQ(spans.size(), 4u);
  const double borders[] = {0, 13, 50, 63, 100};
  for (size_t i = 0; i < spans.size(); ++i) {
    EXPECT_NEAR(spans[i].begin, borders[i], 1e-11) << i;
    EXPECT_NEAR(spans[i].end, borders[i + 1], 1e-11) << i;
    EXPECT_EQ(spans[i].right, i != 3) << i;
    EXPECT_EQ(spans[i].left, i != 1) << i;
    EXPECT_EQ(spans[i].contacts.size(), i % 2 == 0 ? 2u : 1u) << i;
  }
  // Where the heel strike lies after the cut.
  const double cut = GetParam().second, start = std::fmod(100 - cut, 100) / 100 * 1.1;
  EXPECT_NEAR(cycle->start(), start, 1e-11);
}

TEST_P(GaitCycleTest, CurvesAreThoseThatWerePutIn) {
  const auto cycle = GaitCycle::Of(scene_, trajectory_);
  ASSERT_TRUE(cycle);
  const int foot = 3 * scene_.FindContact("right_foot");
  const double begin = cycle->At(0).position[scene_.model.Find("base_x")];
  for (double percent = 0; percent < 100; percent += 2) {
    const MotionSample sample = cycle->At(percent);
    for (const auto& [name, curve] : walk_.angles) {
      EXPECT_NEAR(sample.position[LegJoint(scene_.model, name, BodySide::kRight)], curve(percent), 1e-12)
          << name << " at " << percent;
      const int left = scene_.model.Find(name + "_l");
      EXPECT_NEAR(sample.position[left], curve(percent + 50), 1e-12) << name << " at " << percent;
    }
    EXPECT_NEAR(sample.position[scene_.model.Find("base_x")] - begin, percent / 100 * 1.4, 1e-12);
    const bool on = percent < 63;
    EXPECT_NEAR(sample.forces[foot + 2], on ? 500 + percent : 0, 1e-9) << percent;
    EXPECT_NEAR(sample.forces[foot], on ? percent - 30 : 0, 1e-9) << percent;
  }
  EXPECT_NEAR(cycle->At(100).position[scene_.model.Find("base_x")] - begin, 1.4, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Cuts, GaitCycleTest,
                         ::testing::Values(std::pair{Cycle::kFull, 0.0}, std::pair{Cycle::kFull, 13.0},
                                           std::pair{Cycle::kFull, 30.0}, std::pair{Cycle::kFull, 81.5},
                                           std::pair{Cycle::kHalf, 0.0}, std::pair{Cycle::kHalf, 13.0},
                                           std::pair{Cycle::kHalf, 30.0}, std::pair{Cycle::kHalf, 50.0},
                                           std::pair{Cycle::kHalf, 63.0}));

TEST(GaitCycleWithoutStepsTest, IsNone) {
  const Scene scene = PlanarHuman(Sex::kMale, 1.8, 80);
  Trajectory trajectory = Walk().Make(scene, Cycle::kFull, 0);
  for (TrajectoryPhase& phase : trajectory.phases) phase.contacts = {0, 1};
  EXPECT_FALSE(GaitCycle::Of(scene, trajectory));
  for (TrajectoryPhase& phase : trajectory.phases) phase.contacts.clear();
  EXPECT_FALSE(GaitCycle::Of(scene, trajectory));
}

}  // namespace
}  // namespace rollgait
