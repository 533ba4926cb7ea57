#ifndef ROLLGAIT_CORE_MATH_CHEBYSHEV_H_
#define ROLLGAIT_CORE_MATH_CHEBYSHEV_H_

#include <vector>

#include "core/base/types.h"

namespace rollgait {

// Interpolation on [0, 1] by polynomials of degree n in the points where the Chebyshev polynomial T_n has its extrema.
// An analytic function is approximated with an error that falls geometrically with n, of the size of the last
// coefficients. Immutable after construction. Source: Trefethen, Approximation Theory and Approximation Practice,
// chapters 3, 4 and 8.
class ChebyshevBasis {
 public:
  // Contract: degree >= 2, samples >= 1 (of the dense grid, in equal steps).
  ChebyshevBasis(int degree, int samples);

  int size() const { return static_cast<int>(nodes_.size()); }  // n + 1
  double node(int i) const { return nodes_[i]; }                // ascending, 0 and 1 among them
  const std::vector<double>& grid() const { return grid_; }     // samples + 1 instants, 0 and 1 among them

  // One function a row: values at the nodes -> coefficients of T_0, T_1, …, in x = 2 θ − 1. No allocation if sizes fit.
  void Coefficients(const MatrixX& values, MatrixX* coefficients) const {
    coefficients->noalias() = values * transform_;
  }
  // The interpolants on the grid.
  void OnGrid(const MatrixX& coefficients, MatrixX* values) const { values->noalias() = coefficients * dense_; }
  // One interpolant at θ, by Clenshaw's rule.
  static double Evaluate(const MatrixX& coefficients, int row, double theta);
  // Size of the last two coefficients.
  static double Tail(const MatrixX& coefficients, int row);

 private:
  std::vector<double> nodes_, grid_;
  MatrixX transform_, dense_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MATH_CHEBYSHEV_H_
