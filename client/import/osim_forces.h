// What the forces of an .osim file mean for the joints of a model.
#ifndef ROLLGAIT_CLIENT_IMPORT_OSIM_FORCES_H_
#define ROLLGAIT_CLIENT_IMPORT_OSIM_FORCES_H_

#include <set>
#include <string>

#include "client/import/link_tree.h"
#include "client/import/osim_values.h"

namespace rollgait::client {

// Adds a CoordinateActuator to the efforts of its joint: optimal force times the range of its control, or times ±1 if
// that is unlimited; a SpringGeneralizedForce to its spring and damper. Everything else is told in `left_out`, as is
// what acts on coordinates of `base`, which the floating base stands for, and of joints that are held. Returns whether
// a control without limits was taken for ±1. Throws Failure(kUsage) for empty ranges.
bool AddOsimForce(const OsimElement& force, const std::set<std::string>& base, LinkTree* tree, LeftOut* left_out);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_OSIM_FORCES_H_
