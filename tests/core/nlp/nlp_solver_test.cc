// What every solver of nonlinear programs must do: Ipopt, the interior point method of our own, and the one that
// combines them.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/nlp/interior_point.h"
#include "core/nlp/ipopt_solver.h"
#include "core/nlp/solve_nlp.h"
#include "tests/core/nlp/hs071.h"

namespace rollgait {
namespace {

using Solve = NlpResult (*)(NlpProblem&, const NlpStart&, const NlpOptions&, const SolveControl&);

NlpResult SolveAlone(NlpProblem& problem, const NlpStart& start, const NlpOptions& options,
                     const SolveControl& control) {
  return SolveWithInteriorPoint(problem, start, options, control).result;
}

NlpResult SolveInTurn(NlpProblem& problem, const NlpStart& start, const NlpOptions& options,
                      const SolveControl& control) {
  return SolveNlp(problem, start, options, control);
}

class NlpSolverTest : public ::testing::TestWithParam<Solve> {
 protected:
  NlpResult SolveHs071(double sum_of_squares, const NlpOptions& options, const SolveControl& control = {}) {
    Hs071 problem(sum_of_squares);
    return GetParam()(problem, {Hs071::Start(), {}, {}, {}}, options, control);
  }
};

// Optimum and multipliers as published with the problem (Ipopt's tutorial prints them to these digits).
TEST_P(NlpSolverTest, FindsTheKnownOptimumAndItsMultipliers) {
  NlpOptions options;
  options.tolerance = 1e-9;
  const NlpResult result = SolveHs071(40, options);
  ASSERT_EQ(result.termination, Termination::kOptimal) << result.message;
  EXPECT_NEAR(result.objective, 17.0140173, 1e-6);
  EXPECT_TRUE(result.x.isApprox(Eigen::Vector4d(1, 4.7429994, 3.8211503, 1.3794082), 1e-6));
  EXPECT_NEAR(result.constraint_multipliers(0), -0.5522937, 1e-6);
  EXPECT_NEAR(result.constraint_multipliers(1), 0.1614686, 1e-6);
  EXPECT_NEAR(result.lower_bound_multipliers(0), 1.0878712, 1e-6);
  EXPECT_LT(result.upper_bound_multipliers.cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LE(result.kkt_error, 1e-8);
  EXPECT_LE(result.constraint_violation, 1e-8);
  EXPECT_GT(result.iterations, 0);
}

// x₀ ≥ 1 holds it. At the usual tolerance bounds are moved outwards by 1e-8.
TEST_P(NlpSolverTest, KeepsBoundsAsExactlyAsTheToleranceAsks) {
  for (const auto& [tolerance, excess] : {std::pair(1e-6, 1e-8), std::pair(1e-8, 1e-10), std::pair(1e-10, 1e-12)}) {
    NlpOptions options;
    options.tolerance = tolerance;
    const NlpResult result = SolveHs071(40, options);
    ASSERT_EQ(result.termination, Termination::kOptimal) << result.message;
    EXPECT_GE(result.x(0), 1 - 1.001 * excess) << tolerance;
    EXPECT_LE(result.x(0), 1 + tolerance) << tolerance;
  }
}

// With x ≤ 5 the squares add up to at most 100.
TEST_P(NlpSolverTest, SaysThatAProblemIsInfeasible) {
  const NlpResult result = SolveHs071(150, {});
  EXPECT_EQ(result.termination, Termination::kInfeasible) << result.message;
  ASSERT_EQ(result.x.size(), 4);
  EXPECT_TRUE(result.x.allFinite());
  EXPECT_GT(result.constraint_violation, 1);
}

TEST_P(NlpSolverTest, StopsAtTheIterationLimit) {
  NlpOptions options;
  options.max_iterations = 2;
  const NlpResult result = SolveHs071(40, options);
  EXPECT_EQ(result.termination, Termination::kIterationLimit);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_EQ(result.x.size(), 4);
}

TEST_P(NlpSolverTest, StopsWhenAskedTo) {
  StopFlag stop;
  SolveControl control;
  int last = -1;
  control.stop = &stop;
  control.observer = [&](const IterationInfo& info) {
    last = info.index;
    if (info.index == 3) stop.Request();
  };
  const NlpResult result = SolveHs071(40, {}, control);
  EXPECT_EQ(result.termination, Termination::kCancelled);
  EXPECT_EQ(last, 3);
}

TEST_P(NlpSolverTest, StopsWhenItsTimeIsUp) {
  NlpOptions options;
  options.max_wall_time_s = 0;
  const NlpResult result = SolveHs071(40, options);
  EXPECT_EQ(result.termination, Termination::kTimeLimit);
  EXPECT_NE(result.message.find("max_wall_time_s"), std::string::npos);
}

TEST_P(NlpSolverTest, ReportsEveryIterationInOrder) {
  NlpOptions options;
  options.mesh = 3;
  std::vector<IterationInfo> seen;
  SolveControl control;
  control.observer = [&seen](const IterationInfo& info) { seen.push_back(info); };
  const NlpResult result = SolveHs071(40, options, control);
  ASSERT_EQ(static_cast<int>(seen.size()), result.iterations + 1);
  for (size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].index, static_cast<int>(i));
    EXPECT_EQ(seen[i].mesh, 3);
  }
  EXPECT_NEAR(seen.back().objective, result.objective, 1e-4);
  EXPECT_LE(seen.back().primal_infeasibility, 1e-6);
  EXPECT_LT(seen.back().barrier_parameter, seen.front().barrier_parameter);
}

TEST_P(NlpSolverTest, WarmStartKeepsTheMultipliersAndSavesIterations) {
  const NlpResult cold = SolveHs071(40, {});
  ASSERT_EQ(cold.termination, Termination::kOptimal);
  Hs071 problem(40.1);
  NlpOptions options;
  const NlpResult from_cold = GetParam()(problem, {Hs071::Start(), {}, {}, {}}, options, {});
  options.initial_barrier = 1e-6;
  const NlpResult warm = GetParam()(
      problem, {cold.x, cold.constraint_multipliers, cold.lower_bound_multipliers, cold.upper_bound_multipliers},
      options, {});
  ASSERT_EQ(warm.termination, Termination::kOptimal) << warm.message;
  EXPECT_NEAR(warm.objective, from_cold.objective, 1e-5);
  EXPECT_LT(warm.iterations, from_cold.iterations);
}

// An objective that is nowhere finite.
class NotFinite : public Hs071 {
 public:
  bool Objective(const double*, double*) override { return false; }
};

TEST_P(NlpSolverTest, AnObjectiveThatIsNotFiniteEndsInAWordedOutcome) {
  NotFinite problem;
  const NlpResult result = GetParam()(problem, {Hs071::Start(), {}, {}, {}}, {}, {});
  EXPECT_EQ(result.termination, Termination::kNumericalDifficulty);
  EXPECT_FALSE(result.message.empty());
}

// Three of the four unknowns cannot move.
class Fixed : public Hs071 {
 public:
  Fixed() {
    upper_ = Eigen::Vector4d(1, 4.7429994, 3.8211503, 1.3794082);
    lower_ = upper_;
    lower_(3) = 1;
  }
};

TEST_P(NlpSolverTest, KeepsFixedVariablesWhereTheyAre) {
  Fixed problem;
  NlpOptions options;
  const NlpResult result = GetParam()(problem, {Hs071::Start(), {}, {}, {}}, options, {});
  ASSERT_EQ(result.x.size(), 4);
  EXPECT_EQ(result.x.head(3), problem.lower_bounds().head(3));
}

// With a third row, 100 x₀x₁, that may have any value.
class WithFreeRow : public Hs071 {
 public:
  WithFreeRow() {
    row_lower_ = Eigen::Vector3d(25, 40, -kInfinity);
    row_upper_ = Eigen::Vector3d(kInfinity, 40, kInfinity);
    jacobian_.Add(2, 0);
    jacobian_.Add(2, 1);
  }
  bool Constraints(const double* x, double* g) override {
    g[2] = 100 * x[0] * x[1];
    return Hs071::Constraints(x, g);
  }
  bool Jacobian(const double* x, double* values) override {
    values[8] = 100 * x[1];
    values[9] = 100 * x[0];
    return Hs071::Jacobian(x, values);
  }
  bool Hessian(const double* x, double sigma, const double* lambda, double* values) override {
    if (!Hs071::Hessian(x, sigma, lambda, values)) return false;
    values[1] += 100 * lambda[2];  // of x₁ and x₀
    return true;
  }
};

TEST_P(NlpSolverTest, ARowWithoutBoundsChangesNothing) {
  std::vector<IterationInfo> with, without;
  SolveControl control;
  WithFreeRow problem;
  control.observer = [&with](const IterationInfo& info) { with.push_back(info); };
  const NlpResult result = GetParam()(problem, {Hs071::Start(), {}, {}, {}}, {}, control);
  control.observer = [&without](const IterationInfo& info) { without.push_back(info); };
  const NlpResult expected = SolveHs071(40, {}, control);
  ASSERT_EQ(result.termination, Termination::kOptimal) << result.message;
  EXPECT_TRUE(result.x.isApprox(expected.x, 1e-9));
  ASSERT_EQ(result.constraint_multipliers.size(), 3);
  EXPECT_NEAR(result.constraint_multipliers(2), 0, 1e-12);
  if (GetParam() == SolveWithIpopt) return;  // Ipopt gives the row a slack, which its residuals count
  ASSERT_EQ(with.size(), without.size());
  for (size_t i = 0; i < with.size(); ++i) {
    EXPECT_NEAR(with[i].objective, without[i].objective, 1e-9) << i;
    EXPECT_NEAR(with[i].primal_infeasibility, without[i].primal_infeasibility, 1e-9) << i;
    EXPECT_NEAR(with[i].primal_step, without[i].primal_step, 1e-9) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(IpoptAndInteriorPointAndBoth, NlpSolverTest,
                         ::testing::Values(SolveWithIpopt, SolveAlone, SolveInTurn));

TEST(IpoptSolver, SolvesAloneWhereItIsAskedFor) {
  Hs071 problem(40);
  NlpOptions options;
  options.solver = NlpSolver::kIpopt;
  std::vector<VectorX> points;
  SolveControl control;
  control.observer = [&points](const IterationInfo& info) {
    EXPECT_FALSE(info.restoration);
    points.push_back(Eigen::Map<const VectorX>(info.x, 4));
  };
  const NlpResult result = SolveNlp(problem, {Hs071::Start(), {}, {}, {}}, options, control);
  const NlpResult alone = SolveWithIpopt(problem, {Hs071::Start(), {}, {}, {}}, options, {});
  EXPECT_EQ(result.termination, Termination::kOptimal);
  EXPECT_EQ(result.iterations, alone.iterations);
  EXPECT_EQ(result.x, alone.x);
  EXPECT_NE(result.x, SolveInTurn(problem, {Hs071::Start(), {}, {}, {}}, {}, {}).x);
  EXPECT_EQ(result.restored_from, -1);
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(points.back(), result.x);
}

TEST(IpoptSolver, AsksOnceWhetherToGoOn) {
  Hs071 problem(40);
  NlpOptions options;
  const NlpResult whole = SolveWithIpopt(problem, {Hs071::Start(), {}, {}, {}}, options, {});
  EXPECT_FALSE(whole.rough);
  for (const bool answer : {true, false}) {
    int asked = 0;
    options.rough_tolerance = 1e-2;
    options.worth_finishing = [&](const VectorX& x) {
      ++asked;
      EXPECT_LT((x - whole.x).norm(), 0.1);
      return answer;
    };
    const NlpResult result = SolveWithIpopt(problem, {Hs071::Start(), {}, {}, {}}, options, {});
    EXPECT_EQ(asked, 1);
    EXPECT_EQ(result.rough, !answer);
    EXPECT_EQ(result.termination, Termination::kOptimal);
    EXPECT_EQ(result.iterations == whole.iterations, answer);
  }
}

TEST(IpoptSolver, NamesItsVersion) { EXPECT_EQ(IpoptVersion().rfind("Ipopt 3.", 0), 0u) << IpoptVersion(); }

}  // namespace
}  // namespace rollgait
