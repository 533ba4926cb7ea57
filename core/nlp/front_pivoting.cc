#include "core/nlp/front_pivoting.h"

#include <algorithm>
#include <cmath>

#include "core/math/subtract_products.h"
#include "core/nlp/panel_store.h"

namespace rollgait {
namespace {

// Columns are brought up to date with the pivots when they are looked at, and all of them every so many pivots.
constexpr int kPivotBlock = 16;
// Below this a column counts as zero: its unknown has no equation left in this front.
constexpr double kZeroColumn = 1e-250;

class Elimination {
 public:
  Elimination(const FrontPanel& panel, double threshold) : p_(panel), threshold_(threshold) {
    std::fill_n(p_.updated, p_.columns, 0);
  }

  FrontPivots Run() {
    int tried = 0;  // columns at the end of the list that were refused since the last pivot
    while (found_.count + tried < p_.columns) {
      const int order = TryPivot();
      if (order == 0) {
        Exchange(found_.count, p_.columns - 1 - tried);
        ++tried;
        continue;
      }
      found_.count += order;
      if (found_.count - flushed_ >= kPivotBlock) UpdateAll();
      tried = 0;
    }
    UpdateAll();
    return found_;
  }

 private:
  double* Column(int c) const { return p_.l + static_cast<size_t>(c) * p_.stride; }
  double* Scaled(int c) { return p_.ld + static_cast<size_t>(c) * p_.stride; }

  // First row of an update: that of the next pivot, or a little before it for the sake of whole lines. Nobody reads
  // what becomes of the rows of pivots.
  int FirstRow() const { return found_.count / kNumbersPerLine * kNumbersPerLine; }

  void Update(int c) {
    const int first = p_.updated[c], row = FirstRow();
    SubtractProducts(Column(first) + row, p_.stride, Scaled(first) + c, p_.stride, found_.count - first, p_.rows - row,
                     Column(c) + row);
    p_.updated[c] = found_.count;
  }

  // Columns that have seen equally many pivots go together.
  void UpdateAll() {
    const int row = FirstRow();
    for (int c = found_.count, end; c < p_.columns; c = end) {
      const int first = p_.updated[c];
      for (end = c + 1; end < p_.columns && p_.updated[end] == first;) ++end;
      SubtractProductMatrix(Column(first) + row, p_.stride, Scaled(first) + c, p_.stride, found_.count - first,
                            p_.rows - row, end - c, Column(c) + row, p_.stride);
      std::fill(p_.updated + c, p_.updated + end, found_.count);
    }
    flushed_ = found_.count;
  }

  void Exchange(int a, int b) {
    if (a == b) return;
    std::swap_ranges(Column(a), Column(a) + p_.rows, Column(b));
    for (int c = 0; c < p_.columns; ++c) std::swap(Column(c)[a], Column(c)[b]);
    for (int c = 0; c < found_.count; ++c) std::swap(Scaled(c)[a], Scaled(c)[b]);
    std::swap(p_.unknowns[a], p_.unknowns[b]);
    std::swap(p_.updated[a], p_.updated[b]);
  }

  // Largest entry of a column below the pivots, its diagonal and row `other` left out.
  double Largest(int column, int other) const {
    const double* x = Column(column);
    const int first = std::min(column, other), second = std::max(column, other);
    const int p = found_.count;
    return std::max({LargestMagnitude(x + p, first - p),
                     LargestMagnitude(x + first + 1, std::max(second - first - 1, 0)),
                     LargestMagnitude(x + second + 1, p_.rows - second - 1)});
  }

  // Row of the largest entry among the fully summed of column p = found_.count, its diagonal left out; -1 where all are
  // zero.
  int LargestSummed() const {
    const double* x = Column(found_.count);
    double most = 0;
    int where = -1;
    for (int i = found_.count + 1; i < p_.columns; ++i) {
      if (std::abs(x[i]) > most) {
        most = std::abs(x[i]);
        where = i;
      }
    }
    return where;
  }

  // Order of the pivot that was made at found_.count, 0 if there is none with this column.
  int TryPivot() {
    const int p = found_.count;
    Update(p);
    const double size = std::abs(Column(p)[p]);
    const double rest = Largest(p, p);
    if (std::max(size, rest) < kZeroColumn) return 0;
    if (size >= threshold_ * rest && size >= kZeroColumn) return Single(p);
    const int partner = LargestSummed();
    if (partner < 0) return 0;
    Update(partner);
    const double a = Column(p)[p], b = Column(p)[partner], c = Column(partner)[partner];
    const double rest_p = Largest(p, partner), rest_partner = Largest(partner, p);
    // |D⁻¹| (rest_p, rest_partner)ᵀ ≤ 1 / threshold, everything divided by b first.
    const double d = std::abs((a / b) * (c / b) - 1) * std::abs(b);
    const double first = std::abs(c / b) * rest_p + rest_partner, second = rest_p + std::abs(a / b) * rest_partner;
    if (d > 1e-10 * std::abs(b) && threshold_ * std::max(first, second) <= d) {
      Exchange(p + 1, partner);
      return Double(p);
    }
    if (std::abs(c) >= threshold_ * std::max(std::abs(b), rest_partner) && std::abs(c) >= kZeroColumn) {
      Exchange(p, partner);
      return Single(p);
    }
    return 0;
  }

  int Single(int p) {
    double* x = Column(p);
    const double d = x[p];
    p_.diagonal[p] = d;
    ScaleAndKeep(1 / d, p_.rows - p, x + p, Scaled(p) + p);
    x[p] = 1;
    found_.negative += d < 0 ? 1 : 0;
    return 1;
  }

  int Double(int p) {
    double* __restrict x = Column(p), * __restrict y = Column(p + 1);
    double* __restrict scaled_x = Scaled(p), * __restrict scaled_y = Scaled(p + 1);
    const double a = x[p], b = x[p + 1], c = y[p + 1];
    p_.diagonal[p] = a;
    p_.diagonal[p + 1] = c;
    p_.coupling[p] = b;
    const double ratio_a = a / b, ratio_c = c / b, inverse = 1 / (b * (ratio_a * ratio_c - 1));
    for (int i = p; i < p_.rows; ++i) {
      const double u = x[i], v = y[i];
      scaled_x[i] = u;
      scaled_y[i] = v;
      x[i] = (ratio_c * u - v) * inverse;
      y[i] = (ratio_a * v - u) * inverse;
    }
    x[p] = y[p + 1] = 1;
    x[p + 1] = y[p] = 0;
    if (ratio_a * ratio_c < 1) {
      found_.negative += 1;
    } else {
      found_.negative += a < 0 ? 2 : 0;
    }
    return 2;
  }

  const FrontPanel& p_;
  const double threshold_;
  int flushed_ = 0;
  FrontPivots found_;
};

}  // namespace

FrontPivots EliminateFront(const FrontPanel& panel, double threshold) { return Elimination(panel, threshold).Run(); }

}  // namespace rollgait
