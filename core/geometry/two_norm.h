#ifndef ROLLGAIT_CORE_GEOMETRY_TWO_NORM_H_
#define ROLLGAIT_CORE_GEOMETRY_TWO_NORM_H_

namespace rollgait {

// The norm N(u, v) = (u^q + v^q)^(1/q) of two numbers ≥ 0, not both zero, q > 1, with its partial derivatives up to the
// fourth. With û = u/N, v̂ = v/N, P = û^q and R = v̂^q:
//   ∂^(i+j) N/∂u^i ∂v^j = N^(1−i−j) û^(−i) v̂^(−j) F_ij(P, R)
// where F_ij are the polynomials of table kTerms, every one a multiple of PR for i + j ≥ 2. Exact powers are formed
// from the sum of the exponents, so nothing is divided by a small number that it was multiplied by before.
class TwoNorm {
 public:
  TwoNorm(double u, double v, double q);

  double value() const { return value_; }
  double u() const { return u_; }  // û
  double v() const { return v_; }  // v̂
  // û^(−shift_u) v̂^(−shift_v) F_ij. With shifts (i, j) it is N^(i+j−1) times the partial derivative. May be infinite
  // where the derivative is; never NaN.
  double Scaled(int i, int j, int shift_u, int shift_v) const;

 private:
  double q_, value_, u_, v_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_TWO_NORM_H_
