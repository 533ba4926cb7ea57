#include "core/nlp/symmetric_matrix.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace rollgait {

SymmetricMatrix::SymmetricMatrix(int size, const SparsityPattern& pattern)
    : size_(size), first_(size + 1, 0), below_(size, 0) {
  const auto column_of = [&pattern](int e) { return std::min(pattern.rows[e], pattern.columns[e]); };
  const auto row_of = [&pattern](int e) { return std::max(pattern.rows[e], pattern.columns[e]); };
  // By columns first; those of one column are few, and lie close together in the pattern.
  std::vector<int> next(size + 1, 0);
  for (int e = 0; e < pattern.size(); ++e) {
    if (column_of(e) >= 0) ++next[column_of(e) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<int> entries(next[size]);
  for (int e = 0; e < pattern.size(); ++e) {
    if (column_of(e) >= 0) entries[next[column_of(e)]++] = e;
  }
  const size_t count = entries.size() + size;
  source_.reserve(count);
  pattern_.rows.reserve(count);
  pattern_.columns.reserve(count);
  const auto add = [this](int source, int row, int column) {
    source_.push_back(source);
    pattern_.Add(row, column);
  };
  const auto earlier_row = [&](int a, int b) { return std::pair(row_of(a), a) < std::pair(row_of(b), b); };
  auto entry = entries.begin();
  for (int j = 0; j < size; ++j) {
    const auto end = entries.begin() + next[j];  // the first of column j + 1
    std::sort(entry, end, earlier_row);
    first_[j] = pattern_.size();
    add(-1, j, j);
    for (; entry != end && row_of(*entry) == j; ++entry) add(*entry, j, j);
    below_[j] = pattern_.size();
    for (; entry != end; ++entry) add(*entry, row_of(*entry), j);
  }
  first_[size] = pattern_.size();
  values_ = VectorX::Zero(pattern_.size());
}

void SymmetricMatrix::Assign(const double* values) {
  for (int j = 0; j < size_; ++j) {
    for (int k = first_[j] + 1; k < first_[j + 1]; ++k) values_[k] = values[source_[k]];
  }
}

void SymmetricMatrix::Multiply(const double* x, double* y) const {
  const double* __restrict value = values_.data();
  const double* __restrict in = x;
  double* __restrict out = y;
  const int* row = pattern_.rows.data();
  std::fill(y, y + size_, 0.0);
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
