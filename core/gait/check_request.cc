#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/gait/default_speed.h"
#include "core/gait/gait_spec.h"
#include "core/gait/presets.h"
#include "core/gait/rate_costs.h"
#include "core/gait/request_check.h"
#include "core/models/sides_alike.h"

namespace rollgait {
namespace {

std::optional<Scene> CheckBody(BodyRequest body, RequestCheck& check) {
  if (!body.own) body.model = Printable(body.model);  // it comes back in a message if it is unknown
  Result<Scene> scene = BuildScene(body);
  if (scene.ok()) return std::move(scene).value();
  for (const Violation& violation : scene.violations()) check.Add("model." + violation.field, violation.message);
  return std::nullopt;
}

// Of a body that rolls on its own defaults do not follow mass and gravity: how fast it goes is up to its manoeuvre.
Similarity SimilarityOf(const Scene* scene, double gravity) {
  constexpr double kMass = 75;  // kg
  if (scene == nullptr || scene->selection.rolling_body || !(gravity > 0 && std::isfinite(gravity))) return {};
  return {scene->selection.mass / kMass, gravity / kDefaultGravity};
}

struct CheckedGround {
  double friction_coefficient, min_normal_force_bw, swing_clearance;
};

CheckedGround CheckGround(const GaitRequest::GroundContact& ground, RequestCheck& check) {
  const std::string path = "ground_contact.";
  const CheckedGround checked = {
      check.Number(path + "friction_coefficient", ground.friction_coefficient, 0.8, {0, 5, "", true}),
      check.Number(path + "min_normal_force_bw", ground.min_normal_force_bw, 0, {0, 1}),
      check.Number(path + "swing_clearance_m", ground.swing_clearance, 0.01, {0, 0.3, "m"})};
  const NumberLimits heel_to_toe{-1, 1};
  if (ground.touch_down_point) check.Range(path + "touch_down_point", *ground.touch_down_point, heel_to_toe, true);
  if (ground.lift_off_point) check.Range(path + "lift_off_point", *ground.lift_off_point, heel_to_toe, true);
  return checked;
}

struct CheckedAccuracy {
  double kkt_tolerance;
  CriterionValues bounds;
  int max_refinements;
  std::optional<MaxError> max_error;
};

std::optional<MaxError> CheckMaxError(const std::optional<MaxError>& given, RequestCheck& check) {
  if (!given) return std::nullopt;
  const std::string path = "accuracy.max_error";
  MaxError checked;
  const auto take = [&](const std::optional<double>& error, const std::string& field, double most, const char* unit) {
    std::optional<double> taken;
    if (error) taken = check.Number(path + "." + field, error, 0, {1e-9, most, unit});
    return taken;
  };
  checked.objective = take(given->objective, "objective", 1, "");
  checked.angle = take(given->angle, "angle_rad", 1, "rad");
  checked.torque = take(given->torque, "torque_n_m", kMaxEffort, "N m");
  checked.contact_force = take(given->contact_force, "contact_force_n", kMaxEffort, "N");
  if (!given->objective && !given->angle && !given->torque && !given->contact_force) {
    check.Add(path, "allows no error; give objective, angle_rad, torque_n_m or contact_force_n, or leave it out");
  }
  return checked;
}

// Where gravity is less than the Earth's, all goes slower: velocities are then judged by the bound of the same Froude
// number. Where it is more they are not, so that no level is laxer than it says.
CriterionValues BoundsOfLevel(GaitRequest::AccuracyLevel level, const Similarity& similarity) {
  using Level = GaitRequest::AccuracyLevel;
  if (level == Level::kDraft) return NoBounds();
  CriterionValues bounds = level == Level::kFine ? FineBounds() : StandardBounds();
  for (const Criterion criterion :
       {Criterion::kSlip, Criterion::kVelocityDefect, Criterion::kApproach, Criterion::kMomentum}) {
    bounds[criterion] *= std::min(1.0, similarity.speed());
  }
  return bounds;
}

CheckedAccuracy CheckAccuracy(const GaitRequest::Accuracy& accuracy, const Similarity& similarity, bool allow_overlap,
                              RequestCheck& check) {
  const bool is_draft = accuracy.level == GaitRequest::AccuracyLevel::kDraft;
  CriterionValues bounds = BoundsOfLevel(accuracy.level, similarity);
  for (const auto& [criterion, bound] : accuracy.bounds) {
    const CriterionTraits& traits = TraitsOf(criterion);
    const char* const unit = std::string(traits.unit) == "1" ? "" : traits.unit;
    bounds[criterion] =
        check.Number(std::string("accuracy.") + traits.field, bound, 0, {traits.least, traits.most, unit});
  }
  if (allow_overlap) {
    if (accuracy.bounds.count(Criterion::kOverlap) > 0) {
      check.Add(std::string("accuracy.") + TraitsOf(Criterion::kOverlap).field,
                "bounds what limits.allow_body_overlap leaves free; leave one of the two out");
    }
    bounds[Criterion::kOverlap] = kInfinity;
  }
  return {check.Number("accuracy.kkt_tolerance", accuracy.kkt_tolerance, 1e-6, {1e-12, 1e-2}), bounds,
          check.Integer("accuracy.max_refinements", accuracy.max_refinements, is_draft ? 0 : 12, 0, 20),
          CheckMaxError(accuracy.max_error, check)};
}

// "model.joint_springs["ankle_l"], model.loads[0]": what makes left and right differ.
std::string DifferingFields(const BodyRequest& body) {
  std::vector<std::string> fields = OneSidedFields(body);
  for (std::string& field : fields) field = "model." + field;  // of names that the body has
  return ListNames(fields);
}

// The phases and the motion of a walk.
CheckedMotion CheckGait(const GaitRequest& request, const Scene* scene, double gravity, const Similarity& similarity,
                        std::vector<GaitSpec::Phase>* phases, RequestCheck& check) {
  if (scene != nullptr && scene->selection.rolling_body) {
    check.Add("manoeuvre",
              "is not set; model " + Quoted(scene->name) + " does not walk: give the state that it is to reach");
    return {};
  }
  if (request.cycle == Cycle::kOnce) {
    check.Add("cycle", "CYCLE_ONCE is the cycle of a manoeuvre, which is not set; give CYCLE_HALF or CYCLE_FULL");
  }
  if (scene != nullptr && !scene->symmetric && request.cycle == Cycle::kHalf) {
    check.Add("cycle", "CYCLE_HALF ends in the mirror image of its start, but left and right of this body differ by " +
                           DifferingFields(request.body) +
                           "; give CYCLE_FULL, leave `cycle` out, or give the same of both sides");
  }
  *phases = CheckPhases(request, scene, similarity, check);
  return CheckMotion(request, scene, gravity, similarity, *phases, check);
}

// The request without what makes left and right of its body differ.
GaitRequest ForBothSidesAlike(GaitRequest request) {
  request.body = WithSidesAlike(std::move(request.body));
  request.cycle = Cycle::kFull;
  request.warm_start = false;
  return request;
}

// Whether CheckRequest fills in GaitSpec::symmetric.
enum class Symmetric { kWhereUsed, kLeftOut };
Result<GaitSpec> Check(const GaitRequest& given, Symmetric with);

// Null where it is not used: left and right of the body do not differ, or nothing else is known of it.
std::shared_ptr<const GaitSpec> SymmetricSpec(const GaitRequest& given, const Scene& scene, Cycle cycle) {
  if (scene.symmetric || cycle != Cycle::kFull || given.body.own) return nullptr;
  const Result<GaitSpec> symmetric = Check(ForBothSidesAlike(given), Symmetric::kLeftOut);
  if (!symmetric.ok()) return nullptr;
  return std::make_shared<const GaitSpec>(symmetric.value());
}

Result<GaitSpec> Check(const GaitRequest& given, Symmetric with) {
  GaitRequest request = given;
  FillFromPreset(&request);
  RequestCheck check;
  const std::optional<Scene> scene = CheckBody(request.body, check);
  const Scene* known = scene ? &*scene : nullptr;

  constexpr double kSteepest = std::numbers::pi / 4;
  const double slope = check.Number("slope_rad", request.slope, 0, {-kSteepest, kSteepest, "rad"});
  const double gravity = check.Number("gravity_m_s2", request.gravity, kDefaultGravity, {0.1, 100, "m/s²"});
  const Similarity similarity = SimilarityOf(known, gravity);

  const bool once = request.manoeuvre.has_value();
  const bool is_full_by_body = !request.cycle && !once && known != nullptr && !known->symmetric;
  if (!request.cycle) request.cycle = once ? Cycle::kOnce : is_full_by_body ? Cycle::kFull : Cycle::kHalf;
  CheckedManoeuvre manoeuvre;
  CheckedMotion motion{};
  if (once) {
    for (const auto& [field, is_asked] : {std::pair("estimate_errors", request.accuracy.estimate_errors),
                                          std::pair("max_error", request.accuracy.max_error.has_value())}) {
      if (is_asked) {
        check.Add(std::string("accuracy.") + field,
                  "errors of a manoeuvre are not estimated, only those of gaits; leave it out");
      }
    }
    manoeuvre = CheckManoeuvre(request, known, check);
  } else {
    motion = CheckGait(request, known, gravity, similarity, &manoeuvre.phases, check);
  }
  if (request.motion.duty_factor) {
    check.Range("motion.duty_factor", *request.motion.duty_factor, {0.5, 0.95}, true);
  }
  std::vector<GaitSpec::CostTerm> costs = CheckCosts(request, known, similarity, check);
  if (HasRates(costs) && !HasRatesOfEfforts(request.discretization.scheme)) {
    check.Add("discretization.scheme",
              "has efforts that are constant in every interval, and the cost has " + NamesOfRates(costs) +
                  ", which would keep them from ever changing; take " + TraitsOf(Scheme::kShootingLinear).word +
                  ", or give a weight of 0 to what comes from the preset and leave out the rest");
  }

  const CheckedGround ground = CheckGround(request.ground_contact, check);
  std::vector<Joint> joints = CheckLimits(request, known, similarity, check);
  const CheckedAccuracy accuracy =
      CheckAccuracy(request.accuracy, similarity, request.limits.allow_body_overlap, check);
  const int max_iterations = check.Integer("solver_limits.max_iterations", request.solver_limits.max_iterations,
                                           once ? 5000 : 3000, 1, 100000);
  const double max_wall_time =
      check.Number("solver_limits.max_wall_time_s", request.solver_limits.max_wall_time, 600, {0.01, 86400, "s"});
  const int starts = check.Integer("starts", request.starts, 1, 1, 32);
  if (request.warm_start && given.starts.value_or(1) > 1) {
    check.Add("starts",
              "is " + std::to_string(*given.starts) + "; a warm start is the only one: leave one of the two out");
  }
  if (!check.ok()) return check.Take();

  Result<Model> model = Model::Create(std::move(joints));
  if (!model.ok()) return model.violations();
  std::shared_ptr<const GaitSpec> symmetric;
  if (with == Symmetric::kWhereUsed) symmetric = SymmetricSpec(given, *scene, *request.cycle);
  Scene limited = *scene;
  limited.model = std::move(model).value();
  return GaitSpec{.scene = std::move(limited),
                  .similarity = similarity,
                  .passive_scale = request.preset ? similarity.gravity : 1,
                  .slope = slope,
                  .gravity = gravity * Vector3(-std::sin(slope), 0, -std::cos(slope)),
                  .speed = motion.speed,
                  .step_length = motion.step_length,
                  .step_duration = motion.step_duration,
                  .speed_range = motion.speed_range,
                  .step_length_range = motion.step_length_range,
                  .step_duration_range = motion.step_duration_range,
                  .duty_factor = request.motion.duty_factor,
                  .cycle = *request.cycle,
                  .is_full_by_body = is_full_by_body,
                  .manoeuvre = once ? std::optional(manoeuvre.manoeuvre) : std::nullopt,
                  .phases = std::move(manoeuvre.phases),
                  .costs = std::move(costs),
                  .normalization = request.normalization,
                  .friction_coefficient = ground.friction_coefficient,
                  .min_normal_force_bw = ground.min_normal_force_bw,
                  .swing_clearance = ground.swing_clearance,
                  .touch_down_point = request.ground_contact.touch_down_point,
                  .lift_off_point = request.ground_contact.lift_off_point,
                  .touch_down = request.ground_contact.touch_down,
                  .scheme = request.discretization.scheme,
                  .kkt_tolerance = accuracy.kkt_tolerance,
                  .allow_body_overlap = request.limits.allow_body_overlap,
                  .bounds = accuracy.bounds,
                  .max_refinements = accuracy.max_refinements,
                  .estimate_errors = request.accuracy.estimate_errors || accuracy.max_error.has_value(),
                  .max_error = accuracy.max_error,
                  .nlp_solver = request.nlp_solver,
                  .max_iterations = max_iterations,
                  .max_wall_time = max_wall_time,
                  .starts = request.warm_start ? 1 : starts,
                  .warm_start = std::nullopt,
                  .symmetric = std::move(symmetric)};
}

}  // namespace

Result<GaitSpec> CheckRequest(const GaitRequest& given) { return Check(given, Symmetric::kWhereUsed); }

}  // namespace rollgait
