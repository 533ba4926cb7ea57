#ifndef ROLLGAIT_TESTS_SUPPORT_ROLLER_H_
#define ROLLGAIT_TESTS_SUPPORT_ROLLER_H_

#include <gtest/gtest.h>

#include <cmath>

#include "core/contact/constrained_dynamics.h"
#include "core/math/integrator.h"
#include "tests/support/rolling_body.h"

namespace rollgait {

// A body that rolls, integrated from one time to another.
class Roller {
 public:
  Roller(const RollingBody& body, const Vector3& gravity, double tolerance)
      : dynamics_(body.model), constrained_(dynamics_, {body.surface}), gravity_(gravity) {
    options_.tolerance = tolerance;
  }

  void Advance(double from, double to, VectorX* q, VectorX* v) {
    const int n = dynamics_.size();
    VectorX x(2 * n);
    x << *q, *v;
    const auto right_side = [&](double, const VectorX& state, VectorX* derivative) {
      derivative->head(n) = state.tail(n);
      derivative->tail(n) =
          constrained_.Evaluate(state.head(n), state.tail(n), VectorX::Zero(n), gravity_).acceleration;
    };
    options_.first_step = integrator_.proposed_step();
    ASSERT_EQ(integrator_.Integrate(right_side, from, to, options_, &x), IntegrationStatus::kReachedEnd);
    *q = x.head(n);
    *v = x.tail(n);
    // Leaves contact and state at the end.
    constrained_.Evaluate(*q, *v, VectorX::Zero(n), gravity_);
  }

  double Energy() const {
    return dynamics_.KineticEnergy(constrained_.state()) + dynamics_.PotentialEnergy(constrained_.state(), gravity_);
  }
  Matrix3 Orientation() const { return constrained_.state().back().R_WL; }
  Vector3 Omega() const { return Orientation() * constrained_.state().back().twist.angular; }
  const RollingContact& contact() const { return constrained_.contact(0); }
  Vector3 CenterOfMass() const { return dynamics_.CenterOfMass(constrained_.state()); }

 private:
  BodyDynamics dynamics_;
  ConstrainedDynamics constrained_;
  Dop853 integrator_;
  Dop853::Options options_;
  Vector3 gravity_;
};

// The stone of Kane and Levinson (1982).
inline const Vector3 kRattlebackAxes(0.2, 0.03, 0.02);
inline RollingBody Rattleback() {
  Matrix3 inertia;
  inertia << 2e-4, -2e-5, 0, -2e-5, 1.6e-3, 0, 0, 0, 1.7e-3;
  return MakeRollingBody(kRattlebackAxes, 1.0, Vector3(0, 0, 0.01), inertia);
}

// The first zero of the spin about the vertical after `search`, s, from the state q, v at `from`. Three zeros follow
// each other within 0.05 s, so the search goes in short steps; then a secant iteration. NaN if there is none within a
// second.
inline double NextReversal(double from, double search, Roller* roller, VectorX* q, VectorX* v) {
  roller->Advance(from, search, q, v);
  double t = search, before = search, spin = roller->Omega().z();
  const double sign = spin > 0 ? 1 : -1;
  double spin_before = spin;
  VectorX q_before = *q, v_before = *v;
  while (spin * sign > 0) {
    if (t > search + 1) return std::nan("");
    q_before = *q, v_before = *v, before = t, spin_before = spin;
    t = before + 0.01;
    roller->Advance(before, t, q, v);
    spin = roller->Omega().z();
  }
  double low = before, low_spin = spin_before;
  for (int i = 0; i < 12 && std::abs(spin) > 1e-13; ++i) {
    const double next = t - spin * (t - low) / (spin - low_spin);
    low = t, low_spin = spin;
    t = next;
    *q = q_before, *v = v_before;
    roller->Advance(before, t, q, v);
    spin = roller->Omega().z();
  }
  return t;
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_ROLLER_H_
