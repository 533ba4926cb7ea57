#ifndef ROLLGAIT_CORE_BASE_TYPES_H_
#define ROLLGAIT_CORE_BASE_TYPES_H_

#include <Eigen/Core>
#include <limits>

namespace rollgait {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using VectorX = Eigen::VectorXd;
using MatrixX = Eigen::MatrixXd;
using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_BASE_TYPES_H_
