// A mass on a rail through the whole transcription and the solver, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "core/nlp/solve_nlp.h"
#include "core/ocp/costs/point_costs.h"
#include "core/transcription/collocation_nlp.h"
#include "tests/support/every_scheme.h"

namespace rollgait {
namespace {

constexpr double kMass = 1.3;      // kg
constexpr double kDuration = 2.0;  // s

// One actuated prismatic joint along x, no contact, full cycle of prescribed duration and displacement.
std::unique_ptr<OptimalControlProblem> MassOnRail(double displacement, const Vector3& gravity) {
  Joint joint;
  joint.name = "rail";
  joint.link = "mass";
  joint.type = JointType::kPrismatic;
  joint.axis = Vector3::UnitX();
  joint.actuated = true;
  joint.effort_min = -1e4;
  joint.effort_max = 1e4;
  joint.mass = kMass;
  auto problem = std::make_unique<OptimalControlProblem>(Model::Create({joint}).value());
  problem->gravity = gravity;
  problem->phases.push_back({{}, {kDuration, kDuration}});
  problem->mirrored = false;
  problem->denominator = CostDenominator::kNothing;
  problem->displacement = {displacement, displacement};
  CostDescription effort;
  effort.term = std::make_unique<SquaredTorqueCost>(VectorX::Ones(1), problem->Layout(0), problem->effort_size());
  problem->costs.push_back(std::move(effort));
  return problem;
}

MotionGuess Resting() {
  MotionGuess guess;
  guess.durations = {kDuration};
  guess.motion = [](int, double) {
    return MotionSample{VectorX::Zero(1), VectorX::Zero(1), VectorX::Zero(1), VectorX::Zero(1), VectorX::Zero(0)};
  };
  return guess;
}

// The same problem with the velocity of the first node held at zero, hence, by periodicity, of the last.
class FromRestToRest : public NlpProblem {
 public:
  explicit FromRestToRest(CollocationNlp& nlp) : nlp_(nlp), lower_(nlp.lower_bounds()), upper_(nlp.upper_bounds()) {
    lower_(nlp.layout().node(0) + 1) = upper_(nlp.layout().node(0) + 1) = 0;
  }
  int variables() const override { return nlp_.variables(); }
  int constraints() const override { return nlp_.constraints(); }
  const VectorX& lower_bounds() const override { return lower_; }
  const VectorX& upper_bounds() const override { return upper_; }
  const VectorX& constraint_lower() const override { return nlp_.constraint_lower(); }
  const VectorX& constraint_upper() const override { return nlp_.constraint_upper(); }
  const SparsityPattern& jacobian_pattern() const override { return nlp_.jacobian_pattern(); }
  const SparsityPattern& hessian_pattern() const override { return nlp_.hessian_pattern(); }
  bool Objective(const double* x, double* value) override { return nlp_.Objective(x, value); }
  bool Gradient(const double* x, double* gradient) override { return nlp_.Gradient(x, gradient); }
  bool Constraints(const double* x, double* g) override { return nlp_.Constraints(x, g); }
  bool Jacobian(const double* x, double* values) override { return nlp_.Jacobian(x, values); }
  bool Hessian(const double* x, double sigma, const double* lambda, double* values) override {
    return nlp_.Hessian(x, sigma, lambda, values);
  }

 private:
  CollocationNlp& nlp_;
  VectorX lower_, upper_;
};

NlpResult Solve(CollocationNlp& nlp, NlpProblem& problem) {
  NlpOptions options;
  options.tolerance = 1e-10;
  const NlpResult result = SolveNlp(problem, {nlp.MakeStart(Resting()), {}, {}, {}}, options, {});
  EXPECT_EQ(result.termination, Termination::kOptimal) << result.message;
  return result;
}

// Intervals of lengths 1 : 2 : 1 : 2 …: on a uniform mesh errors of a periodic problem could cancel.
Mesh UnevenMesh(int pairs) {
  Mesh mesh{{{}}};
  for (int i = 0; i < pairs; ++i) {
    mesh.fractions[0].push_back(1.0 / (3 * pairs));
    mesh.fractions[0].push_back(2.0 / (3 * pairs));
  }
  return mesh;
}

class KnownAnswersTest : public ::testing::TestWithParam<Scheme> {};
class CollocatedAnswersTest : public KnownAnswersTest {};
class LinearEffortsTest : public KnownAnswersTest {};  // of degree 1 or more in an interval
class ShootingAnswersTest : public KnownAnswersTest {};

// Double integrator from rest to rest with least ∫ u² dt: u = m (6 D/T²)(1 − 2 t/T), cost 12 m² D²/T³. Efforts are
// linear and u² is quadratic, so every scheme that has such efforts has exact ones, cost and node states on every mesh.
TEST_P(LinearEffortsTest, DoubleIntegratorWithLeastEffort) {
  const double distance = 0.7;
  const auto problem = MassOnRail(distance, {0, 0, -9.81});
  CollocationNlp nlp(*problem, GetParam(), UnevenMesh(2));
  FromRestToRest at_rest(nlp);
  const NlpResult result = Solve(nlp, at_rest);
  const double cost = 12 * kMass * kMass * distance * distance / std::pow(kDuration, 3);
  EXPECT_NEAR(nlp.CostIntegrals(result.x.data())(0), cost, 1e-7 * cost);
  const Trajectory trajectory = nlp.Extract(result.x.data());
  const TrajectoryPhase& phase = trajectory.phases[0];
  for (size_t i = 0; i < phase.point_times.size(); ++i) {
    const double t = phase.point_times[i] / kDuration;
    const int column = static_cast<int>(i);
    EXPECT_NEAR(phase.point_efforts(0, column), kMass * 6 * distance / (kDuration * kDuration) * (1 - 2 * t), 1e-6);
  }
  for (size_t k = 0; k < phase.node_times.size(); ++k) {
    const double t = phase.node_times[k] / kDuration;
    EXPECT_NEAR(phase.node_positions(0, static_cast<int>(k)), distance * t * t * (3 - 2 * t), 1e-7);
  }
}

// With efforts that are constant within N equal intervals it costs 1/(1 − 1/N²) times as much. The limits of the effort
// are so far away that they do not move the solution while the barrier parameter falls.
TEST_P(KnownAnswersTest, DoubleIntegratorWithConstantEffortsInIntervals) {
  const double distance = 0.7;
  const auto problem = MassOnRail(distance, {0, 0, -9.81});
  problem->phases[0].effort_degree = 0;
  CollocationNlp nlp(*problem, GetParam(), Mesh::Uniform({4}));
  FromRestToRest at_rest(nlp);
  const NlpResult result = Solve(nlp, at_rest);
  const double cost = 12 * kMass * kMass * distance * distance / std::pow(kDuration, 3) / (1 - 1.0 / 16);
  EXPECT_NEAR(nlp.CostIntegrals(result.x.data())(0), cost, 1e-9 * cost);
}

// Against a slope at any periodic motion the least effort is the constant m g sin(slope).
TEST_P(KnownAnswersTest, SlopeTakesAConstantEffort) {
  const double along = 9.81 * std::sin(0.2);
  const auto problem = MassOnRail(2.0, {-along, 0, -9.81 * std::cos(0.2)});
  CollocationNlp nlp(*problem, GetParam(), UnevenMesh(2));
  const NlpResult result = Solve(nlp, nlp);
  const double cost = std::pow(kMass * along, 2) * kDuration;
  EXPECT_NEAR(nlp.CostIntegrals(result.x.data())(0), cost, 1e-7 * cost);
}

// ∫ u² + w (q − a sin ωt)² dt over a period: q = A sin ωt with A = a w/(w + m²ω⁴), cost a² T/2 · w m²ω⁴/(w + m²ω⁴).
class TrackedSine {
 public:
  explicit TrackedSine(Scheme scheme, const Mesh& mesh) : problem_(MassOnRail(0, {0, 0, -9.81})) {
    std::vector<double> reference;
    for (int i = 0; i <= 4000; ++i) reference.push_back(kAmplitude * std::sin(2 * M_PI * i / 4000));
    CostDescription tracking;
    tracking.weight = kWeight;
    tracking.term = TrackingCost{{{0, 1.0, CubicSpline(std::move(reference))}}};
    problem_->costs.push_back(std::move(tracking));
    nlp_ = std::make_unique<CollocationNlp>(*problem_, scheme, mesh);
  }
  // Relative errors of the cost and of the worst node position.
  struct Errors {
    double cost, position = 0;
  };
  Errors Measure() {
    const NlpResult result = Solve(*nlp_, *nlp_);
    const VectorX integrals = nlp_->CostIntegrals(result.x.data());
    const double inertia = std::pow(kMass * M_PI * M_PI, 2);  // m²ω⁴ with ω = 2π/T = π
    const double amplitude = kAmplitude * kWeight / (kWeight + inertia);
    const double cost = kAmplitude * amplitude * inertia * kDuration / 2;
    Errors errors{std::abs(integrals(0) + kWeight * integrals(1) - cost) / cost};
    const TrajectoryPhase phase = nlp_->Extract(result.x.data()).phases[0];
    for (size_t k = 0; k < phase.node_times.size(); ++k) {
      const double exact = amplitude * std::sin(M_PI * phase.node_times[k]);
      const double error = std::abs(phase.node_positions(0, static_cast<int>(k)) - exact);
      errors.position = std::max(errors.position, error / amplitude);
    }
    return errors;
  }

 private:
  static constexpr double kAmplitude = 0.3, kWeight = 300;
  std::unique_ptr<OptimalControlProblem> problem_;
  std::unique_ptr<CollocationNlp> nlp_;
};

// Node states converge with the order of the scheme. The odd leading term of the cost's error is a total derivative
// along the motion and vanishes over a period, so that the cost gains an order with the Radau schemes. That of order 9
// takes coarser meshes, on which rounding does not show, but further terms of the error do.
TEST_P(CollocatedAnswersTest, TrackedSineConvergesWithTheOrderOfTheScheme) {
  const SchemeTraits& traits = TraitsOf(GetParam());
  const bool is_highest = traits.order == 9;
  const int pairs = is_highest ? 4 : 8;
  const auto coarse = TrackedSine(GetParam(), UnevenMesh(pairs)).Measure();
  const auto fine = TrackedSine(GetParam(), UnevenMesh(2 * pairs)).Measure();
  const double order = traits.order, cost_order = order + traits.order % 2;
  EXPECT_NEAR(std::log2(coarse.position / fine.position), order, is_highest ? 1 : 0.3);
  EXPECT_NEAR(std::log2(coarse.cost / fine.cost), cost_order, is_highest ? 0.5 : 0.1);
  EXPECT_LT(fine.cost, 2e-4);
}

// ∫ (dτ/dt)² of τ = sin ωt over a period, T ω²/2, by differences: error of second order in the step.
TEST_P(LinearEffortsTest, EffortRateOfASine) {
  const auto problem = MassOnRail(0, {0, 0, -9.81});
  CostDescription rate;
  rate.term = RateCost{RateCost::Of::kEfforts, VectorX::Constant(1, 3.0)};
  problem->costs.push_back(std::move(rate));
  const auto error = [&](int pairs) {
    CollocationNlp nlp(*problem, GetParam(), UnevenMesh(pairs));
    MotionGuess guess = Resting();
    guess.motion = [](int, double fraction) {
      MotionSample sample = Resting().motion(0, 0);
      sample.efforts(0) = std::sin(2 * M_PI * fraction);
      return sample;
    };
    const VectorX x = nlp.MakeStart(guess);
    return std::abs(nlp.CostIntegrals(x.data())(1) / (3 * kDuration * M_PI * M_PI / 2) - 1);
  };
  EXPECT_NEAR(std::log2(error(8) / error(16)), 2, 0.1);
  EXPECT_LT(error(16), 0.01);
}

// The least cost with efforts of a degree in every interval exceeds that with free ones by the square of what the
// efforts differ by, h^(degree + 1). Node states follow the mean of the efforts, which is exact.
TEST_P(ShootingAnswersTest, CostOfATrackedSineConvergesWithTheDegreeOfTheEfforts) {
  const auto coarse = TrackedSine(GetParam(), UnevenMesh(8)).Measure();
  const auto fine = TrackedSine(GetParam(), UnevenMesh(16)).Measure();
  EXPECT_NEAR(std::log2(coarse.cost / fine.cost), 2 * (TraitsOf(GetParam()).effort_degree + 1), 0.1);
  EXPECT_LT(fine.cost, 1e-2);
}

// Linear efforts do not jump between intervals, unless the phase holds them constant.
TEST_P(ShootingAnswersTest, RowsJoinLinearEfforts) {
  for (const std::optional<int> degree : {std::optional<int>(), std::optional<int>(0)}) {
    const auto problem = MassOnRail(0.7, {0, 0, -9.81});
    problem->phases[0].effort_degree = degree;
    const CollocationNlp nlp(*problem, GetParam(), Mesh::Uniform({4}));
    const VectorX x = nlp.MakeStart(Resting());
    int joined = 0;
    for (int row = 0; row < nlp.constraints(); ++row) {
      joined += nlp.Describe(x.data(), row).name.rfind("continuous effort", 0) == 0 ? 1 : 0;
    }
    EXPECT_EQ(joined, GetParam() == Scheme::kShootingLinear && !degree ? 3 : 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, KnownAnswersTest, ::testing::ValuesIn(EveryScheme()));
INSTANTIATE_TEST_SUITE_P(Schemes, CollocatedAnswersTest, ::testing::ValuesIn(EveryCollocation()));
INSTANTIATE_TEST_SUITE_P(Schemes, LinearEffortsTest, ::testing::ValuesIn([] {
                           std::vector<Scheme> schemes = EveryScheme();
                           std::erase_if(schemes, [](Scheme scheme) { return !HasRatesOfEfforts(scheme); });
                           return schemes;
                         }()));
INSTANTIATE_TEST_SUITE_P(Schemes, ShootingAnswersTest,
                         ::testing::Values(Scheme::kShootingConstant, Scheme::kShootingLinear));

}  // namespace
}  // namespace rollgait
