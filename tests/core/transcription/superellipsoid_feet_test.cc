// Programs of bodies on feet of superellipsoids: all their derivatives, where feet stand level, too.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/transcription/collocation_nlp.h"
#include "tests/core/transcription/planar_request.h"

namespace rollgait {
namespace {

struct FeetCase {
  const char* name;
  double exponent;
  bool in_space;
};

void PrintTo(const FeetCase& feet, std::ostream* out) { *out << feet.name; }

class SuperellipsoidFeetTest : public ::testing::TestWithParam<FeetCase> {
 protected:
  SuperellipsoidFeetTest() {
    GaitRequest request;
    if (GetParam().in_space) {
      request.body.model = "human29";
    } else {
      request = PlanarRequestWithEveryTerm();
    }
    request.body.feet = FootShape::kTwoEllipsoids;
    request.body.changes.foot_exponents = {{"heel", GetParam().exponent}, {"forefoot", GetParam().exponent}};
    spec_ = std::make_unique<GaitSpec>(CheckRequest(request).value());
    problem_ = BuildProblem(*spec_);
    for (int p = 0; p < static_cast<int>(problem_->pairs.size()); ++p) {
      const std::string name = spec_->scene.PairName(p);
      if (name == "left_heel / right_heel" || name == "left_shank / right_heel") added_.separated.push_back(p);
    }
    const Mesh mesh = Mesh::Uniform(std::vector<int>(problem_->phases.size(), 1));
    nlp_ = std::make_unique<CollocationNlp>(*problem_, Scheme::kRadau2, mesh, added_);
    x_ = nlp_->MakeStart(WalkingGuess(*spec_, *problem_));
  }

  // λᵀ J + σ ∇f
  VectorX LagrangianGradient(const VectorX& x, double sigma, const VectorX& lambda) {
    VectorX values(nlp_->jacobian_pattern().size()), gradient(nlp_->variables());
    EXPECT_TRUE(nlp_->Gradient(x.data(), gradient.data()));
    gradient *= sigma;
    EXPECT_TRUE(nlp_->Jacobian(x.data(), values.data()));
    for (int e = 0; e < values.size(); ++e) {
      gradient(nlp_->jacobian_pattern().columns[e]) += lambda(nlp_->jacobian_pattern().rows[e]) * values(e);
    }
    return gradient;
  }
  double Lagrangian(const VectorX& x, double sigma, const VectorX& lambda) {
    VectorX rows(nlp_->constraints());
    EXPECT_TRUE(nlp_->Constraints(x.data(), rows.data()));
    double objective = 0;
    EXPECT_TRUE(nlp_->Objective(x.data(), &objective));
    return sigma * objective + lambda.dot(rows);
  }

  std::unique_ptr<GaitSpec> spec_;
  std::unique_ptr<OptimalControlProblem> problem_;
  AddedConstraints added_;
  std::unique_ptr<CollocationNlp> nlp_;
  VectorX x_;
};

TEST_P(SuperellipsoidFeetTest, DerivativesMeetDifferences) {
  EXPECT_EQ(added_.separated.size(), GetParam().in_space ? 2u : 0u);
  for (const ContactSurface& contact : spec_->scene.contacts) {
    EXPECT_NE(contact.surface.plain<SmoothSuperellipsoid>(), nullptr) << contact.name;
  }
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  VectorX lambda(nlp_->constraints());
  for (double& value : lambda) value = uniform(random);
  const double sigma = 0.7;
  // At the guess, where feet stand level in the plane, and beside it.
  for (const double noise : {0.0, 0.02}) {
    for (double& value : x_) value += noise * uniform(random);
    VectorX entries(nlp_->hessian_pattern().size());
    ASSERT_TRUE(nlp_->Hessian(x_.data(), sigma, lambda.data(), entries.data()));
    ASSERT_TRUE(entries.allFinite());
    const VectorX gradient = LagrangianGradient(x_, sigma, lambda);
    EXPECT_GT(gradient.norm(), 0.1);
    for (int i = 0; i < 8; ++i) {
      VectorX direction(nlp_->variables());
      for (double& component : direction) component = uniform(random);
      direction.normalize();
      const double step = 1e-6;
      const VectorX up = x_ + step * direction, down = x_ - step * direction;
      const double difference = (Lagrangian(up, sigma, lambda) - Lagrangian(down, sigma, lambda)) / (2 * step);
      EXPECT_NEAR(gradient.dot(direction), difference, 1e-6 * (1 + gradient.norm()));
      const VectorX turn =
          (LagrangianGradient(up, sigma, lambda) - LagrangianGradient(down, sigma, lambda)) / (2 * step);
      VectorX curved = VectorX::Zero(nlp_->variables());
      for (int e = 0; e < entries.size(); ++e) {
        const int row = nlp_->hessian_pattern().rows[e], column = nlp_->hessian_pattern().columns[e];
        curved(row) += entries(e) * direction(column);
        if (row != column) curved(column) += entries(e) * direction(row);
      }
      EXPECT_GT(curved.norm(), 1e-3);
      EXPECT_LT((curved - turn).norm(), 1e-5 * (1 + turn.norm()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Feet, SuperellipsoidFeetTest,
                         ::testing::Values(FeetCase{"BoxyInThePlane", 0.6, false},
                                           FeetCase{"PointedInThePlane", 1.6, false},
                                           FeetCase{"BoxyInSpace", 0.6, true}, FeetCase{"PointedInSpace", 1.6, true}),
                         [](const auto& feet) { return std::string(feet.param.name); });

}  // namespace
}  // namespace rollgait
