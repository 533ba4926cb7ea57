// Side files: what a walker needs and a URDF, MJCF or OpenSim file does not say.
#ifndef ROLLGAIT_CLIENT_IMPORT_SIDE_FILE_H_
#define ROLLGAIT_CLIENT_IMPORT_SIDE_FILE_H_

#include <string>
#include <string_view>
#include <vector>

#include "client/import/link_tree.h"
#include "rollgait/v1/model_side_file.pb.h"

namespace rollgait::client {

// A joint of the floating base that the client adds to a tree.
struct BaseJoint {
  const char* name;
  v1::Joint::Role role;
  v1::Joint::Type type;
  Eigen::Vector3d axis;
  double least, most;  // range, m or rad; ±infinity: none
};
// The chain of the base, from the world on. BASE_PLANE: three joints, else six.
std::vector<BaseJoint> BaseJoints(v1::ModelSideFile::Base base);

bool IsBaseRole(v1::Joint::Role role);
// Whether joints of the file are the base: one of them has a base role.
bool HasOwnBase(const v1::ModelSideFile& side, const LinkTree& tree);

// Reads and checks a file against the tree that it belongs to. Throws Failure(kUsage) that names the file, the field,
// its value and what is accepted.
v1::ModelSideFile ReadSideFile(const std::string& path, const LinkTree& tree);
// The checks alone. `path` is for messages.
void CheckSideFile(const std::string& path, const v1::ModelSideFile& side, const LinkTree& tree);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_SIDE_FILE_H_
