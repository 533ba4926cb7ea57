#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/gait/gait_spec.h"
#include "core/gait/request_check.h"

namespace rollgait {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

GaitRequest Planar() {
  GaitRequest request;
  request.body.model = "planar";
  return request;
}

std::vector<std::string> Fields(const Result<GaitSpec>& result) {
  std::vector<std::string> fields;
  if (!result.ok()) {
    for (const Violation& violation : result.violations()) fields.push_back(violation.field);
  }
  return fields;
}

TEST(CheckRequest, FillsTheDocumentedDefaults) {
  const Result<GaitSpec> result = CheckRequest(Planar());
  ASSERT_TRUE(result.ok()) << result.violations()[0].field << ": " << result.violations()[0].message;
  const GaitSpec& spec = result.value();
  EXPECT_EQ(spec.speed, 1.3);
  EXPECT_EQ(spec.speed_range.min, 1.3);
  EXPECT_EQ(spec.speed_range.max, 1.3);
  EXPECT_FALSE(spec.step_length);
  EXPECT_DOUBLE_EQ(spec.step_length_range.min, 0.1 * spec.scene.leg_length);
  EXPECT_DOUBLE_EQ(spec.step_length_range.max, 1.6 * spec.scene.leg_length);
  EXPECT_EQ(spec.step_duration_range.min, 0.1);
  EXPECT_EQ(spec.step_duration_range.max, 5);
  EXPECT_EQ(spec.gravity, Vector3(0, 0, -9.81));
  EXPECT_EQ(spec.friction_coefficient, 0.8);
  EXPECT_EQ(spec.min_normal_force_bw, 0);
  EXPECT_EQ(spec.swing_clearance, 0.01);
  EXPECT_EQ(spec.scheme, Scheme::kRadau2);
  EXPECT_EQ(spec.kkt_tolerance, 1e-6);
  EXPECT_EQ(spec.bounds[Criterion::kGap], 1e-4);
  EXPECT_EQ(spec.bounds[Criterion::kSlip], 1e-3);
  EXPECT_EQ(spec.max_refinements, 12);
  EXPECT_EQ(spec.max_iterations, 3000);
  EXPECT_EQ(spec.max_wall_time, 600);
}

TEST(CheckRequest, StandardHalfCycleIsDoubleThenSingleSupport) {
  const GaitSpec spec = CheckRequest(Planar()).value();
  const int left = spec.scene.FindContact("left_foot"), right = spec.scene.FindContact("right_foot");
  ASSERT_EQ(spec.phases.size(), 2u);
  EXPECT_THAT(spec.phases[0].contacts, ElementsAre(left, right));
  EXPECT_THAT(spec.phases[1].contacts, ElementsAre(left));
  EXPECT_EQ(spec.phases[0].intervals, 8);
  EXPECT_EQ(spec.phases[1].intervals, 16);
  EXPECT_EQ(spec.phases[0].min_duration, 0.02);
  EXPECT_EQ(spec.phases[1].max_duration, 1.5);
}

TEST(CheckRequest, StandardFullCycleHasFourPhases) {
  GaitRequest request = Planar();
  request.cycle = Cycle::kFull;
  request.discretization.single_support_intervals = 1;
  const GaitSpec spec = CheckRequest(request).value();
  const int left = spec.scene.FindContact("left_foot"), right = spec.scene.FindContact("right_foot");
  ASSERT_EQ(spec.phases.size(), 4u);
  EXPECT_THAT(spec.phases[1].contacts, ElementsAre(left));
  EXPECT_THAT(spec.phases[2].contacts, ElementsAre(left, right));
  EXPECT_THAT(spec.phases[3].contacts, ElementsAre(right));
  EXPECT_EQ(spec.phases[2].intervals, 1) << "half of one single-support interval, at least 1";
}

TEST(CheckRequest, DefaultCostIsSquaredTorqueOfEveryActuatedJoint) {
  const GaitSpec spec = CheckRequest(Planar()).value();
  ASSERT_EQ(spec.costs.size(), 1u);
  const auto& term = std::get<cost::SquaredTorque>(spec.costs[0].term);
  EXPECT_EQ(spec.costs[0].weight, 1);
  EXPECT_EQ(term.joint_weights.size(), spec.scene.model.actuated().size());
  for (const auto& [joint, weight] : term.joint_weights) EXPECT_EQ(weight, 1) << joint;
}

TEST(CheckRequest, UphillTurnsGravityBackwards) {
  GaitRequest request = Planar();
  request.slope = std::numbers::pi / 4;  // the steepest admissible
  request.gravity = 10;
  const GaitSpec spec = CheckRequest(request).value();
  EXPECT_LT(spec.gravity.x(), 0) << "walking towards +x is uphill";
  EXPECT_EQ(spec.gravity.y(), 0);
  EXPECT_DOUBLE_EQ(spec.gravity.x(), spec.gravity.z());
  EXPECT_NEAR(spec.gravity.norm(), 10, 1e-14);  // rounding
}

TEST(CheckRequest, AppliesLimitsToTheJointsOfTheScene) {
  GaitRequest request = Planar();
  request.limits.joint_position["knee_l"] = {0.1, 1};
  request.limits.joint_velocity["knee_l"] = 3;
  request.limits.joint_effort["knee_l"] = {-10, 20};
  const GaitSpec spec = CheckRequest(request).value();
  const Joint& knee = spec.scene.model.joint(spec.scene.model.Find("knee_l"));
  EXPECT_EQ(knee.position_min, 0.1);
  EXPECT_EQ(knee.position_max, 1);
  EXPECT_EQ(knee.velocity_max, 3);
  EXPECT_EQ(knee.effort_min, -10);
  EXPECT_EQ(knee.effort_max, 20);
  const Joint& other = spec.scene.model.joint(spec.scene.model.Find("knee_r"));
  EXPECT_NE(other.position_max, 1);
}

TEST(CheckRequest, FillsTheOptionalsOfCosts) {
  GaitRequest request = Planar();
  request.costs.push_back({cost::MechanicalWork{}, {}});
  request.costs.push_back({cost::Tracking{{{"hip_l", {0, 1}, {}}}}, 2.5});
  request.costs.push_back({cost::SquaredTorqueRate{{{"hip_l", 0.0}}}, {}});
  const GaitSpec spec = CheckRequest(request).value();
  EXPECT_EQ(std::get<cost::MechanicalWork>(spec.costs[0].term).smoothing, 5);
  EXPECT_EQ(std::get<cost::Tracking>(spec.costs[1].term).channels[0].weight, 1);
  EXPECT_EQ(spec.costs[1].weight, 2.5);
  const auto& weights = std::get<cost::SquaredTorqueRate>(spec.costs[2].term).joint_weights;
  EXPECT_EQ(weights.at("hip_l"), 0);
  EXPECT_EQ(weights.at("hip_r"), 1);
}

TEST(CheckRequest, MotionIsLeftFreeOrDerived) {
  GaitRequest request = Planar();
  request.motion.step_length = 0.6;
  request.motion.step_duration = 0.5;
  GaitSpec spec = CheckRequest(request).value();
  EXPECT_FALSE(spec.speed) << "length and duration fix it already";
  EXPECT_EQ(spec.step_length_range.min, 0.6);
  EXPECT_EQ(spec.step_duration_range.max, 0.5);
  EXPECT_LE(spec.speed_range.min, 1.2);
  EXPECT_GE(spec.speed_range.max, 1.2);

  request.motion = {};
  request.motion.free_speed = true;
  spec = CheckRequest(request).value();
  EXPECT_FALSE(spec.speed);
  EXPECT_EQ(spec.speed_range.min, 0.2);
  EXPECT_LE(spec.speed_range.max, std::sqrt(9.81 * spec.scene.leg_length));
}

TEST(CheckRequest, AccuracyLevelsSetTheBounds) {
  GaitRequest request = Planar();
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  GaitSpec spec = CheckRequest(request).value();
  EXPECT_EQ(spec.max_refinements, 0);
  EXPECT_EQ(spec.bounds[Criterion::kGap], kInfinity);
  EXPECT_EQ(spec.bounds[Criterion::kSlip], kInfinity);
  request.accuracy.level = GaitRequest::AccuracyLevel::kFine;
  request.accuracy.bounds[Criterion::kSlip] = 0.5;
  spec = CheckRequest(request).value();
  EXPECT_EQ(spec.bounds[Criterion::kGap], 1e-5);
  EXPECT_EQ(spec.bounds[Criterion::kSlip], 0.5);
}

TEST(CheckRequest, BodiesMayOverlapOnlyWhereThatIsAllowed) {
  GaitRequest request = Planar();
  EXPECT_FALSE(CheckRequest(request).value().allow_body_overlap);
  EXPECT_EQ(CheckRequest(request).value().bounds[Criterion::kOverlap], StandardBounds()[Criterion::kOverlap]);
  request.limits.allow_body_overlap = true;
  const GaitSpec spec = CheckRequest(request).value();
  EXPECT_TRUE(spec.allow_body_overlap);
  EXPECT_EQ(spec.bounds[Criterion::kOverlap], kInfinity);
  EXPECT_EQ(spec.bounds[Criterion::kGap], StandardBounds()[Criterion::kGap]);
}

TEST(CheckRequest, CollectsEveryViolation) {
  GaitRequest request;
  request.body.model = "horse";
  request.slope = 2;
  request.motion.speed = -1;
  request.phases.emplace();
  request.accuracy.max_refinements = -1;
  EXPECT_THAT(Fields(CheckRequest(request)),
              ElementsAre("model.name", "slope_rad", "phases.phases", "motion.speed_m_s", "accuracy.max_refinements"));
}

TEST(CheckRequest, AMeshOfAMillionIsRefusedWhereverItIsAskedFor) {
  GaitRequest request = Planar();
  request.discretization.double_support_intervals = 1000000;
  EXPECT_THAT(Fields(CheckRequest(request)), Contains("discretization.double_support_intervals"));
}

TEST(CheckRequest, BoundsTheAnswerToHostileNames) {
  GaitRequest request = Planar();
  for (int i = 0; i < 1000; ++i) {
    request.limits.joint_velocity[std::string(2000, 'x') + "\n\xff" + std::to_string(i)] = -1;
  }
  request.limits.joint_velocity["\n\xff"] = 1;
  const Result<GaitSpec> result = CheckRequest(request);
  ASSERT_FALSE(result.ok());
  ASSERT_EQ(result.violations().size(), RequestCheck::kMaxViolations);
  size_t bytes = 0;
  for (const Violation& violation : result.violations()) {
    bytes += violation.field.size() + violation.message.size();
    for (const char c : violation.field + violation.message) EXPECT_TRUE(c >= ' ' && c <= '~') << static_cast<int>(c);
  }
  EXPECT_LT(bytes, 6000u) << "must fit into the trailers of a call";
  EXPECT_THAT(result.violations().back().message, HasSubstr("more violations"));
}

TEST(CheckRequest, AcceptsAJointRangeThatExcludesStanding) {
  GaitRequest request = Planar();
  request.limits.joint_position["knee_l"] = {0.3, 1.5};
  EXPECT_TRUE(CheckRequest(request).ok());
}

// Heel strike, foot flat, opposite toe-off, heel-off; the intervals of a support are shared by its two phases.
TEST(CheckRequest, FeetOfTwoSurfacesRollFromHeelToToe) {
  GaitRequest request;
  request.body.model = "planar";
  request.body.feet = FootShape::kTwoEllipsoids;
  request.discretization.single_support_intervals = 9;
  const GaitSpec spec = CheckRequest(request).value();
  const Scene& scene = spec.scene;
  const int left_heel = scene.FindContact("left_heel"), left_toe = scene.FindContact("left_forefoot");
  const int right_toe = scene.FindContact("right_forefoot");
  ASSERT_EQ(spec.phases.size(), 4u);
  EXPECT_EQ(spec.phases[0].contacts, (std::vector<int>{left_heel, right_toe}));
  EXPECT_EQ(spec.phases[1].contacts, (std::vector<int>{left_heel, left_toe, right_toe}));
  EXPECT_EQ(spec.phases[2].contacts, (std::vector<int>{left_heel, left_toe}));
  EXPECT_EQ(spec.phases[3].contacts, (std::vector<int>{left_toe}));
  EXPECT_EQ(spec.phases[1].intervals, 2);
  EXPECT_EQ(spec.phases[2].intervals, 5);
  request.cycle = Cycle::kFull;
  EXPECT_EQ(CheckRequest(request).value().phases.size(), 8u);
}

// A stiff knee on one side walks, but not as half a cycle and its mirror image.
TEST(CheckRequest, BodiesWithoutSymmetryTakeTheFullCycle) {
  GaitRequest request;
  request.body.model = "human29";
  request.body.locked_joints = {{"knee_l", 0.1}};
  EXPECT_EQ(CheckRequest(request).value().cycle, Cycle::kFull);
  request.cycle = Cycle::kHalf;
  const Result<GaitSpec> half = CheckRequest(request);
  ASSERT_FALSE(half.ok());
  EXPECT_EQ(half.violations().front().field, "cycle");
  EXPECT_NE(half.violations().front().message.find("differ by model.locked_joints_rad[\"knee_l\"];"),
            std::string::npos);
  // Another cause, another field.
  GaitRequest loaded;
  loaded.body.model = "human29";
  loaded.body.changes.loads = {{.segment = "hand_l", .mass = 1, .position = {}}};
  loaded.cycle = Cycle::kHalf;
  EXPECT_NE(CheckRequest(loaded).violations().front().message.find("differ by model.loads[0];"), std::string::npos);
  request.cycle = Cycle::kFull;
  EXPECT_TRUE(CheckRequest(request).ok());
}

TEST(CheckRequest, TheChartOfTheFloatingBaseCannotBeWidened) {
  GaitRequest request;
  request.body.model = "human29";
  request.limits.joint_position["base_roll"] = {-0.5, 1.2};
  const Result<GaitSpec> wide = CheckRequest(request);
  ASSERT_FALSE(wide.ok());
  EXPECT_EQ(wide.violations().front().field, "limits.joint_position[\"base_roll\"]");
  request.limits.joint_position["base_roll"] = {-0.5, 0.5};
  request.limits.joint_position["base_pitch"] = {-2, 2};
  EXPECT_TRUE(CheckRequest(request).ok());
}

}  // namespace
}  // namespace rollgait
