#include <Eigen/Eigenvalues>

#include "core/math/dense_solve.h"

namespace rollgait {

Eigen::VectorXcd Eigenvalues(const MatrixX& a) { return Eigen::EigenSolver<MatrixX>(a, false).eigenvalues(); }

}  // namespace rollgait
