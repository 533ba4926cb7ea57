#include "client/rotation_of_z.h"

#include <cmath>

namespace rollgait::client {

Eigen::Matrix3d RotationOfZTo(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d d = direction.stableNormalized();
  const double sine = std::hypot(d.x(), d.y()), cosine = d.z();
  // The axis (x, y, 0).
  const double x = sine > 0 ? -d.y() / sine : 1, y = sine > 0 ? d.x() / sine : 0;
  // 1 - cos without cancellation near e_z.
  const double versine = cosine > 0 ? sine * sine / (1 + cosine) : 1 - cosine;
  Eigen::Matrix3d rotation;
  rotation << cosine + versine * x * x, versine * x * y, d.x(),  //
      versine * x * y, cosine + versine * y * y, d.y(),          //
      -d.x(), -d.y(), cosine;
  return rotation;
}

}  // namespace rollgait::client
