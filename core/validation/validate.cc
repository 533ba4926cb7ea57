#include <algorithm>

#include "core/base/check.h"
#include "core/multibody/body_dynamics.h"
#include "core/validation/contact_residuals.h"
#include "core/validation/findings.h"
#include "core/validation/joint_limits.h"
#include "core/validation/jumps.h"
#include "core/validation/overlap.h"
#include "core/validation/report.h"
#include "core/validation/residuals.h"
#include "core/validation/resimulation.h"

namespace rollgait {
namespace {

void CheckShapes(const Scene& scene, const Trajectory& trajectory) {
  const int n = scene.model.size();
  const int s = trajectory.points_per_interval;
  ROLLGAIT_CHECK(!trajectory.phases.empty() && s >= 1);
  ROLLGAIT_CHECK(static_cast<int>(trajectory.point_fractions.size()) == s);
  for (const TrajectoryPhase& phase : trajectory.phases) {
    const int nodes = static_cast<int>(phase.node_times.size());
    ROLLGAIT_CHECK(nodes >= 2);
    ROLLGAIT_CHECK(phase.node_positions.rows() == n && phase.node_positions.cols() == nodes);
    ROLLGAIT_CHECK(phase.node_velocities.rows() == n && phase.node_velocities.cols() == nodes);
    ROLLGAIT_CHECK(phase.point_accelerations.rows() == n && phase.point_accelerations.cols() == (nodes - 1) * s);
    ROLLGAIT_CHECK(phase.point_efforts.rows() == static_cast<int>(scene.model.actuated().size()));
    ROLLGAIT_CHECK(phase.point_forces.rows() == 3 * static_cast<int>(phase.contacts.size()));
    ROLLGAIT_CHECK(phase.impulses.size() == 0 || phase.impulses.size() == phase.point_forces.rows());
    for (int k = 0; k + 1 < nodes; ++k) ROLLGAIT_CHECK(phase.node_times[k] < phase.node_times[k + 1]);
    for (int c : phase.contacts) ROLLGAIT_CHECK(c >= 0 && c < static_cast<int>(scene.contacts.size()));
  }
}

}  // namespace

AccuracyReport Validate(const Scene& scene, const Trajectory& trajectory, const ValidationOptions& options) {
  CheckShapes(scene, trajectory);
  const BodyDynamics dynamics(scene.model);
  int intervals = 0;
  for (const TrajectoryPhase& phase : trajectory.phases) intervals += static_cast<int>(phase.node_times.size()) - 1;
  FindingLog log(intervals);
  const double weight = dynamics.total_mass() * options.gravity.norm();
  const ForceBounds bounds{options.friction_coefficient, options.min_normal_force};
  ForceExtremes forces(weight);
  const Resimulation motion = Resimulate(scene, dynamics, trajectory, options.gravity, options.integrator_tolerance,
                                         options.integrator_steps, bounds, &forces, &log);
  const ContactResiduals contacts = MeasureContacts(scene, dynamics, trajectory, bounds, &forces, &log);
  const BalanceErrors balance = MeasureBalances(dynamics, scene.model, trajectory, options.gravity, &log);
  MeasureJointLimits(scene.model, trajectory, &log);
  const OverlapFindings overlap = MeasureOverlap(scene, dynamics, trajectory);
  log.Raise(Criterion::kOverlap, overlap.worst.value, overlap.worst.where, {overlap.worst.phase, overlap.worst.time});
  for (int k = 0; k < intervals; ++k)
    log.RaiseInterval(Criterion::kOverlap, overlap.intervals[static_cast<size_t>(k)], k);

  // Impulses as forces of a tenth of a second.
  ForceExtremes impulses(0.1 * weight);
  const JumpErrors jumps = MeasureJumps(scene, dynamics, trajectory, options.friction_coefficient, &impulses, &log);
  MeasureApproach(scene, dynamics, trajectory, &log);

  AccuracyReport report;
  report.max_position_defect = motion.position.value;
  report.max_position_defect_joint = motion.position.joint;
  report.max_position_defect_time = motion.position.time;
  report.max_velocity_defect = motion.velocity.value;
  report.max_velocity_defect_joint = motion.velocity.joint;
  report.max_velocity_defect_time = motion.velocity.time;
  report.max_gap = contacts.max_gap;
  report.max_slip = contacts.max_slip;
  report.min_normal_force = forces.min_normal();
  report.max_friction_ratio = std::max(forces.max_friction_ratio(), impulses.max_friction_ratio());
  report.min_swing_clearance = contacts.min_swing_clearance;
  report.periodicity_error = PeriodicityError(scene.model, trajectory, &log);
  if (options.manoeuvre) {
    // What a manoeuvre prescribes at its ends stands in the place of periodicity.
    report.end_error = EndError(scene, dynamics, trajectory, *options.manoeuvre);
    const int last = static_cast<int>(trajectory.phases.size()) - 1;
    log.Raise(Criterion::kPeriodicity, report.end_error, "ends of the manoeuvre", {last, trajectory.duration});
  }
  report.energy_balance_error = balance.energy;
  report.energy_balance_error_relative = balance.energy_relative;
  report.momentum_balance_error = balance.momentum;
  report.jump_velocity_error = jumps.velocity;
  report.jump_impulse_error = jumps.impulse;
  report.min_jump_impulse = impulses.min_normal();
  report.impact_loss = jumps.loss;
  report.overlapping_pairs = overlap.Deeper(overlap.worst.value / 2);
  report.integrator_tolerance = options.integrator_tolerance;
  report.findings = log.findings();
  report.intervals = log.intervals();
  return report;
}

}  // namespace rollgait
