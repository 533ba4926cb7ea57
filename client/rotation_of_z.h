// The rotation that turns one axis into a direction by the shortest way.
#ifndef ROLLGAIT_CLIENT_ROTATION_OF_Z_H_
#define ROLLGAIT_CLIENT_ROTATION_OF_Z_H_

#include <Eigen/Core>

namespace rollgait::client {

// R with R e_z = direction / |direction| and the smallest angle, by Rodrigues' formula. Within 1e-7 rad of e_z it is
// the identity, and within 1e-7 rad of -e_z half a turn about e_x, as for `zaxis` of MuJoCo. `direction` is finite and
// not zero, of any length.
Eigen::Matrix3d RotationOfZTo(const Eigen::Vector3d& direction);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_ROTATION_OF_Z_H_
