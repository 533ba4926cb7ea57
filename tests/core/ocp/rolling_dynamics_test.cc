// Forward dynamics on rolling contacts against ConstrainedDynamics, which shares no code with it, and its derivatives against
// differences.
#include "core/ocp/rolling_dynamics.h"

#include <gtest/gtest.h>

#include "core/contact/constrained_dynamics.h"
#include "core/models/catalog.h"
#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

const Vector3 kGravity(1.7, 0.3, -9.6);

struct Case {
  const char* model;
  FootShape feet;
  std::vector<int> active;
};

class RollingDynamicsTest : public ::testing::TestWithParam<Case> {
 protected:
  RollingDynamicsTest() {
    BodyRequest request;
    request.model = GetParam().model;
    request.feet = GetParam().feet;
    scene_ = std::make_unique<Scene>(BuildScene(request).value());
    for (int contact : GetParam().active) active_.push_back(scene_->contacts[contact]);
    n_ = scene_->model.size();
  }
  struct State {
    VectorX q, v, tau;
  };
  State RandomState() {
    return {random_.VectorOf(n_, -0.5, 0.5), random_.VectorOf(n_, -2, 2), random_.VectorOf(n_, -50, 50)};
  }

  std::unique_ptr<Scene> scene_;
  std::vector<ContactSurface> active_;
  int n_ = 0;
  SeededRandom random_{8};
};

TEST_P(RollingDynamicsTest, AgreesWithTheConstrainedDynamicsOfTheJudge) {
  RollingDynamics rolling(scene_->model, active_);
  const BodyDynamics body(scene_->model);
  ConstrainedDynamics constrained(body, active_);
  for (int i = 0; i < 200; ++i) {
    const State at = RandomState();
    rolling.Evaluate(at.q.data(), at.v.data(), at.tau.data(), kGravity);
    const ConstrainedSolution& expected = constrained.Evaluate(at.q, at.v, at.tau, kGravity);
    // The condition number of the mass matrix is 1e5, that of the mobility of two feet 1e3.
    const double scale = 1e-9 * (1 + expected.acceleration.cwiseAbs().maxCoeff());
    ASSERT_TRUE(MatrixNear(rolling.acceleration(), expected.acceleration, scale));
    ASSERT_TRUE(MatrixNear(rolling.forces(), expected.forces, 1e-9 * (1 + expected.forces.cwiseAbs().maxCoeff())));
    ASSERT_GT(expected.forces.cwiseAbs().maxCoeff(), 1);
  }
}

TEST_P(RollingDynamicsTest, DerivativesMeetDifferences) {
  RollingDynamics rolling(scene_->model, active_);
  for (int i = 0; i < 3; ++i) {
    const State at = RandomState();
    rolling.Evaluate(at.q.data(), at.v.data(), at.tau.data(), kGravity);
    rolling.Differentiate();
    const MatrixX da = rolling.acceleration_derivatives(), df = rolling.force_derivatives();
    // Truncation 1e-12 times third derivatives of up to 1e4 of the largest first one, rounding 1e-16 · 1e5 / 1e-6.
    const double step = 1e-6, scale_a = 1e-5 * da.cwiseAbs().maxCoeff(), scale_f = 1e-5 * df.cwiseAbs().maxCoeff();
    for (int j = 0; j < 3 * n_; ++j) {
      const auto moved = [&](double by) {
        State to = at;
        (j < n_ ? to.q : j < 2 * n_ ? to.v : to.tau)(j % n_) += by;
        rolling.Evaluate(to.q.data(), to.v.data(), to.tau.data(), kGravity);
        return std::pair<VectorX, VectorX>(rolling.acceleration(), rolling.forces());
      };
      const auto up = moved(step), down = moved(-step);
      EXPECT_TRUE(MatrixNear((up.first - down.first) / (2 * step), da.col(j), scale_a)) << j;
      EXPECT_TRUE(MatrixNear((up.second - down.second) / (2 * step), df.col(j), scale_f)) << j;
    }
    EXPECT_GT(df.cwiseAbs().maxCoeff(), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, RollingDynamicsTest,
                         ::testing::Values(Case{"planar", FootShape::kOneEllipsoid, {0}},
                                           Case{"planar", FootShape::kOneEllipsoid, {0, 1}},
                                           Case{"human29", FootShape::kOneEllipsoid, {1}},
                                           Case{"human29", FootShape::kOneEllipsoid, {0, 1}},
                                           Case{"human29", FootShape::kTwoEllipsoids, {0, 3}}));

TEST(RollingDynamics, WithoutContactIsForwardDynamics) {
  BodyRequest request;
  request.model = "human29";
  const Scene scene = BuildScene(request).value();
  RollingDynamics rolling(scene.model, {});
  TreeDynamics tree(scene.model);
  SeededRandom random(9);
  const VectorX q = random.VectorOf(29, -1, 1), v = random.VectorOf(29, -1, 1), tau = random.VectorOf(29, -10, 10);
  VectorX expected(29);
  rolling.Evaluate(q.data(), v.data(), tau.data(), kGravity);
  rolling.Differentiate();
  tree.ForwardDynamics(q.data(), v.data(), tau.data(), kGravity, expected.data());
  EXPECT_EQ(rolling.acceleration(), expected);
  MatrixX mass = MatrixX::Zero(29, 29);
  tree.MassMatrix(q.data(), mass);
  EXPECT_TRUE(MatrixNear(mass * rolling.acceleration_derivatives().rightCols(29), MatrixX::Identity(29, 29), 1e-10));
}

}  // namespace
}  // namespace rollgait
