// A body of another mass, and another planet at the same Froude number: the same gait, in another time.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "core/gait/default_speed.h"
#include "core/gait/optimizing_gait_solver.h"
#include "core/gait/own_units.h"

namespace rollgait {
namespace {

struct Solved {
  GaitSpec spec;
  GaitSolution solution;
};

GaitSpec Spec(Preset preset, double slope, double mass, double gravity, const char* model = "planar") {
  GaitRequest request;
  request.body.model = model;
  request.body.mass = mass;
  request.gravity = gravity;
  request.preset = preset;
  request.slope = slope;
  request.starts = 1;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.discretization.single_support_intervals = 12;
  return CheckRequest(request).value();
}

Solved Walk(GaitSpec spec) {
  GaitSolution solution = OptimizingGaitSolver().Solve(spec, SolveControl());
  EXPECT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  return {std::move(spec), std::move(solution)};
}

int Iterations(const GaitSolution& solution) {
  int sum = 0;
  for (const MeshStatistics& mesh : solution.meshes) sum += mesh.iterations;
  return sum;
}

// The second walk is the first one with time in units of `time` and forces in units of `force`; relative errors.
void ExpectSimilar(const Solved& a, const Solved& b, double time, double force, double tolerance) {
  const auto near = [tolerance](const MatrixX& x, const MatrixX& y) {
    return (x - y).cwiseAbs().maxCoeff() <= tolerance * std::max(1.0, x.cwiseAbs().maxCoeff());
  };
  ASSERT_TRUE(a.solution.trajectory && b.solution.trajectory);
  const Trajectory &first = *a.solution.trajectory, &second = *b.solution.trajectory;
  EXPECT_NEAR(second.displacement, first.displacement, tolerance);
  ASSERT_EQ(first.phases.size(), second.phases.size());
  for (size_t p = 0; p < first.phases.size(); ++p) {
    const TrajectoryPhase &x = first.phases[p], &y = second.phases[p];
    EXPECT_NEAR(y.duration / time, x.duration, tolerance);
    ASSERT_EQ(x.node_positions.cols(), y.node_positions.cols());
    EXPECT_TRUE(near(x.node_positions, y.node_positions))
        << (x.node_positions - y.node_positions).cwiseAbs().maxCoeff();
    EXPECT_TRUE(near(x.node_velocities, time * y.node_velocities));
    EXPECT_TRUE(near(x.point_efforts, y.point_efforts / force));
    EXPECT_TRUE(near(x.point_forces, y.point_forces / force));
  }
}

class ScalingTest : public ::testing::TestWithParam<std::tuple<Preset, double>> {};

// Same stature, half and double the mass: inertias, strengths and passive torques follow it, and with them the
// iterations, since a factor of two is exact in binary.
TEST_P(ScalingTest, MassChangesForcesOnly) {
  const auto [preset, slope] = GetParam();
  const Solved one = Walk(Spec(preset, slope, 75, 9.81));
  for (const double mass : {37.5, 150.0}) {
    const Solved other = Walk(Spec(preset, slope, mass, 9.81));
    const double factor = mass / 75, power = preset == Preset::kTorque ? factor * factor : 1;
    EXPECT_NEAR(other.solution.objective / power, one.solution.objective, 1e-6 * one.solution.objective) << mass;
    EXPECT_EQ(Iterations(other.solution), Iterations(one.solution)) << mass;
    ExpectSimilar(one, other, 1, factor, 1e-6);
  }
}

// The speed that is not given is that of the same Froude number. From the guess: the solver sees the same numbers, so
// that presets with minima side by side, `transport` most of all, end in the same one.
TEST_P(ScalingTest, AnotherPlanetAndMassChangeTimeAndForces) {
  const auto [preset, slope] = GetParam();
  const Solved earth = Walk(Spec(preset, slope, 75, 9.81));
  for (const auto& [mass, gravity] : {std::pair{75.0, 1.62}, {75.0, 3.71}, {75.0, 14.0}, {62.0, 9.81}, {90.0, 3.71}}) {
    const Solved planet = Walk(Spec(preset, slope, mass, gravity));
    const double factor = gravity / 9.81, heavier = mass / 75;
    EXPECT_NEAR(planet.solution.speed, 1.3 * std::sqrt(factor), 1e-6);
    EXPECT_EQ(Iterations(planet.solution), Iterations(earth.solution)) << gravity;
    const double power = preset == Preset::kTorque ? heavier * heavier * std::pow(factor, 1.5) : 1;  // torque² · time
    EXPECT_NEAR(planet.solution.objective / power, earth.solution.objective, 1e-6 * earth.solution.objective)
        << gravity;
    ExpectSimilar(earth, planet, 1 / std::sqrt(factor), heavier * factor, 1e-6);
  }
}

class ScalingInSpaceTest : public ScalingTest {};

TEST_P(ScalingInSpaceTest, MassAndGravityChangeTimeAndForces) {
  const auto [preset, slope] = GetParam();
  const Solved earth = Walk(Spec(preset, slope, 75, 9.81, "human29"));
  for (const auto& [mass, gravity] : {std::pair{75.0, 1.62}, {62.0, 14.0}}) {
    const Solved planet = Walk(Spec(preset, slope, mass, gravity, "human29"));
    const double factor = gravity / 9.81, heavier = mass / 75;
    const double power = preset == Preset::kTorque ? heavier * heavier * std::pow(factor, 1.5) : 1;
    EXPECT_NEAR(planet.solution.objective / power, earth.solution.objective, 1e-6 * earth.solution.objective)
        << gravity;
    EXPECT_EQ(Iterations(planet.solution), Iterations(earth.solution)) << gravity;
    ExpectSimilar(earth, planet, 1 / std::sqrt(factor), heavier * factor, 1e-6);
  }
}

// Bounds of a level follow lower gravity, so meshes are refined alike; higher gravity does not make a level laxer.
TEST_P(ScalingTest, SoDoTheyAtStandardAccuracy) {
  const auto [preset, slope] = GetParam();
  const auto spec = [preset = preset, slope = slope](double mass, double gravity) {
    GaitRequest request;
    request.body.model = "planar";
    request.body.mass = mass;
    request.gravity = gravity;
    request.preset = preset;
    request.slope = slope;
    return CheckRequest(request).value();
  };
  const Solved earth = Walk(spec(75, 9.81));
  EXPECT_GT(earth.solution.meshes.size(), 1u);
  for (const auto& [mass, gravity] : {std::pair{50.0, 9.81}, {75.0, 1.62}, {110.0, 3.71}}) {
    const Solved planet = Walk(spec(mass, gravity));
    const double factor = gravity / 9.81;
    EXPECT_NEAR(planet.spec.bounds[Criterion::kSlip], 1e-3 * std::sqrt(factor), 1e-15);
    EXPECT_EQ(planet.solution.verdict.kind, Verdict::Kind::kWithin);
    EXPECT_EQ(Iterations(planet.solution), Iterations(earth.solution)) << gravity;
    ExpectSimilar(earth, planet, 1 / std::sqrt(factor), mass / 75 * factor, 1e-6);
  }
  EXPECT_EQ(spec(75, 14).bounds[Criterion::kSlip], 1e-3);
}

// With any preset, mass and gravity the scaled solution is a solution: started from there the solver stays.
TEST_P(ScalingTest, ScaledSolutionsAreSolutions) {
  const auto [preset, slope] = GetParam();
  const Solved earth = Walk(Spec(preset, slope, 75, 9.81));
  for (const auto& [mass, gravity] : {std::pair{75.0, 1.62}, {75.0, 14.0}, {62.0, 3.71}, {20.0, 9.81}}) {
    GaitSpec spec = Spec(preset, slope, mass, gravity);
    const double time = spec.similarity.time(), force = spec.similarity.mass;
    Trajectory scaled = InUnits({.time = 1 / time}, *earth.solution.trajectory);
    for (TrajectoryPhase& phase : scaled.phases) {
      phase.point_efforts *= force;
      phase.point_forces *= force;
    }
    const double objective = preset == Preset::kTorque ? std::pow(force, 2) / std::pow(time, 3) : 1;
    SolutionMultipliers multipliers = *earth.solution.multipliers;
    multipliers.rows *= objective;
    multipliers.bounds *= objective;
    spec.warm_start = WarmStart{std::move(scaled), std::move(multipliers), earth.solution.added};
    const Solved other = Walk(std::move(spec));
    EXPECT_TRUE(other.solution.warm_started);
    EXPECT_NEAR(other.solution.objective / objective, earth.solution.objective, 1e-6 * earth.solution.objective)
        << gravity;
    ExpectSimilar(earth, other, time, other.spec.similarity.torque(), 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, ScalingTest,
                         ::testing::Combine(::testing::Values(Preset::kTorque, Preset::kTransport, Preset::kHuman),
                                            ::testing::Values(0.0, 0.1)));
INSTANTIATE_TEST_SUITE_P(Presets, ScalingInSpaceTest,
                         ::testing::Values(std::tuple(Preset::kTorque, 0.1), std::tuple(Preset::kTransport, 0.0),
                                           std::tuple(Preset::kHuman, 0.1)));

// The figures of the report are in SI units, and the judge, who knows of no other, finds the motion within bounds.
TEST(Scaling, AnotherPlanetIsReportedInSiUnits) {
  GaitRequest request;
  request.body.model = "planar";
  request.preset = Preset::kHuman;
  request.gravity = 3.71;
  request.discretization.single_support_intervals = 24;
  const GaitSpec spec = CheckRequest(request).value();
  const GaitSolution solution = OptimizingGaitSolver().Solve(spec, SolveControl());
  ASSERT_EQ(solution.termination, Termination::kOptimal) << solution.message;
  const Trajectory& trajectory = *solution.trajectory;
  EXPECT_NEAR(trajectory.displacement / trajectory.duration, solution.speed, 1e-12);
  EXPECT_NEAR(solution.speed, DefaultSpeed(3.71), 1e-6);
  double sum = 0;
  for (const CostValue& cost : solution.costs) {
    EXPECT_NEAR(cost.contribution, cost.weight * cost.value / trajectory.displacement, 1e-9 * cost.contribution)
        << cost.name;
    sum += cost.contribution;
  }
  EXPECT_NEAR(sum, solution.objective, 1e-9 * sum);
  EXPECT_NEAR(solution.meshes.back().smoothing, 5 * std::pow(3.71 / 9.81, 1.5), 1e-9);
  EXPECT_LT(solution.accuracy->findings[static_cast<int>(Criterion::kPositionDefect)].value, 5e-3);
  EXPECT_LT(solution.accuracy->findings[static_cast<int>(Criterion::kEnergy)].value, 0.02);
}

// What a preset does not name stays: the body's own limits, where a request gives costs.
TEST(Scaling, WithoutAPresetTheBodyStaysAsItIs) {
  GaitRequest request;
  request.body.model = "planar";
  request.gravity = 1.62;
  const GaitSpec body = CheckRequest(request).value();
  request.preset = Preset::kHuman;
  const GaitSpec preset = CheckRequest(request).value();
  const int knee = body.scene.model.Find("knee_l");
  EXPECT_EQ(body.scene.model.joint(knee).effort_max, 250);
  EXPECT_EQ(body.scene.model.joint(knee).velocity_max, 20);
  EXPECT_EQ(body.passive_scale, 1);
  EXPECT_NEAR(preset.scene.model.joint(knee).effort_max, 250 * 1.62 / 9.81, 1e-12);
  EXPECT_NEAR(preset.scene.model.joint(knee).velocity_max, 20 * std::sqrt(1.62 / 9.81), 1e-12);
  EXPECT_NEAR(preset.passive_scale, 1.62 / 9.81, 1e-12);
  request.limits.joint_velocity["knee_l"] = 13;
  EXPECT_EQ(CheckRequest(request).value().scene.model.joint(knee).velocity_max, 13);
}

}  // namespace
}  // namespace rollgait
