#include "client/accuracy_table.h"

#include "client/error_table.h"
#include "client/failure.h"
#include "client/joint_kinds.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

// How a criterion is shown; `field` is CriterionResult.criterion.
struct Display {
  const char* field;
  double factor;  // from the report's unit to the one shown
  const char* unit;
  const char* explanation;
};

constexpr Display kDisplays[] = {
    {"max_gap_m", 1e3, "mm", "Distance between a rolling foot and the ground, above or below it, at every instant."},
    {"max_slip_m_s", 1e3, "mm/s",
     "Speed of the foot's material point that touches the ground; zero when it rolls without slipping."},
    {"max_penetration_m", 1e3, "mm", "How deep a swinging surface is in the ground."},
    {"max_overlap_m", 1e3, "mm", "How far two bodies, the legs for example, are inside each other."},
    {"max_position_defect", 1, "rad or m",
     "Each mesh interval is integrated again from its start with the optimal efforts by another method; this is how "
     "far the end is "
     "from the next node."},
    {"max_velocity_defect", 1, "rad/s or m/s", "The same for the velocities."},
    {"max_range_excess", 180 / kPi, "°", "How far a joint is past its range of motion."},
    {"max_velocity_excess", 100, "%", "How far a joint is faster than its limit, as a share of the limit."},
    {"max_effort_excess", 100, "%", "How far an effort is past its limit, as a share of the limit."},
    {"max_pull_bw", 100, "% of body weight",
     "How far the normal force of a contact is below the least that the request allows; that is zero by default, since "
     "the ground does "
     "not pull."},
    {"max_friction_excess", 100, "%",
     "How far tangential over normal force is past the coefficient of friction, as a share of the coefficient."},
    {"max_separation_speed_m_s", 1e3, "mm/s", "Speed at which a surface rises when it is said to touch down."},
    {"max_periodicity_error", 1, "rad, m, rad/s or m/s",
     "Difference between the end of the cycle and its start, moved forward (and mirrored, for half a cycle)."},
    {"max_energy_error", 100, "%",
     "Energy that appears or vanishes, as a share of the work. Rolling contact does no work."},
    {"max_momentum_error_m_s", 1e3, "mm/s",
     "Change of momentum minus the impulse of gravity and ground forces, over the mass."},
};

// A criterion that this program does not know is shown as the server states it.
Display DisplayOf(const v1::CriterionResult& criterion, const v1::Model& model) {
  for (const Display& display : kDisplays) {
    if (criterion.criterion() != display.field) continue;
    for (const v1::Joint& joint : model.joints()) {
      const bool slides = joint.name() == criterion.where() && IsSlide(joint);
      if (slides && criterion.criterion() == "max_range_excess") return {display.field, 1e3, "mm", display.explanation};
    }
    return display;
  }
  return {criterion.criterion().c_str(), 1, criterion.unit().c_str(), ""};
}

std::string Where(const std::string& what, double time_s) {
  return what.empty() ? "" : what + " at " + FormatNumber(time_s, 3) + " s";
}

AccuracyLine CriterionLine(const v1::CriterionResult& criterion, const v1::Model& model) {
  const Display display = DisplayOf(criterion, model);
  AccuracyLine line{criterion.meaning(), display.factor * criterion.value(), display.unit,
                    Where(criterion.where(), criterion.time_s()), display.explanation};
  if (criterion.has_bound()) line.bound = display.factor * criterion.bound();
  line.exceeded = criterion.exceeded();
  return line;
}

double Ratio(const v1::CriterionResult& criterion) { return criterion.value() / criterion.bound(); }

// The criterion that is furthest beyond its bound; null: none exceeds its bound.
const v1::CriterionResult* Worst(const v1::AccuracyReport& report) {
  const v1::CriterionResult* worst = nullptr;
  for (const v1::CriterionResult& criterion : report.criteria()) {
    if (!criterion.exceeded()) continue;
    if (worst == nullptr || !(Ratio(criterion) <= Ratio(*worst))) worst = &criterion;
  }
  return worst;
}

// What results of versions before 0.4.0 have in place of criteria.
std::vector<AccuracyLine> LinesWithoutCriteria(const v1::AccuracyReport& report) {
  return {
      {"largest position defect", report.max_position_defect(), "rad or m",
       Where(report.max_position_defect_joint(), report.max_position_defect_time_s()), kDisplays[4].explanation},
      {"largest velocity defect", report.max_velocity_defect(), "rad/s or m/s",
       Where(report.max_velocity_defect_joint(), report.max_velocity_defect_time_s()), kDisplays[5].explanation},
      {"largest gap", report.max_gap_m() * 1e3, "mm", "",
       "Distance between a rolling foot and the ground, sampled between the nodes."},
      {"largest slip", report.max_slip_m_s() * 1e3, "mm/s", "", kDisplays[1].explanation},
      {"periodicity error", report.periodicity_error(), "rad, m, rad/s or m/s", "", kDisplays[12].explanation},
  };
}

std::vector<AccuracyLine> ImpactLines(const v1::AccuracyReport& report) {
  return {
      {"energy lost in impacts", report.impact_loss_j(), "J", "",
       "Kinetic energy that touch-down takes away, in all that the motion spans."},
      {"least impulse", report.min_jump_impulse_n_s(), "N s", "",
       "Of a contact in an impact. Positive: the ground pushes."},
      {"impact, velocity error", report.jump_velocity_error(), "rad/s or m/s", "",
       "Difference between the velocities after an impact and those that another method computes from those before "
       "it."},
      {"impact, impulse error", report.jump_impulse_error_n_s(), "N s", "",
       "Change of momentum in an impact minus the impulses of the ground."},
  };
}

}  // namespace

std::vector<AccuracyLine> AccuracyLines(const v1::Solve& solve) {
  const v1::AccuracyReport& report = solve.result().accuracy();
  std::vector<AccuracyLine> lines;
  for (const v1::CriterionResult& criterion : report.criteria()) {
    lines.push_back(CriterionLine(criterion, solve.result().model()));
  }
  if (lines.empty()) lines = LinesWithoutCriteria(report);
  const v1::GroundContact& ground = solve.spec().ground_contact();
  const double friction = ground.has_friction_coefficient() ? ground.friction_coefficient() : 0.8;
  lines.push_back(
      {"least normal force", report.min_normal_force_n(), "N", "", "Positive: the ground pushes and never pulls."});
  lines.push_back({"largest friction ratio", report.max_friction_ratio(), "",
                   "the ground's coefficient is " + FormatNumber(friction), "Tangential over normal force."});
  // The ball of a manoeuvre never swings.
  if (solve.spec().has_manoeuvre()) {
    lines.push_back(
        {"end error", report.end_error(), "m, rad or rad/s", "",
         "Difference between the states that the manoeuvre prescribes at its ends and those of the motion."});
  } else {
    lines.push_back(
        {"least swing clearance", report.min_swing_clearance_m() * 1e3, "mm", "",
         "Height of the swing foot over the ground. It is zero at lift-off and touch-down; negative: the foot is in "
         "the ground."});
  }
  const double kkt = solve.spec().accuracy().has_kkt_tolerance() ? solve.spec().accuracy().kkt_tolerance() : 1e-6;
  const std::vector<AccuracyLine> rest = {
      {"energy balance error", report.energy_balance_error_j(), "J",
       FormatNumber(100 * report.energy_balance_error_relative(), 3) + " % of the work",
       "Change of mechanical energy minus the work of the joints."},
      {"momentum balance error", report.momentum_balance_error_n_s(), "N s", "",
       "Change of momentum minus the impulse of gravity and ground forces."},
      {"KKT error", report.kkt_error(), "", "",
       "How far the solver is from a stationary point of the discretised problem (scaled).", kkt,
       !(report.kkt_error() <= kkt)},
      {"constraint violation", report.constraint_violation(), "", "",
       "Largest violation of any constraint of the discretised problem (scaled)."},
  };
  lines.insert(lines.end(), rest.begin(), rest.end());
  const std::vector<AccuracyLine> errors = ErrorLines(solve);
  lines.insert(lines.end(), errors.begin(), errors.end());
  if (ground.touch_down() == v1::TOUCH_DOWN_PLASTIC) {
    const std::vector<AccuracyLine> impacts = ImpactLines(report);
    lines.insert(lines.end(), impacts.begin(), impacts.end());
  }
  return lines;
}

namespace {

std::string ExceededText(const AccuracyLine& line) {
  const std::string unit = line.unit.empty() ? "" : " " + line.unit;
  return "EXCEEDED: " + line.name + ", " + FormatNumber(line.value, 3) + unit + " where " +
         FormatNumber(*line.bound, 3) + unit + " is allowed" + (line.where.empty() ? "" : " (" + line.where + ")");
}

// By the bounds alone.
std::string BoundsVerdict(const v1::Solve& solve) {
  const v1::AccuracyReport& report = solve.result().accuracy();
  if (report.verdict() == v1::VERDICT_WITHIN) return "within the requested bounds";
  const v1::CriterionResult* worst = Worst(report);
  if (report.verdict() == v1::VERDICT_EXCEEDED && worst != nullptr) {
    return ExceededText(CriterionLine(*worst, solve.result().model()));
  }
  if (report.verdict() == v1::VERDICT_EXCEEDED) return "EXCEEDED";
  if (report.verdict() == v1::VERDICT_UNSPECIFIED) return "not judged (a result of a version before 0.4.0)";
  return HasSolution(solve) ? "not judged (draft)" : "not judged (the solver did not converge)";
}

// What the estimated errors add to the verdict.
std::string ErrorVerdict(const v1::Solve& solve) {
  if (!solve.spec().accuracy().has_max_error()) return "";
  if (!MissesMaxError(solve)) return ", within the requested errors";
  for (const AccuracyLine& line : ErrorLines(solve)) {
    if (line.exceeded) return "; errors " + ExceededText(line);
  }
  return "; errors NOT ESTIMATED";
}

}  // namespace

std::string AccuracyVerdict(const v1::Solve& solve) {
  return BoundsVerdict(solve) + (HasSolution(solve) ? ErrorVerdict(solve) : "");
}

}  // namespace rollgait::client
