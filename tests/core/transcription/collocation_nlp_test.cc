#include "core/transcription/collocation_nlp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "tests/core/transcription/planar_request.h"
#include "tests/support/every_scheme.h"

namespace rollgait {
namespace {

using Normalization = GaitRequest::Normalization;
using TouchDown = GaitRequest::TouchDown;
using Case = std::tuple<Scheme, Normalization, Cycle, TouchDown>;

class CollocationNlpTest : public ::testing::TestWithParam<Case> {
 protected:
  CollocationNlpTest() {
    const auto [scheme, normalization, cycle, touch_down] = GetParam();
    GaitRequest request = PlanarRequestWithEveryTerm(scheme);
    request.normalization = normalization;
    request.cycle = cycle;
    request.ground_contact.touch_down = touch_down;
    spec_ = std::make_unique<GaitSpec>(CheckRequest(request).value());
    problem_ = BuildProblem(*spec_);
    Mesh mesh;
    for (size_t p = 0; p < problem_->phases.size(); ++p) {
      const bool two = p == problem_->phases.size() - 1;
      mesh.fractions.push_back(two ? std::vector<double>{0.3, 0.7} : std::vector<double>{1});
    }
    // Every kind of constraint that may be added is there.
    AddedConstraints added;
    const int knee = problem_->model.Find("knee_r");
    added.between.assign(problem_->phases.size(), {{knee}, {knee, problem_->model.Find("hip_l")}, {knee}});
    nlp_ = std::make_unique<CollocationNlp>(*problem_, scheme, mesh, added);
    x_ = nlp_->MakeStart(WalkingGuess(*spec_, *problem_));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> noise(-0.05, 0.05);
    for (double& value : x_) value += noise(random);
  }
  static bool Plastic() { return std::get<3>(GetParam()) == TouchDown::kPlastic; }
  MatrixX DenseJacobian(const VectorX& x) {
    VectorX values(nlp_->jacobian_pattern().size());
    EXPECT_TRUE(nlp_->Jacobian(x.data(), values.data()));
    MatrixX dense = MatrixX::Zero(nlp_->constraints(), nlp_->variables());
    for (int e = 0; e < values.size(); ++e) {
      dense(nlp_->jacobian_pattern().rows[e], nlp_->jacobian_pattern().columns[e]) += values(e);
    }
    return dense;
  }
  VectorX GradientAt(const VectorX& x) {
    VectorX gradient(x.size());
    EXPECT_TRUE(nlp_->Gradient(x.data(), gradient.data()));
    return gradient;
  }

  std::unique_ptr<GaitSpec> spec_;
  std::unique_ptr<OptimalControlProblem> problem_;
  std::unique_ptr<CollocationNlp> nlp_;
  VectorX x_;
};

// Central differences with step 1e-6: truncation 1e-12 times third derivatives, rounding 1e-10 times values; columns
// are compared relative to their largest entry.
constexpr double kStep = 1e-6;

TEST_P(CollocationNlpTest, JacobianAndGradientMeetDifferences) {
  const MatrixX jacobian = DenseJacobian(x_);
  const VectorX gradient = GradientAt(x_);
  VectorX up(nlp_->constraints()), down(nlp_->constraints());
  for (int j = 0; j < x_.size(); ++j) {
    VectorX x = x_;
    x(j) += kStep;
    double f_up, f_down;
    ASSERT_TRUE(nlp_->Constraints(x.data(), up.data()));
    ASSERT_TRUE(nlp_->Objective(x.data(), &f_up));
    x(j) -= 2 * kStep;
    ASSERT_TRUE(nlp_->Constraints(x.data(), down.data()));
    ASSERT_TRUE(nlp_->Objective(x.data(), &f_down));
    const VectorX difference = (up - down) / (2 * kStep);
    const double size = 1 + difference.cwiseAbs().maxCoeff();
    int row;
    EXPECT_LT((difference - jacobian.col(j)).cwiseAbs().maxCoeff(&row), 1e-6 * size)
        << "unknown " << j << " row " << row << " " << nlp_->Describe(x_.data(), row).name;
    EXPECT_NEAR((f_up - f_down) / (2 * kStep), gradient(j), 1e-6 * (1 + gradient.cwiseAbs().maxCoeff())) << j;
  }
}

TEST_P(CollocationNlpTest, HessianMeetsDifferencesOfFirstDerivatives) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-1, 1);
  VectorX lambda(nlp_->constraints());
  for (double& value : lambda) value = uniform(random);
  const double sigma = 0.7;
  VectorX values(nlp_->hessian_pattern().size());
  ASSERT_TRUE(nlp_->Hessian(x_.data(), sigma, lambda.data(), values.data()));
  MatrixX hessian = MatrixX::Zero(x_.size(), x_.size());
  for (int e = 0; e < values.size(); ++e) {
    const int r = nlp_->hessian_pattern().rows[e], c = nlp_->hessian_pattern().columns[e];
    ASSERT_GE(r, c);
    hessian(r, c) += values(e);
    if (r != c) hessian(c, r) += values(e);
  }
  const auto lagrangian_gradient = [&](const VectorX& x) -> VectorX {
    return sigma * GradientAt(x) + DenseJacobian(x).transpose() * lambda;
  };
  EXPECT_GT(hessian.cwiseAbs().maxCoeff(), 1);
  for (int j = 0; j < x_.size(); ++j) {
    VectorX up = x_, down = x_;
    up(j) += kStep;
    down(j) -= kStep;
    const VectorX difference = (lagrangian_gradient(up) - lagrangian_gradient(down)) / (2 * kStep);
    int row;
    const double error = (difference - hessian.col(j)).cwiseAbs().maxCoeff(&row);
    EXPECT_LT(error, 1e-5 * (1 + difference.cwiseAbs().maxCoeff())) << "column " << j << " row " << row;
  }
}

TEST_P(CollocationNlpTest, BothDerivativesAtOnceAreThoseApart) {
  const VectorX lambda = VectorX::LinSpaced(nlp_->constraints(), -1, 2);
  VectorX jacobian(nlp_->jacobian_pattern().size()), hessian(nlp_->hessian_pattern().size());
  VectorX jacobian_apart(jacobian), hessian_apart(hessian);
  ASSERT_TRUE(nlp_->Derivatives(x_.data(), 0.7, lambda.data(), jacobian.data(), hessian.data()));
  ASSERT_TRUE(nlp_->Jacobian(x_.data(), jacobian_apart.data()));
  ASSERT_TRUE(nlp_->Hessian(x_.data(), 0.7, lambda.data(), hessian_apart.data()));
  EXPECT_EQ(jacobian, jacobian_apart);
  EXPECT_EQ(hessian, hessian_apart);
}

// Whatever is eliminated early is known by then to few: every unknown and row has a group, and none but the first node,
// the durations and the displacement is in the last one.
TEST_P(CollocationNlpTest, EliminationFollowsTheStages) {
  const EliminationGroups groups = nlp_->elimination_groups();
  ASSERT_EQ(static_cast<int>(groups.variables.size()), nlp_->variables());
  ASSERT_EQ(static_cast<int>(groups.constraints.size()), nlp_->constraints());
  const int last = groups.variables.back();
  const long in_last = std::count(groups.variables.begin(), groups.variables.end(), last);
  const int impulses = Plastic() ? nlp_->layout().impulse_size(0) : 0;  // of the first node
  EXPECT_EQ(in_last, 18 + nlp_->layout().phases() + 1 + impulses);
  for (int k = 1; k <= nlp_->layout().intervals(); ++k) {
    EXPECT_LT(groups.variables[nlp_->layout().efforts(k - 1, 0)], groups.variables[nlp_->layout().node(k)]);
    EXPECT_LT(groups.variables[nlp_->layout().node(k)], last);
  }
}

TEST_P(CollocationNlpTest, ObjectiveIsTheSumOfTheTermsThatAreReported) {
  const VectorX integrals = nlp_->CostIntegrals(x_.data());
  ASSERT_EQ(integrals.size(), static_cast<int>(spec_->costs.size()));
  const int rates = HasRatesOfEfforts(spec_->scheme) ? 0 : 2;
  ASSERT_EQ(integrals.size(), static_cast<int>(std::tuple_size_v<decltype(kCostTable)>) - rates);
  EXPECT_GT(integrals.minCoeff(), 0);
  double sum = 0, objective;
  for (int t = 0; t < integrals.size(); ++t) sum += problem_->costs[t].weight * integrals(t);
  ASSERT_TRUE(nlp_->Objective(x_.data(), &objective));
  EXPECT_NEAR(objective, nlp_->objective_scale() * sum / nlp_->Denominator(x_.data()), 1e-12 * objective);
  for (int t = 0; t < integrals.size(); ++t) {
    if (!std::holds_alternative<cost::Time>(spec_->costs[t].term)) continue;
    EXPECT_NEAR(integrals(t), nlp_->duration(x_.data()), 1e-12);
  }
}

TEST_P(CollocationNlpTest, RowsAreDescribedInOrder) {
  int going_on = 0;
  std::map<std::string, int> kinds;  // first word of the name -> rows
  double time = 0;
  bool in_intervals = true;
  for (int row = 0; row < nlp_->constraints(); ++row) {
    const RowInfo info = nlp_->Describe(x_.data(), row);
    EXPECT_GT(info.size, 0) << info.name;
    in_intervals &= info.name.rfind("touch-down", 0) != 0;
    if (in_intervals) {
      EXPECT_GE(info.time, time - 1e-12) << info.name;
      time = info.time;
    }
    ++kinds[info.name.substr(0, info.name.find(' '))];
    going_on += info.name.rfind("rolling acceleration", 0) == 0 ? 1 : 0;
  }
  const int points = nlp_->layout().intervals() * nlp_->layout().points();
  EXPECT_NEAR(time, nlp_->duration(x_.data()), 1e-12);
  EXPECT_EQ(kinds["dynamics"], 9 * points);
  EXPECT_EQ(kinds["periodicity"], Plastic() ? 9 : 18);
  EXPECT_EQ(kinds["touch-down"], problem_->mirrored ? 1 : 2);
  EXPECT_EQ(kinds["speed"], 1);
  const Scheme scheme = std::get<0>(GetParam());
  // Contacts go on rolling in all stages of an explicit method, and at first points that are nodes.
  const int entries = Plastic() || !problem_->mirrored ? 0 : 2;  // x and z of the foot that comes down
  if (entries > 0) {
    const int in_points = kinds["rolling"] - entries, per_interval = nlp_->layout().points();
    const bool is_explicit = !TraitsOf(scheme).is_collocation();
    EXPECT_EQ(going_on, is_explicit ? in_points : TraitsOf(scheme).points.front() == 0 ? in_points / per_interval : 0);
  }
  const bool is_continuous = TraitsOf(scheme).points.front() == 0 && HasRatesOfEfforts(scheme);
  // Six efforts at every instant; of forces x and z of a foot at those within a phase: the only such phase stands on
  // one foot.
  const int within = nlp_->layout().intervals() - nlp_->layout().phases();
  EXPECT_EQ(kinds["continuous"], is_continuous ? 6 * nlp_->layout().intervals() + 2 * within : 0);
  // Nine of the dynamics and two of each of two cones for every foot that comes down, in a half cycle one.
  const int feet = problem_->mirrored ? 1 : 2;
  EXPECT_EQ(kinds["impact,"], Plastic() ? 14 * feet : 0);
  EXPECT_EQ(kinds["position"], Plastic() ? 9 * (feet - 1) : 0);
}

INSTANTIATE_TEST_SUITE_P(HalfCycle, CollocationNlpTest,
                         ::testing::Combine(::testing::ValuesIn(EveryScheme()),
                                            ::testing::Values(Normalization::kPerDistance),
                                            ::testing::Values(Cycle::kHalf), ::testing::Values(TouchDown::kSmooth)));
// What the integrals are divided by is no matter of the scheme.
INSTANTIATE_TEST_SUITE_P(Normalizations, CollocationNlpTest,
                         ::testing::Combine(::testing::Values(Scheme::kRadau2),
                                            ::testing::Values(Normalization::kPerTime, Normalization::kNone),
                                            ::testing::Values(Cycle::kHalf), ::testing::Values(TouchDown::kSmooth)));
// Twice as many unknowns: every scheme and every normalization once.
INSTANTIATE_TEST_SUITE_P(
    FullCycle, CollocationNlpTest,
    ::testing::Values(Case{Scheme::kRadau2, Normalization::kNone, Cycle::kFull, TouchDown::kSmooth},
                      Case{Scheme::kRadau3, Normalization::kPerTime, Cycle::kFull, TouchDown::kSmooth},
                      Case{Scheme::kHermiteSimpson, Normalization::kPerDistance, Cycle::kFull, TouchDown::kSmooth}));
INSTANTIATE_TEST_SUITE_P(
    Plastic, CollocationNlpTest,
    ::testing::Values(Case{Scheme::kRadau2, Normalization::kPerDistance, Cycle::kHalf, TouchDown::kPlastic},
                      Case{Scheme::kRadau3, Normalization::kPerDistance, Cycle::kFull, TouchDown::kPlastic},
                      Case{Scheme::kHermiteSimpson, Normalization::kPerTime, Cycle::kHalf, TouchDown::kPlastic}));

}  // namespace
}  // namespace rollgait
