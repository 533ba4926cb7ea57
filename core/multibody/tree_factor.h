#ifndef ROLLGAIT_CORE_MULTIBODY_TREE_FACTOR_H_
#define ROLLGAIT_CORE_MULTIBODY_TREE_FACTOR_H_

#include <vector>

#include "core/base/types.h"

namespace rollgait {

// M = Lᵀ L of a matrix that is symmetric, positive definite and zero where neither of row and column is on the other's
// path to the world, as the mass matrix of a tree is. L is lower triangular and zero in the same places.
// Source: Featherstone, Rigid Body Dynamics Algorithms (2008), section 6.5. No allocation after construction.
class TreeFactor {
 public:
  // parents[c] < c: the column before column c on its path to the world, −1 if there is none.
  explicit TreeFactor(const std::vector<int>& parents = {});
  // For a matrix without zeros: a chain of n columns.
  static TreeFactor Dense(int n);

  int size() const { return static_cast<int>(inverse_.size()); }
  // Row c of the lower triangle of M, to be written before Factorise: `path_length` entries, in the columns of the path
  // from the world to c, c the last.
  double* row(int c) { return entries_.data() + first_[static_cast<size_t>(c)]; }
  int path_length(int c) const { return length_[static_cast<size_t>(c)]; }
  void Factorise();
  // The same for the entries of M (n × n), of which it reads the upper triangle along the paths.
  void Factorise(const MatrixX& mass);

  // x ← L⁻ᵀ x and x ← L⁻¹ x for the `columns` columns of x, which has n rows, each `stride` after the last one. One
  // after the other: M⁻¹ x. Fastest if `columns` is a multiple of four.
  void SolveTransposed(double* x, int stride, int columns) const;
  void Solve(double* x, int stride, int columns) const;

 private:
  template <int kColumns>
  void SolveTransposedFew(double* x, int stride) const;
  void SolveOne(double* x, int stride) const;

  // Columns of the path to c: length_[c] of them from path_[first_[c]], then filling up to a multiple of four, so that
  // rows of entries_ are vectors without remainder.
  std::vector<int> path_, first_, length_;
  std::vector<int> beyond_, first_beyond_;  // columns beyond c (c on their path): beyond_[first_beyond_[c] … [c + 1])
  std::vector<int> place_;                  // of an entry below the diagonal in by_column_
  std::vector<int> row_of_;                 // of an entry: first_ of its column
  std::vector<double> entries_, by_column_;  // by row, as path_; by column, as beyond_
  std::vector<double> inverse_;              // 1 / L_cc
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MULTIBODY_TREE_FACTOR_H_
