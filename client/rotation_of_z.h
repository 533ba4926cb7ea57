// The rotation that turns one axis into a direction by the shortest way.
#ifndef ROLLGAIT_CLIENT_ROTATION_OF_Z_H_
#define ROLLGAIT_CLIENT_ROTATION_OF_Z_H_

#include <Eigen/Core>

namespace rollgait::client {

// R with R e_z = direction / |direction| and the smallest angle, by Rodrigues' formula. About e_x for -e_z, where every
// horizontal axis would do (MuJoCo's `zaxis` takes the same). `direction` is finite and not zero, of any length.
Eigen::Matrix3d RotationOfZTo(const Eigen::Vector3d& direction);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_ROTATION_OF_Z_H_
