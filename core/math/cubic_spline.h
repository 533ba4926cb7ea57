#ifndef ROLLGAIT_CORE_MATH_CUBIC_SPLINE_H_
#define ROLLGAIT_CORE_MATH_CUBIC_SPLINE_H_

#include <vector>

namespace rollgait {

// Natural cubic spline through values at equally spaced θ from 0 to 1 (at least two, finite): twice continuously
// differentiable, second derivative zero at both ends. Outside 0 … 1 the outermost pieces go on. Value type.
class CubicSpline {
 public:
  explicit CubicSpline(std::vector<double> values);

  // The spline and its first and second derivative by θ.
  double Value(double theta) const;
  double First(double theta) const;
  double Second(double theta) const;

 private:
  // Piece of θ and the weights of its right end (t) and left end (1 − t).
  struct Place {
    int piece;
    double t;
  };
  Place Find(double theta) const;

  std::vector<double> values_;
  std::vector<double> curvatures_;  // second derivatives at the knots
  double spacing_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MATH_CUBIC_SPLINE_H_
