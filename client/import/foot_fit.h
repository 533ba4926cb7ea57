// An ellipsoid for a foot that a file draws as simple shapes.
#ifndef ROLLGAIT_CLIENT_IMPORT_FOOT_FIT_H_
#define ROLLGAIT_CLIENT_IMPORT_FOOT_FIT_H_

#include <optional>
#include <vector>

#include "client/import/tree_posture.h"

namespace rollgait::client {

// The box along the axes of the world that holds the shapes of some links.
struct Extent {
  Eigen::Vector3d least, most;  // m
};
// Nothing if the links have no shapes.
std::optional<Extent> ExtentOf(const LinkTree& tree, const TreePosture& posture, const std::vector<int>& links);

struct FittedEllipsoid {
  Eigen::Vector3d center;     // m, world
  Eigen::Vector3d semi_axes;  // m, along the axes of the world
};

// As long and as broad as the extent, its lowest point in the middle of the extent's bottom. Its height is that of the
// extent, or more: the sole's radius of curvature along x is at most 0.3 of the leg (m), that of human feet, since an
// ellipsoid as flat as a sole would leave the ground at once. Semi-axes are rounded to 1e-6 m and at least 0.001 m.
FittedEllipsoid FitFoot(const Extent& extent, double leg);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_FOOT_FIT_H_
