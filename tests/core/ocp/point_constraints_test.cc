// Every constraint of a walker on its own, in the plane and in space, with feet of one and of two surfaces: derivatives
// against differences, patterns against what is delivered.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>
#include <set>
#include <string>

#include "core/gait/build_problem.h"
#include "core/ocp/constraints/contact_point.h"
#include "core/ocp/constraints/force_shares.h"

namespace rollgait {
namespace {

// Tree and contacts at any z.
class Evaluator {
 public:
  explicit Evaluator(const OptimalControlProblem& problem) : problem_(problem), tree_(problem.model) {
    for (const ContactSurface& contact : problem.contacts) {
      contacts_.emplace_back(problem.model, contact);
      dual_contacts_.emplace_back(problem.model, contact);
    }
  }
  PointContext At(const VectorX& z) {
    const int n = problem_.model.size();
    tree_.Update(z.data(), z.data() + n, z.data() + 2 * n, problem_.gravity);
    for (size_t c = 0; c < contacts_.size(); ++c) {
      contacts_[c].Update(tree_);
      contacts_[c].UpdateSecond();
      dual_contacts_[c].Update(tree_);
      dual_contacts_[c].UpdateSecond();
    }
    return {z.data(), &tree_, &contacts_, &dual_contacts_};
  }

 private:
  const OptimalControlProblem& problem_;
  TreeDynamics tree_;
  std::vector<ContactDerivatives<double>> contacts_;
  std::vector<ContactDerivatives<Dual>> dual_contacts_;
};

struct Body {
  const char* model;
  FootShape feet;
};

class PointConstraintsTest : public ::testing::TestWithParam<Body> {
 protected:
  std::unique_ptr<OptimalControlProblem> Problem() {
    GaitRequest request;
    request.body.model = GetParam().model;
    request.body.feet = GetParam().feet;
    request.slope = 0.1;
    request.motion.speed = 1.3;
    request.ground_contact.touch_down_point = GaitRequest::Range{-0.95, -0.2};
    request.ground_contact.lift_off_point = GaitRequest::Range{0.2, 0.95};
    return BuildProblem(CheckRequest(request).value());
  }

  bool TwoSurfaces() const { return GetParam().feet == FootShape::kTwoEllipsoids; }

  void CheckDerivatives(PointConstraint& constraint, int size) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-0.4, 0.4);
    VectorX z(size), lambda(constraint.rows());
    for (double& value : z) value = uniform(random);
    for (double& value : lambda) value = uniform(random);
    const auto values_at = [&](const VectorX& at) {
      VectorX g(constraint.rows());
      constraint.Value(evaluator_.At(at), g.data());
      return g;
    };
    const auto jacobian_at = [&](const VectorX& at) {
      MatrixX jacobian = MatrixX::Zero(constraint.rows(), size);
      constraint.Jacobian(evaluator_.At(at), jacobian);
      return jacobian;
    };
    const MatrixX jacobian = jacobian_at(z);
    MatrixX hessian = MatrixX::Zero(size, size);
    constraint.AddHessian(evaluator_.At(z), lambda.data(), hessian);
    const double step = 1e-5;
    for (int i = 0; i < size; ++i) {
      VectorX up = z, down = z;
      up(i) += step;
      down(i) -= step;
      const VectorX column = (values_at(up) - values_at(down)) / (2 * step);
      const VectorX curvature = (jacobian_at(up) - jacobian_at(down)).transpose() * lambda / (2 * step);
      // Rounding 1e-16/step times values of up to 1e3; truncation step² times third derivatives.
      EXPECT_LT((jacobian.col(i) - column).cwiseAbs().maxCoeff(), 1e-7 * (1 + column.cwiseAbs().maxCoeff()))
          << constraint.Name(0) << " by " << i;
      const double size_of_curvature = 1 + curvature.cwiseAbs().maxCoeff();
      for (int j = 0; j <= i; ++j) {
        EXPECT_NEAR(hessian(j, i), curvature(j), 1e-7 * size_of_curvature)
            << constraint.Name(0) << " " << j << " " << i;
      }
    }
    CheckPatterns(constraint, jacobian, hessian);
  }

  static void CheckPatterns(const PointConstraint& constraint, const MatrixX& jacobian, const MatrixX& hessian) {
    const Entries first = constraint.JacobianPattern(), second = constraint.HessianPattern();
    const std::set<std::pair<int, int>> rows(first.begin(), first.end());
    std::set<std::pair<int, int>> pairs(second.begin(), second.end());
    for (const auto& [a, b] : second) pairs.emplace(b, a);
    EXPECT_EQ(rows.size(), first.size()) << "an entry of " << constraint.Name(0) << " occurs twice";
    for (int j = 0; j < jacobian.cols(); ++j) {
      for (int r = 0; r < jacobian.rows(); ++r) EXPECT_TRUE(jacobian(r, j) == 0 || rows.count({r, j}) == 1);
      for (int i = 0; i < hessian.rows(); ++i) EXPECT_TRUE(hessian(i, j) == 0 || pairs.count({i, j}) == 1);
    }
  }

  const std::unique_ptr<OptimalControlProblem> problem_ = Problem();
  Evaluator evaluator_{*problem_};
};

TEST_P(PointConstraintsTest, DerivativesOfTheRowsOfEveryPhase) {
  int checked = 0;
  for (int phase = 0; phase < static_cast<int>(problem_->phases.size()); ++phase) {
    for (const PointKind kind : {PointKind::kCollocation, PointKind::kNode, PointKind::kStage}) {
      for (const auto& constraint : problem_->PointConstraints(phase, kind)) {
        CheckDerivatives(*constraint, problem_->Layout(phase).size());
        ++checked;
      }
    }
  }
  EXPECT_GE(checked, 11);
}

TEST_P(PointConstraintsTest, DerivativesOfTheRowsOfAJump) {
  problem_->plastic_touch_down = true;
  int approaches = 0;
  for (int phase = 0; phase < static_cast<int>(problem_->phases.size()); ++phase) {
    if (!problem_->Jumps(phase)) continue;
    for (const auto& constraint : problem_->JumpConstraints(phase)) {
      if (constraint->Name(0).starts_with("approach")) {
        CheckDerivatives(*constraint, problem_->JumpLayout(phase).size());
        ++approaches;
      }
    }
  }
  EXPECT_EQ(approaches, TwoSurfaces() ? 2 : 1);
}

TEST_P(PointConstraintsTest, DerivativesOfTheEntryRows) {
  int checked = 0;
  for (int phase = 0; phase < static_cast<int>(problem_->phases.size()); ++phase) {
    for (const auto& constraint : problem_->EntryConstraints(phase)) {
      CheckDerivatives(*constraint, 3 * problem_->model.size());
      ++checked;
    }
  }
  // For every touch-down gap, rest and point; for every lift-off a point.
  EXPECT_EQ(checked, TwoSurfaces() ? 8 : 4);
}

// Two surfaces of one rigid foot: the second is not held along x, which the first holds already. The rows that are left
// are independent of each other.
TEST_P(PointConstraintsTest, RollingRowsOfAPhaseAreIndependent) {
  const int n = problem_->model.size();
  for (int phase = 0; phase < static_cast<int>(problem_->phases.size()); ++phase) {
    const PointLayout layout = problem_->Layout(phase);
    VectorX z = VectorX::Zero(layout.size());
    for (int j = 0; j < layout.n; ++j) z(j) = problem_->model.joint(j).name.starts_with("knee") ? 0.3 : 0.02 * j;
    MatrixX rolling(0, layout.size());
    int shares = 0;
    for (const auto& constraint : problem_->PointConstraints(phase, PointKind::kCollocation)) {
      if (constraint->Name(0).starts_with("share")) shares += constraint->rows();
      if (!constraint->Name(0).starts_with("rolling")) continue;
      MatrixX rows = MatrixX::Zero(constraint->rows(), layout.size());
      constraint->Jacobian(evaluator_.At(z), rows);
      MatrixX all(rolling.rows() + rows.rows(), layout.size());
      all << rolling, rows;
      rolling = all;
    }
    // Every force is determined by a rolling row, or by its share of the force of a foot along x.
    ASSERT_EQ(rolling.rows() + shares, layout.forces);
    const MatrixX velocity = rolling.middleCols(layout.v(), n);
    const Eigen::SelfAdjointEigenSolver<MatrixX> solver(velocity * velocity.transpose());
    EXPECT_GT(solver.eigenvalues()(0), 1e-4) << "phase " << phase;  // 1 cm of lever, squared
    if (TwoSurfaces() && phase == 2) {
      EXPECT_EQ(layout.forces, GetParam().model == std::string("planar") ? 4 : 6);
      EXPECT_EQ(shares, 1);
    }
  }
}

TEST_P(PointConstraintsTest, ClearanceLeavesTheGroundAndMeetsItWithoutVelocityOrAcceleration) {
  GapConstraint gap(problem_->model, problem_->contacts, 0, problem_->Layout(0), GapConstraint::Kind::kClearance, 0.02);
  double lower, upper;
  gap.Bounds(0.5, &lower, &upper);
  EXPECT_DOUBLE_EQ(lower, 0.02);
  EXPECT_EQ(upper, kInfinity);
  gap.Bounds(0.25, &lower, &upper);
  EXPECT_DOUBLE_EQ(lower, 0.02 * 27 / 64);
  gap.Bounds(1, &lower, &upper);
  EXPECT_EQ(lower, 0);
  // Less than any parabola that starts with a horizontal tangent: no surface that rolls and then swings is in its way.
  for (const double near : {1e-3, 1e-5}) {
    for (const double fraction : {near, 1 - near}) {
      gap.Bounds(fraction, &lower, &upper);
      EXPECT_GT(lower, 0);
      EXPECT_LT(lower, 64.1 * 0.02 * near * near * near);
    }
  }
}

// 30 N along x on normal forces of 60 and 20 N: 22.5 and 7.5 N; a surface without normal force bears nothing.
TEST_P(PointConstraintsTest, SurfacesOfOneLinkShareTheForceAlongXByTheirNormalForces) {
  std::vector<ContactSurface> contacts(2);
  PointLayout layout;
  layout.forces = 6;
  const std::vector<ActiveContact> active = {{0, 0, {0, 1, 2}}, {1, 3, {0, 1, 2}}};
  const auto shares = MakeForceShares(contacts, active, layout, 1);
  ASSERT_TRUE(shares);
  ASSERT_EQ(shares->rows(), 1);
  VectorX z(6);
  double g;
  const auto value = [&](double x_1, double n_1, double x_2, double n_2) {
    z << x_1, 5, n_1, x_2, -3, n_2;
    shares->Value({z.data()}, &g);
    return g;
  };
  EXPECT_NEAR(value(22.5, 60, 7.5, 20), 0, 1e-12);
  EXPECT_NEAR(value(0, 0, 30, 80), 0, 1e-12);
  EXPECT_NEAR(value(30, 60, 0, 20), -600, 1e-12);
  // To 1e-5 of the square of the weight, so that rows of the cones may touch it.
  double lower, upper;
  MakeForceShares(contacts, active, layout, 800)->Bounds(0, &lower, &upper);
  EXPECT_DOUBLE_EQ(lower, -6.4);
  EXPECT_DOUBLE_EQ(upper, 6.4);
  contacts[1].joint = 1;
  EXPECT_FALSE(MakeForceShares(contacts, active, layout, 1));
}

INSTANTIATE_TEST_SUITE_P(Bodies, PointConstraintsTest,
                         ::testing::Values(Body{"planar", FootShape::kOneEllipsoid},
                                           Body{"planar", FootShape::kTwoEllipsoids},
                                           Body{"human29", FootShape::kOneEllipsoid},
                                           Body{"human29", FootShape::kTwoEllipsoids}));

}  // namespace
}  // namespace rollgait
