#ifndef ROLLGAIT_TESTS_PAPER_CONTACT_SOLUTION_H_
#define ROLLGAIT_TESTS_PAPER_CONTACT_SOLUTION_H_

#include "core/contact/constrained_dynamics.h"
#include "tests/paper/rolling_tree.h"

namespace rollgait {

// Forward dynamics of the rolling tree with its terms in the notation of eq. (3.8), evaluated one by one.
struct ContactSolution {
  ContactSolution() {
    const Vector3 gravity(0.9, -0.4, -9.7);
    tau = testing::RandomVector(tree.random, RollingTree::kSize, 20);
    const BodyDynamics::State state = tree.StateAt(0);
    BodyDynamics::Workspace workspace;
    tree.dynamics.MassMatrix(state, &workspace, &mass);
    tree.dynamics.BiasForce(state, gravity, &workspace, &bias);
    jacobian = tree.Jacobian();
    gamma = tree.ContactAt(0).drift;
    ConstrainedDynamics constrained(tree.dynamics, {tree.surface});
    const ConstrainedSolution& solution = constrained.Evaluate(tree.q, tree.v, tau, gravity);
    acceleration = solution.acceleration;
    lambda = solution.forces;
  }

  RollingTree tree;
  MatrixX mass, jacobian;
  VectorX bias, tau, acceleration, lambda;
  Vector3 gamma;
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_PAPER_CONTACT_SOLUTION_H_
