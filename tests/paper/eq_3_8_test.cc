// Eqs (3.8) and (3.9): M q̈ + b = Sᵀτ + Jᵀλ with J q̈ + γ = 0, as printed; λ is the force on the body. The solution of
// the library's saddle-point solver satisfies both.
#include <gtest/gtest.h>

#include "tests/paper/contact_solution.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

TEST(Equation3_8, SolutionSatisfiesDynamicsAndConstraint) {
  const ContactSolution s;
  EXPECT_TRUE(MatrixNear(s.mass * s.acceleration + s.bias, s.tau + s.jacobian.transpose() * s.lambda, 1e-10));
  EXPECT_TRUE(MatrixNear(s.jacobian * s.acceleration + s.gamma, Vector3::Zero(), 1e-10));
  EXPECT_GT(s.lambda.norm(), 1);
}

TEST(Equation3_9, AccelerationFollowsFromTheContactForce) {
  const ContactSolution s;
  const VectorX q_ddot = s.mass.llt().solve(s.tau - s.bias + s.jacobian.transpose() * s.lambda);
  EXPECT_TRUE(MatrixNear(q_ddot, s.acceleration, 1e-10));
}

}  // namespace
}  // namespace rollgait
