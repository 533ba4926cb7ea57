#ifndef ROLLGAIT_CORE_VALIDATION_PIECES_H_
#define ROLLGAIT_CORE_VALIDATION_PIECES_H_

#include "core/math/chebyshev.h"

namespace rollgait {

// Functions of time, one a row, approximated by Chebyshev interpolants on pieces of an interval that are halved until
// the last coefficients are small enough. Extrema are then sought on the interpolants, between their samples, too.
class Pieces {
 public:
  explicit Pieces(const ChebyshevBasis& basis) : basis_(basis) {}

  const ChebyshevBasis& basis() const { return basis_; }
  // Of the piece at hand: one row a function; columns are nodes, coefficients, instants of the grid.
  const MatrixX& values() const { return values_; }
  const MatrixX& coefficients() const { return coefficients_; }
  const MatrixX& samples() const { return samples_; }

  // Covers [from, to] from left to right. sample(t, values, column) writes the functions at t into a column; resolved()
  // says whether the interpolants of the piece at hand are good enough; visit(from, to) takes a piece that is, or whose
  // length is 2^−halvings of the first, or on which a value is not finite. No allocation but the first time.
  template <class Sample, class Resolved, class Visit>
  void Cover(int rows, double from, double to, int halvings, const Sample& sample, const Resolved& resolved,
             const Visit& visit) {
    values_.resize(rows, basis_.size());
    for (int i = 0; i < basis_.size(); ++i) sample(from + basis_.node(i) * (to - from), &values_, i);
    Continue(from, to, halvings, sample, resolved, visit);
  }
  // The same where the first piece's values have been written by the caller.
  template <class Sample, class Resolved, class Visit>
  void Continue(double from, double to, int halvings, const Sample& sample, const Resolved& resolved,
                const Visit& visit) {
    basis_.Coefficients(values_, &coefficients_);
    if (halvings > 0 && values_.allFinite() && !resolved()) {
      const double middle = 0.5 * (from + to);
      const int rows = static_cast<int>(values_.rows());
      Cover(rows, from, middle, halvings - 1, sample, resolved, visit);
      Cover(rows, middle, to, halvings - 1, sample, resolved, visit);
      return;
    }
    basis_.OnGrid(coefficients_, &samples_);
    visit(from, to);
  }
  MatrixX* mutable_values(int rows) {
    values_.resize(rows, basis_.size());
    return &values_;
  }

 private:
  const ChebyshevBasis& basis_;
  MatrixX values_, coefficients_, samples_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_PIECES_H_
