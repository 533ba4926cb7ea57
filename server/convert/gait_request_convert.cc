#include "server/convert/gait_request_convert.h"

#include <utility>

#include "server/convert/cost_convert.h"
#include "server/convert/field_decoding.h"
#include "server/convert/own_model_convert.h"
#include "server/convert/scheme_convert.h"

namespace rollgait::server {
namespace {

class RequestDecoder {
 public:
  GaitRequest Decode(const v1::SolveSpec& spec);
  BodyRequest DecodeSelection(const std::string& prefix, const v1::ModelSelection& selection);
  Violations violations;

 private:
  void RefuseEnum(const std::string& field, int value) {
    violations.push_back(
        {field, "enum value " + std::to_string(value) + " is not known to this server; use a named one"});
  }
  std::optional<Cycle> DecodeCycle(v1::Cycle cycle);
  GaitRequest::Normalization DecodeNormalization(v1::CostNormalization normalization, bool manoeuvre);
  std::optional<Preset> DecodePreset(v1::Preset preset);
  Scheme SchemeOf(v1::Discretization::Scheme scheme);
  NlpSolver DecodeSolver(v1::NlpSolver solver);
  GaitRequest::AccuracyLevel DecodeLevel(v1::Accuracy::Level level);
  GaitRequest::TouchDown DecodeTouchDown(v1::TouchDown touch_down);
};

GaitRequest::Range DecodeRange(const v1::Range& range) { return {range.min(), range.max()}; }

std::map<std::string, GaitRequest::Range> DecodeRanges(const google::protobuf::Map<std::string, v1::Range>& ranges) {
  std::map<std::string, GaitRequest::Range> decoded;
  for (const auto& [name, range] : ranges) decoded[name] = DecodeRange(range);
  return decoded;
}

GaitRequest::Phase DecodePhase(const v1::Phase& phase) {
  return {{phase.contacts().begin(), phase.contacts().end()},
          ROLLGAIT_OPTIONAL(phase, intervals),
          ROLLGAIT_OPTIONAL(phase, min_duration_s),
          ROLLGAIT_OPTIONAL(phase, max_duration_s)};
}

GaitRequest::GroundContact DecodeGround(const v1::GroundContact& ground) {
  GaitRequest::GroundContact decoded;
  decoded.friction_coefficient = ROLLGAIT_OPTIONAL(ground, friction_coefficient);
  decoded.min_normal_force_bw = ROLLGAIT_OPTIONAL(ground, min_normal_force_bw);
  decoded.swing_clearance = ROLLGAIT_OPTIONAL(ground, swing_clearance_m);
  if (ground.has_touch_down_point()) decoded.touch_down_point = DecodeRange(ground.touch_down_point());
  if (ground.has_lift_off_point()) decoded.lift_off_point = DecodeRange(ground.lift_off_point());
  return decoded;
}

Vector3 DecodeComponents(const v1::Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }

ManoeuvreRequest::State DecodeState(const v1::Manoeuvre::State& state) {
  ManoeuvreRequest::State decoded;
  decoded.x = ROLLGAIT_OPTIONAL(state, x_m);
  decoded.y = ROLLGAIT_OPTIONAL(state, y_m);
  const v1::Quaternion& q = state.orientation();
  if (state.has_orientation()) decoded.orientation = Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
  decoded.angular_velocity = DecodeComponents(state.angular_velocity_rad_s());
  return decoded;
}

RollingEllipsoidRequest DecodeRollingBody(const v1::RollingBody& body) {
  RollingEllipsoidRequest decoded;
  if (body.has_semi_axes_m()) decoded.semi_axes = DecodeComponents(body.semi_axes_m());
  decoded.mass = ROLLGAIT_OPTIONAL(body, mass_kg);
  if (body.has_moments_kg_m2()) decoded.moments = DecodeComponents(body.moments_kg_m2());
  return decoded;
}

// The field of a criterion is found by its name in the table; tests hold that each is there and is an optional double.
std::optional<MaxError> DecodeMaxError(const v1::Accuracy& accuracy) {
  if (!accuracy.has_max_error()) return std::nullopt;
  const v1::MaxError& error = accuracy.max_error();
  return MaxError{ROLLGAIT_OPTIONAL(error, objective), ROLLGAIT_OPTIONAL(error, angle_rad),
                  ROLLGAIT_OPTIONAL(error, torque_n_m), ROLLGAIT_OPTIONAL(error, contact_force_n)};
}

std::map<Criterion, double> DecodeBounds(const v1::Accuracy& accuracy) {
  std::map<Criterion, double> bounds;
  for (const CriterionTraits& traits : Criteria()) {
    const google::protobuf::FieldDescriptor* field = v1::Accuracy::descriptor()->FindFieldByName(traits.field);
    ROLLGAIT_CHECK(field != nullptr);
    const google::protobuf::Reflection& reflection = *v1::Accuracy::GetReflection();
    if (reflection.HasField(accuracy, field)) bounds[traits.criterion] = reflection.GetDouble(accuracy, field);
  }
  return bounds;
}

SubjectChanges DecodeChanges(const v1::ModelSelection& selection) {
  SubjectChanges changes;
  for (const v1::ModelSelection::Load& load : selection.loads()) {
    changes.loads.push_back({.segment = load.segment(), .mass = load.mass_kg(), .position = {}});
    if (load.has_position_m()) changes.loads.back().position = DecodeComponents(load.position_m());
    if (load.has_moments_kg_m2()) changes.loads.back().moments = DecodeComponents(load.moments_kg_m2());
  }
  changes.strengths = DecodeNumbers(selection.joint_strengths());
  for (const auto& [name, spring] : selection.joint_springs()) {
    changes.springs[name] = {spring.stiffness_n_m_rad(), spring.rest_rad(), spring.damping_n_m_s_rad()};
  }
  for (const auto& [name, axes] : selection.foot_semi_axes_m()) {
    changes.foot_semi_axes[name] = DecodeComponents(axes);
  }
  changes.foot_exponents = DecodeNumbers(selection.foot_exponents());
  return changes;
}

BodyRequest RequestDecoder::DecodeSelection(const std::string& prefix, const v1::ModelSelection& selection) {
  BodyRequest body;
  body.model = selection.name();
  body.stature = ROLLGAIT_OPTIONAL(selection, stature_m);
  body.mass = ROLLGAIT_OPTIONAL(selection, body_mass_kg);
  switch (selection.sex()) {
    case v1::ModelSelection::SEX_UNSPECIFIED:
    case v1::ModelSelection::SEX_MALE:
      body.sex = Sex::kMale;
      break;
    case v1::ModelSelection::SEX_FEMALE:
      body.sex = Sex::kFemale;
      break;
    default:
      RefuseEnum(prefix + "sex", selection.sex());
  }
  body.segment_lengths = DecodeNumbers(selection.segment_lengths_m());
  switch (selection.feet()) {
    case v1::ModelSelection::FEET_UNSPECIFIED:
      break;
    case v1::ModelSelection::FEET_ONE_ELLIPSOID:
      body.feet = FootShape::kOneEllipsoid;
      break;
    case v1::ModelSelection::FEET_TWO_ELLIPSOIDS:
      body.feet = FootShape::kTwoEllipsoids;
      break;
    default:
      RefuseEnum(prefix + "feet", selection.feet());
  }
  body.toes = selection.toes();
  switch (selection.ranges()) {
    case v1::ModelSelection::RANGES_UNSPECIFIED:
      break;
    case v1::ModelSelection::RANGES_ANATOMICAL:
      body.ranges = JointRanges::kAnatomical;
      break;
    case v1::ModelSelection::RANGES_WALKING:
      body.ranges = JointRanges::kWalking;
      break;
    default:
      RefuseEnum(prefix + "ranges", selection.ranges());
  }
  body.sagittal = selection.sagittal();
  body.drop_arms = selection.drop_arms();
  body.rigid_trunk = selection.rigid_trunk();
  body.locked_joints = DecodeNumbers(selection.locked_joints_rad());
  body.changes = DecodeChanges(selection);
  if (selection.has_own()) body.own = DecodeOwnModel(prefix + "own.", selection.own(), &violations);
  if (selection.has_rolling_body()) body.rolling_body = DecodeRollingBody(selection.rolling_body());
  return body;
}

std::optional<Cycle> RequestDecoder::DecodeCycle(v1::Cycle cycle) {
  switch (cycle) {
    case v1::CYCLE_UNSPECIFIED:
      return std::nullopt;
    case v1::CYCLE_ONCE:
      return Cycle::kOnce;
    case v1::CYCLE_HALF:
      return Cycle::kHalf;
    case v1::CYCLE_FULL:
      return Cycle::kFull;
    default:
      RefuseEnum("cycle", cycle);
      return Cycle::kHalf;
  }
}

GaitRequest::Normalization RequestDecoder::DecodeNormalization(v1::CostNormalization normalization, bool manoeuvre) {
  switch (normalization) {
    case v1::COST_NORMALIZATION_UNSPECIFIED:
      return manoeuvre ? GaitRequest::Normalization::kNone : GaitRequest::Normalization::kPerDistance;
    case v1::COST_NORMALIZATION_PER_DISTANCE:
      return GaitRequest::Normalization::kPerDistance;
    case v1::COST_NORMALIZATION_PER_TIME:
      return GaitRequest::Normalization::kPerTime;
    case v1::COST_NORMALIZATION_NONE:
      return GaitRequest::Normalization::kNone;
    default:
      RefuseEnum("cost_normalization", normalization);
      return GaitRequest::Normalization::kPerDistance;
  }
}

std::optional<Preset> RequestDecoder::DecodePreset(v1::Preset preset) {
  switch (preset) {
    case v1::PRESET_UNSPECIFIED:
      return std::nullopt;
    case v1::PRESET_TORQUE:
      return Preset::kTorque;
    case v1::PRESET_TRANSPORT:
      return Preset::kTransport;
    case v1::PRESET_HUMAN:
      return Preset::kHuman;
    default:
      RefuseEnum("preset", preset);
      return std::nullopt;
  }
}

GaitRequest::TouchDown RequestDecoder::DecodeTouchDown(v1::TouchDown touch_down) {
  switch (touch_down) {
    case v1::TOUCH_DOWN_UNSPECIFIED:
    case v1::TOUCH_DOWN_SMOOTH:
      return GaitRequest::TouchDown::kSmooth;
    case v1::TOUCH_DOWN_PLASTIC:
      return GaitRequest::TouchDown::kPlastic;
    default:
      RefuseEnum("ground_contact.touch_down", touch_down);
      return GaitRequest::TouchDown::kSmooth;
  }
}

Scheme RequestDecoder::SchemeOf(v1::Discretization::Scheme scheme) {
  if (scheme == v1::Discretization::SCHEME_UNSPECIFIED) return Scheme::kRadau2;
  const std::optional<Scheme> known = DecodeScheme(scheme);
  if (!known) RefuseEnum("discretization.scheme", scheme);
  return known.value_or(Scheme::kRadau2);
}

NlpSolver RequestDecoder::DecodeSolver(v1::NlpSolver solver) {
  if (!v1::NlpSolver_IsValid(solver)) RefuseEnum("nlp_solver", solver);
  return solver == v1::NLP_SOLVER_IPOPT ? NlpSolver::kIpopt : NlpSolver::kInteriorPoint;
}

GaitRequest::AccuracyLevel RequestDecoder::DecodeLevel(v1::Accuracy::Level level) {
  switch (level) {
    case v1::Accuracy::LEVEL_DRAFT:
      return GaitRequest::AccuracyLevel::kDraft;
    case v1::Accuracy::LEVEL_UNSPECIFIED:
    case v1::Accuracy::LEVEL_STANDARD:
      return GaitRequest::AccuracyLevel::kStandard;
    case v1::Accuracy::LEVEL_FINE:
      return GaitRequest::AccuracyLevel::kFine;
    default:
      RefuseEnum("accuracy.level", level);
      return GaitRequest::AccuracyLevel::kStandard;
  }
}

GaitRequest RequestDecoder::Decode(const v1::SolveSpec& spec) {
  GaitRequest request;
  request.body = DecodeSelection("model.", spec.model());
  request.slope = spec.slope_rad();
  request.motion = {ROLLGAIT_OPTIONAL(spec.motion(), speed_m_s), ROLLGAIT_OPTIONAL(spec.motion(), step_length_m),
                    ROLLGAIT_OPTIONAL(spec.motion(), step_duration_s), spec.motion().free_speed(), std::nullopt};
  if (spec.motion().has_duty_factor()) request.motion.duty_factor = DecodeRange(spec.motion().duty_factor());
  request.cycle = DecodeCycle(spec.cycle());
  if (spec.has_manoeuvre()) {
    request.manoeuvre.emplace();
    request.manoeuvre->start = DecodeState(spec.manoeuvre().start());
    request.manoeuvre->end = DecodeState(spec.manoeuvre().end());
    request.manoeuvre->duration = ROLLGAIT_OPTIONAL(spec.manoeuvre(), duration_s);
  }
  if (spec.has_phases()) {
    request.phases.emplace();
    for (const v1::Phase& phase : spec.phases().phases()) request.phases->push_back(DecodePhase(phase));
  }
  request.preset = DecodePreset(spec.preset());
  request.starts = ROLLGAIT_OPTIONAL(spec, starts);
  request.warm_start = !spec.warm_start().empty();
  for (int i = 0; i < spec.costs_size(); ++i) {
    request.costs.push_back(DecodeCost("costs[" + std::to_string(i) + "]", spec.costs(i), &violations));
  }
  request.normalization = DecodeNormalization(spec.cost_normalization(), spec.has_manoeuvre());
  request.ground_contact = DecodeGround(spec.ground_contact());
  request.ground_contact.touch_down = DecodeTouchDown(spec.ground_contact().touch_down());
  request.limits = {DecodeRanges(spec.limits().joint_position()), DecodeNumbers(spec.limits().joint_velocity()),
                    DecodeRanges(spec.limits().joint_effort()), spec.limits().allow_body_overlap()};
  request.discretization = {SchemeOf(spec.discretization().scheme()),
                            ROLLGAIT_OPTIONAL(spec.discretization(), single_support_intervals),
                            ROLLGAIT_OPTIONAL(spec.discretization(), double_support_intervals)};
  const v1::Accuracy& accuracy = spec.accuracy();
  request.accuracy = {DecodeLevel(accuracy.level()), ROLLGAIT_OPTIONAL(accuracy, kkt_tolerance),
                      DecodeBounds(accuracy),        ROLLGAIT_OPTIONAL(accuracy, max_refinements),
                      accuracy.estimate_errors(),    DecodeMaxError(accuracy)};
  request.solver_limits = {ROLLGAIT_OPTIONAL(spec.solver_limits(), max_iterations),
                           ROLLGAIT_OPTIONAL(spec.solver_limits(), max_wall_time_s)};
  request.nlp_solver = DecodeSolver(spec.nlp_solver());
  request.gravity = ROLLGAIT_OPTIONAL(spec, gravity_m_s2);
  return request;
}

// An answer has to fit into the trailers of a call; see RequestCheck.
void Append(Violations violations, Violations* all) {
  constexpr size_t kMaxViolations = 20;
  for (Violation& violation : violations) {
    if (all->size() < kMaxViolations) all->push_back(std::move(violation));
  }
}

// Decodes as far as possible; `refused` gets what could not be.
GaitRequest Decode(const v1::SolveSpec& spec, Violations* refused) {
  RequestDecoder decoder;
  GaitRequest request = decoder.Decode(spec);
  Append(std::move(decoder.violations), refused);
  return request;
}

}  // namespace

Result<GaitRequest> DecodeRequest(const v1::SolveSpec& spec) {
  Violations refused;
  GaitRequest request = Decode(spec, &refused);
  if (!refused.empty()) return refused;
  return request;
}

Result<GaitSpec> DecodeSpec(const v1::SolveSpec& spec) {
  Violations refused;
  Result<GaitSpec> checked = CheckRequest(Decode(spec, &refused));
  if (refused.empty()) return checked;
  if (!checked.ok()) Append(checked.violations(), &refused);
  return refused;
}

Result<BodyRequest> DecodeBody(const v1::ModelSelection& selection) {
  RequestDecoder decoder;
  BodyRequest body = decoder.DecodeSelection("", selection);
  if (!decoder.violations.empty()) return std::move(decoder.violations);
  return body;
}

}  // namespace rollgait::server
