#include "core/multibody/tree_factor.h"

#include <cmath>
#include <cstddef>

#include "core/base/check.h"
#include "core/math/subtract_products.h"

namespace rollgait {
namespace {

constexpr int kWidth = 4;
int RoundUp(int length) { return (length + kWidth - 1) & -kWidth; }

}  // namespace

TreeFactor::TreeFactor(const std::vector<int>& parents) : inverse_(parents.size()) {
  const int n = size();
  std::vector<std::vector<int>> beyond(parents.size());
  for (int c = 0; c < n; ++c) {
    const int parent = parents[static_cast<size_t>(c)];
    ROLLGAIT_CHECK(parent >= -1 && parent < c);
    first_.push_back(static_cast<int>(path_.size()));
    const int shared = parent < 0 ? 0 : length_[static_cast<size_t>(parent)];
    for (int k = 0; k < shared; ++k) {
      const int before = path_[static_cast<size_t>(first_[static_cast<size_t>(parent)] + k)];
      path_.push_back(before);
      beyond[static_cast<size_t>(before)].push_back(c);
    }
    path_.push_back(c);
    length_.push_back(shared + 1);
    path_.resize(static_cast<size_t>(first_.back() + RoundUp(shared + 1)), c);
  }
  first_beyond_.push_back(0);
  for (const std::vector<int>& columns : beyond) {
    beyond_.insert(beyond_.end(), columns.begin(), columns.end());
    first_beyond_.push_back(static_cast<int>(beyond_.size()));
  }
  std::vector<int> next = first_beyond_;
  place_.resize(path_.size());
  for (int c = 0; c < n; ++c) {
    for (int k = 0; k + 1 < path_length(c); ++k) {
      const auto entry = static_cast<size_t>(first_[static_cast<size_t>(c)] + k);
      place_[entry] = next[static_cast<size_t>(path_[entry])]++;
    }
  }
  for (const int column : path_) row_of_.push_back(first_[static_cast<size_t>(column)]);
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
  for (int c = 0; c < size(); ++c) {
    const double* const column = mass.col(c).data();
    double* const entry = row(c);
    const int* const before = path_.data() + first_[static_cast<size_t>(c)];
    for (int k = 0; k < path_length(c); ++k) entry[k] = column[before[k]];
  }
  Factorise();
}

void TreeFactor::Factorise() {
  using Four = Eigen::Map<Eigen::Array<double, 4, 1>>;
  double* const entries = entries_.data();
  double* const by_column = by_column_.data();
  for (int c = size() - 1; c >= 0; --c) {
    const int last = path_length(c) - 1;  // the diagonal
    const int begin = first_[static_cast<size_t>(c)];
    double* const pivot = entries + begin;
    const double inverse = inverse_[static_cast<size_t>(c)] = 1 / std::sqrt(pivot[last]);
    for (int j = last; j < RoundUp(last + 1); ++j) pivot[j] = 0;  // what follows the row takes no part
    for (int j = 0; j < last; j += kWidth) Four(pivot + j) *= inverse;
    const int* const places = place_.data() + begin;
    const int* const rows = row_of_.data() + begin;
    for (int k = 0; k < last; ++k) {
      const double factor = pivot[k];
      by_column[places[k]] = factor;
      // The path of a column on the path is the beginning of it; entries beyond the diagonal of that row are its
      // filling.
      double* const changed = entries + rows[k];
      for (int j = 0; j <= k; j += kWidth) Four(changed + j) -= factor * Four(pivot + j);
    }
  }
}

// Few columns: y_b −= L_cb y_c for all b on the path of c, in place of sums over what is beyond b.
template <int kColumns>
void TreeFactor::SolveTransposedFew(double* x, int stride) const {
  using Row = Eigen::Array<double, 1, kColumns>;
  for (int c = size() - 1; c >= 0; --c) {
    const int begin = first_[static_cast<size_t>(c)], end = begin + path_length(c) - 1;
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
    const int begin = first_[static_cast<size_t>(c)], end = begin + path_length(c) - 1;
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
