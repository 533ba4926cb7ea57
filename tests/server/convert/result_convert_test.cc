#include "server/convert/result_convert.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rollgait::server {
namespace {

GaitSpec Planar() {
  GaitRequest request;
  request.body.model = "planar";
  request.slope = 0.2;
  return CheckRequest(request).value();
}

MatrixX Numbered(int rows, int columns, double first) {
  MatrixX matrix(rows, columns);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) matrix(i, j) = first + 100 * i + j;
  }
  return matrix;
}

// One phase of two intervals with two points each; every number differs.
TrajectoryPhase Phase() {
  TrajectoryPhase phase;
  phase.contacts = {1, 0};
  phase.start = 0.25;
  phase.duration = 0.5;
  phase.node_times = {0.25, 0.5, 0.75};
  phase.node_positions = Numbered(9, 3, 1000);
  phase.node_velocities = Numbered(9, 3, 2000);
  phase.point_times = {0.3, 0.5, 0.6, 0.75};
  phase.point_positions = Numbered(9, 4, 3000);
  phase.point_velocities = Numbered(9, 4, 4000);
  phase.point_accelerations = Numbered(9, 4, 5000);
  phase.point_efforts = Numbered(6, 4, 6000);
  phase.point_forces = Numbered(6, 4, 7000);
  phase.impulses = VectorX::LinSpaced(6, 8000, 8005);
  phase.impact_loss = 9000;
  return phase;
}

void ExpectRowsAreTimes(const v1::Matrix& matrix, const MatrixX& columns_are_times) {
  ASSERT_EQ(matrix.rows(), columns_are_times.cols());
  ASSERT_EQ(matrix.columns(), columns_are_times.rows());
  ASSERT_EQ(matrix.values_size(), columns_are_times.size());
  for (int row = 0; row < matrix.rows(); ++row) {
    for (int column = 0; column < matrix.columns(); ++column) {
      ASSERT_EQ(matrix.values(row * matrix.columns() + column), columns_are_times(column, row));
    }
  }
}

TEST(EncodeTrajectory, RowsAreTimesAndColumnsAreJoints) {
  const GaitSpec spec = Planar();
  Trajectory trajectory;
  trajectory.scheme = Scheme::kRadau3;
  trajectory.points_per_interval = 2;
  trajectory.cycle = Cycle::kFull;
  trajectory.duration = 1.1;
  trajectory.displacement = 1.4;
  trajectory.phases = {Phase()};
  const v1::Trajectory encoded = EncodeTrajectory(trajectory, spec.scene);
  EXPECT_EQ(encoded.joint_names_size(), 9);
  EXPECT_EQ(encoded.joint_names(0), "base_x");
  EXPECT_EQ(encoded.actuated_joint_names_size(), 6);
  EXPECT_EQ(encoded.scheme(), v1::Discretization::SCHEME_RADAU3);
  EXPECT_EQ(encoded.points_per_interval(), 2);
  EXPECT_EQ(encoded.cycle(), v1::CYCLE_FULL);
  EXPECT_EQ(encoded.duration_s(), 1.1);
  EXPECT_EQ(encoded.displacement_m(), 1.4);
  ASSERT_EQ(encoded.phases_size(), 1);
  const v1::TrajectoryPhase& phase = encoded.phases(0);
  EXPECT_EQ(phase.contacts(0), "right_foot");
  EXPECT_EQ(phase.contacts(1), "left_foot");
  EXPECT_EQ(phase.start_s(), 0.25);
  EXPECT_EQ(phase.duration_s(), 0.5);
  EXPECT_EQ(phase.node_times_s(2), 0.75);
  EXPECT_EQ(phase.point_times_s(2), 0.6);
  ExpectRowsAreTimes(phase.node_positions(), trajectory.phases[0].node_positions);
  ExpectRowsAreTimes(phase.node_velocities(), trajectory.phases[0].node_velocities);
  ExpectRowsAreTimes(phase.point_positions(), trajectory.phases[0].point_positions);
  ExpectRowsAreTimes(phase.point_velocities(), trajectory.phases[0].point_velocities);
  ExpectRowsAreTimes(phase.point_accelerations(), trajectory.phases[0].point_accelerations);
  ExpectRowsAreTimes(phase.point_efforts(), trajectory.phases[0].point_efforts);
  ExpectRowsAreTimes(phase.point_forces(), trajectory.phases[0].point_forces);
  ASSERT_EQ(phase.impulses_n_s_size(), 6);
  EXPECT_EQ(phase.impulses_n_s(1), 8001);
  EXPECT_EQ(phase.impact_loss_j(), 9000);
}

GaitSolution Solution() {
  GaitSolution solution;
  solution.termination = Termination::kInfeasible;
  solution.message = "no way";
  solution.trajectory.emplace();
  solution.accuracy.emplace();
  solution.accuracy->max_position_defect = 1;
  solution.accuracy->max_position_defect_joint = 4;
  solution.accuracy->max_velocity_defect = 2;
  solution.accuracy->max_velocity_defect_joint = 99;
  solution.accuracy->max_gap = 3;
  solution.accuracy->max_slip = 4;
  solution.accuracy->min_normal_force = 5;
  solution.accuracy->max_friction_ratio = 6;
  solution.accuracy->min_swing_clearance = 7;
  solution.accuracy->periodicity_error = 8;
  solution.accuracy->energy_balance_error = 9;
  solution.accuracy->energy_balance_error_relative = 10;
  solution.accuracy->momentum_balance_error = 11;
  solution.accuracy->integrator_tolerance = 12;
  solution.accuracy->jump_velocity_error = 41;
  solution.accuracy->jump_impulse_error = 42;
  solution.accuracy->min_jump_impulse = 43;
  solution.accuracy->impact_loss = 44;
  solution.verdict.kind = Verdict::Kind::kWithin;
  solution.kkt_error = 13;
  solution.constraint_violation = 14;
  solution.objective = 15;
  solution.costs = {{"time", 16, 17, "s", 18, 35}};
  solution.unmet_constraints = {{"speed", 1, 19, 20, "m/s"}};
  solution.meshes = {{.start = StartOf::kImage,
                      .slope = 37,
                      .kkt_tolerance = 38,
                      .cycle = Cycle::kHalf,
                      .has_sides_alike = true,
                      .has_added_rates = true,
                      .termination = Termination::kTimeLimit,
                      .message = "why",
                      .intervals = {8, 16},
                      .unknowns = 21,
                      .constraints = 22,
                      .jacobian_nonzeros = 23,
                      .hessian_nonzeros = 24,
                      .iterations = 25,
                      .wall_time = 26,
                      .evaluation_time = 27,
                      .objective = 28,
                      .kkt_error = 29,
                      .max_gap = 30,
                      .max_slip = 31,
                      .smoothing = 36}};
  solution.speed = 32;
  solution.step_length = 33;
  solution.wall_time = 34;
  return solution;
}

TEST(EncodeResult, EveryFigureArrives) {
  const GaitSpec spec = Planar();
  const v1::SolveResult result = EncodeResult(Solution(), spec);
  EXPECT_EQ(result.termination(), v1::TERMINATION_INFEASIBLE);
  EXPECT_EQ(result.message(), "no way");
  EXPECT_TRUE(result.has_trajectory());
  const v1::AccuracyReport& accuracy = result.accuracy();
  EXPECT_EQ(accuracy.max_position_defect(), 1);
  EXPECT_EQ(accuracy.max_position_defect_joint(), spec.scene.model.joint(4).name);
  EXPECT_EQ(accuracy.max_velocity_defect(), 2);
  EXPECT_EQ(accuracy.max_velocity_defect_joint(), "") << "no such joint";
  EXPECT_EQ(accuracy.max_gap_m(), 3);
  EXPECT_EQ(accuracy.max_slip_m_s(), 4);
  EXPECT_EQ(accuracy.min_normal_force_n(), 5);
  EXPECT_EQ(accuracy.max_friction_ratio(), 6);
  EXPECT_EQ(accuracy.min_swing_clearance_m(), 7);
  EXPECT_EQ(accuracy.periodicity_error(), 8);
  EXPECT_EQ(accuracy.energy_balance_error_j(), 9);
  EXPECT_EQ(accuracy.energy_balance_error_relative(), 10);
  EXPECT_EQ(accuracy.momentum_balance_error_n_s(), 11);
  EXPECT_EQ(accuracy.integrator_tolerance(), 12);
  EXPECT_EQ(accuracy.jump_velocity_error(), 41);
  EXPECT_EQ(accuracy.jump_impulse_error_n_s(), 42);
  EXPECT_EQ(accuracy.min_jump_impulse_n_s(), 43);
  EXPECT_EQ(accuracy.impact_loss_j(), 44);
  EXPECT_TRUE(accuracy.within_requested_accuracy());
  EXPECT_EQ(accuracy.kkt_error(), 13);
  EXPECT_EQ(accuracy.constraint_violation(), 14);
  EXPECT_EQ(result.objective(), 15);
  EXPECT_EQ(result.costs(0).name(), "time");
  EXPECT_EQ(result.costs(0).weight(), 16);
  EXPECT_EQ(result.costs(0).value(), 17);
  EXPECT_EQ(result.costs(0).unit(), "s");
  EXPECT_EQ(result.costs(0).contribution(), 18);
  EXPECT_EQ(result.costs(0).unsmoothed_value(), 35);
  EXPECT_EQ(result.unmet_constraints(0).name(), "speed");
  EXPECT_EQ(result.unmet_constraints(0).phase(), 1);
  EXPECT_EQ(result.unmet_constraints(0).time_s(), 19);
  EXPECT_EQ(result.unmet_constraints(0).violation(), 20);
  EXPECT_EQ(result.speed_m_s(), 32);
  EXPECT_EQ(result.step_length_m(), 33);
  EXPECT_EQ(result.wall_time_s(), 34);
  EXPECT_EQ(result.model().joints_size(), spec.scene.model.size());
  EXPECT_NEAR(result.model().gravity_m_s2(), 9.81, 1e-14) << "magnitude of the turned vector, rounding";
}

TEST(EncodeResult, EitherLegArrivesInItsOwnField) {
  GaitSolution solution = Solution();
  solution.normative.emplace().cadence = 111;
  EXPECT_FALSE(EncodeResult(solution, Planar()).has_normative_left());
  solution.normative_left.emplace().cadence = 113;
  const v1::SolveResult result = EncodeResult(solution, Planar());
  EXPECT_EQ(result.normative().cadence_per_min(), 111);
  EXPECT_EQ(result.normative_left().cadence_per_min(), 113);
}

TEST(EncodeResult, TheVerdictArrives) {
  const auto encoded = [](Verdict::Kind kind) {
    GaitSolution solution = Solution();
    solution.verdict.kind = kind;
    return EncodeResult(solution, Planar()).accuracy();
  };
  EXPECT_EQ(encoded(Verdict::Kind::kNotJudged).verdict(), v1::VERDICT_NOT_JUDGED);
  EXPECT_EQ(encoded(Verdict::Kind::kWithin).verdict(), v1::VERDICT_WITHIN);
  EXPECT_EQ(encoded(Verdict::Kind::kExceeded).verdict(), v1::VERDICT_EXCEEDED);
  EXPECT_FALSE(encoded(Verdict::Kind::kNotJudged).within_requested_accuracy());
  EXPECT_TRUE(encoded(Verdict::Kind::kWithin).within_requested_accuracy());
  EXPECT_FALSE(encoded(Verdict::Kind::kExceeded).within_requested_accuracy());
}

// One bound is left out and one measure is not a number; every number differs.
TEST(EncodeResult, EveryCriterionArrives) {
  GaitSpec spec = Planar();
  GaitSolution solution = Solution();
  for (int i = 0; i < kCriterionCount; ++i) {
    solution.accuracy->findings[i] = {100 + i + 0.5, "place " + std::to_string(i), 200 + i, 300.0 + i};
    spec.bounds[static_cast<Criterion>(i)] = i % 2 == 0 ? 100 + i : 101 + i;
  }
  spec.bounds[Criterion::kOverlap] = kInfinity;
  solution.accuracy->findings[static_cast<int>(Criterion::kFriction)].value = std::nan("");
  const v1::AccuracyReport accuracy = EncodeResult(solution, spec).accuracy();
  ASSERT_EQ(accuracy.criteria_size(), kCriterionCount);
  for (int i = 0; i < kCriterionCount; ++i) {
    const CriterionTraits& traits = Criteria()[i];
    const v1::CriterionResult& result = accuracy.criteria(i);
    EXPECT_EQ(result.criterion(), traits.field);
    EXPECT_EQ(result.unit(), traits.unit);
    EXPECT_EQ(result.meaning(), traits.meaning);
    EXPECT_EQ(result.where(), "place " + std::to_string(i));
    EXPECT_EQ(result.phase(), 200 + i);
    EXPECT_EQ(result.time_s(), 300 + i);
    if (traits.criterion == Criterion::kFriction) {
      EXPECT_TRUE(std::isnan(result.value()));
      EXPECT_TRUE(result.exceeded()) << "what is not a number exceeds every bound";
      continue;
    }
    EXPECT_EQ(result.value(), 100 + i + 0.5);
    EXPECT_EQ(result.has_bound(), traits.criterion != Criterion::kOverlap);
    EXPECT_EQ(result.bound(), !result.has_bound() ? 0 : i % 2 == 0 ? 100 + i : 101 + i);
    EXPECT_EQ(result.exceeded(), result.has_bound() && i % 2 == 0) << traits.field;
  }
}

TEST(EncodeResult, EstimatedErrorsArrive) {
  GaitSolution solution;
  EXPECT_FALSE(EncodeResult(solution, Planar()).has_errors());
  ErrorEstimate& errors = solution.errors.emplace();
  errors.objective = 0.1;
  errors.duration = 0.2;
  errors.phase_durations = {0.3, 0.4};
  errors.speed = 0.5;
  errors.step_length = 0.6;
  errors.finer_intervals = {12, 24};
  QuantityDifference& torque = errors.motion[static_cast<int>(MotionQuantity::kTorque)];
  torque = {.largest = 7, .rms = 8, .peak = 9, .where = "knee_l", .phase = 1, .time = 0.25};
  const v1::ErrorEstimate encoded = EncodeResult(solution, Planar()).errors();
  EXPECT_EQ(encoded.objective(), 0.1);
  EXPECT_EQ(encoded.duration_s(), 0.2);
  EXPECT_EQ(encoded.phase_durations_s(1), 0.4);
  EXPECT_EQ(encoded.speed_m_s(), 0.5);
  EXPECT_EQ(encoded.step_length_m(), 0.6);
  EXPECT_EQ(encoded.finer_intervals(1), 24);
  EXPECT_FALSE(encoded.has_within_max_error());
  ASSERT_EQ(encoded.quantities_size(), 1);
  EXPECT_EQ(encoded.quantities(0).quantity(), "joint torque");
  EXPECT_EQ(encoded.quantities(0).unit(), "N m");
  EXPECT_EQ(encoded.quantities(0).largest(), 7);
  EXPECT_EQ(encoded.quantities(0).rms(), 8);
  EXPECT_EQ(encoded.quantities(0).peak(), 9);
  EXPECT_EQ(encoded.quantities(0).where(), "knee_l");
  EXPECT_EQ(encoded.quantities(0).phase(), 1);
  EXPECT_EQ(encoded.quantities(0).time_s(), 0.25);
  errors.is_within_max_error = false;
  EXPECT_TRUE(EncodeResult(solution, Planar()).errors().has_within_max_error());
}

TEST(EncodeResult, MeshStatisticsArrive) {
  const v1::SolveResult result = EncodeResult(Solution(), Planar());
  ASSERT_EQ(result.meshes_size(), 1);
  const v1::MeshStatistics& mesh = result.meshes(0);
  EXPECT_EQ(mesh.start(), v1::PROGRAM_START_MIRROR_IMAGE);
  EXPECT_EQ(mesh.slope_rad(), 37);
  EXPECT_EQ(mesh.kkt_tolerance(), 38);
  EXPECT_TRUE(mesh.half_cycle() && mesh.sides_alike() && mesh.added_torque_rates());
  EXPECT_EQ(mesh.termination(), v1::TERMINATION_TIME_LIMIT);
  EXPECT_EQ(mesh.message(), "why");
  EXPECT_EQ(mesh.intervals(1), 16);
  EXPECT_EQ(mesh.unknowns(), 21);
  EXPECT_EQ(mesh.constraints(), 22);
  EXPECT_EQ(mesh.jacobian_nonzeros(), 23);
  EXPECT_EQ(mesh.hessian_nonzeros(), 24);
  EXPECT_EQ(mesh.iterations(), 25);
  EXPECT_EQ(mesh.wall_time_s(), 26);
  EXPECT_EQ(mesh.evaluation_time_s(), 27);
  EXPECT_EQ(mesh.objective(), 28);
  EXPECT_EQ(mesh.kkt_error(), 29);
  EXPECT_EQ(mesh.max_gap_m(), 30);
  EXPECT_EQ(mesh.max_slip_m_s(), 31);
  EXPECT_EQ(mesh.smoothing_w(), 36);
}

TEST(EncodeResult, WithoutATrajectoryThereIsNone) {
  GaitSolution solution;
  solution.termination = Termination::kNumericalDifficulty;
  const v1::SolveResult result = EncodeResult(solution, Planar());
  EXPECT_EQ(result.termination(), v1::TERMINATION_NUMERICAL_DIFFICULTY);
  EXPECT_FALSE(result.has_trajectory());
  EXPECT_FALSE(result.has_accuracy());
}

TEST(EncodeIteration, EveryFigureArrives) {
  const v1::Iteration iteration = EncodeIteration({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, true, 11, 12});
  EXPECT_EQ(iteration.index(), 1);
  EXPECT_EQ(iteration.objective(), 2);
  EXPECT_EQ(iteration.primal_infeasibility(), 3);
  EXPECT_EQ(iteration.dual_infeasibility(), 4);
  EXPECT_EQ(iteration.barrier_parameter(), 5);
  EXPECT_EQ(iteration.step_norm(), 6);
  EXPECT_EQ(iteration.regularization(), 7);
  EXPECT_EQ(iteration.primal_step(), 8);
  EXPECT_EQ(iteration.dual_step(), 9);
  EXPECT_EQ(iteration.line_search_trials(), 10);
  EXPECT_TRUE(iteration.restoration());
  EXPECT_EQ(iteration.elapsed_s(), 11);
  EXPECT_EQ(iteration.mesh(), 12);
}

}  // namespace
}  // namespace rollgait::server
