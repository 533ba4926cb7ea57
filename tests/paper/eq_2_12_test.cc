// Eq. (2.12), the motion of the contact point. Printed:
//   d(¹x)/dt = ( (nᵀx) Ȧ⁻¹ n − ½ (nᵀ Ȧ⁻¹ n) x ) / √(nᵀ A⁻¹ n).
// The quotient rule gives the denominator nᵀ A⁻¹ n, the square of the printed root; and the left side is the absolute
// derivative of the vector CP, in world axes, not the rate of its body coordinates. The library uses S (ω × n) for the
// motion along the surface, which is the corrected value minus ω × CP without the cancellation.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/paper/moving_ellipsoid.h"
#include "tests/support/matrix_near.h"

namespace rollgait {
namespace {

struct Forms {
  Vector3 printed, corrected;
};

Forms Evaluate(const MovingEllipsoid& body) {
  const Matrix3 inverse_a = body.InverseA(0);
  const Matrix3 rate = Skew(body.omega) * inverse_a - inverse_a * Skew(body.omega);
  const Vector3 x = body.CP(0);
  const Vector3 numerator = body.n.dot(x) * (rate * body.n) - 0.5 * body.n.dot(rate * body.n) * x;
  const double square = body.n.dot(inverse_a * body.n);
  return {numerator / std::sqrt(square), numerator / square};
}

TEST(Equation2_12, TheDenominatorIsTheSquareOfThePrintedRoot) {
  MovingEllipsoid body;
  body.ellipsoid = Ellipsoid({0.135, 0.05, 0.068});  // a foot: the root is some centimetres
  const Forms forms = Evaluate(body);
  const Vector3 rate = Derivative([&](double t) { return body.CP(t); });
  EXPECT_TRUE(MatrixNear(forms.corrected, rate, kDerivativeTolerance));
  const double root = body.ellipsoid.Support(body.nu(0));
  EXPECT_TRUE(MatrixNear(forms.printed, root * rate, kDerivativeTolerance));
  EXPECT_LT(forms.printed.norm(), 0.2 * rate.norm());
}

// In units in which every length is ten times larger as a number, a velocity must grow tenfold; the printed form grows
// a hundredfold.
TEST(Equation2_12, ThePrintedFormHasTheWrongDimension) {
  MovingEllipsoid body;
  const Forms metres = Evaluate(body);
  body.ellipsoid = Ellipsoid(10 * body.ellipsoid.semi_axes());
  const Forms decimetres = Evaluate(body);
  EXPECT_TRUE(MatrixNear(decimetres.corrected, 10 * metres.corrected, 1e-13));
  EXPECT_TRUE(MatrixNear(decimetres.printed, 100 * metres.printed, 1e-12));
}

TEST(Equation2_12, IsAnAbsoluteDerivativeNotTheRateOfBodyCoordinates) {
  const MovingEllipsoid body;
  const Vector3 corrected = Evaluate(body).corrected;
  const Vector3 body_rate = Derivative([&](double t) { return Vector3(body.ellipsoid.SupportPoint(body.nu(t))); });
  const Vector3 along_surface = body.S() * body.omega.cross(body.n);
  EXPECT_TRUE(MatrixNear(body.R0 * body_rate, along_surface, kDerivativeTolerance));
  EXPECT_TRUE(MatrixNear(corrected - body.omega.cross(body.CP(0)), along_surface, 1e-13));
  EXPECT_GT((corrected - body.R0 * body_rate).norm(), 0.1 * corrected.norm());
}

// "When the plane also moves, (2.12) must be augmented with a second term": d(CP)/dt = ω₁ × CP + S ((ω₁ − ω₂) × n).
TEST(Equation2_12, MovingPlane) {
  const MovingEllipsoid body;
  const Vector3 omega_2(0.4, 0.7, -0.5);
  const Vector3 rate = Derivative([&](double t) {
    const Vector3 n = Rotation(omega_2 * t) * body.n;
    return Vector3(body.R(t) * body.ellipsoid.SupportPoint(-(body.R(t).transpose() * n)));
  });
  const Vector3 expected = body.omega.cross(body.CP(0)) + body.S() * (body.omega - omega_2).cross(body.n);
  EXPECT_TRUE(MatrixNear(expected, rate, kDerivativeTolerance));
  EXPECT_GT((rate - Evaluate(body).corrected).norm(), 0.1);
}

}  // namespace
}  // namespace rollgait
