#ifndef ROLLGAIT_CORE_OCP_ROLLING_DYNAMICS_H_
#define ROLLGAIT_CORE_OCP_ROLLING_DYNAMICS_H_

#include <vector>

#include <Eigen/Cholesky>

#include "core/contact/contact_derivatives.h"
#include "core/multibody/tree_dynamics.h"

namespace rollgait {

// Explicit dynamics of a tree whose contacts roll on the plane z = 0: accelerations a and contact forces f from
//   M a − Jᵀ f = τ − b,   J a + γ = 0                                 (eqs (3.8) to (3.10); contact-math 7)
// with all first derivatives. Holds the acceleration level only: gap and slip of the state are carried on. Forces may pull
// and leave every cone: the caller checks. No allocation after construction; one object a thread.
// Contract of every method: the rows of J are independent (of two contacts on one link drop a direction of one), M is
// positive definite. `active` are contacts of the model; each contributes a row per direction.
class RollingDynamics {
 public:
  RollingDynamics(const Model& model, std::vector<ContactSurface> active);

  int size() const { return n_; }
  int rows() const { return rows_; }

  // Evaluates at q, v (n values each) with generalized forces tau (n; N m, N) and gravity (m/s², world axes).
  void Evaluate(const double* q, const double* v, const double* tau, const Vector3& gravity);
  const VectorX& acceleration() const { return acceleration_; }  // n, rad/s² or m/s²
  const VectorX& forces() const { return forces_; }              // rows, N, on the tree

  // Derivatives of the last Evaluate, as  [∂/∂q  ∂/∂v  ∂/∂τ]: n × 3n of a and rows × 3n of f. Valid until the next call.
  void Differentiate();
  const RowMajorMatrix& acceleration_derivatives() const { return d_acceleration_; }
  const RowMajorMatrix& force_derivatives() const { return d_forces_; }

 private:
  struct Contact {
    ContactSurface surface;
    int first_row;
    ContactDerivatives<Dual> along;  // carried along (v, a)
    ContactDerivatives<Dual>::Field field;
    std::vector<Dual> path_u;
  };
  void AddRows(const Contact& contact, const Vector3& gravity);
  void AddContactDerivatives(Contact& contact);

  int n_, rows_ = 0;
  TreeDynamics tree_;
  std::vector<Contact> contacts_;
  Vector3 gravity_ = Vector3::Zero();
  VectorX q_, v_, acceleration_, forces_, drift_;
  RowMajorMatrix jacobian_, response_;  // J (rows × n), X = M⁻¹ Jᵀ (n × rows)
  Eigen::LLT<MatrixX> mobility_;        // G = J X
  MatrixX gram_, dq_, dv_, da_;
  RowMajorMatrix d_acceleration_, d_forces_, d_rolling_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_ROLLING_DYNAMICS_H_
