#include "core/nlp/ipopt_solver.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/core/nlp/hs071.h"

namespace rollgait {
namespace {

NlpResult SolveHs071(double sum_of_squares, const IpoptOptions& options, const SolveControl& control = {}) {
  Hs071 problem(sum_of_squares);
  return SolveWithIpopt(problem, {Hs071::Start(), {}, {}, {}}, options, control);
}

// Optimum and multipliers as published with the problem (Ipopt's tutorial prints them to these digits).
TEST(IpoptSolver, FindsTheKnownOptimumAndItsMultipliers) {
  IpoptOptions options;
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

// With x ≤ 5 the squares add up to at most 100.
TEST(IpoptSolver, SaysThatAProblemIsInfeasible) {
  const NlpResult result = SolveHs071(150, {});
  EXPECT_EQ(result.termination, Termination::kInfeasible) << result.message;
  ASSERT_EQ(result.x.size(), 4);
  EXPECT_TRUE(result.x.allFinite());
  EXPECT_GT(result.constraint_violation, 1);
}

TEST(IpoptSolver, StopsAtTheIterationLimit) {
  IpoptOptions options;
  options.max_iterations = 2;
  const NlpResult result = SolveHs071(40, options);
  EXPECT_EQ(result.termination, Termination::kIterationLimit);
  EXPECT_EQ(result.iterations, 2);
  EXPECT_EQ(result.x.size(), 4);
}

TEST(IpoptSolver, StopsWhenAskedTo) {
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

TEST(IpoptSolver, StopsWhenItsTimeIsUp) {
  IpoptOptions options;
  options.max_wall_time_s = 0;
  const NlpResult result = SolveHs071(40, options);
  EXPECT_EQ(result.termination, Termination::kTimeLimit);
  EXPECT_NE(result.message.find("max_wall_time_s"), std::string::npos);
}

TEST(IpoptSolver, ReportsEveryIterationInOrder) {
  IpoptOptions options;
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

TEST(IpoptSolver, WarmStartKeepsTheMultipliersAndSavesIterations) {
  const NlpResult cold = SolveHs071(40, {});
  ASSERT_EQ(cold.termination, Termination::kOptimal);
  Hs071 problem(40.1);
  IpoptOptions options;
  const NlpResult from_cold = SolveWithIpopt(problem, {Hs071::Start(), {}, {}, {}}, options, {});
  options.initial_barrier = 1e-6;
  const NlpResult warm = SolveWithIpopt(problem,
                                        {cold.x, cold.constraint_multipliers, cold.lower_bound_multipliers,
                                         cold.upper_bound_multipliers},
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

TEST(IpoptSolver, AnObjectiveThatIsNotFiniteEndsInAWordedOutcome) {
  NotFinite problem;
  const NlpResult result = SolveWithIpopt(problem, {Hs071::Start(), {}, {}, {}}, {}, {});
  EXPECT_EQ(result.termination, Termination::kNumericalDifficulty);
  EXPECT_FALSE(result.message.empty());
}

TEST(IpoptSolver, NamesItsVersion) { EXPECT_EQ(IpoptVersion().rfind("Ipopt 3.", 0), 0u) << IpoptVersion(); }

}  // namespace
}  // namespace rollgait
