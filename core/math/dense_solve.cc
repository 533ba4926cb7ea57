#include "core/math/dense_solve.h"

#include <Eigen/QR>

namespace rollgait {
namespace {

using Decomposition = Eigen::CompleteOrthogonalDecomposition<MatrixX>;

Decomposition Decompose(const MatrixX& a, double threshold) {
  Decomposition decomposition(a.rows(), a.cols());
  decomposition.setThreshold(threshold);
  decomposition.compute(a);
  return decomposition;
}

// A P = Q [T 0; 0 0] Z: the columns of P Zᵀ are the row space, then the null space. With full column rank there is no
// Z.
MatrixX Bases(const Decomposition& decomposition) {
  const Eigen::Index n = decomposition.cols();
  if (decomposition.rank() == n) return MatrixX::Identity(n, n);
  return decomposition.colsPermutation() * decomposition.matrixZ().transpose();
}

}  // namespace

LeastNormSolution SolveLeastNorm(const MatrixX& a, const VectorX& b, double threshold) {
  const Decomposition decomposition = Decompose(a, threshold);
  LeastNormSolution solution;
  solution.rank = static_cast<int>(decomposition.rank());
  if (solution.rank > 0) {
    const auto pivots = decomposition.matrixQTZ().diagonal().head(solution.rank).cwiseAbs();
    solution.least_pivot = pivots.minCoeff() / pivots.maxCoeff();
  }
  solution.x = decomposition.solve(b);
  solution.null_space.resize(a.cols(), a.cols() - solution.rank);
  if (solution.rank < a.cols()) solution.null_space = Bases(decomposition).rightCols(a.cols() - solution.rank);
  return solution;
}

void SplitRowSpace(const MatrixX& a, double threshold, MatrixX* row_space, MatrixX* null_space) {
  const Decomposition decomposition = Decompose(a, threshold);
  const MatrixX bases = Bases(decomposition);
  *row_space = bases.leftCols(decomposition.rank());
  *null_space = bases.rightCols(a.cols() - decomposition.rank());
}

}  // namespace rollgait
