#ifndef ROLLGAIT_CORE_SIMULATION_SCENE_DYNAMICS_H_
#define ROLLGAIT_CORE_SIMULATION_SCENE_DYNAMICS_H_

#include <optional>
#include <utility>
#include <vector>

#include "core/contact/contact_dynamics.h"
#include "core/simulation/scene.h"

namespace rollgait {

// The equations of motion of a scene as ẋ = f(t, x) for a set of active contacts. x = [q (nq); v (nv); W]: W is the
// work done on the mechanism by everything that is not gravity or a spring, J (dampers, constant efforts, contacts with
// moving ground), so that energy − W is constant between impacts. Not thread-safe.
class SceneDynamics {
 public:
  // The last entries of x on which ẋ does not depend: W.
  static constexpr int kQuadratures = 1;

  explicit SceneDynamics(const SimulationScene& scene);

  int size() const { return nq_ + nv_ + 1; }
  VectorX MakeState(const VectorX& q, const VectorX& v, double work) const;
  VectorX Positions(const VectorX& x) const { return x.head(nq_); }
  VectorX Velocities(const VectorX& x) const { return x.segment(nq_, nv_); }

  void SetActive(std::vector<int> active) { active_ = std::move(active); }
  const std::vector<int>& active() const { return active_; }
  bool IsActive(int k) const;

  // The slip of contact k relative to the other body in its tangent directions (of kRollingAlong: along it), world,
  // m/s.
  Vector3 TangentialSlip(int k);
  // The tangential part of its last force, N.
  Vector3 TangentialForce(int k);
  // Contact k slides, for now along `direction` (unit, world); or holds its slip again.
  void Slide(int k, const Vector3& direction);
  void Stick(int k) { contacts_.SetSliding(k, std::nullopt); }
  bool IsSliding(int k) const { return contacts_.sliding(k).has_value(); }
  // True for contacts that may slide (FrictionLoss::kSlide).
  bool MaySlide(int k) const { return scene_.contacts[static_cast<size_t>(k)].friction_loss == FrictionLoss::kSlide; }
  // True if what contact k would hold does not move faster than `speed`, m/s, at the state.
  bool IsAtRest(int k, double speed);
  // Second derivative of the gap of contact k, which has no slip, under the last right side, m/s²; 0 within rounding.
  double GapAcceleration(int k);
  // True if contact k, which slides but has no slip yet, would slip against its direction under the last right side.
  bool TurnsBack(int k);
  // Turns the reference of every sliding contact into its direction of slip at the state. True if there is one.
  bool FollowSlip();

  // ẋ at (t, x). Leaves contacts() with kinematics and forces of that instant.
  void RightSide(double t, const VectorX& x, VectorX* derivative);
  // The time in which positions or velocities change by a thousandth of themselves at that rate, s, whatever the unit
  // of time; infinite if nothing moves.
  double FirstStep(const VectorX& x, const VectorX& derivative) const;
  // Kinematics alone.
  void SetState(double t, const VectorX& x);
  ContactDynamics& contacts() { return contacts_; }
  // Of the last RightSide.
  const ConstrainedSolution& solution() const { return *solution_; }

  // J, at the last state: kinetic; potential of gravity and springs.
  double KineticEnergy() const;
  double PotentialEnergy() const;
  int evaluations() const { return evaluations_; }

  // Moves q and v onto the constraints of the active contacts by the change of least kinetic energy; quaternions to
  // unit norm. Returns the largest gap, slip found before.
  struct Drift {
    double gap = 0, slip = 0, quaternion = 0;
  };
  Drift Project(double t, bool positions_and_velocities, VectorX* x);

 private:
  // Of the slip of contact k along a direction (unit, world) under the last right side, m/s²; 0 within rounding.
  double SlipRate(int k, const Vector3& direction);
  // W, of constant efforts and dampers.
  double Power() const;

  const SimulationScene& scene_;
  const int nq_, nv_;
  ContactDynamics contacts_;
  std::vector<int> active_;
  std::vector<FrameMotion> ground_;
  VectorX q_, v_, tau_, rate_;
  const ConstrainedSolution* solution_ = nullptr;
  ConstrainedSolver solver_;
  ConstrainedSolution correction_;
  MatrixX jacobian_, linear_, angular_;
  VectorX right_;
  int evaluations_ = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_SIMULATION_SCENE_DYNAMICS_H_
