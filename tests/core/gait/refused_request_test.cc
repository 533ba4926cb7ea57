#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/gait/gait_spec.h"

namespace rollgait {
namespace {

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
     "0.79 rad (45.2637 deg) is outside [-0.785398163, 0.785398163] rad (-45 to 45 deg); give a value in that range"},
    {"SlopeNan", [](GaitRequest& r) { r.slope = kNan; }, "slope_rad", "not a finite number"},
    {"GravityInfinite", [](GaitRequest& r) { r.gravity = kInfinity; }, "gravity_m_s2", "not a finite number"},
    {"NoGravity", [](GaitRequest& r) { r.gravity = 0; }, "gravity_m_s2", "[0.1, 100]"},
    {"SpeedZero", [](GaitRequest& r) { r.motion.speed = 0; }, "motion.speed_m_s", "(0, 4] m/s"},
    {"SpeedNoOneCanRun", [](GaitRequest& r) { r.motion.speed = 12; }, "motion.speed_m_s", "12 is outside"},
    {"SpeedNoOneCanWalk", [](GaitRequest& r) { r.motion.speed = 3.9; }, "motion.speed_m_s", "walking is impossible"},
    {"EarthsSpeedOnTheMoon",
     [](GaitRequest& r) {
       r.gravity = 1.62;
       r.motion.speed = 1.3;
     },
     "motion.speed_m_s", "walking is impossible"},
    {"DutyFactorOfARun",
     [](GaitRequest& r) {
       r.motion.duty_factor = GaitRequest::Range{0.4, 0.6};
     },
     "motion.duty_factor.min", "[0.5, 0.95]"},
    {"DutyFactorUpsideDown",
     [](GaitRequest& r) {
       r.motion.duty_factor = GaitRequest::Range{0.62, 0.6};
     },
     "motion.duty_factor", "0.62"},
    {"NoErrorAtAll", [](GaitRequest& r) { r.accuracy.max_error = MaxError{}; }, "accuracy.max_error",
     "allows no error"},
    {"ErrorZero", [](GaitRequest& r) { r.accuracy.max_error = MaxError{.angle = 0}; }, "accuracy.max_error.angle_rad",
     "[1e-09, 1] rad"},
    {"ErrorNan", [](GaitRequest& r) { r.accuracy.max_error = MaxError{.torque = kNan}; },
     "accuracy.max_error.torque_n_m", "not a finite number"},
    {"ErrorOfAllOfTheObjective", [](GaitRequest& r) { r.accuracy.max_error = MaxError{.objective = 2}; },
     "accuracy.max_error.objective", "2 is outside"},
    {"ErrorOfNoForce", [](GaitRequest& r) { r.accuracy.max_error = MaxError{.contact_force = -1}; },
     "accuracy.max_error.contact_force_n", "-1 is outside"},
    {"NoStart", [](GaitRequest& r) { r.starts = 0; }, "starts", "[1, 32]"},
    {"BadWeightBesideAPreset",
     [](GaitRequest& r) {
       r.preset = Preset::kHuman;
       r.costs.push_back({cost::Time{}, {}});
       r.costs.push_back({cost::PassiveLoad{}, -1.0});
     },
     "costs[1].weight", "-1"},
    {"TooManyCostsWithThoseOfThePreset",
     [](GaitRequest& r) {
       r.preset = Preset::kHuman;
       r.costs.assign(27, {cost::Time{}, {}});
     },
     "costs", "33 terms, those of the preset included"},
    {"EffortBelowTheSquare",
     [](GaitRequest& r) {
       r.costs.push_back({cost::MuscleEffort{1.5, {}}, {}});
     },
     "costs[0].muscle_effort.exponent", "[2, 10]"},
    {"MuscleWithoutEfficiency",
     [](GaitRequest& r) {
       r.costs.push_back({cost::MuscleWork{0.0, {}, {}, {}}, {}});
     },
     "costs[0].muscle_work.positive_efficiency", "[0.01, 100]"},
    {"PassiveLoadOfNoJoint",
     [](GaitRequest& r) {
       r.costs.push_back({cost::PassiveLoad{{{"tail", 1}}}, {}});
     },
     "costs[0].passive_load.joint_weights[\"tail\"]", "no joint"},
    {"NegativeAcceleration",
     [](GaitRequest& r) {
       r.costs.push_back({cost::SquaredAcceleration{{{"base_z", -1}}}, {}});
     },
     "costs[0].squared_acceleration.joint_weights[\"base_z\"]", "-1"},
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
       r.costs.push_back({cost::Time{}, -1});
     },
     "costs[0].weight", "-1 is outside [0, 1000000]"},
    {"NegativeJointWeight",
     [](GaitRequest& r) {
       r.costs.push_back({cost::SquaredTorque{{{"knee_l", -0.5}}}, {}});
     },
     "costs[0].squared_torque.joint_weights[\"knee_l\"]", "-0.5"},
    {"UnknownJointWeight",
     [](GaitRequest& r) {
       r.costs.push_back({cost::SquaredTorqueRate{{{"tail", 1}}}, {}});
     },
     "costs[0].squared_torque_rate.joint_weights[\"tail\"]", "no joint \"tail\""},
    {"UnactuatedJointWeight",
     [](GaitRequest& r) {
       r.costs.push_back({cost::SquaredTorque{{{"base_pitch", 1}}}, {}});
     },
     "costs[0].squared_torque.joint_weights[\"base_pitch\"]", "not actuated"},
    {"Smoothing",
     [](GaitRequest& r) {
       r.costs.push_back({cost::MechanicalWork{0}, {}});
     },
     "costs[0].mechanical_work.smoothing_w", "[0.01, 1000] W"},
    {"TrackingNothing",
     [](GaitRequest& r) {
       r.costs.push_back({cost::Tracking{}, {}});
     },
     "costs[0].tracking.channels", "no channel"},
    {"TrackingOnePosition",
     [](GaitRequest& r) {
       r.costs.push_back({cost::Tracking{{{"hip_l", {1}, {}}}}, {}});
     },
     "costs[0].tracking.channels[0].positions", "1 positions"},
    {"TrackingTwice",
     [](GaitRequest& r) {
       r.costs.push_back({cost::Tracking{{{"hip_l", {1, 2}, {}}, {"hip_l", {1, 2}, {}}}}, {}});
     },
     "costs[0].tracking.channels[1].joint", "twice"},
    {"TrackingNan",
     [](GaitRequest& r) {
       r.costs.push_back({cost::Tracking{{{"hip_l", {1, kNan}, {}}}}, {}});
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
    {"Gap", [](GaitRequest& r) { r.accuracy.bounds[Criterion::kGap] = 1; }, "accuracy.max_gap_m", "[1e-09, 0.1] m"},
    {"OverlapAllowedAndBounded",
     [](GaitRequest& r) {
       r.limits.allow_body_overlap = true;
       r.accuracy.bounds[Criterion::kOverlap] = 1e-3;
     },
     "accuracy.max_overlap_m", "leave one of the two out"},
    {"Slip", [](GaitRequest& r) { r.accuracy.bounds[Criterion::kSlip] = 0; }, "accuracy.max_slip_m_s",
     "[1e-09, 1] m/s"},
    {"Refinements", [](GaitRequest& r) { r.accuracy.max_refinements = 21; }, "accuracy.max_refinements", "[0, 20]"},
    {"Iterations", [](GaitRequest& r) { r.solver_limits.max_iterations = 0; }, "solver_limits.max_iterations",
     "[1, 100000]"},
    {"WallTime", [](GaitRequest& r) { r.solver_limits.max_wall_time = 1e6; }, "solver_limits.max_wall_time_s",
     "[0.01, 86400] s"},
};

INSTANTIATE_TEST_SUITE_P(Bad, RefusedRequest, ::testing::ValuesIn(kBadCases),
                         [](const auto& parameter) { return parameter.param.name; });

}  // namespace
}  // namespace rollgait
