#ifndef ROLLGAIT_CORE_SIMULATION_HELD_CONTACTS_H_
#define ROLLGAIT_CORE_SIMULATION_HELD_CONTACTS_H_

#include <vector>

#include "core/simulation/scene_dynamics.h"

namespace rollgait {

// Bodies closer than this touch, m, over their size and distance from the origin, of which 1 m is the least.
inline constexpr double kTouching = 1e-10;
// A normal force this small, over the largest force, is zero within rounding.
inline constexpr double kForceRounding = 1e-11;
// A contact that slips or closes no faster is at rest, m/s.
inline constexpr double kAtRest = 1e-9;

// Not of contacts that gates may keep from it.
bool MayTouchDown(const SimulationScene& scene, int contact, const SceneDynamics& dynamics);
// At the last state, within rounding.
bool Touches(int contact, SceneDynamics* dynamics);

// Which contacts carry force from an instant on, and how they differ from those before. Ascending.
struct HeldChoice {
  // kNone: some contact can neither be held, let go nor slide. kNotFinite: the accelerations are not.
  enum class Outcome { kFound, kNone, kNotFinite } outcome = Outcome::kNone;
  std::vector<int> let_go, began_to_slide, taken_up;
  bool may_slide = false;  // one of the contacts at hand may
};

// Chooses them at (t, x) and sets them in `dynamics`: begins with those that are active, but for the one whose force is
// falling through zero (`let_go`, -1: none), and those that touch and rest; lets go the one that pulls most, takes back
// the one that closes fastest, until every one-way contact pushes and none that was let go closes. A contact that must
// go and come back takes a force along the ground that no pressure comes with: it slides if it may, against that force.
HeldChoice ChooseHeldContacts(const SimulationScene& scene, int let_go, double t, const VectorX& x,
                              SceneDynamics* dynamics);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_SIMULATION_HELD_CONTACTS_H_
