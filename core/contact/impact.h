#ifndef ROLLGAIT_CORE_CONTACT_IMPACT_H_
#define ROLLGAIT_CORE_CONTACT_IMPACT_H_

#include <vector>

#include "core/base/types.h"
#include "core/contact/contact_dynamics.h"

namespace rollgait {

// What a plastic impact did. Indices of contacts are those of ContactDynamics.
struct Impact {
  VectorX velocity;                   // v⁺ (nv)
  std::vector<int> held;              // contacts that hold after it, ascending
  std::vector<int> released;          // contacts that touched and do not hold
  std::vector<Vector3> impulses;      // N s on body 1, world; one per contact of the dynamics, zero if not held
  std::vector<double> spin_impulses;  // N m s about the normal
  std::vector<double> gap_rates;      // m/s, n·w⁺ of every contact (only of `held` and `released`)
  double energy_loss = 0;             // J, kinetic energy before − after (in the world's axes)
  bool redundant = false;             // impulses are not unique (ConstrainedSolution::ForcesUnique)
  // False if no set of held contacts is free of pulling impulses and of released contacts that move into each other.
  // Then `held` is what had to be held (the newly touching and the bilateral ones).
  bool consistent = true;
};

// Plastic impact without slip,  M (v⁺ − v⁻) = Jᵀ Λ,  J v⁺ = 0 relative to the ground, at the state of `dynamics`
// (contact-math 7). `touching` lists the contacts with no gap (ascending, at most 16), `must_hold` those of them that
// close now or cannot open. Of the others the fewest are held such that every held contact pushes, n·Λ ≥ 0, and every
// released one separates, n·w⁺ ≥ 0. A contact that slides (ContactDynamics::SetSliding) keeps its slip but for a
// friction impulse of μ times the normal one against it; velocities are not finite where that is undetermined.
Impact ResolveImpact(const std::vector<int>& touching, const std::vector<int>& must_hold, ContactDynamics* dynamics);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_IMPACT_H_
