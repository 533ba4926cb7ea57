#include "client/principal_axes.h"

#include <Eigen/Eigenvalues>
#include <limits>

namespace rollgait::client {

PrincipalAxes PrincipalAxesOf(const Eigen::Matrix3d& inertia) {
  if (!inertia.allFinite()) {
    return {Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()), Eigen::Matrix3d::Identity()};
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
  PrincipalAxes result{solver.eigenvalues(), solver.eigenvectors()};
  if (result.axes.col(0).cross(result.axes.col(1)).dot(result.axes.col(2)) < 0) result.axes.col(0) *= -1;
  return result;
}

}  // namespace rollgait::client
