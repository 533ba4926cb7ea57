// The tree of links and joints of a URDF, as liburdfdom reads it.
#ifndef ROLLGAIT_CLIENT_IMPORT_URDF_TREE_H_
#define ROLLGAIT_CLIENT_IMPORT_URDF_TREE_H_

#include <string>

#include "client/import/link_tree.h"
#include "client/import/urdf_document.h"

namespace rollgait::client {

// Throws Failure(kUsage) with file, element and reason for what CheckUrdf refuses; FinishTree has not been called.
LinkTree ReadUrdf(const std::string& path, const tinyxml2::XMLDocument& xml);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_URDF_TREE_H_
