// Numbers for files that programs read: the shortest decimal that reads back as the same double.
#ifndef ROLLGAIT_CLIENT_FORMATS_EXACT_NUMBER_H_
#define ROLLGAIT_CLIENT_FORMATS_EXACT_NUMBER_H_

#include <Eigen/Core>
#include <string>

namespace rollgait::client {

// "inf", "-inf" and "nan" as such; "0" for −0.
std::string Exact(double value);

// "x y z".
std::string Exact(const Eigen::Vector3d& vector);

// The unit quaternion of a rotation: "w x y z", w >= 0.
std::string ExactQuaternion(const Eigen::Matrix3d& rotation);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_EXACT_NUMBER_H_
