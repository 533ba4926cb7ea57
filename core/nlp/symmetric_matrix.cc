#include "core/nlp/symmetric_matrix.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace rollgait {
namespace {

// Entries in the order of their keys, 0 to size − 1; equal ones stay in turn.
template <typename Key>
std::vector<int> SortedBy(const Key& key, int size, const std::vector<int>& entries) {
  std::vector<int> next(size + 1, 0), sorted(entries.size());
  for (const int e : entries) ++next[key(e) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (const int e : entries) sorted[next[key(e)]++] = e;
  return sorted;
}

}  // namespace

SymmetricMatrix::SymmetricMatrix(int size, const SparsityPattern& pattern)
    : size_(size), place_(pattern.size()), source_(pattern.size()), values_(VectorX::Zero(pattern.size())) {
  const auto column_of = [&pattern](int e) { return std::min(pattern.rows[e], pattern.columns[e]); };
  const auto row_of = [&pattern](int e) { return std::max(pattern.rows[e], pattern.columns[e]); };
  std::iota(source_.begin(), source_.end(), 0);
  source_ = SortedBy(row_of, size, source_);
  source_ = SortedBy(column_of, size, source_);
  first_.assign(size + 1, 0);
  below_.assign(size, 0);
  pattern_.rows.reserve(pattern.size());
  pattern_.columns.reserve(pattern.size());
  for (int k = 0; k < pattern.size(); ++k) {
    const int e = source_[k], column = column_of(e), row = row_of(e);
    place_[e] = k;
    pattern_.Add(row, column);
    ++first_[column + 1];
    if (row == column) ++below_[column];
  }
  for (int j = 0; j < size; ++j) {
    first_[j + 1] += first_[j];
    below_[j] += first_[j];
  }
}

void SymmetricMatrix::Assign(const double* values) {
  for (size_t k = 0; k < source_.size(); ++k) values_[static_cast<int>(k)] = values[source_[k]];
}

void SymmetricMatrix::Multiply(const VectorX& x, VectorX* y) const {
  const double* __restrict value = values_.data();
  const double* __restrict in = x.data();
  double* __restrict out = y->data();
  const int* row = pattern_.rows.data();
  y->setZero();
  for (int j = 0; j < size_; ++j) {
    const double factor = in[j];
    double sum = 0;
    for (int e = first_[j]; e < below_[j]; ++e) sum += value[e] * factor;
    for (int e = below_[j]; e < first_[j + 1]; ++e) {
      sum += value[e] * in[row[e]];
      out[row[e]] += value[e] * factor;
    }
    out[j] += sum;
  }
}

}  // namespace rollgait
