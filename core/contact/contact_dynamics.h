#ifndef ROLLGAIT_CORE_CONTACT_CONTACT_DYNAMICS_H_
#define ROLLGAIT_CORE_CONTACT_CONTACT_DYNAMICS_H_

#include <optional>
#include <vector>

#include "core/base/types.h"
#include "core/contact/constrained_dynamics.h"
#include "core/contact/pair_kinematics.h"
#include "core/contact/surface_pair.h"
#include "core/contact/tree_contact.h"
#include "core/multibody/body_dynamics.h"
#include "core/multibody/motion_derivatives.h"

namespace rollgait {

// Dynamics of any tree with any set of active contacts, each with the ground (fixed, or with a prescribed motion) or
// with another link of the tree. An active contact holds its gap (φ̈ = 0), in its tangent directions the slip (t·ẇ =
// 0), with no_spin the relative spin about the normal, each with the Baumgarte terms that are given. Forces may have
// any sign and size: who uses them checks the normal force and friction. Source: contact-math 4, 5, 7; eqs (3.5) to
// (3.10). A contact that slides (SetSliding) holds its gap only; its friction follows its normal force.
// Rows of a contact: kRolling: world x, y, z; kRollingAlong: tangent, normal; kFrictionless: normal; then spin.
// Sliding: normal. Not thread-safe: one object a thread.
class ContactDynamics {
 public:
  // Contract: links exist; ground indices are below the number of frames passed to SetState.
  ContactDynamics(const BodyDynamics& dynamics, std::vector<TreeContact> contacts);

  const BodyDynamics& dynamics() const { return dynamics_; }
  int contact_count() const { return static_cast<int>(contacts_.size()); }
  const TreeContact& contact(int k) const { return contacts_[k]; }

  // Contact k slides from now on, or (nullopt) holds its slip again. Contract of sliding: a grip, no `no_spin`.
  void SetSliding(int k, const std::optional<Sliding>& sliding);
  const std::optional<Sliding>& sliding(int k) const { return sliding_[static_cast<size_t>(k)]; }
  // Unit direction of slip that friction acts against (world), and the slip along the reference, m/s. Contract: k
  // slides.
  Vector3 SlidingDirection(int k);
  double SlipAlongReference(int k);

  // The state that everything below refers to. `ground` holds full accelerations.
  void SetState(const VectorX& q, const VectorX& v, const std::vector<FrameMotion>& ground);
  const BodyDynamics::State& state() const { return state_; }
  const VectorX& velocity() const { return velocity_; }
  // Of contact k with bias accelerations (zero joint accelerations); computed when first asked for after SetState.
  const PairKinematics& Kinematics(int k);
  // The separation that it comes from, for a contact with another surface; null for one with a plane.
  const Separation* separation(int k) const { return pairs_[k] ? &pairs_[k]->separation() : nullptr; }
  const FrameMotion& ground(int i) const { return ground_[i]; }
  // Angular velocity of body 1 relative to body 2 about the normal, rad/s.
  double Spin(int k);
  // The tangent direction of kRollingAlong: `along` in world axes, made tangent and of unit length.
  Vector3 Tangent(int k);
  // ∂w/∂v (3 × nv), world axes, and ∂(relative angular velocity)/∂v unless `angular` is null.
  void SlipJacobian(int k, MatrixX* linear, MatrixX* angular);
  // M at the state.
  const MatrixX& MassMatrix();
  // Of the state, and of the accelerations that its SetAcceleration was given last.
  MotionDerivatives& Motion();

  // Accelerations and forces with these contacts active (ascending), generalized forces tau (nv) and gravity (m/s²,
  // world). Not finite where the surface of an active contact is flat. Valid until the next call.
  const ConstrainedSolution& Accelerate(const std::vector<int>& active, const VectorX& tau, const Vector3& gravity,
                                        const Baumgarte& baumgarte);
  const ConstrainedSolution& solution() const { return solution_; }
  // The derivatives of that solution (ConstrainedSolver::Differentiate). Contract: no active contact slides.
  void Differentiate(RowMajorMatrix* acceleration, RowMajorMatrix* forces) {
    solver_.Differentiate(acceleration, forces);
  }
  // Of the last Accelerate: force on body 1 (N, world), torque about the normal on body 1 (N m); zero if not active.
  Vector3 Force(int k) const { return forces_[k]; }
  double SpinTorque(int k) const { return spin_torques_[k]; }

  // The rows J and the right side r of  J v̇ = r  for `active`. For sensitivities and tests.
  void AccelerationRows(const std::vector<int>& active, const Baumgarte& baumgarte, MatrixX* jacobian, VectorX* right);
  // The same rows with the velocities they hold: J v − (what the ground prescribes) is `rate`, zero when nothing slips.
  void VelocityRows(const std::vector<int>& active, MatrixX* jacobian, VectorX* rate);
  // J with the rows of sliding contacts turned into the direction of their force, n − μ ŝ: generalised forces are its
  // transpose times the row forces.
  void ForceRows(const std::vector<int>& active, const MatrixX& jacobian, MatrixX* force_jacobian);
  bool AnySlides(const std::vector<int>& active) const;
  // Turns row values (forces or impulses of the rows of `active`) into a force and a spin torque per contact.
  void Distribute(const std::vector<int>& active, const VectorX& rows, std::vector<Vector3>* forces,
                  std::vector<double>* spin_torques);

  // Rows of contact k now.
  int Rows(int k) const { return sliding(k) ? 1 : RowCount(contacts_[static_cast<size_t>(k)]); }

 private:
  Grip GripNow(int k) const { return sliding(k) ? Grip::kFrictionless : contacts_[static_cast<size_t>(k)].grip; }
  const FrameMotion& Body(int link, int ground) const { return link < 0 ? ground_[ground] : links_[link]; }
  const FrameMotion& Body1(int k) const { return links_[contacts_[k].link]; }
  const FrameMotion& Body2(int k) const { return Body(contacts_[k].other_link, contacts_[k].ground); }
  // Writes the Jacobian rows of contact k from `row`; returns the next free row.
  int WriteRows(int k, int row, MatrixX* jacobian);

  BodyDynamics dynamics_;
  std::vector<TreeContact> contacts_;
  std::vector<FrameMotion> ground_, links_;
  VectorX velocity_;
  BodyDynamics::State state_;
  std::vector<std::optional<Sliding>> sliding_;
  std::vector<std::optional<SurfacePair>> pairs_;  // of contacts with another surface: each follows its normal in time
  std::vector<std::optional<PairKinematics>> kinematics_;
  bool motion_known_ = false, mass_known_ = false;
  MotionDerivatives motion_;
  MatrixX mass_, jacobian_, force_jacobian_, twist_;
  MatrixX linear_, angular_;
  VectorX no_acceleration_, force_, right_;
  ConstrainedSolver solver_;
  ConstrainedSolution solution_;
  std::vector<Vector3> forces_;
  std::vector<double> spin_torques_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_CONTACT_DYNAMICS_H_
