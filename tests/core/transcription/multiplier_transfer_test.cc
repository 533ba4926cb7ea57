#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/gait/mesh_refinement.h"
#include "core/gait/meshes.h"
#include "core/gait/optimizing_gait_solver.h"
#include "core/nlp/solve_nlp.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {
namespace {

class MultiplierTransferTest : public ::testing::TestWithParam<Scheme> {
 protected:
  MultiplierTransferTest() {
    GaitRequest request;
    request.body.model = "planar";
    request.slope = 0.1745;
    request.motion.speed = 1.3;
    request.discretization.scheme = GetParam();
    spec_ = std::make_unique<GaitSpec>(CheckRequest(request).value());
    problem_ = BuildProblem(*spec_);
    mesh_ = Mesh::Uniform({8, 16});
    nlp_ = std::make_unique<CollocationNlp>(*problem_, GetParam(), mesh_);
    solution_ = SolveNlp(*nlp_, {nlp_->MakeStart(WalkingGuess(*spec_, *problem_)), {}, {}, {}}, {}, {});
  }

  std::unique_ptr<GaitSpec> spec_;
  std::unique_ptr<OptimalControlProblem> problem_;
  Mesh mesh_;
  std::unique_ptr<CollocationNlp> nlp_;
  NlpResult solution_;
};
INSTANTIATE_TEST_SUITE_P(Schemes, MultiplierTransferTest,
                         ::testing::Values(Scheme::kRadau2, Scheme::kRadau3, Scheme::kHermiteSimpson,
                                           Scheme::kLobatto4));

TEST_P(MultiplierTransferTest, TheSameMeshKeepsThemAll) {
  ASSERT_EQ(solution_.termination, Termination::kOptimal);
  const CollocationNlp again(*problem_, GetParam(), mesh_);
  NlpStart start;
  again.TransferMultipliers(*nlp_, solution_, &start);
  // Times of points are sums of fractions: equal but for rounding.
  const double size = solution_.constraint_multipliers.lpNorm<Eigen::Infinity>();
  EXPECT_LT((start.constraint_multipliers - solution_.constraint_multipliers).lpNorm<Eigen::Infinity>(), 1e-10 * size);
  // Free accelerations have no bounds, and no multipliers to lose.
  EXPECT_LT((start.lower_bound_multipliers - solution_.lower_bound_multipliers).lpNorm<Eigen::Infinity>(), 1e-8 * size);
  EXPECT_LT((start.upper_bound_multipliers - solution_.upper_bound_multipliers).lpNorm<Eigen::Infinity>(), 1e-8 * size);
}

// Halving every interval doubles the rows and halves their multipliers: sums over a phase stay what they were.
TEST_P(MultiplierTransferTest, SumsOverAPhaseSurviveRefinement) {
  const CollocationNlp finer(*problem_, GetParam(), Halved(mesh_));
  NlpStart start;
  finer.TransferMultipliers(*nlp_, solution_, &start);
  const auto sums = [&](const CollocationNlp& nlp, const NlpResult& at, const VectorX& multipliers) {
    std::map<std::string, double> total;
    for (int row = 0; row < nlp.constraints(); ++row) {
      const RowInfo info = nlp.Describe(at.x.data(), row);
      if (info.name.rfind("dynamics", 0) == 0 && info.phase == 1) total[info.name] += multipliers(row);
    }
    return total;
  };
  NlpResult moved = solution_;
  moved.x = VectorX::Zero(finer.variables());
  const auto before = sums(*nlp_, solution_, solution_.constraint_multipliers);
  const auto after = sums(finer, moved, start.constraint_multipliers);
  ASSERT_EQ(before.size(), 9u);
  double largest = 0;
  for (const auto& [name, value] : before) largest = std::max(largest, std::abs(value));
  // Linear interpolation between points of intervals that are 1/16 of the phase.
  for (const auto& [name, value] : before) EXPECT_NEAR(after.at(name), value, 0.05 * largest) << name;
}

// Iterations on a mesh that is twice as fine, from the motion of the coarser one, with its multipliers and with zeros.
struct Iterations {
  int with = 0, without = 0;
};

Iterations OnAFinerMesh(Scheme scheme) {
  GaitRequest request;
  request.body.model = "planar";
  request.preset = Preset::kHuman;
  request.motion.speed = 1.3;
  request.discretization.scheme = scheme;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  const GaitSpec spec = CheckRequest(request).value();
  const auto problem = BuildProblem(spec);
  const GaitSolution solution = OptimizingGaitSolver().Solve(spec, {});
  EXPECT_EQ(solution.termination, Termination::kOptimal);
  NlpOptions options;
  options.initial_barrier = options.warm_push = 1e-4;
  CollocationNlp coarse(*problem, scheme, RequestedMesh(spec)), finer(*problem, scheme, Halved(RequestedMesh(spec)));
  const NlpStart again{coarse.MakeStart(GuessFromTrajectory(*solution.trajectory)), {}, {}, {}};
  const NlpResult known = SolveNlp(coarse, again, options, {});
  EXPECT_EQ(known.termination, Termination::kOptimal);
  NlpStart start{finer.MakeStart(GuessFromTrajectory(coarse.Extract(known.x.data()))),
                 VectorX::Zero(finer.constraints()), VectorX::Zero(finer.variables()),
                 VectorX::Zero(finer.variables())};
  const NlpResult without = SolveNlp(finer, start, options, {});
  finer.TransferMultipliers(coarse, known, &start);
  const NlpResult with = SolveNlp(finer, start, options, {});
  EXPECT_EQ(with.termination, Termination::kOptimal);
  return {with.iterations, without.iterations};
}

// Where rates cost something and forces vanish with their contacts. Of one solve alone chance decides: 24, 14, 18 and
// 20 iterations with them, 26, 16, 22 and 19 with zeros.
TEST(MultiplierTransfer, BringsFinerMeshesCloserToTheirSolutions) {
  Iterations all;
  for (const Scheme scheme : {Scheme::kRadau2, Scheme::kRadau3, Scheme::kHermiteSimpson, Scheme::kLobatto4}) {
    const Iterations one = OnAFinerMesh(scheme);
    all.with += one.with;
    all.without += one.without;
    std::printf("%d iterations, with zeros %d\n", one.with, one.without);
  }
  EXPECT_LT(all.with, all.without);
}

}  // namespace
}  // namespace rollgait
