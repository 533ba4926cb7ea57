#include "client/import/foot_fit.h"

#include <algorithm>
#include <cmath>

#include "client/import/lumped_links.h"

namespace rollgait::client {
namespace {

// Half the shape's extent along each axis of the world.
Eigen::Vector3d HalfExtent(const TreeShape& shape, const Eigen::Matrix3d& rotation) {
  if (shape.kind == TreeShape::Kind::kSphere) return shape.half_size;
  if (shape.kind == TreeShape::Kind::kBox) return rotation.cwiseAbs() * shape.half_size;
  if (shape.kind == TreeShape::Kind::kEllipsoid) {
    return (rotation * shape.half_size.asDiagonal()).rowwise().norm();
  }
  const Eigen::Vector3d axis = rotation.col(2);
  if (shape.kind == TreeShape::Kind::kCapsule) {
    return Eigen::Vector3d::Constant(shape.half_size.x()) + shape.half_size.z() * axis.cwiseAbs();
  }
  const Eigen::Vector3d across = (Eigen::Vector3d::Ones() - axis.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
  return shape.half_size.x() * across + shape.half_size.z() * axis.cwiseAbs();
}

double Rounded(double metres) { return std::max(0.001, std::round(metres * 1e6) / 1e6); }

}  // namespace

std::optional<Extent> ExtentOf(const LinkTree& tree, const TreePosture& posture, const std::vector<int>& links) {
  std::optional<Extent> extent;
  for (const int link : links) {
    for (const TreeShape& shape : tree.links[static_cast<size_t>(link)].shapes) {
      const Pose place = Compose(posture.links[static_cast<size_t>(link)], shape.place);
      const Eigen::Vector3d half = HalfExtent(shape, place.rotation);
      const Eigen::Vector3d least = place.position - half, most = place.position + half;
      extent = extent ? Extent{extent->least.cwiseMin(least), extent->most.cwiseMax(most)} : Extent{least, most};
    }
  }
  return extent;
}

FittedEllipsoid FitFoot(const Extent& extent, double leg) {
  constexpr double kHumanSoleRadius = 0.3;  // of the leg: Adamczyk, Collins, Kuo 2006, J Exp Biol 209:3953
  const Eigen::Vector3d half = (extent.most - extent.least) / 2, middle = (extent.most + extent.least) / 2;
  const double height = std::max(half.z(), half.x() * half.x() / (kHumanSoleRadius * leg));
  const Eigen::Vector3d semi_axes(Rounded(half.x()), Rounded(half.y()), Rounded(height));
  return {{middle.x(), middle.y(), extent.least.z() + semi_axes.z()}, semi_axes};
}

}  // namespace rollgait::client
