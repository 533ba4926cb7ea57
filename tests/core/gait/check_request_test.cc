#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "core/gait/gait_request.h"
#include "core/gait/request_check.h"

namespace rollgait {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

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

GaitRequest::Phase Contacts(std::vector<std::string> contacts) { return {std::move(contacts), {}, {}, {}}; }

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
  EXPECT_EQ(spec.max_gap, 1e-4);
  EXPECT_EQ(spec.max_slip, 1e-3);
  EXPECT_EQ(spec.max_refinements, 3);
  EXPECT_EQ(spec.max_iterations, 1000);
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
  const auto& term = std::get<GaitRequest::SquaredTorque>(spec.costs[0].term);
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
  request.costs.push_back({GaitRequest::MechanicalWork{}, {}});
  request.costs.push_back({GaitRequest::Tracking{{{"hip_l", {0, 1}, {}}}}, 2.5});
  request.costs.push_back({GaitRequest::SquaredTorqueRate{{{"hip_l", 0.0}}}, {}});
  const GaitSpec spec = CheckRequest(request).value();
  EXPECT_EQ(std::get<GaitRequest::MechanicalWork>(spec.costs[0].term).smoothing, 1);
  EXPECT_EQ(std::get<GaitRequest::Tracking>(spec.costs[1].term).channels[0].weight, 1);
  EXPECT_EQ(spec.costs[1].weight, 2.5);
  const auto& weights = std::get<GaitRequest::SquaredTorqueRate>(spec.costs[2].term).joint_weights;
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
  EXPECT_EQ(spec.max_gap, kInfinity);
  EXPECT_EQ(spec.max_slip, kInfinity);
  request.accuracy.level = GaitRequest::AccuracyLevel::kFine;
  request.accuracy.max_slip = 0.5;
  spec = CheckRequest(request).value();
  EXPECT_EQ(spec.max_gap, 1e-5);
  EXPECT_EQ(spec.max_slip, 0.5);
}

struct BadCase {
  const char* name;
  std::function<void(GaitRequest&)> spoil;
  const char* field;
  const char* says;
};

void PrintTo(const BadCase& bad, std::ostream* out) { *out << bad.name; }

class RefusedRequest : public ::testing::TestWithParam<BadCase> {};

TEST_P(RefusedRequest, NamesTheField) {
  GaitRequest request = Planar();
  GetParam().spoil(request);
  const Result<GaitSpec> result = CheckRequest(request);
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(Fields(result), ElementsAre(GetParam().field));
  EXPECT_THAT(result.violations()[0].message, HasSubstr(GetParam().says));
}

const BadCase kBadCases[] = {
    {"UnknownModel", [](GaitRequest& r) { r.body.model = "horse"; }, "model.name", "horse"},
    {"EmptyModel", [](GaitRequest& r) { r.body.model = ""; }, "model.name", "empty"},
    {"Giant", [](GaitRequest& r) { r.body.stature = 3; }, "model.stature_m", "3"},
    {"MassNan", [](GaitRequest& r) { r.body.mass = kNan; }, "model.body_mass_kg", "nan"},
    {"TooSteep", [](GaitRequest& r) { r.slope = 0.79; }, "slope_rad",
     "0.79 is outside [-0.785398163, 0.785398163] rad"},
    {"SlopeNan", [](GaitRequest& r) { r.slope = kNan; }, "slope_rad", "not a finite number"},
    {"GravityInfinite", [](GaitRequest& r) { r.gravity = kInfinity; }, "gravity_m_s2", "not a finite number"},
    {"NoGravity", [](GaitRequest& r) { r.gravity = 0; }, "gravity_m_s2", "[0.1, 100]"},
    {"SpeedZero", [](GaitRequest& r) { r.motion.speed = 0; }, "motion.speed_m_s", "(0, 4] m/s"},
    {"SpeedNoOneCanRun", [](GaitRequest& r) { r.motion.speed = 12; }, "motion.speed_m_s", "12 is outside"},
    {"SpeedNoOneCanWalk", [](GaitRequest& r) { r.motion.speed = 3.9; }, "motion.speed_m_s", "walking is impossible"},
    {"DefaultSpeedOnTheMoon", [](GaitRequest& r) { r.gravity = 0.5; }, "motion.speed_m_s", "(the default)"},
    {"DerivedSpeed",
     [](GaitRequest& r) {
       r.motion.step_length = 1.4;
       r.motion.step_duration = 0.4;
     },
     "motion", "walking is impossible"},
    {"ThreeOfMotion",
     [](GaitRequest& r) {
       r.motion.speed = 1;
       r.motion.step_length = 0.6;
       r.motion.step_duration = 0.5;
     },
     "motion", "at most two"},
    {"FreeAndPrescribed",
     [](GaitRequest& r) {
       r.motion.speed = 1;
       r.motion.free_speed = true;
     },
     "motion.free_speed", "contradicts speed_m_s"},
    {"FreeAndFixedByStep",
     [](GaitRequest& r) {
       r.motion.step_length = 0.6;
       r.motion.step_duration = 0.5;
       r.motion.free_speed = true;
     },
     "motion.free_speed", "fix the speed"},
    {"StepTooLong", [](GaitRequest& r) { r.motion.step_length = 2.1; }, "motion.step_length_m", "(0, 2] m"},
    {"DerivedStepTooLong",
     [](GaitRequest& r) {
       r.motion.speed = 2;
       r.motion.step_duration = 1.2;
     },
     "motion", "2.4 is outside (0, 2] m of step length"},
    {"DerivedStepTooShort",
     [](GaitRequest& r) {
       r.motion.speed = 2;
       r.motion.step_length = 0.1;
     },
     "motion", "0.05 is outside [0.1, 5] s of step duration"},
    {"StepLongerThanItsPhases",
     [](GaitRequest& r) {
       r.motion.free_speed = true;
       r.motion.step_duration = 4;
     },
     "motion.step_duration_s", "0.04 to 3 s"},
    {"NoPhases", [](GaitRequest& r) { r.phases.emplace(); }, "phases.phases", "no phase"},
    {"NoContact",
     [](GaitRequest& r) {
       r.phases = {Contacts({}), Contacts({"left_foot"})};
     },
     "phases.phases[0].contacts", "no contact"},
    {"UnknownContact",
     [](GaitRequest& r) {
       r.phases = {Contacts({"left_foot", "hoof"})};
     },
     "phases.phases[0].contacts[1]", "no contact \"hoof\""},
    {"RepeatedContact",
     [](GaitRequest& r) {
       r.phases = {Contacts({"left_foot", "left_foot"})};
     },
     "phases.phases[0].contacts[1]", "twice"},
    {"EqualConsecutivePhases",
     [](GaitRequest& r) {
       r.phases = {Contacts({"left_foot", "right_foot"}), Contacts({"right_foot", "left_foot"}),
                   Contacts({"left_foot"})};
     },
     "phases.phases[0].contacts", "phase 1"},
    {"EqualToTheMirroredFirst",
     [](GaitRequest& r) {
       r.phases = {Contacts({"right_foot"}), Contacts({"left_foot", "right_foot"}), Contacts({"left_foot"})};
     },
     "phases.phases[2].contacts", "mirrored phase 0"},
    {"EqualToTheFirst",
     [](GaitRequest& r) {
       r.cycle = Cycle::kFull;
       r.phases = {Contacts({"left_foot"}), Contacts({"right_foot"}), Contacts({"left_foot"})};
     },
     "phases.phases[2].contacts", "phase 0"},
    {"DurationsInverted",
     [](GaitRequest& r) {
       r.phases = {Contacts({"left_foot"})};
       r.phases->front().min_duration = 2;
     },
     "phases.phases[0].min_duration_s", "(its default)"},
    {"DurationZero",
     [](GaitRequest& r) {
       r.phases = {Contacts({"left_foot"})};
       r.phases->front().min_duration = 0;
     },
     "phases.phases[0].min_duration_s", "(0, 10] s"},
    {"PhaseWithoutIntervals",
     [](GaitRequest& r) {
       r.phases = {Contacts({"left_foot"})};
       r.phases->front().intervals = 0;
     },
     "phases.phases[0].intervals", "[1, 1000]"},
    {"NoMesh", [](GaitRequest& r) { r.discretization.single_support_intervals = 0; },
     "discretization.single_support_intervals", "0 is outside [1, 1000]"},
    {"HugeMesh",
     [](GaitRequest& r) {
       r.phases.emplace();
       for (int i = 0; i < 6; ++i) r.phases->push_back(Contacts({i % 2 == 0 ? "left_foot" : "right_foot"}));
       r.cycle = Cycle::kFull;
       r.discretization.single_support_intervals = 1000;
     },
     "phases.phases", "6000 mesh intervals"},
    {"NegativeCostWeight",
     [](GaitRequest& r) {
       r.costs.push_back({GaitRequest::Time{}, -1});
     },
     "costs[0].weight", "-1 is outside [0, 1000000]"},
    {"NegativeJointWeight",
     [](GaitRequest& r) {
       r.costs.push_back({GaitRequest::SquaredTorque{{{"knee_l", -0.5}}}, {}});
     },
     "costs[0].squared_torque.joint_weights[\"knee_l\"]", "-0.5"},
    {"UnknownJointWeight",
     [](GaitRequest& r) {
       r.costs.push_back({GaitRequest::SquaredTorqueRate{{{"tail", 1}}}, {}});
     },
     "costs[0].squared_torque_rate.joint_weights[\"tail\"]", "no joint \"tail\""},
    {"UnactuatedJointWeight",
     [](GaitRequest& r) {
       r.costs.push_back({GaitRequest::SquaredTorque{{{"base_pitch", 1}}}, {}});
     },
     "costs[0].squared_torque.joint_weights[\"base_pitch\"]", "not actuated"},
    {"Smoothing",
     [](GaitRequest& r) {
       r.costs.push_back({GaitRequest::MechanicalWork{0}, {}});
     },
     "costs[0].mechanical_work.smoothing_w", "[0.01, 1000] W"},
    {"TrackingNothing",
     [](GaitRequest& r) {
       r.costs.push_back({GaitRequest::Tracking{}, {}});
     },
     "costs[0].tracking.channels", "no channel"},
    {"TrackingOnePosition",
     [](GaitRequest& r) {
       r.costs.push_back({GaitRequest::Tracking{{{"hip_l", {1}, {}}}}, {}});
     },
     "costs[0].tracking.channels[0].positions", "1 positions"},
    {"TrackingTwice",
     [](GaitRequest& r) {
       r.costs.push_back({GaitRequest::Tracking{{{"hip_l", {1, 2}, {}}, {"hip_l", {1, 2}, {}}}}, {}});
     },
     "costs[0].tracking.channels[1].joint", "twice"},
    {"TrackingNan",
     [](GaitRequest& r) {
       r.costs.push_back({GaitRequest::Tracking{{{"hip_l", {1, kNan}, {}}}}, {}});
     },
     "costs[0].tracking.channels[0].positions[1]", "nan"},
    {"NoFriction", [](GaitRequest& r) { r.ground_contact.friction_coefficient = 0; },
     "ground_contact.friction_coefficient", "(0, 5]"},
    {"NormalForce", [](GaitRequest& r) { r.ground_contact.min_normal_force_bw = -0.1; },
     "ground_contact.min_normal_force_bw", "[0, 1]"},
    {"Clearance", [](GaitRequest& r) { r.ground_contact.swing_clearance = 0.5; }, "ground_contact.swing_clearance_m",
     "[0, 0.3] m"},
    {"TouchDownBeyondTheHeel",
     [](GaitRequest& r) {
       r.ground_contact.touch_down_point = {-1.5, 0};
     },
     "ground_contact.touch_down_point.min", "[-1, 1]"},
    {"LiftOffInverted",
     [](GaitRequest& r) {
       r.ground_contact.lift_off_point = {0.5, 0.4};
     },
     "ground_contact.lift_off_point", "at most"},
    {"PositionInverted",
     [](GaitRequest& r) {
       r.limits.joint_position["knee_l"] = {1, 0.5};
     },
     "limits.joint_position[\"knee_l\"]", "less than"},
    {"PositionEmpty",
     [](GaitRequest& r) {
       r.limits.joint_position["knee_l"] = {0, 0};
     },
     "limits.joint_position[\"knee_l\"]", "less than"},
    {"PositionInfinite",
     [](GaitRequest& r) {
       r.limits.joint_position["knee_l"] = {-kInfinity, 0};
     },
     "limits.joint_position[\"knee_l\"].min", "finite"},
    {"PositionUnknown",
     [](GaitRequest& r) {
       r.limits.joint_position["tail"] = {0, 1};
     },
     "limits.joint_position[\"tail\"]", "hip_l"},
    {"VelocityZero", [](GaitRequest& r) { r.limits.joint_velocity["knee_l"] = 0; }, "limits.joint_velocity[\"knee_l\"]",
     "(0, 1000]"},
    {"EffortWithoutZero",
     [](GaitRequest& r) {
       r.limits.joint_effort["knee_l"] = {1, 2};
     },
     "limits.joint_effort[\"knee_l\"]", "does not contain 0"},
    {"EffortOfTheBase",
     [](GaitRequest& r) {
       r.limits.joint_effort["base_z"] = {-1, 2};
     },
     "limits.joint_effort[\"base_z\"]", "not actuated"},
    {"Tolerance", [](GaitRequest& r) { r.accuracy.kkt_tolerance = 0; }, "accuracy.kkt_tolerance", "[1e-12, 0.01]"},
    {"Gap", [](GaitRequest& r) { r.accuracy.max_gap = 1; }, "accuracy.max_gap_m", "[1e-09, 0.1] m"},
    {"Slip", [](GaitRequest& r) { r.accuracy.max_slip = 0; }, "accuracy.max_slip_m_s", "[1e-09, 1] m/s"},
    {"Refinements", [](GaitRequest& r) { r.accuracy.max_refinements = 7; }, "accuracy.max_refinements", "[0, 6]"},
    {"Iterations", [](GaitRequest& r) { r.solver_limits.max_iterations = 0; }, "solver_limits.max_iterations",
     "[1, 100000]"},
    {"WallTime", [](GaitRequest& r) { r.solver_limits.max_wall_time = 1e6; }, "solver_limits.max_wall_time_s",
     "[0.01, 86400] s"},
};

INSTANTIATE_TEST_SUITE_P(Bad, RefusedRequest, ::testing::ValuesIn(kBadCases),
                         [](const auto& parameter) { return parameter.param.name; });

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

}  // namespace
}  // namespace rollgait
