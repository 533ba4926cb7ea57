#include "client/accuracy_table.h"

#include "client/text.h"

namespace rollgait::client {
namespace {

struct Bounds {
  std::optional<double> gap_m, slip_m_s;
  double kkt = 1e-6;
};

// What the level and its overrides ask for; the defaults are those that solve_spec.proto states.
Bounds RequestedBounds(const v1::Accuracy& accuracy) {
  Bounds bounds;
  if (accuracy.level() == v1::Accuracy::LEVEL_FINE) {
    bounds.gap_m = 1e-5;
    bounds.slip_m_s = 1e-4;
  } else if (accuracy.level() != v1::Accuracy::LEVEL_DRAFT) {
    bounds.gap_m = 1e-4;
    bounds.slip_m_s = 1e-3;
  }
  if (accuracy.has_max_gap_m()) bounds.gap_m = accuracy.max_gap_m();
  if (accuracy.has_max_slip_m_s()) bounds.slip_m_s = accuracy.max_slip_m_s();
  if (accuracy.has_kkt_tolerance()) bounds.kkt = accuracy.kkt_tolerance();
  return bounds;
}

std::optional<double> Thousandfold(std::optional<double> value) {
  if (value) *value *= 1e3;
  return value;
}

std::string Where(const std::string& joint, double time_s) {
  return joint.empty() ? "" : joint + " at " + FormatNumber(time_s, 3) + " s";
}

// How well the two ends fit: those of a cycle to each other, those of a manoeuvre to what was asked for.
AccuracyLine EndLine(const v1::Solve& solve) {
  const v1::AccuracyReport& report = solve.result().accuracy();
  if (solve.spec().has_manoeuvre()) {
    return {"end error", report.end_error(), "m, rad or rad/s", "",
            "Difference between the states that the manoeuvre prescribes at its ends and those of the motion.", {}};
  }
  return {"periodicity error", report.periodicity_error(), "rad, m, rad/s or m/s", "",
          "Difference between the end of the cycle and its start, moved forward (and mirrored, for half a cycle).", {}};
}

std::vector<AccuracyLine> ImpactLines(const v1::AccuracyReport& report) {
  return {
      {"energy lost in impacts", report.impact_loss_j(), "J", "",
       "Kinetic energy that touch-down takes away, in all that the motion spans.", {}},
      {"least impulse", report.min_jump_impulse_n_s(), "N s", "", "Of a contact in an impact. Positive: the ground pushes.", {}},
      {"impact, velocity error", report.jump_velocity_error(), "rad/s or m/s", "",
       "Difference between the velocities after an impact and those that another method computes from those before it.", {}},
      {"impact, impulse error", report.jump_impulse_error_n_s(), "N s", "",
       "Change of momentum in an impact minus the impulses of the ground.", {}},
  };
}

}  // namespace

std::vector<AccuracyLine> AccuracyLines(const v1::Solve& solve) {
  const v1::AccuracyReport& report = solve.result().accuracy();
  const Bounds bounds = RequestedBounds(solve.spec().accuracy());
  const std::string tolerance = FormatNumber(report.integrator_tolerance(), 2);
  const v1::GroundContact& ground = solve.spec().ground_contact();
  const double friction = ground.has_friction_coefficient() ? ground.friction_coefficient() : 0.8;
  std::vector<AccuracyLine> lines = {
      {"largest position defect",
       report.max_position_defect(),
       "rad or m",
       Where(report.max_position_defect_joint(), report.max_position_defect_time_s()),
       "Each mesh interval is integrated again from its start with the optimal efforts by another method (tolerance " +
           tolerance + "); this is how far the end is from the next node.",
       {}},
      {"largest velocity defect",
       report.max_velocity_defect(),
       "rad/s or m/s",
       Where(report.max_velocity_defect_joint(), report.max_velocity_defect_time_s()),
       "The same for the velocities.",
       {}},
      {"largest gap", report.max_gap_m() * 1e3, "mm", "",
       "Distance between a rolling foot and the ground, above or below it, sampled between the nodes.",
       Thousandfold(bounds.gap_m)},
      {"largest slip", report.max_slip_m_s() * 1e3, "mm/s", "",
       "Speed of the foot's material point that touches the ground; zero when it rolls without slipping.",
       Thousandfold(bounds.slip_m_s)},
      {"least normal force", report.min_normal_force_n(), "N", "", "Positive: the ground pushes and never pulls.", {}},
      {"largest friction ratio",
       report.max_friction_ratio(),
       "",
       "the ground's coefficient is " + FormatNumber(friction),
       "Tangential over normal force. It is held below the coefficient at the collocation points; sampled between them "
       "too.",
       {}},
  };
  // The ball of a manoeuvre never swings.
  if (!solve.spec().has_manoeuvre()) {
    lines.push_back({"least swing clearance", report.min_swing_clearance_m() * 1e3, "mm", "",
                     "Height of the swing foot over the ground. It is zero at lift-off and touch-down; negative: the foot is in "
                     "the ground.",
                     {}});
  }
  lines.push_back(EndLine(solve));
  const std::vector<AccuracyLine> balances = {
      {"energy balance error",
       report.energy_balance_error_j(),
       "J",
       FormatNumber(100 * report.energy_balance_error_relative(), 3) + " % of the work",
       "Change of mechanical energy minus the work of the joints. Rolling contact does no work.",
       {}},
      {"momentum balance error",
       report.momentum_balance_error_n_s(),
       "N s",
       "",
       "Change of momentum minus the impulse of gravity and ground forces.",
       {}},
      {"KKT error", report.kkt_error(), "", "",
       "How far the solver is from a stationary point of the discretised problem (scaled).", bounds.kkt},
      {"constraint violation",
       report.constraint_violation(),
       "",
       "",
       "Largest violation of any constraint of the discretised problem (scaled).",
       {}},
  };
  lines.insert(lines.end(), balances.begin(), balances.end());
  if (solve.spec().ground_contact().touch_down() == v1::TOUCH_DOWN_PLASTIC) {
    const std::vector<AccuracyLine> impacts = ImpactLines(report);
    lines.insert(lines.end(), impacts.begin(), impacts.end());
  }
  return lines;
}

}  // namespace rollgait::client
