#include "client/rotation_of_z.h"

#include <cmath>

namespace rollgait::client {
namespace {

// The sine below which the compiler of MuJoCo 2.2 takes the axis e_x (found by trying; its vectors of a square below
// 1e-14 have no direction). A file has sin(pi) = 1.2e-16 where its author meant 0.
constexpr double kVertical = 1e-7;

}  // namespace

Eigen::Matrix3d RotationOfZTo(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d d = direction.stableNormalized();
  const double sine = std::hypot(d.x(), d.y()), cosine = d.z();
  if (sine < kVertical) return Eigen::Vector3d(1, std::copysign(1, cosine), std::copysign(1, cosine)).asDiagonal();
  const double x = -d.y() / sine, y = d.x() / sine;  // the axis (x, y, 0)
  // 1 - cos without cancellation near e_z.
  const double versine = cosine > 0 ? sine * sine / (1 + cosine) : 1 - cosine;
  Eigen::Matrix3d rotation;
  rotation << cosine + versine * x * x, versine * x * y, d.x(),  //
      versine * x * y, cosine + versine * y * y, d.y(),          //
      -d.x(), -d.y(), cosine;
  return rotation;
}

}  // namespace rollgait::client
