#ifndef ROLLGAIT_CORE_MULTIBODY_MOTION_DERIVATIVES_H_
#define ROLLGAIT_CORE_MULTIBODY_MOTION_DERIVATIVES_H_

#include <vector>

#include "core/multibody/body_dynamics.h"
#include "core/multibody/model.h"
#include "core/multibody/spatial.h"

namespace rollgait {

// ID(q, v, a), its exact first derivatives (that by a is M) and those of the motion of every link along the tangent
// directions of q and along v, for any tree: free joints count six columns S_c that are fixed in the link's axes. Along
// column c of joint k, with parent p, in the frame that moves with what is beyond k (docs/explanation/derivatives.md;
// six-vectors in world axes at a point of the world close to the tree, so that they keep their digits far from the
// world's origin):
//   by q:  δV_i = ψ̇_c,  δA_i = ψ̈_c − V_i × ψ̇_c      ψ̇_c = V_p × S_c,  ψ̈_c = A_p × S_c + V_p × ψ̇_c
//   by v:  δV_i = S_c,  δA_i = ψ̇_c + Ṡ_c − V_i × S_c    Ṡ_c = V_k × S_c (equal to ψ̇_c with one degree of freedom)
// TreeDynamics holds the same for trees without free joints, with second derivatives. One object a thread.
class MotionDerivatives {
 public:
  explicit MotionDerivatives(const Model& model);

  // Evaluates at the state (BodyDynamics::ComputeState at q, v), v (nv), a (nv), gravity (m/s², world). Everything
  // below refers to it.
  void Update(const BodyDynamics::State& state, const VectorX& v, const VectorX& a, const Vector3& gravity);
  // The same in steps, for who needs less: MassMatrix asks for the first, the value of InverseDynamics and Origin for
  // two, all else for three.
  void SetState(const BodyDynamics::State& state);
  void SetAcceleration(const VectorX& a, const Vector3& gravity);
  void UpdateDerivatives();

  // M, nv × nv, both triangles, written where one of row and column moves the other, else not touched.
  void MassMatrix(Eigen::Ref<MatrixX> mass) const;
  // τ (nv) = ID(q, v, a), N m or N.
  void InverseDynamics(VectorX* tau) const;
  // ∂ID/∂q and ∂ID/∂v, nv × nv, written as M is.
  void InverseDynamics(Eigen::Ref<RowMajorMatrix> dq, Eigen::Ref<RowMajorMatrix> dv) const;

  // How a point fixed to a link moves: velocity, acceleration (without gravity) and their changes along one column.
  struct PointMotion {
    Vector3 w, v, alpha, a;  // rad/s, m/s, rad/s², m/s²
  };
  // Of the link's origin, complete accelerations.
  PointMotion Origin(int link) const;
  // Changes along column c of v's indices, which belongs to `link` or an ancestor. By q the origin itself moves along
  // `shift` and the link turns by `turn`.
  struct Change {
    Vector3 shift, turn;  // zero by v
    PointMotion motion;
  };
  Change AlongPosition(int link, int c) const;
  Change AlongVelocity(int link, int c) const;
  // S_c, and the point at which the six-vectors of a link's tree are taken, m, world.
  const Vector6& column(int c) const { return columns_[static_cast<size_t>(c)].s; }
  const Vector3& reference(int link) const { return bodies_[static_cast<size_t>(link)].reference; }
  // Columns on the path from the world to a link, ascending; and whether column m moves column k: it belongs to the
  // same joint or one before it.
  const std::vector<int>& path(int link) const { return paths_[static_cast<size_t>(link)]; }
  bool Moves(int m, int k) const {
    return model_.IsAncestor(joint_of_[static_cast<size_t>(m)], joint_of_[static_cast<size_t>(k)]);
  }

 private:
  struct Column {
    Vector6 s, psi, psi2, rate;  // rate: ψ̇ + Ṡ
  };
  struct Body {
    Vector6 twist, acceleration, force;    // gravity counts as −g at the root; force of the subtree
    Vector6 velocity_product, gyroscopic;  // parts of acceleration and force of this body without a
    Vector3 reference, origin;             // origin: from the reference
    SpatialInertia own, inertia;           // of the body, of the subtree
    CompositeMotion motion;                // of the subtree
    double spring = 0;                     // what spring and damper of the joint take, N m or N
    Vector3 couple = Vector3::Zero();      // what the damper of a free joint takes, N m
    bool massive = false;
    int anchor = 0;  // link at whose origin the reference is
  };
  // Turns changes of twist and acceleration in world axes at the reference into those of a link's origin.
  Change AtOrigin(const Body& body, const Vector6& pose, const Vector6& twist, const Vector6& acceleration) const;

  Model model_;
  std::vector<std::vector<int>> paths_;
  std::vector<int> joint_of_;
  std::vector<Column> columns_;
  std::vector<Body> bodies_;
  Vector3 gravity_ = Vector3::Zero();
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MULTIBODY_MOTION_DERIVATIVES_H_
