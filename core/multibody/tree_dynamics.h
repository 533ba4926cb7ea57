#ifndef ROLLGAIT_CORE_MULTIBODY_TREE_DYNAMICS_H_
#define ROLLGAIT_CORE_MULTIBODY_TREE_DYNAMICS_H_

#include <vector>

#include "core/multibody/model.h"
#include "core/multibody/row_hessians.h"
#include "core/multibody/spatial.h"
#include "core/multibody/tree_factor.h"

namespace rollgait {

// Inverse dynamics  ID(q, v, a) = M(q) a + b(q, v)  of a tree, springs and dampers of its joints included in b, with
// its exact first derivatives and the Hessian of  λᵀ ID, all from one pass of world-frame spatial quantities; its mass
// matrix, and forward dynamics by factorising that. Derivation: docs/explanation/derivatives.md; in short, turning
// joint k moves everything beyond it rigidly, so every derivative along joint m is one linear map of three six-vectors:
//   ψ̇_m = V_p(m) × S_m,  ψ̈_m = A_p(m) × S_m + V_p(m) × ψ̇_m,  ω_m = W_p(m) × S_m,   W = Σ S λ  ("virtual velocity").
// Cost O(n d) for tree depth d (factorising: O(n d²)), no allocation after construction. What Update leaves out is made
// when it is first asked for. Not thread-safe: one object a thread. Contract: no free joints.
class TreeDynamics {
 public:
  explicit TreeDynamics(const Model& model);

  int size() const { return n_; }
  const Model& model() const { return *model_; }

  // Evaluates the tree at (q, v, a), n values each, with gravity (m/s², world axes). Everything below refers to this
  // point.
  void Update(const double* q, const double* v, const double* a, const Vector3& gravity);
  // Evaluates an impact: the tree at rest at q (n), whose velocities change by `change` (n) in no time. Forces of
  // finite size have no impulse, so InverseDynamics and its derivatives are then those of M(q) · change alone, N m s or
  // N s: neither gravity nor springs and dampers are in them.
  void UpdateImpact(const double* q, const double* change);
  // The part of Update that contact kinematics needs: poses, axes, velocities.
  void UpdateKinematics(const double* q, const double* v);

  // τ (n) = ID(q, v, a), N m or N; after UpdateImpact impulses.
  void InverseDynamics(double* tau);

  // ∂ID/∂q, ∂ID/∂v, ∂ID/∂a = M; each n × n, written where (row, column) are related, zero elsewhere on entry and exit.
  void FirstDerivatives(Eigen::Ref<MatrixX> dq, Eigen::Ref<MatrixX> dv, Eigen::Ref<MatrixX> da);

  // Adds the second derivatives of  λᵀ ID(q, v, a)  to n × n blocks: H_qq and H_vv symmetric and full, H_qv (row q,
  // column v), H_qa (row q, column a). H_va and H_aa are zero. Cheaper for a λ that is zero on some branches.
  void AddContractedHessian(const double* lambda, Eigen::Ref<MatrixX> h_qq, Eigen::Ref<MatrixX> h_qv,
                            Eigen::Ref<MatrixX> h_qa, Eigen::Ref<MatrixX> h_vv);

  // Second derivatives of every row of ID; each written where row and both variables are on one path, zero elsewhere on
  // entry and exit.
  void SecondDerivatives(RowHessians* rows);

  // M(q), both triangles, written as in FirstDerivatives. Moves the tree to (q, at rest): Update before anything else.
  void MassMatrix(const double* q, Eigen::Ref<MatrixX> mass);

  // a (n) = M⁻¹ (τ − b(q, v)) for generalized forces τ (n). Moves the tree to (q, v, 0) and factorises its mass matrix.
  // Contract: M is positive definite.
  void ForwardDynamics(const double* q, const double* v, const double* tau, const Vector3& gravity, double* a);
  // World pose of link i and its twist, joint axes, spatial accelerations (gravity included as −g at the root).
  const Matrix3& rotation(int i) const { return rotation_[i]; }
  const Vector3& origin(int i) const { return origin_[i]; }
  const Vector6& axis(int i) const { return axis_[i]; }
  const Vector6& twist(int i) const { return twist_[i]; }
  const Vector6& acceleration(int i) const { return acceleration_[i]; }

 private:
  // What never changes of a joint and its link.
  struct JointData {
    int parent;
    bool turns, slides, massive;  // slides: advance is not zero
    double advance;               // m by unit of the position, see JointKind
    bool aligned;                 // R_PJ is the identity and the axis is ± a coordinate axis
    int axis_index;               // of an aligned joint
    double axis_sign;
    Vector3 p_PJ, axis, center_of_mass;
    Matrix3 R_PJ, inertia;
    double mass;
  };
  // A joint with a spring or a damper, and what it exerts at the point of evaluation, N m or N.
  struct JointSpring {
    int joint;
    double stiffness, rest, damping;
    double force = 0;
  };
  // Subtree quantities of one joint.
  struct Composite {
    SpatialInertia inertia;
    CompositeMotion motion;
  };
  // The same for the virtual velocity W: momentum P, the moment Z = BᵀW, and E X = [e x_ω − 2 P_v × x_v; 0].
  struct VirtualComposite {
    Vector6 momentum = Vector6::Zero();
    Vector3 z = Vector3::Zero();
    Matrix3 e = Matrix3::Zero();
  };
  // The joints from the root to a leaf, and (18 × their number, filled up to a multiple of four) their S, ψ̇, ψ̈.
  struct Path {
    std::vector<int> joints;
    RowMajorMatrix vectors;
  };
  void UpdatePose(int i, double q);
  void Slide(int i, double q, const Vector3& axis_W);
  void UpdateAccelerations(const double* v, const double* a, const Vector3& gravity);
  void UpdateForces();
  void UpdateInertias();
  void UpdateComposites();
  void UpdateVirtual(const double* lambda);
  void DifferentiateRow(int l, RowHessians* rows);
  void DifferentiateRowsBefore(int k, RowHessians* rows);

  const Model* model_;
  int n_;
  std::vector<JointData> joints_;
  std::vector<JointSpring> springs_;
  bool springs_act_ = true;  // not in an impact
  bool has_forces_ = false, has_composites_ = false;
  std::vector<Matrix3> rotation_;
  std::vector<Vector3> origin_;
  std::vector<Vector6> axis_, twist_, acceleration_, psi_, psi2_, force_;  // force_: of the subtree
  std::vector<SpatialInertia> link_inertia_;
  std::vector<Composite> composite_;
  std::vector<Vector6> virtual_twist_, omega_;
  std::vector<VirtualComposite> virtual_;
  std::vector<char> moves_,
      touched_;  // joints with a virtual velocity; joints of which a derivative may differ from zero
  std::vector<Path> paths_;
  std::vector<int> path_of_, depth_;  // of a joint: a path on which it is, and its place there
  Vector6 root_acceleration_ = Vector6::Zero();
  TreeFactor factor_;
  VectorX scratch_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MULTIBODY_TREE_DYNAMICS_H_
