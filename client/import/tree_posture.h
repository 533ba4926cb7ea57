// Where the links of a tree are, and which joints move which.
#ifndef ROLLGAIT_CLIENT_IMPORT_TREE_POSTURE_H_
#define ROLLGAIT_CLIENT_IMPORT_TREE_POSTURE_H_

#include <map>
#include <string>
#include <vector>

#include "client/import/link_tree.h"

namespace rollgait::client {

struct TreePosture {
  std::vector<Pose> links;    // link frame -> world
  std::vector<int> moved_by;  // of each link: index of the last joint that moves it, -1: it is fixed to the root
  std::vector<int> behind;    // of each joint that moves: index of the joint that moves its parent link, -1: none
  std::vector<Eigen::Vector3d> axes;    // of each joint: its axis in the world
  std::vector<Eigen::Vector3d> joints;  // of each joint: origin of its moved frame in the world
};

// `root` places the root link; joints named in `positions` are there (rad, m), all others at zero; `locked` joints and
// fixed, planar and floating ones move nothing.
TreePosture PostureOf(const LinkTree& tree, const Pose& root, const std::map<std::string, double>& positions,
                      const std::vector<bool>& locked);

// Joints from the root to `joint`, that one last.
std::vector<int> ChainTo(const TreePosture& posture, int joint);

// The links that `joint` moves and no joint behind it does.
std::vector<int> LinksMovedBy(const TreePosture& posture, int joint);

// Of each joint whether no link behind it has mass.
std::vector<bool> JointsWithoutMass(const LinkTree& tree);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_TREE_POSTURE_H_
