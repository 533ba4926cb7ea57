// The tree of bodies and joints of an .osim file, an OpenSim model of version 4.
#ifndef ROLLGAIT_CLIENT_IMPORT_OSIM_TREE_H_
#define ROLLGAIT_CLIENT_IMPORT_OSIM_TREE_H_

#include <string>

#include "client/import/link_tree.h"

namespace tinyxml2 {
class XMLDocument;
}

namespace rollgait::client {

// Bodies are links behind the root link "ground", in their own frames with OpenSim's X, Y, Z named x, z and −y: x
// forward, y left, z up. Joints are named after coordinates and count as those do. A body that moves freely, or in the
// plane of X and Y, is the floating base (tree_chain.h). Throws Failure(kUsage) with file, element and reason for what
// the file states wrongly, for versions before 4, a gravity that is not along −Y and joints that are not read
// (osim_joint.h). FinishTree has not been called.
LinkTree ReadOsim(const std::string& path, const tinyxml2::XMLDocument& xml);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_OSIM_TREE_H_
