// Sensitivities of contact dynamics against differences of order 8 of the equations they are derived from, which use
// values only: inverse dynamics of the judge, Jacobian and right side of the rows.
#include "core/contact/contact_sensitivity.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

#include "core/contact/constrained_dynamics.h"
#include "core/models/catalog.h"
#include "tests/support/contact_tree.h"
#include "tests/support/high_order_difference.h"
#include "tests/support/matrix_near.h"
#include "tests/support/standing_box.h"

namespace rollgait {
namespace {

using testing::ContactTree;
using testing::RandomVector;

const Vector3 kGravity(1.1, -0.6, -9.3);

Baumgarte AllTerms() {
  Baumgarte terms;
  terms.frequency = 2, terms.damping = 0.7, terms.slip_rate = 3;
  return terms;
}

class DifferencedSystem {
 public:
  DifferencedSystem(const Model& model, ContactDynamics* dynamics, const std::vector<FrameMotion>& ground,
                    std::vector<int> active, const Baumgarte& terms, double step = 2e-3)
      : model_(model), dynamics_(*dynamics), ground_(ground), active_(std::move(active)), terms_(terms), step_(step) {}

  // [M −Jᵀ; J 0] [da; dλ] = −d(residual), the right side by differences; columns by q, v and τ.
  void Compare(const VectorX& q, const VectorX& v, const VectorX& tau, const ContactSensitivity& sensitivity) {
    const int nv = model_.nv();
    dynamics_.SetState(q, v, ground_);
    const ConstrainedSolution solution = dynamics_.Accelerate(active_, tau, kGravity, terms_);
    MatrixX jacobian;
    VectorX right;
    dynamics_.AccelerationRows(active_, terms_, &jacobian, &right);
    const MatrixX mass = dynamics_.MassMatrix();
    const int rows = static_cast<int>(right.size());
    const auto residual = [&](const VectorX& q_at, const VectorX& v_at) {
      dynamics_.SetState(q_at, v_at, ground_);
      MatrixX at;
      VectorX needed, wanted, both(nv + rows);
      dynamics_.AccelerationRows(active_, terms_, &at, &wanted);
      dynamics_.dynamics().InverseDynamics(dynamics_.state(), solution.acceleration, kGravity, &workspace_, &needed);
      both << needed - at.transpose() * solution.forces, at * solution.acceleration - wanted;
      return both;
    };
    const double terms = (mass.cwiseAbs() * solution.acceleration.cwiseAbs()).norm() + tau.norm() +
                         (jacobian.cwiseAbs().transpose() * solution.forces.cwiseAbs()).norm() +
                         (jacobian.cwiseAbs() * solution.acceleration.cwiseAbs()).norm();
    int moving = 0;
    const auto check = [&](const VectorX& slope, const auto& acceleration, const auto& forces, const char* by, int j) {
      // The left side of the linear system: no solve, so no condition number between the two.
      VectorX left(nv + rows);
      left << mass * acceleration - jacobian.transpose() * forces, jacobian * acceleration;
      const double size = slope.norm() + (mass.cwiseAbs() * acceleration.cwiseAbs()).norm() +
                          (jacobian.cwiseAbs().transpose() * forces.cwiseAbs()).norm();
      // (step / length)⁸ of the derivative, and rounding of the terms that cancel in the residual over the step.
      EXPECT_TRUE(MatrixNear(left, -slope, 3e-11 * (1 + size) + 1e-14 / step_ * terms)) << "by " << by << " " << j;
      if (slope.norm() > 1e-6) ++moving;
    };
    for (int j = 0; j < nv; ++j) {
      const VectorX unit = VectorX::Unit(nv, j);
      check(HighOrderDifference([&](double h) { return residual(Retract(model_, q, h * unit), v); }, step_),
            sensitivity.acceleration_q.col(j), sensitivity.forces_q.col(j), "q", j);
      check(HighOrderDifference([&](double h) { return residual(q, v + h * unit); }, step_),
            sensitivity.acceleration_v.col(j), sensitivity.forces_v.col(j), "v", j);
      VectorX by_tau = VectorX::Zero(nv + rows);
      by_tau[j] = -1;
      check(by_tau, sensitivity.acceleration_tau.col(j), sensitivity.forces_tau.col(j), "tau", j);
    }
    EXPECT_GT(moving, 2 * nv);  // nothing depends on where a free body is, but on most else
  }

 private:
  const Model& model_;
  ContactDynamics& dynamics_;
  const std::vector<FrameMotion>& ground_;
  const std::vector<int> active_;
  const Baumgarte terms_;
  const double step_;
  BodyDynamics::Workspace workspace_;
};

class ContactSensitivityTest : public ::testing::TestWithParam<unsigned> {
 protected:
  void CheckSensitivity(ContactTree* tree, const std::vector<int>& active, const Baumgarte& terms, double step = 2e-3) {
    ContactDynamics dynamics(BodyDynamics(tree->model), tree->contacts);
    const VectorX tau = RandomVector(tree->random, tree->model.nv());
    dynamics.SetState(tree->q, tree->v, tree->ground);
    ContactSensitivitySolver solver(tree->model, &dynamics);
    const ContactSensitivity sensitivity = solver.Solve(active, tau, kGravity, terms);
    EXPECT_TRUE(sensitivity.exists);
    EXPECT_FALSE(sensitivity.redundant);
    DifferencedSystem(tree->model, &dynamics, tree->ground, active, terms, step)
        .Compare(tree->q, tree->v, tau, sensitivity);
  }
};

TEST_P(ContactSensitivityTest, EveryKindOfContactAtOnce) {
  ContactTree tree(GetParam());
  CheckSensitivity(&tree, {0, 1, 2, 3}, AllTerms());
}

TEST_P(ContactSensitivityTest, OneKindAtATime) {
  for (int k = 0; k < 4; ++k) {
    SCOPED_TRACE(k);
    ContactTree tree(GetParam());
    CheckSensitivity(&tree, {k}, {});
  }
}

TEST_P(ContactSensitivityTest, WithoutContact) {
  ContactTree tree(GetParam());
  CheckSensitivity(&tree, {}, {});
}

TEST_P(ContactSensitivityTest, SuperellipsoidsRollingAndSpinningOnEachOther) {
  ContactTree tree(GetParam());
  tree.contacts[3].surface.surface = Superellipsoid({0.5, 0.7, 0.6}, 0.8, 0.9);
  std::get<PlacedSurface>(tree.contacts[3].other).surface = Superellipsoid({0.9, 0.7, 0.8}, 0.9, 0.7);
  tree.contacts[3].no_spin = true;
  // Their curvature changes within a fifth of the length that that of ellipsoids does.
  CheckSensitivity(&tree, {3}, AllTerms(), 4e-4);
  tree.contacts[3].grip = Grip::kRollingAlong;
  CheckSensitivity(&tree, {3}, AllTerms(), 4e-4);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ContactSensitivityTest, ::testing::Range(1u, 6u));

// Against differences of order 8 of the whole solution, where the system is well conditioned.
TEST(ContactSensitivity, IsTheDerivativeOfTheSolution) {
  ContactTree tree(3);
  const std::vector<int> active = {0, 3};
  ContactDynamics dynamics(BodyDynamics(tree.model), tree.contacts);
  const int nv = tree.model.nv();
  const VectorX tau = RandomVector(tree.random, nv);
  dynamics.SetState(tree.q, tree.v, tree.ground);
  ContactSensitivitySolver solver(tree.model, &dynamics);
  const ContactSensitivity sensitivity = solver.Solve(active, tau, kGravity, AllTerms());
  const auto solve = [&](const VectorX& q, const VectorX& v) {
    dynamics.SetState(q, v, tree.ground);
    const ConstrainedSolution& solution = dynamics.Accelerate(active, tau, kGravity, AllTerms());
    VectorX both(nv + solution.forces.size());
    both << solution.acceleration, solution.forces;
    return both;
  };
  for (int j = 0; j < nv; ++j) {
    const VectorX unit = VectorX::Unit(nv, j);
    const auto at_q = [&](double h) { return solve(Retract(tree.model, tree.q, h * unit), tree.v); };
    const auto at_v = [&](double h) { return solve(tree.q, tree.v + h * unit); };
    const VectorX by_q = HighOrderDifference(at_q, 1e-3), by_v = HighOrderDifference(at_v, 1e-3);
    VectorX exact_q(by_q.size()), exact_v(by_v.size());
    exact_q << sensitivity.acceleration_q.col(j), sensitivity.forces_q.col(j);
    exact_v << sensitivity.acceleration_v.col(j), sensitivity.forces_v.col(j);
    EXPECT_TRUE(MatrixNear(exact_q, by_q, 1e-8 * (1 + by_q.norm()))) << j;
    EXPECT_TRUE(MatrixNear(exact_v, by_v, 1e-8 * (1 + by_v.norm()))) << j;
  }
}

// A box on four points: twelve rows of rank six. Accelerations answer to efforts as those of a box on three points do,
// and the forces of least norm change so that they balance the effort.
TEST(ContactSensitivity, OfRedundantContacts) {
  testing::StandingBox box(Vector3(0.1, 0.2, 0.3));
  ContactDynamics& dynamics = box.dynamics;
  ContactSensitivitySolver solver(box.model, &dynamics);
  const ContactSensitivity all = solver.Solve({0, 1, 2, 3}, VectorX::Zero(6), kGravity, {});
  EXPECT_TRUE(all.redundant);
  EXPECT_LT(all.acceleration_tau.cwiseAbs().maxCoeff(), 1e-12);
  MatrixX rows;
  VectorX right;
  dynamics.AccelerationRows({0, 1, 2, 3}, {}, &rows, &right);
  EXPECT_TRUE(MatrixNear(rows.transpose() * all.forces_tau, -MatrixX::Identity(6, 6), 1e-12));
  const ContactSensitivity three = solver.Solve({0, 1, 2}, VectorX::Zero(6), kGravity, {});
  EXPECT_TRUE(MatrixNear(three.acceleration_v, all.acceleration_v, 1e-11));
}

// Where a superellipsoid is flat there is no curvature: said, not guessed.
TEST(ContactSensitivity, SaysWhereThereIsNone) {
  Joint joint;
  joint.name = "block", joint.type = JointType::kFree, joint.mass = 1;
  joint.inertia = Vector3(0.1, 0.1, 0.1).asDiagonal();
  const Model model = Model::Create({joint}).value();
  std::vector<TreeContact> contacts(1);
  contacts[0].surface = {Superellipsoid({1, 1, 1}, 0.5, 0.5), Vector3::Zero(), Matrix3::Identity()};
  ContactDynamics dynamics(BodyDynamics(model), contacts);
  VectorX q = NeutralConfiguration(model);
  q[6] = 1;
  dynamics.SetState(q, VectorX::Unit(6, 0), {FrameMotion{}});
  EXPECT_FALSE(ContactSensitivitySolver(model, &dynamics).Solve({0}, VectorX::Zero(6), kGravity, {}).exists);
}

// The feet of the models: the judge's dynamics agrees with the general one, and the sensitivities hold.
class FeetTest : public ::testing::TestWithParam<std::pair<const char*, std::vector<int>>> {};

TEST_P(FeetTest, AgreeWithTheJudge) {
  BodyRequest request;
  request.model = GetParam().first;
  request.feet = FootShape::kTwoEllipsoids;
  const Scene scene = BuildScene(request).value();
  std::vector<ContactSurface> surfaces;
  std::vector<TreeContact> contacts;
  std::vector<int> active;
  for (int k : GetParam().second) {
    const ContactSurface& surface = scene.contacts[static_cast<size_t>(k)];
    active.push_back(static_cast<int>(surfaces.size()));
    surfaces.push_back(surface);
    TreeContact contact;
    contact.link = surface.joint;
    contact.surface = {surface.surface, surface.p_LE, surface.R_LE};
    if (surface.directions.size() == 2) contact.grip = Grip::kRollingAlong;
    contacts.push_back(contact);
  }
  const BodyDynamics body(scene.model);
  ConstrainedDynamics judge(body, surfaces);
  ContactDynamics dynamics(body, contacts);
  ContactSensitivitySolver solver(scene.model, &dynamics);
  std::mt19937 random(8);
  const int n = scene.model.size();
  const std::vector<FrameMotion> ground(1);
  for (int i = 0; i < 5; ++i) {
    const VectorX q = RandomVector(random, n, 0.5), v = RandomVector(random, n, 2);
    const VectorX tau = RandomVector(random, n, 50);
    dynamics.SetState(q, v, ground);
    const ContactSensitivity& sensitivity = solver.Solve(active, tau, kGravity, {});
    const ConstrainedSolution& expected = judge.Evaluate(q, v, tau, kGravity);
    // The condition number of the mass matrix is 1e5, that of the mobility of two feet 1e3.
    const VectorX& found = dynamics.solution().acceleration;
    EXPECT_TRUE(MatrixNear(found, expected.acceleration, 1e-9 * (1 + found.cwiseAbs().maxCoeff())));
    for (size_t k = 0; k < surfaces.size(); ++k) {
      const Vector3 force = judge.Force(static_cast<int>(k));
      EXPECT_TRUE(MatrixNear(dynamics.Force(static_cast<int>(k)), force, 1e-9 * (1 + force.norm())));
    }
    DifferencedSystem(scene.model, &dynamics, ground, active, {}).Compare(q, v, tau, sensitivity);
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, FeetTest,
                         ::testing::Values(std::pair("planar", std::vector<int>{0}),
                                           std::pair("planar", std::vector<int>{0, 2}),
                                           std::pair("human29", std::vector<int>{1}),
                                           std::pair("human29", std::vector<int>{0, 3})));

}  // namespace
}  // namespace rollgait
