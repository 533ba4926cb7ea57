#ifndef ROLLGAIT_CORE_MULTIBODY_BODY_DYNAMICS_H_
#define ROLLGAIT_CORE_MULTIBODY_BODY_DYNAMICS_H_

#include <vector>

#include "core/base/types.h"
#include "core/multibody/model.h"

namespace rollgait {

// The tree's dynamics in link axes, after Featherstone, Rigid Body Dynamics Algorithms (2008): the recursive
// Newton–Euler algorithm (table 5.1) and the composite rigid body algorithm (table 6.2). It is the second algorithm of
// the library: trajectories are judged with it, and it shares no code with TreeDynamics, which makes them.
//
// Equations of motion:  M(q) v̇ + b(q, v) = τ + Jᵀ λ, springs and dampers of joints included in b.  Units: SI; rad or m
// for q by joint type (free joints: see JointType). Gravity is a vector in world axes, m/s²; the world axes are fixed
// to the ground, so a slope turns gravity. Immutable after construction; any thread may share it, with a State and a
// Workspace of its own.
class BodyDynamics {
 public:
  // A motion vector (twist, acceleration) at the link's origin, in link axes.
  struct Motion {
    Vector3 angular = Vector3::Zero();  // rad/s, rad/s²
    Vector3 linear = Vector3::Zero();   // m/s, m/s²
  };
  // A force vector at the link's origin, in link axes.
  struct Force {
    Vector3 moment = Vector3::Zero();  // N m
    Vector3 force = Vector3::Zero();   // N
  };
  // Inertia about the link's origin, in link axes.
  struct Inertia {
    double mass = 0;                         // kg
    Vector3 first_moment = Vector3::Zero();  // kg m, mass times centre of mass
    Matrix3 rotational = Matrix3::Zero();    // kg m²
  };
  // Where each link is and how it moves. Index = joint.
  struct Link {
    Matrix3 R_PL;  // link axes -> axes of the parent link (or world)
    Vector3 p_PL;  // m, link origin in the parent link (or world)
    Matrix3 R_WL;
    Vector3 p_WL;
    Motion twist;
    // Spatial acceleration of the link at v̇ = 0 without gravity, in link axes. It is not the classical one: the
    // classical acceleration of the origin is  bias.linear + twist.angular × twist.linear.
    Motion bias;
    double position = 0, velocity = 0;  // of the joint: rad or m, rad/s or m/s; zero of a free joint
    Vector3 spin = Vector3::Zero();     // rad/s, of a free joint: of the link relative to its parent, in link axes
  };
  using State = std::vector<Link>;
  // Scratch memory; any content, one a thread.
  struct Workspace {
    std::vector<Inertia> composite;
    std::vector<Motion> acceleration;
    std::vector<Force> force;
  };

  explicit BodyDynamics(const Model& model);
  const Model& model() const { return model_; }

  // Number of joints and links; the lengths of q and v are nq() and nv(), the same number in a tree without free
  // joints.
  int size() const { return static_cast<int>(joints_.size()); }
  int nq() const { return nq_; }
  int nv() const { return nv_; }
  // Parent of joint i, -1 for the world.
  int parent(int i) const { return joints_[i].parent; }
  // Axis of joint i in its own link's axes (unit), whether its link turns about it, and how far it moves along it by
  // unit of the position, m. One degree of freedom only.
  const Vector3& axis(int i) const { return joints_[i].axis; }
  bool turns(int i) const { return joints_[i].turns; }
  double advance(int i) const { return joints_[i].advance; }
  double total_mass() const { return total_mass_; }

  // Poses, twists and bias accelerations at q (nq), v (nv). Resizes `state`.
  void ComputeState(const VectorX& q, const VectorX& v, State* state) const;

  // M (nv × nv), symmetric positive definite, both triangles.
  void MassMatrix(const State& state, Workspace* workspace, MatrixX* mass) const;
  // τ = M a + b for a given acceleration a (nv).
  void InverseDynamics(const State& state, const VectorX& a, const Vector3& gravity, Workspace* workspace,
                       VectorX* tau) const;
  // b: Coriolis, centrifugal and gravity terms, and what springs and dampers of joints take.
  void BiasForce(const State& state, const Vector3& gravity, Workspace* workspace, VectorX* bias) const;
  // Adds `sign` times the Jacobian of  [angular velocity; velocity of the material point at `point`]  of a link, all in
  // world axes, to the 6 × nv matrix `jacobian`.
  void AddTwistJacobian(const State& state, int link, const Vector3& point, double sign, MatrixX* jacobian) const;

  // J.
  double KineticEnergy(const State& state) const;
  // J, of gravity and springs; zero with every centre of mass at the world origin and every spring at rest.
  double PotentialEnergy(const State& state, const Vector3& gravity) const;
  // Sum over the links, N s, world axes.
  Vector3 LinearMomentum(const State& state) const;
  // Of the whole tree, m, world. Undefined for a tree without mass.
  Vector3 CenterOfMass(const State& state) const;

 private:
  struct JointData {
    int parent;
    bool turns, slides;  // slides: advance is not zero
    double advance;      // m by unit of the position, see JointKind
    int q_index, v_index, columns;
    Vector3 axis;
    Matrix3 R_PJ;
    Vector3 p_PJ;
    Inertia inertia;
    double stiffness, rest, damping;
    bool free() const { return columns > 1; }
  };
  // Column c of the motion subspace of a joint, and the component of a force along it.
  static Motion Column(const JointData& joint, int c);
  static double Along(const JointData& joint, int c, const Force& force);
  // Relative motion of a joint under the joint velocities (or accelerations) v.
  static Motion Relative(const JointData& joint, const VectorX& v);
  // The recursion common to InverseDynamics (a given) and BiasForce (a null).
  void NewtonEuler(const State& state, const VectorX* a, const Vector3& gravity, Workspace* workspace,
                   VectorX* tau) const;

  Model model_;
  std::vector<JointData> joints_;
  int nq_ = 0, nv_ = 0;
  double total_mass_ = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MULTIBODY_BODY_DYNAMICS_H_
