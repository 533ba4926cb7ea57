#ifndef ROLLGAIT_CORE_MULTIBODY_TREE_DYNAMICS_H_
#define ROLLGAIT_CORE_MULTIBODY_TREE_DYNAMICS_H_

#include <vector>

#include "core/multibody/model.h"
#include "core/multibody/spatial.h"

namespace rollgait {

// Inverse dynamics  ID(q, v, a) = M(q) a + b(q, v)  of a tree with its exact first derivatives and the Hessian of  λᵀ ID,
// all from one pass of world-frame spatial quantities. The derivation is in docs/derivatives.md; in short, turning joint k
// moves everything beyond it rigidly, so every derivative along joint m is one linear map of three six-vectors:
//   ψ̇_m = V_p(m) × S_m,  ψ̈_m = A_p(m) × S_m + V_p(m) × ψ̇_m,  ω_m = W_p(m) × S_m,   W = Σ S λ  ("virtual velocity").
// Cost O(n d) for tree depth d, no allocation after construction. Not thread-safe: one object a thread.
class TreeDynamics {
 public:
  explicit TreeDynamics(const Model& model);

  int size() const { return n_; }
  const Model& model() const { return *model_; }

  // Evaluates the tree at (q, v, a), n values each, with gravity (m/s², world axes). Everything below refers to this point.
  void Update(const double* q, const double* v, const double* a, const Vector3& gravity);
  // The part of Update that contact kinematics needs: poses, axes, velocities.
  void UpdateKinematics(const double* q, const double* v);

  // τ (n) = ID(q, v, a), N m or N.
  void InverseDynamics(double* tau) const;

  // ∂ID/∂q, ∂ID/∂v, ∂ID/∂a = M; each n × n, written where (row, column) are related, zero elsewhere on entry and exit.
  void FirstDerivatives(Eigen::Ref<MatrixX> dq, Eigen::Ref<MatrixX> dv, Eigen::Ref<MatrixX> da);

  // Adds the second derivatives of  λᵀ ID(q, v, a)  to n × n blocks: H_qq and H_vv symmetric and full, H_qv (row q, column v),
  // H_qa (row q, column a). H_va and H_aa are zero.
  void AddContractedHessian(const double* lambda, Eigen::Ref<MatrixX> h_qq, Eigen::Ref<MatrixX> h_qv,
                            Eigen::Ref<MatrixX> h_qa, Eigen::Ref<MatrixX> h_vv);

  // World pose of link i and its twist, joint axes, spatial accelerations (gravity included as −g at the root).
  const Matrix3& rotation(int i) const { return rotation_[i]; }
  const Vector3& origin(int i) const { return origin_[i]; }
  const Vector6& axis(int i) const { return axis_[i]; }
  const Vector6& twist(int i) const { return twist_[i]; }
  const Vector6& acceleration(int i) const { return acceleration_[i]; }

 private:
  // Composite (subtree) quantities of one joint. B X = [b x_ω; −2 p × x_ω] is the Coriolis operator of the subtree,
  // p its linear momentum.
  struct Composite {
    SpatialInertia inertia;
    Matrix3 coriolis = Matrix3::Zero();
    Vector3 momentum = Vector3::Zero();
    Vector6 force = Vector6::Zero();
  };
  // The same for the virtual velocity W: momentum P, Z = BᵀW, and E X = [e x_ω − 2 P_v × x_v; 0].
  struct VirtualComposite {
    Vector6 momentum = Vector6::Zero();
    Vector6 z = Vector6::Zero();
    Matrix3 e = Matrix3::Zero();
  };

  Vector6 ApplyCoriolis(const Composite& c, const Vector6& x) const;
  Vector6 ApplyCoriolisTranspose(const Composite& c, const Vector6& w) const;
  void UpdateComposites();
  void UpdateVirtual(const double* lambda);

  const Model* model_;
  int n_;
  std::vector<int> parent_;
  std::vector<char> has_mass_;
  std::vector<Matrix3> rotation_;
  std::vector<Vector3> origin_;
  std::vector<Vector6> axis_, twist_, acceleration_, psi_, psi2_;
  std::vector<SpatialInertia> link_inertia_;
  std::vector<Composite> composite_;
  std::vector<Vector6> virtual_twist_, omega_;
  std::vector<VirtualComposite> virtual_;
  Vector6 root_acceleration_ = Vector6::Zero();
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MULTIBODY_TREE_DYNAMICS_H_
