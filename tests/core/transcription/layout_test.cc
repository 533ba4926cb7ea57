#include "core/transcription/layout.h"

#include <gtest/gtest.h>

#include "core/gait/build_problem.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {
namespace {

// Planar walker: 9 coordinates, 6 efforts, double support with 4 forces and single support with 2.
class LayoutTest : public ::testing::Test {
 protected:
  static std::unique_ptr<OptimalControlProblem> Problem() {
    GaitRequest request;
    request.body.model = "planar";
    request.motion.speed = 1.3;
    return BuildProblem(CheckRequest(request).value());
  }
  const std::unique_ptr<OptimalControlProblem> problem_ = Problem();
  const Mesh mesh_{{{1.0}, {0.25, 0.75}}};
};

TEST_F(LayoutTest, TwoPoints) {
  const DecisionLayout layout(*problem_, mesh_, 2);
  ASSERT_EQ(layout.intervals(), 3);
  ASSERT_EQ(layout.phases(), 2);
  // 18 of a node, then 2 · (6 + 4) or 2 · (6 + 2).
  EXPECT_EQ(layout.node(0), 0);
  EXPECT_EQ(layout.interior(0), 18);
  EXPECT_EQ(layout.efforts(0, 0), 18);
  EXPECT_EQ(layout.forces(0, 0), 24);
  EXPECT_EQ(layout.efforts(0, 1), 28);
  EXPECT_EQ(layout.node(1), 38);
  EXPECT_EQ(layout.efforts(1, 1), 64);
  EXPECT_EQ(layout.forces(1, 1), 70);
  EXPECT_EQ(layout.node(2), 72);
  EXPECT_EQ(layout.node(3), 106);
  EXPECT_EQ(layout.duration(0), 124);
  EXPECT_EQ(layout.duration(1), 125);
  EXPECT_EQ(layout.displacement(), 126);
  EXPECT_EQ(layout.size(), 127);
}

TEST_F(LayoutTest, ThreePointsHaveAFreeAcceleration) {
  const DecisionLayout layout(*problem_, mesh_, 3);
  EXPECT_EQ(layout.interior_size(0), 9 + 3 * 10);
  EXPECT_EQ(layout.interior_size(1), 9 + 3 * 8);
  EXPECT_EQ(layout.free_acceleration(0, 0), 18);
  EXPECT_EQ(layout.efforts(0, 0), 27);
  EXPECT_EQ(layout.efforts(0, 2), 47);
  EXPECT_EQ(layout.node(1), 57);
  EXPECT_EQ(layout.node(2), 108);
  EXPECT_EQ(layout.node(3), 159);
  EXPECT_EQ(layout.size(), 159 + 18 + 2 + 1);
}

// Before the first node the impulses of the first phase; nothing touches down in the second. In a full cycle something
// does in the third: a node and 4 impulses more.
TEST_F(LayoutTest, JumpsHaveImpulsesAndAStateBefore) {
  const auto problem = Problem();
  problem->plastic_touch_down = true;
  const DecisionLayout half(*problem, mesh_, 2);
  EXPECT_TRUE(half.jumps(0));
  EXPECT_FALSE(half.jumps(1));
  EXPECT_EQ(half.impulse(0), 0);
  EXPECT_EQ(half.impulse_size(0), 4);
  EXPECT_EQ(half.node(0), 4);
  EXPECT_EQ(half.end_node(0), 42);
  EXPECT_EQ(half.node(1), 42);
  EXPECT_EQ(half.size(), 131);

  GaitRequest request;
  request.body.model = "planar";
  request.cycle = Cycle::kFull;
  request.ground_contact.touch_down = GaitRequest::TouchDown::kPlastic;
  const auto both = BuildProblem(CheckRequest(request).value());
  const DecisionLayout full(*both, {{{1.0}, {1.0}, {1.0}, {1.0}}}, 2);
  EXPECT_TRUE(full.jumps(2));
  EXPECT_EQ(full.node(1), 42);
  EXPECT_EQ(full.end_node(1), 42 + 34);
  EXPECT_EQ(full.source(1, 2), 42 + 34);
  EXPECT_EQ(full.impulse(2), 42 + 34 + 18);
  EXPECT_EQ(full.node(2), 42 + 34 + 18 + 4);
  EXPECT_EQ(full.end_node(3), full.node(4));
}

TEST_F(LayoutTest, SourcesAreTheNodesAndTheFreeAccelerations) {
  const DecisionLayout layout(*problem_, mesh_, 3);
  const int expected[] = {57, 66, 108, 117, 75};
  for (int s = 0; s < 5; ++s) EXPECT_EQ(layout.source(1, s), expected[s]);
  EXPECT_EQ(DecisionLayout::source_scale(3), 1);
  EXPECT_EQ(DecisionLayout::source_scale(4), 10);
}

TEST_F(LayoutTest, IntervalsOfPhases) {
  const DecisionLayout layout(*problem_, mesh_, 2);
  EXPECT_EQ(layout.phase(0), 0);
  EXPECT_EQ(layout.phase(1), 1);
  EXPECT_EQ(layout.phase(2), 1);
  EXPECT_EQ(layout.first_interval(1), 1);
  EXPECT_EQ(layout.intervals_in(0), 1);
  EXPECT_EQ(layout.intervals_in(1), 2);
  EXPECT_TRUE(layout.ends_phase(0));
  EXPECT_FALSE(layout.ends_phase(1));
  EXPECT_TRUE(layout.ends_phase(2));
  EXPECT_EQ(layout.start(1), 0);
  EXPECT_EQ(layout.start(2), 0.25);
  EXPECT_EQ(layout.length(2), 0.75);
}

TEST(Mesh, UniformFractionsSumToOne) {
  const Mesh mesh = Mesh::Uniform({3, 5});
  EXPECT_EQ(mesh.Intervals(), (std::vector<int>{3, 5}));
  double sum = 0;
  for (double fraction : mesh.fractions[1]) sum += fraction;
  EXPECT_NEAR(sum, 1, 1e-15);
}

// Without the mirror nothing else says where a walk in space is to its side.
TEST(Bounds, AFullCycleStartsInTheMiddle) {
  for (const Cycle cycle : {Cycle::kHalf, Cycle::kFull}) {
    GaitRequest request;
    request.body.model = "human29";
    request.cycle = cycle;
    const GaitSpec spec = CheckRequest(request).value();
    const auto problem = BuildProblem(spec);
    const CollocationNlp nlp(*problem, Scheme::kRadau2, Mesh::Uniform(std::vector<int>(problem->phases.size(), 1)));
    const int y = nlp.layout().node(0) + problem->model.Find("base_y");
    EXPECT_EQ(nlp.lower_bounds()(y) == 0 && nlp.upper_bounds()(y) == 0, cycle == Cycle::kFull);
  }
}

}  // namespace
}  // namespace rollgait
