// How a tree must be turned to stand upright.
#ifndef ROLLGAIT_CLIENT_IMPORT_UPRIGHT_H_
#define ROLLGAIT_CLIENT_IMPORT_UPRIGHT_H_

#include <optional>

#include "client/import/tree_posture.h"

namespace rollgait::client {

// Drawings often have y up, or x along the legs. Returns the turn of the root link (root link -> world) after which the
// legs hang along −z, by the axis of the world that is nearest to the direction from hips to feet; nothing where they
// hang along −z already, lie between axes, or no names of joints and links tell hips and feet.
std::optional<Eigen::Matrix3d> TurnUpright(const LinkTree& tree, const TreePosture& posture);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_UPRIGHT_H_
