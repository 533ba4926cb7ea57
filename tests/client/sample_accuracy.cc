#include "tests/client/sample_accuracy.h"

namespace rollgait::client {
namespace {

void AddCriterion(v1::AccuracyReport& accuracy, const char* name, const char* meaning, const char* unit, double value,
                  double bound, const char* where) {
  v1::CriterionResult& criterion = *accuracy.add_criteria();
  criterion.set_criterion(name);
  criterion.set_meaning(meaning);
  criterion.set_unit(unit);
  criterion.set_value(value);
  criterion.set_bound(bound);
  criterion.set_where(where);
  criterion.set_phase(1);
  criterion.set_time_s(0.31);
  criterion.set_exceeded(value > bound);
}

}  // namespace

v1::AccuracyReport SampleAccuracy() {
  v1::AccuracyReport accuracy;
  accuracy.set_max_position_defect(2.1e-6);
  accuracy.set_max_position_defect_joint("knee_l");
  accuracy.set_max_position_defect_time_s(0.31);
  accuracy.set_max_velocity_defect(8.4e-5);
  accuracy.set_max_velocity_defect_joint("ankle_l");
  accuracy.set_max_velocity_defect_time_s(0.12);
  accuracy.set_max_gap_m(3.2e-5);
  accuracy.set_max_slip_m_s(4.1e-4);
  accuracy.set_min_normal_force_n(11.2);
  accuracy.set_max_friction_ratio(0.31);
  accuracy.set_min_swing_clearance_m(0);
  accuracy.set_periodicity_error(1.3e-12);
  accuracy.set_energy_balance_error_j(2.4e-3);
  accuracy.set_energy_balance_error_relative(6.1e-5);
  accuracy.set_momentum_balance_error_n_s(1.1e-4);
  accuracy.set_kkt_error(4.4e-8);
  accuracy.set_constraint_violation(3.0e-11);
  accuracy.set_integrator_tolerance(1e-10);
  accuracy.set_within_requested_accuracy(true);
  accuracy.set_verdict(v1::VERDICT_WITHIN);
  AddCriterion(accuracy, "max_gap_m", "gap of a contact that rolls", "m", 3.2e-5, 1e-4, "left_foot");
  AddCriterion(accuracy, "max_slip_m_s", "slip of a contact that rolls", "m/s", 4.1e-4, 1e-3, "left_foot");
  AddCriterion(accuracy, "max_position_defect", "difference of positions after re-integration of an interval",
               "rad or m", 2.1e-6, 5e-3, "knee_l");
  AddCriterion(accuracy, "max_range_excess", "joint past its range", "rad or m", 1.1e-4, 8.7266e-4, "knee_l");
  AddCriterion(accuracy, "max_pull_bw", "normal force below its least value, over body weight", "1", 2e-4, 1e-3,
               "right_foot");
  return accuracy;
}

void Exceed(v1::Solve& solve, const std::string& criterion, double factor) {
  v1::AccuracyReport& accuracy = *solve.mutable_result()->mutable_accuracy();
  for (v1::CriterionResult& result : *accuracy.mutable_criteria()) {
    if (result.criterion() != criterion) continue;
    result.set_value(factor * result.bound());
    result.set_exceeded(true);
  }
  accuracy.set_within_requested_accuracy(false);
  accuracy.set_verdict(v1::VERDICT_EXCEEDED);
  solve.mutable_outcome()->set_verdict(v1::VERDICT_EXCEEDED);
}

}  // namespace rollgait::client
