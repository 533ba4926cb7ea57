#include "server/convert/result_convert.h"

#include "server/convert/gait_events_convert.h"
#include "server/convert/model_convert.h"
#include "server/convert/normative_convert.h"
#include "server/convert/scheme_convert.h"

namespace rollgait::server {
namespace {

v1::Termination EncodeTermination(Termination termination) {
  switch (termination) {
    case Termination::kOptimal:
      return v1::TERMINATION_OPTIMAL;
    case Termination::kAcceptable:
      return v1::TERMINATION_ACCEPTABLE;
    case Termination::kInfeasible:
      return v1::TERMINATION_INFEASIBLE;
    case Termination::kIterationLimit:
      return v1::TERMINATION_ITERATION_LIMIT;
    case Termination::kTimeLimit:
      return v1::TERMINATION_TIME_LIMIT;
    case Termination::kNumericalDifficulty:
      return v1::TERMINATION_NUMERICAL_DIFFICULTY;
    case Termination::kCancelled:
      return v1::TERMINATION_CANCELLED;
  }
  ROLLGAIT_CHECK(false);
}

v1::Verdict EncodeVerdict(Verdict::Kind kind) {
  switch (kind) {
    case Verdict::Kind::kNotJudged:
      return v1::VERDICT_NOT_JUDGED;
    case Verdict::Kind::kWithin:
      return v1::VERDICT_WITHIN;
    case Verdict::Kind::kExceeded:
      return v1::VERDICT_EXCEEDED;
  }
  ROLLGAIT_CHECK(false);
}

// One column per time becomes one row per time; column-major in, row-major out, so the numbers keep their order.
void EncodeTimes(const MatrixX& columns, v1::Matrix* matrix) {
  matrix->set_rows(static_cast<int>(columns.cols()));
  matrix->set_columns(static_cast<int>(columns.rows()));
  matrix->mutable_values()->Add(columns.data(), columns.data() + columns.size());
}

void EncodePhase(const TrajectoryPhase& phase, const Scene& scene, v1::TrajectoryPhase* encoded) {
  for (const int contact : phase.contacts) encoded->add_contacts(scene.contacts[contact].name);
  encoded->set_start_s(phase.start);
  encoded->set_duration_s(phase.duration);
  encoded->mutable_node_times_s()->Add(phase.node_times.begin(), phase.node_times.end());
  EncodeTimes(phase.node_positions, encoded->mutable_node_positions());
  EncodeTimes(phase.node_velocities, encoded->mutable_node_velocities());
  encoded->mutable_point_times_s()->Add(phase.point_times.begin(), phase.point_times.end());
  EncodeTimes(phase.point_positions, encoded->mutable_point_positions());
  EncodeTimes(phase.point_velocities, encoded->mutable_point_velocities());
  EncodeTimes(phase.point_accelerations, encoded->mutable_point_accelerations());
  EncodeTimes(phase.point_efforts, encoded->mutable_point_efforts());
  EncodeTimes(phase.point_forces, encoded->mutable_point_forces());
  encoded->mutable_impulses_n_s()->Add(phase.impulses.begin(), phase.impulses.end());
  encoded->set_impact_loss_j(phase.impact_loss);
}

// `bound` infinite: not judged.
void EncodeCriterion(const CriterionTraits& traits, const Finding& finding, double bound,
                     v1::CriterionResult* encoded) {
  encoded->set_criterion(traits.field);
  encoded->set_value(finding.value);
  if (bound != kInfinity) encoded->set_bound(bound);
  encoded->set_unit(traits.unit);
  encoded->set_meaning(traits.meaning);
  encoded->set_where(finding.where);
  encoded->set_phase(finding.phase);
  encoded->set_time_s(finding.time);
  encoded->set_exceeded(bound != kInfinity && !(finding.value <= bound));
}

v1::AccuracyReport EncodeAccuracy(const AccuracyReport& report, const GaitSolution& solution, const Model& model,
                                  const CriterionValues& bounds) {
  const auto joint_name = [&](int joint) {
    return joint >= 0 && joint < model.size() ? model.joint(joint).name : std::string();
  };
  v1::AccuracyReport encoded;
  encoded.set_max_position_defect(report.max_position_defect);
  encoded.set_max_position_defect_joint(joint_name(report.max_position_defect_joint));
  encoded.set_max_position_defect_time_s(report.max_position_defect_time);
  encoded.set_max_velocity_defect(report.max_velocity_defect);
  encoded.set_max_velocity_defect_joint(joint_name(report.max_velocity_defect_joint));
  encoded.set_max_velocity_defect_time_s(report.max_velocity_defect_time);
  encoded.set_max_gap_m(report.max_gap);
  encoded.set_max_slip_m_s(report.max_slip);
  encoded.set_min_normal_force_n(report.min_normal_force);
  encoded.set_max_friction_ratio(report.max_friction_ratio);
  encoded.set_min_swing_clearance_m(report.min_swing_clearance);
  encoded.set_periodicity_error(report.periodicity_error);
  encoded.set_end_error(report.end_error);
  encoded.set_energy_balance_error_j(report.energy_balance_error);
  encoded.set_energy_balance_error_relative(report.energy_balance_error_relative);
  encoded.set_momentum_balance_error_n_s(report.momentum_balance_error);
  encoded.set_jump_velocity_error(report.jump_velocity_error);
  encoded.set_jump_impulse_error_n_s(report.jump_impulse_error);
  encoded.set_min_jump_impulse_n_s(report.min_jump_impulse);
  encoded.set_impact_loss_j(report.impact_loss);
  encoded.set_integrator_tolerance(report.integrator_tolerance);
  encoded.set_kkt_error(solution.kkt_error);
  encoded.set_constraint_violation(solution.constraint_violation);
  encoded.set_within_requested_accuracy(solution.within_requested_accuracy());
  encoded.set_verdict(EncodeVerdict(solution.verdict.kind));
  for (const CriterionTraits& traits : Criteria()) {
    EncodeCriterion(traits, report.findings[static_cast<int>(traits.criterion)], bounds[traits.criterion],
                    encoded.add_criteria());
  }
  return encoded;
}

void EncodeCost(const CostValue& cost, v1::CostValue* encoded) {
  encoded->set_name(cost.name);
  encoded->set_weight(cost.weight);
  encoded->set_value(cost.value);
  encoded->set_unit(cost.unit);
  encoded->set_contribution(cost.contribution);
  encoded->set_unsmoothed_value(cost.unsmoothed);
}

void EncodeUnmet(const UnmetConstraint& unmet, v1::UnmetConstraint* encoded) {
  encoded->set_name(unmet.name);
  encoded->set_phase(unmet.phase);
  encoded->set_time_s(unmet.time);
  encoded->set_violation(unmet.violation);
  encoded->set_unit(unmet.unit);
}

v1::ProgramStart EncodeStart(StartOf start) {
  switch (start) {
    case StartOf::kGuess:
      return v1::PROGRAM_START_GUESS;
    case StartOf::kNeighbour:
      return v1::PROGRAM_START_NEIGHBOUR;
    case StartOf::kSmoother:
      return v1::PROGRAM_START_SMOOTHER;
    case StartOf::kOtherRequest:
      return v1::PROGRAM_START_OTHER_REQUEST;
    case StartOf::kFinerMesh:
      return v1::PROGRAM_START_COARSER_MESH;
    case StartOf::kImage:
      return v1::PROGRAM_START_MIRROR_IMAGE;
    case StartOf::kSameMesh:
      return v1::PROGRAM_START_SAME_MESH;
  }
  ROLLGAIT_CHECK(false);
}

void EncodeMesh(const MeshStatistics& mesh, v1::MeshStatistics* encoded) {
  encoded->set_start(EncodeStart(mesh.start));
  encoded->set_termination(EncodeTermination(mesh.termination));
  encoded->set_message(mesh.message);
  encoded->set_slope_rad(mesh.slope);
  encoded->set_kkt_tolerance(mesh.kkt_tolerance);
  encoded->set_half_cycle(mesh.cycle == Cycle::kHalf);
  encoded->set_sides_alike(mesh.has_sides_alike);
  encoded->set_added_torque_rates(mesh.has_added_rates);
  encoded->mutable_intervals()->Add(mesh.intervals.begin(), mesh.intervals.end());
  encoded->set_unknowns(mesh.unknowns);
  encoded->set_constraints(mesh.constraints);
  encoded->set_jacobian_nonzeros(mesh.jacobian_nonzeros);
  encoded->set_hessian_nonzeros(mesh.hessian_nonzeros);
  encoded->set_iterations(mesh.iterations);
  encoded->set_wall_time_s(mesh.wall_time);
  encoded->set_evaluation_time_s(mesh.evaluation_time);
  encoded->set_objective(mesh.objective);
  encoded->set_kkt_error(mesh.kkt_error);
  encoded->set_max_gap_m(mesh.max_gap);
  encoded->set_max_slip_m_s(mesh.max_slip);
  encoded->set_smoothing_w(mesh.smoothing);
  encoded->set_for_errors(mesh.for_errors);
}

v1::ErrorEstimate EncodeErrors(const ErrorEstimate& errors) {
  v1::ErrorEstimate encoded;
  encoded.set_objective(errors.objective);
  encoded.set_duration_s(errors.duration);
  encoded.mutable_phase_durations_s()->Add(errors.phase_durations.begin(), errors.phase_durations.end());
  encoded.set_speed_m_s(errors.speed);
  encoded.set_step_length_m(errors.step_length);
  for (const MotionQuantityTraits& traits : MotionQuantities()) {
    const QuantityDifference& difference = errors.motion[static_cast<int>(traits.quantity)];
    if (difference.where.empty()) continue;  // the model has none of these, or they agree
    v1::QuantityError& quantity = *encoded.add_quantities();
    quantity.set_quantity(traits.name);
    quantity.set_unit(traits.unit);
    quantity.set_largest(difference.largest);
    quantity.set_rms(difference.rms);
    quantity.set_peak(difference.peak);
    quantity.set_where(difference.where);
    quantity.set_phase(difference.phase);
    quantity.set_time_s(difference.time);
  }
  encoded.mutable_finer_intervals()->Add(errors.finer_intervals.begin(), errors.finer_intervals.end());
  if (errors.is_within_max_error) encoded.set_within_max_error(*errors.is_within_max_error);
  return encoded;
}

void EncodeAdded(const AddedConstraints& added, v1::Multipliers* multipliers) {
  for (const BoundedBetween& phase : added.between) {
    v1::Multipliers::BoundedBetween& encoded = *multipliers->add_between();
    encoded.mutable_range()->Add(phase.range.begin(), phase.range.end());
    encoded.mutable_velocity()->Add(phase.velocity.begin(), phase.velocity.end());
    encoded.mutable_effort()->Add(phase.effort.begin(), phase.effort.end());
    for (const FrictionEdge& edge : phase.friction) {
      v1::Multipliers::FrictionEdge& added_edge = *encoded.add_friction();
      added_edge.set_contact(edge.contact);
      added_edge.set_direction(edge.direction);
    }
  }
  multipliers->mutable_separated()->Add(added.separated.begin(), added.separated.end());
}

}  // namespace

v1::Cycle EncodeCycle(Cycle cycle) {
  switch (cycle) {
    case Cycle::kHalf:
      return v1::CYCLE_HALF;
    case Cycle::kFull:
      return v1::CYCLE_FULL;
    case Cycle::kOnce:
      return v1::CYCLE_ONCE;
  }
  ROLLGAIT_CHECK(false);
}

v1::Iteration EncodeIteration(const IterationInfo& iteration) {
  v1::Iteration encoded;
  encoded.set_index(iteration.index);
  encoded.set_objective(iteration.objective);
  encoded.set_primal_infeasibility(iteration.primal_infeasibility);
  encoded.set_dual_infeasibility(iteration.dual_infeasibility);
  encoded.set_barrier_parameter(iteration.barrier_parameter);
  encoded.set_step_norm(iteration.step_norm);
  encoded.set_regularization(iteration.regularization);
  encoded.set_primal_step(iteration.primal_step);
  encoded.set_dual_step(iteration.dual_step);
  encoded.set_line_search_trials(iteration.line_search_trials);
  encoded.set_restoration(iteration.restoration);
  encoded.set_elapsed_s(iteration.elapsed_s);
  encoded.set_mesh(iteration.mesh);
  return encoded;
}

v1::Trajectory EncodeTrajectory(const Trajectory& trajectory, const Scene& scene) {
  v1::Trajectory encoded;
  for (const Joint& joint : scene.model.joints()) {
    encoded.add_joint_names(joint.name);
    if (joint.actuated) encoded.add_actuated_joint_names(joint.name);
  }
  encoded.set_scheme(EncodeScheme(trajectory.scheme));
  encoded.set_points_per_interval(trajectory.points_per_interval);
  encoded.set_cycle(EncodeCycle(trajectory.cycle));
  encoded.set_duration_s(trajectory.duration);
  encoded.set_displacement_m(trajectory.displacement);
  for (const TrajectoryPhase& phase : trajectory.phases) EncodePhase(phase, scene, encoded.add_phases());
  return encoded;
}

v1::SolveResult EncodeResult(const GaitSolution& solution, const GaitSpec& spec) {
  const Scene& scene = solution.scene ? *solution.scene : spec.scene;
  v1::SolveResult result;
  result.set_termination(EncodeTermination(solution.termination));
  result.set_message(solution.message);
  if (solution.trajectory) *result.mutable_trajectory() = EncodeTrajectory(*solution.trajectory, scene);
  if (solution.multipliers) {
    const auto [rows, bounds] = *solution.multipliers;
    result.mutable_multipliers()->mutable_rows()->Add(rows.begin(), rows.end());
    result.mutable_multipliers()->mutable_bounds()->Add(bounds.begin(), bounds.end());
    EncodeAdded(solution.added, result.mutable_multipliers());
  }
  if (solution.accuracy) {
    *result.mutable_accuracy() = EncodeAccuracy(*solution.accuracy, solution, scene.model, spec.bounds);
  }
  if (solution.errors) *result.mutable_errors() = EncodeErrors(*solution.errors);
  if (solution.events) *result.mutable_gait_events() = EncodeGaitEvents(*solution.events, scene);
  if (solution.normative) *result.mutable_normative() = EncodeNormative(*solution.normative);
  if (solution.normative_left) *result.mutable_normative_left() = EncodeNormative(*solution.normative_left);
  result.set_objective(solution.objective);
  for (const CostValue& cost : solution.costs) EncodeCost(cost, result.add_costs());
  for (const UnmetConstraint& unmet : solution.unmet_constraints) EncodeUnmet(unmet, result.add_unmet_constraints());
  for (const MeshStatistics& mesh : solution.meshes) EncodeMesh(mesh, result.add_meshes());
  result.set_speed_m_s(solution.speed);
  result.set_step_length_m(solution.step_length);
  result.set_wall_time_s(solution.wall_time);
  *result.mutable_model() = EncodeModel(scene, spec.gravity.norm(), JointForm::kChains);
  return result;
}

}  // namespace rollgait::server
