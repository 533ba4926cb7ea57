#include "core/geometry/sphere.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/check.h"

namespace rollgait {

Sphere::Sphere(double radius) : radius_(radius) { ROLLGAIT_CHECK(std::isfinite(radius) && radius > 0); }

Matrix3 Sphere::SupportHessian(const Vector3& nu) const {
  SupportJet jet;
  Evaluate(nu, 2, &jet);
  return jet.S;
}

Vector3 Sphere::RollingVelocity(const Vector3& nu, const Vector3& omega) const { return radius_ * nu.cross(omega); }

void Sphere::Evaluate(const Vector3& nu, int order, SupportJet* jet) const {
  jet->h = 0;
  jet->x.setZero();
  if (order >= 2) jet->S.setZero();
  if (order >= 3) jet->T.fill(Matrix3::Zero());
  if (order >= 4) jet->Q.fill(Matrix3::Zero());
  jet->order = order;
  AddBall(nu, radius_, order, jet);
}

// With m = ν/|ν| and P = I − m mᵀ:  S = ρ P/|ν|,  T = −(sum over the three ways to split the indices of S m)/|ν|,
// Q = −(the four ways of T m and the three ways of P P ρ/|ν|²)/|ν|.
void AddBall(const Vector3& nu, double radius, int order, SupportJet* jet) {
  const double length = nu.norm();
  const Vector3 m = nu / length;
  jet->h += radius * length;
  jet->x += radius * m;
  if (order < 2) return;
  const double a = m.x(), b = m.y(), c = m.z(), scale = radius / length;
  Matrix3 S;  // no subtraction: 1 − a² = b² + c²
  S << b * b + c * c, -a * b, -a * c, -a * b, a * a + c * c, -b * c, -a * c, -b * c, a * a + b * b;
  S *= scale;
  jet->S += S;
  if (order < 3) return;
  std::array<Matrix3, 3> T;
  for (int k = 0; k < 3; ++k) {
    const Matrix3 outer = S.col(k) * m.transpose();
    T[k] = -(outer + outer.transpose() + m[k] * S) / length;
    jet->T[k] += T[k];
  }
  if (order < 4) return;
  for (int k = 0; k < 3; ++k) {
    for (int l = k; l < 3; ++l) {
      const Matrix3 outer = T[l].col(k) * m.transpose() + S.col(k) * S.col(l).transpose() / radius;
      jet->Q[SupportJet::PairIndex(k, l)] -=
          (outer + outer.transpose() + S(k, l) / radius * S + m[k] * T[l] + m[l] * T[k]) / length;
    }
  }
}

}  // namespace rollgait
