#ifndef ROLLGAIT_CORE_MATH_DENSE_SOLVE_H_
#define ROLLGAIT_CORE_MATH_DENSE_SOLVE_H_

#include <Eigen/Core>

#include "core/base/types.h"

namespace rollgait {

// Dense decompositions of small matrices whose templates are slow to compile, each in one place. Not for inner loops:
// they allocate. `threshold`, relative to the largest pivot, is where a matrix counts as rank deficient.

struct LeastNormSolution {
  VectorX x;           // of all minimisers of |A x − b| the shortest
  MatrixX null_space;  // orthonormal columns, n × (n − rank)
  int rank = 0;
  double least_pivot = 1;  // of the pivots that count, relative to the largest
};

// By complete orthogonal decomposition (Golub, Van Loan, section 5.4). A may be of any shape; finite.
LeastNormSolution SolveLeastNorm(const MatrixX& a, const VectorX& b, double threshold = 1e-14);

// Orthonormal bases (columns) of the row space and of the null space.
void SplitRowSpace(const MatrixX& a, double threshold, MatrixX* row_space, MatrixX* null_space);

// Of a square matrix, real or in conjugate pairs, in no order.
Eigen::VectorXcd Eigenvalues(const MatrixX& a);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MATH_DENSE_SOLVE_H_
