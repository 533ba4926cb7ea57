#ifndef ROLLGAIT_CORE_VALIDATION_REPORT_H_
#define ROLLGAIT_CORE_VALIDATION_REPORT_H_

#include <array>
#include <optional>
#include <vector>

#include "core/models/scene.h"
#include "core/trajectory/manoeuvre.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/criteria.h"

namespace rollgait {

// See rollgait.v1.AccuracyReport for the meaning of each field. The solver's own figures (KKT error) are not here.
struct AccuracyReport {
  double max_position_defect = 0;
  int max_position_defect_joint = 0;
  double max_position_defect_time = 0;
  double max_velocity_defect = 0;
  int max_velocity_defect_joint = 0;
  double max_velocity_defect_time = 0;
  double max_gap = 0;
  double max_slip = 0;
  double min_normal_force = 0;
  double max_friction_ratio = 0;
  double min_swing_clearance = 0;
  double periodicity_error = 0;
  double end_error = 0;
  double energy_balance_error = 0;
  double energy_balance_error_relative = 0;
  double momentum_balance_error = 0;
  double integrator_tolerance = 0;
  double jump_velocity_error = 0;
  double jump_impulse_error = 0;
  double min_jump_impulse = 0;
  double impact_loss = 0;

  // The largest measure of every criterion.
  std::array<Finding, kCriterionCount> findings;
  // For every interval in order of time, its own largest measures; 0 where a criterion judges the whole motion or an
  // impact.
  std::vector<CriterionValues> intervals;
  // Pairs of bodies (Scene::pairs) that overlap at some instant, at least half as deep as the deepest.
  std::vector<int> overlapping_pairs;
};

struct ValidationOptions {
  Vector3 gravity{0, 0, -9.81};         // m/s², world axes (fixed to the slope)
  double integrator_tolerance = 1e-10;  // relative and absolute
  int integrator_steps = 2000;          // of an interval, which takes one to ten; one that takes more is not integrated
  std::optional<Manoeuvre> manoeuvre;   // what a motion of Cycle::kOnce was asked to do
  double friction_coefficient = kInfinity;  // of the ground
  double min_normal_force = 0;              // N, of a contact that is on the ground
};

// Judges a trajectory of a scene by re-integration and dense sampling.
AccuracyReport Validate(const Scene& scene, const Trajectory& trajectory, const ValidationOptions& options);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_REPORT_H_
