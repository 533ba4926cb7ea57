// Forward dynamics of a phase for the audit: the mass matrix and the bias of core/multibody, all else dense and its
// own.
#ifndef ROLLGAIT_BENCH_VERDICT_AUDIT_DENSE_DYNAMICS_H_
#define ROLLGAIT_BENCH_VERDICT_AUDIT_DENSE_DYNAMICS_H_

#include <vector>

#include "bench/verdict_audit/interval_motion.h"
#include "core/models/scene.h"
#include "core/multibody/tree_dynamics.h"

namespace rollgait::audit {

// The efforts move the tree while its active contacts roll: M a + b = S τ + Jᵀ λ, d/dt(J v) = 0. The term of J's own
// change is a central difference along the motion. Of redundant contacts the forces are those of least norm.
class DenseDynamics {
 public:
  DenseDynamics(const Scene& scene, std::vector<int> contacts, const Vector3& gravity);

  struct Answer {
    VectorX acceleration;
    std::vector<Vector3> forces;  // N, a contact each, on the body
    std::vector<Vector3> points;  // m, where they act
  };
  Answer Evaluate(const VectorX& q, const VectorX& v, const VectorX& efforts);

  // The velocities after an impact that stops every contact: M (v⁺ − v) = Jᵀ Λ, J v⁺ = 0.
  struct Impact {
    VectorX velocity;
    std::vector<Vector3> points;
  };
  Impact Stop(const VectorX& q, const VectorX& v);

  struct State {
    VectorX q, v;
  };
  // One step of the classical Runge–Kutta method over the fractions from θ to θ + δ of an interval. `first` is the
  // answer at the start, which is known already.
  State Step(const State& state, const IntervalMotion& interval, double theta, double delta, const Answer& first);

 private:
  MatrixX Mass(const VectorX& q);
  // The rows of J, and the contact points.
  MatrixX ContactJacobian(const VectorX& q, const VectorX& v, std::vector<Vector3>* points) const;
  // Velocities of the contact points in the directions in which the contacts hold them.
  VectorX RowVelocities(const VectorX& q, const VectorX& v) const;

  const Scene& scene_;
  std::vector<int> contacts_;
  Vector3 gravity_;
  TreeDynamics tree_;
};

}  // namespace rollgait::audit

#endif  // ROLLGAIT_BENCH_VERDICT_AUDIT_DENSE_DYNAMICS_H_
