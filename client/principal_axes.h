// Principal axes of an inertia: the one place of the client that decomposes a matrix.
#ifndef ROLLGAIT_CLIENT_PRINCIPAL_AXES_H_
#define ROLLGAIT_CLIENT_PRINCIPAL_AXES_H_

#include <Eigen/Core>

namespace rollgait::client {

struct PrincipalAxes {
  Eigen::Vector3d moments;  // in ascending order, in the unit of the inertia
  Eigen::Matrix3d axes;     // column k is the axis of moment k; a rotation (determinant 1)
};

// Of a symmetric matrix (its lower triangle is read). Entries that are not finite give moments that are NaN.
PrincipalAxes PrincipalAxesOf(const Eigen::Matrix3d& inertia);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_PRINCIPAL_AXES_H_
