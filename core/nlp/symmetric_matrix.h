#ifndef ROLLGAIT_CORE_NLP_SYMMETRIC_MATRIX_H_
#define ROLLGAIT_CORE_NLP_SYMMETRIC_MATRIX_H_

#include <vector>

#include "core/nlp/problem.h"

namespace rollgait {

// A sparse symmetric matrix, kept by the columns of its lower triangle, where a product reads and writes neighbours.
class SymmetricMatrix {
 public:
  // `pattern`: entries of one triangle (either, duplicates add) of a matrix of order `size`. Contract: rows and columns
  // within size.
  SymmetricMatrix(int size, const SparsityPattern& pattern);

  // The same entries by columns; row >= column. The entries on the diagonal come first in their column.
  const SparsityPattern& pattern() const { return pattern_; }
  // Where entry e of the pattern that was given went.
  int place(int e) const { return place_[e]; }

  // In the order of pattern().
  const double* values() const { return values_.data(); }
  double& value(int place) { return values_(place); }

  // Takes over values in the order of the pattern that was given.
  void Assign(const double* values);

  // y = A x; both of the matrix's order, y is not x.
  void Multiply(const VectorX& x, VectorX* y) const;

 private:
  int size_;
  SparsityPattern pattern_;
  std::vector<int> place_, source_;  // inverse permutations
  std::vector<int> first_, below_;   // of a column: its first entry, and its first below the diagonal
  VectorX values_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_SYMMETRIC_MATRIX_H_
