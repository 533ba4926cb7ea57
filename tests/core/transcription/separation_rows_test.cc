// Bodies that are kept apart in a whole program: which rows there are, what bounds them, and their derivatives.
#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/transcription/collocation_nlp.h"
#include "tests/support/every_scheme.h"

namespace rollgait {
namespace {

class SeparationRowsTest : public ::testing::TestWithParam<Scheme> {
 protected:
  SeparationRowsTest() {
    GaitRequest request;
    request.body.model = "human29";
    request.body.feet = FootShape::kTwoEllipsoids;
    request.discretization.scheme = GetParam();
    spec_ = std::make_unique<GaitSpec>(CheckRequest(request).value());
    problem_ = BuildProblem(*spec_);
    plain_ = std::make_unique<CollocationNlp>(*problem_, GetParam(), mesh());
    for (int p = 0; p < static_cast<int>(problem_->pairs.size()); ++p) {
      const std::string name = spec_->scene.PairName(p);
      if (name == "left_shank / right_shank" || name == "left_heel / right_shank" ||
          name == "left_shank / right_heel") {
        added_.separated.push_back(p);
      }
    }
    nlp_ = std::make_unique<CollocationNlp>(*problem_, GetParam(), mesh(), added_);
    x_ = nlp_->MakeStart(WalkingGuess(*spec_, *problem_));
  }
  Mesh mesh() const { return Mesh::Uniform(std::vector<int>(problem_->phases.size(), 1)); }

  bool IsDistance(int row) const { return nlp_->Describe(x_.data(), row).name.starts_with("distance "); }

  std::unique_ptr<GaitSpec> spec_;
  std::unique_ptr<OptimalControlProblem> problem_;
  AddedConstraints added_;
  std::unique_ptr<CollocationNlp> plain_, nlp_;
  VectorX x_;
};

// One row for every pair and point but the first point of a Lobatto scheme, bounded at the end of a phase, too. In the
// program every other row and its bounds are as without them.
TEST_P(SeparationRowsTest, RowsAndBounds) {
  ASSERT_EQ(added_.separated.size(), 3u);
  const SchemeTraits& traits = TraitsOf(GetParam());
  const int points = static_cast<int>(traits.points.size()) - (traits.points.front() == 0 ? 1 : 0);
  int distances = 0, other = 0;
  VectorX values(nlp_->constraints());
  ASSERT_TRUE(nlp_->Constraints(x_.data(), values.data()));
  for (int r = 0; r < nlp_->constraints(); ++r) {
    if (!IsDistance(r)) {
      EXPECT_EQ(nlp_->Describe(x_.data(), r).name, plain_->Describe(x_.data(), other).name);
      EXPECT_EQ(nlp_->constraint_lower()(r), plain_->constraint_lower()(other));
      EXPECT_EQ(nlp_->constraint_upper()(r), plain_->constraint_upper()(other));
      ++other;
      continue;
    }
    ++distances;
    const auto info = nlp_->Describe(x_.data(), r);
    EXPECT_NEAR(nlp_->constraint_lower()(r) * info.size, problem_->pair_clearance, 1e-15);
    EXPECT_EQ(nlp_->constraint_upper()(r), kInfinity);
    EXPECT_GT(values(r), nlp_->constraint_lower()(r)) << info.name;  // the guess keeps its legs apart
  }
  EXPECT_EQ(other, plain_->constraints());
  EXPECT_EQ(distances, 3 * points * static_cast<int>(problem_->phases.size()));
}

// Along random directions: distances and their curvature by central differences.
TEST_P(SeparationRowsTest, DerivativesMeetDifferences) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (double& value : x_) value += 0.02 * uniform(random);
  VectorX lambda = VectorX::Zero(nlp_->constraints());
  for (int r = 0; r < lambda.size(); ++r) {
    if (IsDistance(r)) lambda(r) = uniform(random);
  }
  const auto jacobian_product = [&](const VectorX& x) {  // λᵀ J
    VectorX values(nlp_->jacobian_pattern().size()), product = VectorX::Zero(nlp_->variables());
    EXPECT_TRUE(nlp_->Jacobian(x.data(), values.data()));
    for (int e = 0; e < values.size(); ++e) {
      product(nlp_->jacobian_pattern().columns[e]) += lambda(nlp_->jacobian_pattern().rows[e]) * values(e);
    }
    return product;
  };
  const auto value = [&](const VectorX& x) {
    VectorX rows(nlp_->constraints());
    EXPECT_TRUE(nlp_->Constraints(x.data(), rows.data()));
    double sum = 0;
    for (int r = 0; r < rows.size(); ++r) sum += lambda(r) != 0 ? lambda(r) * rows(r) : 0;
    return sum;
  };
  VectorX entries(nlp_->hessian_pattern().size());
  ASSERT_TRUE(nlp_->Hessian(x_.data(), 0, lambda.data(), entries.data()));
  const VectorX gradient = jacobian_product(x_);
  EXPECT_GT(gradient.norm(), 0.1);
  for (int i = 0; i < 8; ++i) {
    VectorX direction(nlp_->variables());
    for (double& component : direction) component = uniform(random);
    direction.normalize();
    const double step = 1e-5;
    const VectorX up = x_ + step * direction, down = x_ - step * direction;
    // Truncation step² times third derivatives of up to 1e3; rounding 1e-15 / step.
    EXPECT_NEAR(gradient.dot(direction), (value(up) - value(down)) / (2 * step), 1e-7 * (1 + gradient.norm()));
    const VectorX difference = (jacobian_product(up) - jacobian_product(down)) / (2 * step);
    VectorX curved = VectorX::Zero(nlp_->variables());
    for (int e = 0; e < entries.size(); ++e) {
      const int row = nlp_->hessian_pattern().rows[e], column = nlp_->hessian_pattern().columns[e];
      curved(row) += entries(e) * direction(column);
      if (row != column) curved(column) += entries(e) * direction(row);
    }
    EXPECT_GT(curved.norm(), 1e-3);
    EXPECT_LT((curved - difference).norm(), 1e-6 * (1 + difference.norm()));
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, SeparationRowsTest, ::testing::ValuesIn(EveryScheme()));

}  // namespace
}  // namespace rollgait
