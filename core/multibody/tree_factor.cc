#include "core/multibody/tree_factor.h"

#include <cmath>
#include <cstddef>

#include "core/base/check.h"
#include "core/math/subtract_products.h"

namespace rollgait {

TreeFactor::TreeFactor(const std::vector<int>& parents) : first_{0}, inverse_(parents.size()) {
  const int n = size();
  std::vector<std::vector<int>> beyond(parents.size());
  for (int c = 0; c < n; ++c) {
    const int parent = parents[static_cast<size_t>(c)];
    ROLLGAIT_CHECK(parent >= -1 && parent < c);
    const int begin = parent < 0 ? 0 : first_[static_cast<size_t>(parent)];
    const int end = parent < 0 ? 0 : first_[static_cast<size_t>(parent) + 1];
    for (int k = begin; k < end; ++k) {
      const int before = path_[static_cast<size_t>(k)];
      path_.push_back(before);
      beyond[static_cast<size_t>(before)].push_back(c);
    }
    path_.push_back(c);
    first_.push_back(static_cast<int>(path_.size()));
  }
  first_beyond_.push_back(0);
  for (const std::vector<int>& columns : beyond) {
    beyond_.insert(beyond_.end(), columns.begin(), columns.end());
    first_beyond_.push_back(static_cast<int>(beyond_.size()));
  }
  std::vector<int> next = first_beyond_;
  for (int c = 0; c < n; ++c) {
    for (int k = first_[static_cast<size_t>(c)]; k < first_[static_cast<size_t>(c) + 1]; ++k) {
      const auto column = static_cast<size_t>(path_[static_cast<size_t>(k)]);
      place_.push_back(path_[static_cast<size_t>(k)] == c ? -1 : next[column]++);
    }
  }
  entries_.resize(path_.size());
  by_column_.resize(beyond_.size());
}

TreeFactor TreeFactor::Dense(int n) {
  std::vector<int> parents(static_cast<size_t>(n));
  for (int c = 0; c < n; ++c) parents[static_cast<size_t>(c)] = c - 1;
  return TreeFactor(parents);
}

void TreeFactor::Factorise(const MatrixX& mass) {
  ROLLGAIT_CHECK(mass.rows() == size() && mass.cols() == size());
  double* entry = entries_.data();
  const int* before = path_.data();
  for (int c = 0; c < size(); ++c) {
    const double* const column = mass.col(c).data();
    for (int k = path_length(c); k > 0; --k) *entry++ = column[*before++];
  }
  Factorise();
}

void TreeFactor::Factorise() {
  for (int c = size() - 1; c >= 0; --c) {
    const int length = path_length(c) - 1;  // without the diagonal
    const int begin = first_[static_cast<size_t>(c)];
    double* const pivot = row(c);
    const double inverse = inverse_[static_cast<size_t>(c)] = 1 / std::sqrt(pivot[length]);
    for (int k = 0; k < length; ++k) pivot[k] *= inverse;
    for (int k = 0; k < length; ++k) {
      const double factor = pivot[k];
      by_column_[static_cast<size_t>(place_[static_cast<size_t>(begin + k)])] = factor;
      // The path of a column on the path is the beginning of it.
      double* const __restrict changed = row(path_[static_cast<size_t>(begin + k)]);
      int j = 0;
      for (; j < k; j += 2) {  // by two, of k + 1: rows are short
        changed[j] -= factor * pivot[j];
        changed[j + 1] -= factor * pivot[j + 1];
      }
      if (j == k) changed[j] -= factor * pivot[j];
    }
  }
}

// Few columns: y_b −= L_cb y_c for all b on the path of c, in place of sums over what is beyond b.
template <int kColumns>
void TreeFactor::SolveTransposedFew(double* x, int stride) const {
  using Row = Eigen::Array<double, 1, kColumns>;
  for (int c = size() - 1; c >= 0; --c) {
    const int begin = first_[static_cast<size_t>(c)], end = first_[static_cast<size_t>(c) + 1] - 1;
    const double* const l = entries_.data();
    Eigen::Map<Row> given(x + static_cast<ptrdiff_t>(c) * stride);
    const Row solved = given * inverse_[static_cast<size_t>(c)];
    given = solved;
    for (int k = begin; k < end; ++k) {
      Eigen::Map<Row>(x + static_cast<ptrdiff_t>(path_[static_cast<size_t>(k)]) * stride) -= l[k] * solved;
    }
  }
}

void TreeFactor::SolveTransposed(double* x, int stride, int columns) const {
  if (columns == 1) return SolveTransposedFew<1>(x, stride);
  if (columns == 4) return SolveTransposedFew<4>(x, stride);
  if (columns == 8) return SolveTransposedFew<8>(x, stride);
  for (int c = size() - 1; c >= 0; --c) {
    const auto begin = static_cast<size_t>(first_beyond_[static_cast<size_t>(c)]);
    const int count = first_beyond_[static_cast<size_t>(c) + 1] - static_cast<int>(begin);
    double* const y = x + static_cast<ptrdiff_t>(c) * stride;
    // Rows of x are columns to the kernel.
    SubtractColumns(x, stride, beyond_.data() + begin, by_column_.data() + begin, count, columns, y);
    const double inverse = inverse_[static_cast<size_t>(c)];
    for (int k = 0; k < columns; ++k) y[k] *= inverse;
  }
}

void TreeFactor::SolveOne(double* x, int stride) const {
  for (int c = 0; c < size(); ++c) {
    const int begin = first_[static_cast<size_t>(c)], end = first_[static_cast<size_t>(c) + 1] - 1;
    double sum = x[static_cast<ptrdiff_t>(c) * stride];
    for (int k = begin; k < end; ++k) {
      sum -= entries_[static_cast<size_t>(k)] * x[static_cast<ptrdiff_t>(path_[static_cast<size_t>(k)]) * stride];
    }
    x[static_cast<ptrdiff_t>(c) * stride] = sum * inverse_[static_cast<size_t>(c)];
  }
}

void TreeFactor::Solve(double* x, int stride, int columns) const {
  if (columns == 1) return SolveOne(x, stride);
  for (int c = 0; c < size(); ++c) {
    const auto begin = static_cast<size_t>(first_[static_cast<size_t>(c)]);
    double* const y = x + static_cast<ptrdiff_t>(c) * stride;
    SubtractColumns(x, stride, path_.data() + begin, entries_.data() + begin, path_length(c) - 1, columns, y);
    const double inverse = inverse_[static_cast<size_t>(c)];
    for (int k = 0; k < columns; ++k) y[k] *= inverse;
  }
}

}  // namespace rollgait
