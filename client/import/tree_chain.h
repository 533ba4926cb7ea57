// A joint of several degrees of freedom as joints one behind the other.
#ifndef ROLLGAIT_CLIENT_IMPORT_TREE_CHAIN_H_
#define ROLLGAIT_CLIENT_IMPORT_TREE_CHAIN_H_

#include <string>
#include <vector>

#include "client/import/link_tree.h"

namespace rollgait::client {

struct TreeChain {
  std::string name = {};        // of the joint that stands for a chain that is fixed or floats
  int parent = -1, child = -1;  // indices of links
  bool from_world = false;      // the parent is the world
  // Each origin in the moved frame of the joint before it; parent and child are set by AddChain.
  std::vector<TreeJoint> joints = {};
  Pose end = kNoMotion;  // child's link frame in the moved frame of the last joint; of no joint: in the parent's
};

// Adds the joints, with links without mass between them, which have the joints' names and "_link". Without joints the
// child is fixed. From the world, three slides and three turns about independent axes are one floating joint, and so
// are two slides and a turn in the plane of x and z, with base_in_plane; where that joint puts the child is not kept:
// gaits do not depend on it. Returns whether the chain floats.
bool AddChain(TreeChain chain, LinkTree* tree);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_TREE_CHAIN_H_
