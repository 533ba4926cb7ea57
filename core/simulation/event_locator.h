#ifndef ROLLGAIT_CORE_SIMULATION_EVENT_LOCATOR_H_
#define ROLLGAIT_CORE_SIMULATION_EVENT_LOCATOR_H_

#include <optional>
#include <vector>

#include "core/math/integrator.h"
#include "core/simulation/scene_dynamics.h"
#include "core/simulation/simulation.h"

namespace rollgait {

// A change of sign of a watched quantity: where it happens and the state there.
struct Crossing {
  SimulationEventKind kind = SimulationEventKind::kTouchDown;
  int contact = 0;
  double time = 0;
  VectorX state;
};

// Watches, over each step of the integrator: gaps of inactive contacts that can touch down (falling through zero with
// open gates), normal forces of active unilateral contacts (falling through zero), friction margins  μ n·F −
// |tangential force| of active contacts with a coefficient (both ways), the slip of sliding contacts along its
// direction at the start of the step (falling through zero: there it ends). Quantities are sampled at quarters of the
// step on the continuous extension (gaps also at their minimum between samples); a change of sign is located there,
// then with single steps of the integrator from the start of the step until the time no longer changes: to rounding of
// the quantity over its slope. A gap or a normal force that is zero within rounding at the start of the step, as after
// an event, and then falls below zero by more than rounding, has fallen through zero at the start; a gap that first
// rises, where it comes back. A gap whose minimum is zero within rounding does not close.
class EventLocator {
 public:
  EventLocator(const SimulationScene& scene, SceneDynamics* dynamics);

  // The earliest event within the step from (t, x) that `integrator` has just made; after it nothing is watched
  // further.
  std::optional<Crossing> FirstInStep(const Dop853::RightSide& right_side, const VectorX& x, Dop853* integrator);

  // Marks contacts whose friction margin is negative at (t, x) now. Returns those not marked before.
  std::vector<int> MarkFriction(double t, const VectorX& x);

 private:
  struct Watched {
    SimulationEventKind kind;
    int contact;
  };
  struct Point {
    double time;
    VectorX state;
    std::vector<double> values, rates;  // rates of gaps only
    std::vector<double> rounding;       // of gaps and normal forces
    std::vector<double> zero;           // as large as what is taken for zero after an event
  };

  void ChooseWatched();
  void Evaluate(Point* point);
  double Value(const Watched& watched);
  bool GatesOpen(int contact, const VectorX& x) const;
  // Where watched quantity w falls through zero between a and b, if it does.
  std::optional<double> FallsAt(size_t w, const Point& a, const Point& b);
  // The point between a and b where the gap w is least (its rate goes from below to above zero), or greatest. Ends
  // early where the gap is beyond zero by more than rounding.
  Point TurnBetween(size_t w, const Point& a, const Point& b);
  // Root of watched quantity w between a and b on the continuous extension; positive at a, not at b.
  double RootBetween(size_t w, const Point& a, const Point& b);
  Point At(double t);
  std::optional<Crossing> FirstBetween(const Point& a, const Point& b, const VectorX& x);
  // Moves the root to where single steps from the start of the step put it.
  Crossing Polish(const Watched& watched, double root, double slope, const VectorX& x);

  const SimulationScene& scene_;
  SceneDynamics& dynamics_;
  const Dop853::RightSide* right_side_ = nullptr;
  Dop853* integrator_ = nullptr;
  Dop853 single_;
  std::vector<Watched> watched_;
  bool forces_watched_ = false;
  std::vector<char> beyond_friction_;
  VectorX derivative_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_SIMULATION_EVENT_LOCATOR_H_
