// Which joints of a tree are its legs.
#ifndef ROLLGAIT_CLIENT_IMPORT_LEG_CHAINS_H_
#define ROLLGAIT_CLIENT_IMPORT_LEG_CHAINS_H_

#include <vector>

#include "client/import/tree_posture.h"
#include "rollgait/v1/model.pb.h"

namespace rollgait::client {

// Index of the last joint of the chain that reaches lowest on a side, -1 if the side has none. A joint's side is that
// of its name, of its link's name, else that on which its link is, beyond 1 cm. `locked`: joints that move nothing.
int LegEnd(const LinkTree& tree, const TreePosture& posture, const std::vector<bool>& locked, v1::BodySide side);

// The joints from the hip to `end`, without what also carries the leg that ends at `other` (-1: there is none).
std::vector<int> LegTo(const TreePosture& posture, int end, int other);

// The axis in the world about which the first joint behind the hip bends whose range is mostly on one side: knees bend
// backwards, so it points to the left. Zero if there is none.
Eigen::Vector3d LeftOfKnees(const LinkTree& tree, const TreePosture& posture, const std::vector<int>& leg);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_LEG_CHAINS_H_
