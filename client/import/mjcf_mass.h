// Masses and shapes of MJCF bodies.
#ifndef ROLLGAIT_CLIENT_IMPORT_MJCF_MASS_H_
#define ROLLGAIT_CLIENT_IMPORT_MJCF_MASS_H_

#include <optional>

#include "client/import/link_tree.h"
#include "client/import/mjcf_values.h"

namespace rollgait::client {

// A geom in the frame of its parent element.
struct MjcfGeom {
  MassProperties mass;             // of its volume and density, or its mass; zero if it does not count
  std::optional<TreeShape> shape;  // nothing for planes, height fields, meshes and what collides with nothing
  bool is_file = false;            // its shape is in a file, which is not opened
  bool weighs_as_file = false;     // and so is its mass
};

// Throws Failure(kUsage) for sizes that are missing or <= 0, negative masses, unknown types and shellinertia.
MjcfGeom ReadMjcfGeom(const MjcfElement& geom);

// <inertial>. Throws Failure(kUsage) for what it does not state, and for both diaginertia and fullinertia.
MassProperties ReadMjcfInertial(const MjcfElement& inertial);

// The compiler's boundmass, boundinertia and balanceinertia.
MassProperties BoundedMass(const MjcfCompiler& compiler, const MassProperties& mass);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_MJCF_MASS_H_
