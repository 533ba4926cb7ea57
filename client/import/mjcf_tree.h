// The tree of bodies and joints of an MJCF, MuJoCo's XML.
#ifndef ROLLGAIT_CLIENT_IMPORT_MJCF_TREE_H_
#define ROLLGAIT_CLIENT_IMPORT_MJCF_TREE_H_

#include <string>

#include "client/import/link_tree.h"

namespace tinyxml2 {
class XMLDocument;
}

namespace rollgait::client {

// Bodies are links, in the frames that the file gives them, on a root link "world". A body that moves freely is the
// floating base (tree_chain.h). Positions count as the file counts them, in rad. Joints that no actuator drives are not
// driven, if the file has actuators and all are of joints. Bodies without a joint, before or behind them, are left out
// if others have one. Throws Failure(kUsage) with file, element and reason for what the file states wrongly, and for
// elements whose content is in another file or made by MuJoCo: include, attach, composite, replicate, flexcomp, masses
// of meshes. FinishTree has not been called.
LinkTree ReadMjcf(const std::string& path, const tinyxml2::XMLDocument& xml);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_MJCF_TREE_H_
