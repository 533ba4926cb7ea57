#include "server/convert/gait_request_convert.h"

#include <gmock/gmock.h>
#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace rollgait::server {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

v1::SolveSpec Parse(const std::string& text) {
  v1::SolveSpec spec;
  ROLLGAIT_CHECK(google::protobuf::TextFormat::ParseFromString(text, &spec));
  return spec;
}

std::vector<std::string> Fields(const Violations& violations) {
  std::vector<std::string> fields;
  for (const Violation& violation : violations) fields.push_back(violation.field);
  return fields;
}

TEST(DecodeRequest, UnsetFieldsStayUnset) {
  const GaitRequest request = DecodeRequest(Parse("model { name: 'planar' }")).value();
  EXPECT_EQ(request.body.model, "planar");
  EXPECT_EQ(request.body.sex, Sex::kMale);
  EXPECT_FALSE(request.body.stature);
  EXPECT_FALSE(request.body.mass);
  EXPECT_FALSE(request.motion.speed);
  EXPECT_FALSE(request.motion.step_length);
  EXPECT_FALSE(request.motion.step_duration);
  EXPECT_FALSE(request.motion.free_speed);
  EXPECT_FALSE(request.phases);
  EXPECT_TRUE(request.costs.empty());
  EXPECT_FALSE(request.cycle);  // up to the body
  EXPECT_EQ(request.normalization, GaitRequest::Normalization::kPerDistance);
  EXPECT_FALSE(request.ground_contact.friction_coefficient);
  EXPECT_FALSE(request.ground_contact.touch_down_point);
  EXPECT_EQ(request.ground_contact.touch_down, GaitRequest::TouchDown::kSmooth);
  EXPECT_EQ(request.discretization.scheme, Scheme::kRadau2);
  EXPECT_FALSE(request.discretization.single_support_intervals);
  EXPECT_EQ(request.accuracy.level, GaitRequest::AccuracyLevel::kStandard);
  EXPECT_FALSE(request.accuracy.max_refinements);
  EXPECT_FALSE(request.solver_limits.max_iterations);
  EXPECT_FALSE(request.gravity);
}

// Every number differs, so that no two fields can be mixed up.
TEST(DecodeRequest, EveryFieldArrives) {
  const GaitRequest request = DecodeRequest(Parse(R"(
      model { name: 'planar' sex: SEX_FEMALE stature_m: 1.71 body_mass_kg: 61 }
      slope_rad: 0.11
      motion { speed_m_s: 1.2 step_length_m: 0.62 step_duration_s: 0.53 free_speed: true }
      cycle: CYCLE_FULL
      phases { phases { contacts: 'a' contacts: 'b' intervals: 7 min_duration_s: 0.04 max_duration_s: 0.9 }
               phases { contacts: 'c' } }
      cost_normalization: COST_NORMALIZATION_PER_TIME
      ground_contact { friction_coefficient: 0.71 min_normal_force_bw: 0.05 swing_clearance_m: 0.02
                       touch_down_point { min: -0.9 max: -0.8 } lift_off_point { min: 0.7 max: 0.75 }
                       touch_down: TOUCH_DOWN_PLASTIC }
      limits { joint_position { key: 'k' value { min: -1 max: 2 } } joint_velocity { key: 'v' value: 3 }
               joint_effort { key: 'e' value { min: -4 max: 5 } } allow_body_overlap: true }
      discretization { scheme: SCHEME_HERMITE_SIMPSON single_support_intervals: 21 double_support_intervals: 11 }
      accuracy { level: LEVEL_FINE kkt_tolerance: 1e-7 max_gap_m: 2e-4 max_slip_m_s: 3e-3 max_refinements: 2 }
      solver_limits { max_iterations: 321 max_wall_time_s: 44 }
      gravity_m_s2: 1.62 nlp_solver: NLP_SOLVER_IPOPT)"))
                                  .value();
  EXPECT_EQ(request.body.sex, Sex::kFemale);
  EXPECT_EQ(request.body.stature, 1.71);
  EXPECT_EQ(request.body.mass, 61);
  EXPECT_EQ(request.slope, 0.11);
  EXPECT_EQ(request.motion.speed, 1.2);
  EXPECT_EQ(request.motion.step_length, 0.62);
  EXPECT_EQ(request.motion.step_duration, 0.53);
  EXPECT_TRUE(request.motion.free_speed);
  EXPECT_EQ(request.cycle, Cycle::kFull);
  ASSERT_EQ(request.phases->size(), 2u);
  EXPECT_THAT(request.phases->at(0).contacts, ElementsAre("a", "b"));
  EXPECT_EQ(request.phases->at(0).intervals, 7);
  EXPECT_EQ(request.phases->at(0).min_duration, 0.04);
  EXPECT_EQ(request.phases->at(0).max_duration, 0.9);
  EXPECT_FALSE(request.phases->at(1).intervals);
  EXPECT_EQ(request.normalization, GaitRequest::Normalization::kPerTime);
  EXPECT_EQ(request.ground_contact.friction_coefficient, 0.71);
  EXPECT_EQ(request.ground_contact.min_normal_force_bw, 0.05);
  EXPECT_EQ(request.ground_contact.swing_clearance, 0.02);
  EXPECT_EQ(request.ground_contact.touch_down_point->min, -0.9);
  EXPECT_EQ(request.ground_contact.touch_down_point->max, -0.8);
  EXPECT_EQ(request.ground_contact.lift_off_point->min, 0.7);
  EXPECT_EQ(request.ground_contact.touch_down, GaitRequest::TouchDown::kPlastic);
  EXPECT_EQ(request.limits.joint_position.at("k").max, 2);
  EXPECT_EQ(request.limits.joint_velocity.at("v"), 3);
  EXPECT_EQ(request.limits.joint_effort.at("e").min, -4);
  EXPECT_TRUE(request.limits.allow_body_overlap);
  EXPECT_EQ(request.discretization.scheme, Scheme::kHermiteSimpson);
  EXPECT_EQ(request.discretization.single_support_intervals, 21);
  EXPECT_EQ(request.discretization.double_support_intervals, 11);
  EXPECT_EQ(request.accuracy.level, GaitRequest::AccuracyLevel::kFine);
  EXPECT_EQ(request.accuracy.kkt_tolerance, 1e-7);
  EXPECT_EQ(request.accuracy.bounds.at(Criterion::kGap), 2e-4);
  EXPECT_EQ(request.accuracy.bounds.at(Criterion::kSlip), 3e-3);
  EXPECT_EQ(request.accuracy.max_refinements, 2);
  EXPECT_EQ(request.solver_limits.max_iterations, 321);
  EXPECT_EQ(request.solver_limits.max_wall_time, 44);
  EXPECT_EQ(request.nlp_solver, NlpSolver::kIpopt);
  EXPECT_EQ(DecodeRequest(Parse("")).value().nlp_solver, NlpSolver::kInteriorPoint);
  EXPECT_EQ(request.gravity, 1.62);
}

// Every criterion of the table has a field of its own, and no field is without a criterion.
TEST(DecodeRequest, EveryBoundArrives) {
  v1::SolveSpec spec = Parse("model { name: 'planar' } accuracy { level: LEVEL_DRAFT }");
  EXPECT_TRUE(DecodeRequest(spec).value().accuracy.bounds.empty());
  const google::protobuf::Reflection& reflection = *v1::Accuracy::GetReflection();
  for (const CriterionTraits& traits : Criteria()) {
    const google::protobuf::FieldDescriptor* field = v1::Accuracy::descriptor()->FindFieldByName(traits.field);
    ASSERT_NE(field, nullptr) << traits.field;
    EXPECT_EQ(field->cpp_type(), google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE) << traits.field;
    EXPECT_TRUE(field->has_presence()) << traits.field;
    reflection.SetDouble(spec.mutable_accuracy(), field,
                         traits.most * (0.5 + 0.01 * static_cast<int>(traits.criterion)));
  }
  int doubles = 0;
  for (int i = 0; i < v1::Accuracy::descriptor()->field_count(); ++i) {
    doubles +=
        v1::Accuracy::descriptor()->field(i)->cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE ? 1 : 0;
  }
  EXPECT_EQ(doubles, kCriterionCount + 1) << "kkt_tolerance is the only other";
  const GaitRequest request = DecodeRequest(spec).value();
  ASSERT_EQ(request.accuracy.bounds.size(), static_cast<size_t>(kCriterionCount));
  const GaitSpec checked = CheckRequest(request).value();
  for (const CriterionTraits& traits : Criteria()) {
    const double bound = traits.most * (0.5 + 0.01 * static_cast<int>(traits.criterion));
    EXPECT_EQ(request.accuracy.bounds.at(traits.criterion), bound) << traits.field;
    EXPECT_EQ(checked.bounds[traits.criterion], bound) << traits.field;
  }
}

TEST(DecodeRequest, EveryErrorArrives) {
  v1::SolveSpec spec;
  spec.mutable_model()->set_name("planar");
  EXPECT_FALSE(DecodeRequest(spec).value().accuracy.estimate_errors);
  EXPECT_FALSE(DecodeRequest(spec).value().accuracy.max_error);
  spec.mutable_accuracy()->set_estimate_errors(true);
  EXPECT_TRUE(DecodeSpec(spec).value().estimate_errors);
  spec.mutable_accuracy()->set_estimate_errors(false);
  v1::MaxError& error = *spec.mutable_accuracy()->mutable_max_error();
  error.set_objective(0.01);
  error.set_angle_rad(0.02);
  error.set_torque_n_m(3);
  error.set_contact_force_n(4);
  const GaitSpec checked = DecodeSpec(spec).value();
  EXPECT_TRUE(checked.estimate_errors) << "implied";
  ASSERT_TRUE(checked.max_error);
  EXPECT_EQ(checked.max_error->objective, 0.01);
  EXPECT_EQ(checked.max_error->angle, 0.02);
  EXPECT_EQ(checked.max_error->torque, 3);
  EXPECT_EQ(checked.max_error->contact_force, 4);
}

TEST(DecodeRequest, EveryCostTermArrives) {
  const GaitRequest request = DecodeRequest(Parse(R"(
      costs { squared_torque { joint_weights { key: 'a' value: 2 } } weight: 3 }
      costs { squared_torque_rate { joint_weights { key: 'b' value: 4 } } }
      costs { mechanical_work { smoothing_w: 5 } }
      costs { time {} }
      costs { tracking { channels { joint: 'c' positions: [6, 7] weight: 8 } } }
      costs { muscle_effort { exponent: 3 joint_weights { key: 'd' value: 9 } } }
      costs { muscle_work { positive_efficiency: 0.2 negative_efficiency: 1.1 smoothing_w: 7
                            joint_weights { key: 'e' value: 10 } } }
      costs { passive_load { joint_weights { key: 'f' value: 11 } } }
      costs { squared_acceleration { joint_weights { key: 'g' value: 12 } } }
      costs { squared_force_rate {} weight: 13 })"))
                                  .value();
  ASSERT_EQ(request.costs.size(), 10u);
  EXPECT_TRUE(std::holds_alternative<cost::SquaredForceRate>(request.costs[9].term));
  EXPECT_EQ(request.costs[9].weight, 13);
  const auto& effort = std::get<cost::MuscleEffort>(request.costs[5].term);
  EXPECT_EQ(effort.exponent, 3);
  EXPECT_THAT(effort.joint_weights, ElementsAre(Pair("d", 9)));
  const auto& work = std::get<cost::MuscleWork>(request.costs[6].term);
  EXPECT_EQ(work.positive_efficiency, 0.2);
  EXPECT_EQ(work.negative_efficiency, 1.1);
  EXPECT_EQ(work.smoothing, 7);
  EXPECT_THAT(work.joint_weights, ElementsAre(Pair("e", 10)));
  EXPECT_THAT(std::get<cost::PassiveLoad>(request.costs[7].term).joint_weights, ElementsAre(Pair("f", 11)));
  EXPECT_THAT(std::get<cost::SquaredAcceleration>(request.costs[8].term).joint_weights, ElementsAre(Pair("g", 12)));
  EXPECT_EQ(request.costs[0].weight, 3);
  EXPECT_FALSE(request.costs[1].weight);
  EXPECT_THAT(std::get<cost::SquaredTorque>(request.costs[0].term).joint_weights, ElementsAre(Pair("a", 2)));
  EXPECT_THAT(std::get<cost::SquaredTorqueRate>(request.costs[1].term).joint_weights, ElementsAre(Pair("b", 4)));
  EXPECT_EQ(std::get<cost::MechanicalWork>(request.costs[2].term).smoothing, 5);
  EXPECT_TRUE(std::holds_alternative<cost::Time>(request.costs[3].term));
  const auto& channel = std::get<cost::Tracking>(request.costs[4].term).channels.at(0);
  EXPECT_EQ(channel.joint, "c");
  EXPECT_THAT(channel.positions, ElementsAre(6, 7));
  EXPECT_EQ(channel.weight, 8);
}

TEST(DecodeRequest, PresetStartsAndDutyFactorArrive) {
  const GaitRequest request = DecodeRequest(Parse("preset: PRESET_TRANSPORT starts: 5 warm_start: \"nearest\" "
                                                  "motion { duty_factor { min: 0.6 max: 0.62 } }"))
                                  .value();
  EXPECT_EQ(request.preset, Preset::kTransport);
  EXPECT_EQ(request.starts, 5);
  EXPECT_TRUE(request.warm_start);
  EXPECT_EQ(request.motion.duty_factor->min, 0.6);
  EXPECT_EQ(request.motion.duty_factor->max, 0.62);
  EXPECT_EQ(DecodeRequest(Parse("preset: PRESET_HUMAN")).value().preset, Preset::kHuman);
  EXPECT_EQ(DecodeRequest(Parse("preset: PRESET_TORQUE")).value().preset, Preset::kTorque);
  EXPECT_FALSE(DecodeRequest(Parse("")).value().preset);
}

TEST(DecodeRequest, ManoeuvreArrivesWithItsOwnDefaults) {
  const GaitRequest request = DecodeRequest(Parse(R"(
      model { name: 'ball' rolling_body { semi_axes_m { x: 0.3 y: 0.2 z: 0.1 } mass_kg: 4 moments_kg_m2 { x: 5 y: 6 z: 7 } } }
      manoeuvre { start { x_m: 0.1 y_m: 0.2 orientation { w: 0.3 x: 0.4 y: 0.5 z: 0.6 } }
                  end { y_m: 0.7 angular_velocity_rad_s { x: 0.8 y: 0.9 z: 1.1 } } duration_s: 1.2 })"))
                                  .value();
  EXPECT_EQ(*request.body.rolling_body->semi_axes, Vector3(0.3, 0.2, 0.1));
  EXPECT_EQ(request.body.rolling_body->mass, 4);
  EXPECT_EQ(*request.body.rolling_body->moments, Vector3(5, 6, 7));
  ASSERT_TRUE(request.manoeuvre);
  EXPECT_EQ(request.manoeuvre->start.x, 0.1);
  EXPECT_EQ(request.manoeuvre->start.y, 0.2);
  EXPECT_EQ(*request.manoeuvre->start.orientation, Eigen::Vector4d(0.3, 0.4, 0.5, 0.6));
  EXPECT_FALSE(request.manoeuvre->end.x);
  EXPECT_EQ(request.manoeuvre->end.y, 0.7);
  EXPECT_FALSE(request.manoeuvre->end.orientation);
  EXPECT_EQ(request.manoeuvre->end.angular_velocity, Vector3(0.8, 0.9, 1.1));
  EXPECT_EQ(request.manoeuvre->duration, 1.2);
  EXPECT_FALSE(request.cycle);
  EXPECT_EQ(request.normalization, GaitRequest::Normalization::kNone);
}

TEST(DecodeSpec, AcceptsTheSmallestManoeuvre) {
  const Result<GaitSpec> spec = DecodeSpec(Parse("model { name: 'ball' } manoeuvre { end { x_m: 1 } duration_s: 2 }"));
  ASSERT_TRUE(spec.ok()) << spec.violations()[0].field << ": " << spec.violations()[0].message;
  EXPECT_EQ(spec.value().manoeuvre->end.x, 1);
}

TEST(DecodeRequest, PhasesThatAreSetAndEmptyAreNotTheDefault) {
  const GaitRequest request = DecodeRequest(Parse("phases {}")).value();
  ASSERT_TRUE(request.phases);
  EXPECT_TRUE(request.phases->empty());
}

TEST(DecodeRequest, RefusesEnumValuesWithoutAName) {
  v1::SolveSpec spec;
  spec.mutable_model()->set_sex(static_cast<v1::ModelSelection::Sex>(9));
  spec.set_cycle(static_cast<v1::Cycle>(-1));
  spec.set_cost_normalization(static_cast<v1::CostNormalization>(77));
  spec.mutable_discretization()->set_scheme(static_cast<v1::Discretization::Scheme>(99));
  spec.set_preset(static_cast<v1::Preset>(4));
  spec.mutable_accuracy()->set_level(static_cast<v1::Accuracy::Level>(4));
  spec.set_nlp_solver(static_cast<v1::NlpSolver>(3));
  const Result<GaitRequest> request = DecodeRequest(spec);
  ASSERT_FALSE(request.ok());
  EXPECT_THAT(Fields(request.violations()), ElementsAre("model.sex", "cycle", "preset", "cost_normalization",
                                                        "discretization.scheme", "accuracy.level", "nlp_solver"));
  EXPECT_THAT(request.violations()[3].message, HasSubstr("77"));
}

TEST(DecodeRequest, RefusesACostWithoutATerm) {
  const Result<GaitRequest> request = DecodeRequest(Parse("costs { time {} } costs { weight: 2 }"));
  ASSERT_FALSE(request.ok());
  EXPECT_THAT(Fields(request.violations()), ElementsAre("costs[1]"));
}

TEST(DecodeSpec, JoinsTheViolationsOfBothSteps) {
  v1::SolveSpec spec = Parse("model { name: 'horse' } slope_rad: 1");
  spec.set_cycle(static_cast<v1::Cycle>(5));
  const Result<GaitSpec> checked = DecodeSpec(spec);
  ASSERT_FALSE(checked.ok());
  EXPECT_THAT(Fields(checked.violations()), ElementsAre("cycle", "model.name", "slope_rad"));
}

TEST(DecodeSpec, AcceptsTheSmallestRequest) {
  const Result<GaitSpec> checked = DecodeSpec(Parse("model { name: 'planar' }"));
  ASSERT_TRUE(checked.ok());
  EXPECT_EQ(checked.value().phases.size(), 2u);
}

TEST(DecodeBody, NamesFieldsRelativeToTheSelection) {
  v1::ModelSelection selection;
  selection.set_sex(static_cast<v1::ModelSelection::Sex>(3));
  const Result<BodyRequest> body = DecodeBody(selection);
  ASSERT_FALSE(body.ok());
  EXPECT_THAT(Fields(body.violations()), ElementsAre("sex"));
}

TEST(DecodeBody, EveryReductionArrives) {
  const v1::SolveSpec spec = Parse(
      "model { name: 'human29' segment_lengths_m { key: 'thigh' value: 0.45 } feet: FEET_TWO_ELLIPSOIDS toes: true "
      "ranges: RANGES_WALKING "
      "sagittal: true drop_arms: true rigid_trunk: true locked_joints_rad { key: 'knee_l' value: 0.2 } "
      "loads { segment: 'hand_l' mass_kg: 10 position_m { x: 1 y: 2 z: 3 } moments_kg_m2 { x: 4 y: 5 z: 6 } } "
      "loads { segment: 'torso' mass_kg: 2 } joint_strengths { key: 'hip_l' value: 0.3 } "
      "foot_semi_axes_m { key: 'heel_l' value { x: 7 y: 8 z: 9 } } foot_exponents { key: 'heel_r' value: 0.8 } "
      "joint_springs { key: 'ankle_r' value { stiffness_n_m_rad: 300 rest_rad: 0.1 damping_n_m_s_rad: 2 } } }");
  const BodyRequest body = DecodeBody(spec.model()).value();
  EXPECT_EQ(body.segment_lengths.at("thigh"), 0.45);
  EXPECT_EQ(body.feet, FootShape::kTwoEllipsoids);
  EXPECT_EQ(body.ranges, JointRanges::kWalking);
  EXPECT_TRUE(body.toes && body.sagittal && body.drop_arms && body.rigid_trunk);
  EXPECT_EQ(body.locked_joints.at("knee_l"), 0.2);
  ASSERT_EQ(body.changes.loads.size(), 2u);
  EXPECT_EQ(body.changes.loads[0].segment, "hand_l");
  EXPECT_EQ(body.changes.loads[0].mass, 10);
  EXPECT_EQ(body.changes.loads[0].position, Vector3(1, 2, 3));
  EXPECT_EQ(body.changes.loads[0].moments, Vector3(4, 5, 6));
  EXPECT_FALSE(body.changes.loads[1].position);
  EXPECT_TRUE(body.changes.loads[1].moments.isZero(0));
  EXPECT_EQ(body.changes.strengths.at("hip_l"), 0.3);
  EXPECT_EQ(body.changes.foot_semi_axes.at("heel_l"), Vector3(7, 8, 9));
  EXPECT_EQ(body.changes.foot_exponents.at("heel_r"), 0.8);
  const JointSpring& spring = body.changes.springs.at("ankle_r");
  EXPECT_EQ(Vector3(spring.stiffness, spring.rest, spring.damping), Vector3(300, 0.1, 2));
  const BodyRequest unset = DecodeBody(v1::ModelSelection()).value();
  EXPECT_FALSE(unset.feet || unset.ranges || unset.toes || unset.sagittal || unset.drop_arms || unset.rigid_trunk);
  EXPECT_TRUE(unset.segment_lengths.empty() && unset.locked_joints.empty());
}

TEST(DecodeBody, RefusesFeetWithoutAName) {
  v1::ModelSelection selection;
  selection.set_feet(static_cast<v1::ModelSelection::Feet>(7));
  const Result<BodyRequest> body = DecodeBody(selection);
  ASSERT_FALSE(body.ok());
  EXPECT_THAT(Fields(body.violations()), ElementsAre("feet"));
}

}  // namespace
}  // namespace rollgait::server
