#ifndef ROLLGAIT_CORE_NLP_SYMMETRIC_MATRIX_H_
#define ROLLGAIT_CORE_NLP_SYMMETRIC_MATRIX_H_

#include <vector>

#include "core/nlp/problem.h"

namespace rollgait {

// A sparse symmetric matrix, kept by the columns of its lower triangle, where a product reads and writes neighbours. To
// the entries of a pattern it adds one on the diagonal of every column.
class SymmetricMatrix {
 public:
  // `pattern`: entries of one triangle (either, duplicates add) of a matrix of order `size`. An entry whose row or
  // column is negative is left out. Contract: rows and columns below size.
  SymmetricMatrix(int size, const SparsityPattern& pattern);

  // All entries by columns; row >= column. The added entry is the first of its column, then come the others on the
  // diagonal, then those below it by rows.
  const SparsityPattern& pattern() const { return pattern_; }
  // In the order of pattern().
  const double* values() const { return values_.data(); }

  // Takes over values in the order of the pattern that was given. The added entries stay.
  void Assign(const double* values);
  // The added entry of a column.
  double& diagonal(int column) { return values_(first_[column]); }

  // y = A x; both of the matrix's order, y is not x.
  void Multiply(const double* x, double* y) const;

 private:
  int size_;
  SparsityPattern pattern_;
  std::vector<int> source_;         // of an entry: its place in the pattern that was given; −1: added
  std::vector<int> first_, below_;  // of a column: its first entry, and its first below the diagonal
  VectorX values_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_SYMMETRIC_MATRIX_H_
