// A Model of a tree of links and its side file.
#ifndef ROLLGAIT_CLIENT_IMPORT_TREE_MODEL_H_
#define ROLLGAIT_CLIENT_IMPORT_TREE_MODEL_H_

#include <string>
#include <vector>

#include "client/import/link_tree.h"
#include "rollgait/v1/model.pb.h"
#include "rollgait/v1/model_side_file.pb.h"

namespace rollgait::client {

// A model and how it came about, a sentence each.
struct ImportedModel {
  v1::Model model;
  std::vector<std::string> read, merged, assumed, left_out;
};

// Joints in the order of the tree behind the base; a link frame is the frame of the joint that moves it, at position
// zero, which is the side file's reference posture. Links behind fixed and locked joints are merged into the link that
// carries them. What is assumed is also a line of Model.sources. `side_path` is for messages; `side` has passed
// CheckSideFile. Throws Failure(kUsage) with file, element and reason for: joints that a model does not have and that
// are not locked; a reference out of range; actuated joints without limits; links with mass that no joint of the base
// carries; a second floating joint; joints that move and links with mass that are not behind the floating joint; names
// that Model does not accept.
ImportedModel ModelOfTree(const LinkTree& tree, const std::string& side_path, const v1::ModelSideFile& side);

// The name with "_" in place of what a model's name must not have, its first 64 characters; "model" for an empty one.
std::string AsModelName(const std::string& name);

// The same as ModelOfTree of two files.
ImportedModel ReadImportedModel(const std::string& path, const std::string& side_path);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_TREE_MODEL_H_
