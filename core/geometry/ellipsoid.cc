#include "core/geometry/ellipsoid.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/check.h"

namespace rollgait {

// Everything is computed for the ellipsoid divided by its largest semi-axis, so that fourth powers of the axes neither
// overflow nor underflow; h, x, S, T and Q are all proportional to the size.

Ellipsoid::Ellipsoid(const Vector3& semi_axes) : semi_axes_(semi_axes), scale_(semi_axes.maxCoeff()) {
  ROLLGAIT_CHECK(semi_axes.allFinite() && semi_axes.minCoeff() > 0);
  unit_axes_ = semi_axes / scale_;
  const double a = unit_axes_(0), b = unit_axes_(1), c = unit_axes_(2);
  cofactors_ = Vector3(b * b * c * c, a * a * c * c, a * a * b * b);
}

double Ellipsoid::Support(const Vector3& nu) const { return scale_ * unit_axes_.cwiseProduct(nu).norm(); }

Vector3 Ellipsoid::SupportPoint(const Vector3& nu) const {
  const Vector3 d_nu = unit_axes_.cwiseProduct(nu);
  return semi_axes_.cwiseProduct(d_nu / d_nu.norm());
}

Matrix3 Ellipsoid::SupportHessian(const Vector3& nu) const {
  const double s = unit_axes_.cwiseProduct(nu).norm();
  return UnitHessian(nu, s) * scale_;
}

Matrix3 Ellipsoid::UnitHessian(const Vector3& nu, double s) const {
  const Vector3 weights = cofactors_ / (s * s * s);
  Matrix3 hessian;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    hessian(i, i) = nu(k) * nu(k) * weights(j) + nu(j) * nu(j) * weights(k);
    hessian(i, j) = hessian(j, i) = -nu(i) * nu(j) * weights(k);
  }
  return hessian;
}

Matrix3 Ellipsoid::UnitThird(const Vector3& x, const Matrix3& hessian, double s, const Vector3& u) {
  const Vector3 hessian_u = hessian * u;
  const Matrix3 outer = hessian_u * x.transpose();
  return -(outer + outer.transpose() + x.dot(u) * hessian) / s;
}

Matrix3 Ellipsoid::SupportThird(const Vector3& nu, const Vector3& u) const {
  const Vector3 d_nu = unit_axes_.cwiseProduct(nu);
  const double s = d_nu.norm();
  const Vector3 x = unit_axes_.cwiseProduct(d_nu / s);
  return UnitThird(x, UnitHessian(nu, s), s, u) * scale_;
}

Matrix3 Ellipsoid::SupportFourth(const Vector3& nu, const Vector3& u, const Vector3& w) const {
  const Vector3 d_nu = unit_axes_.cwiseProduct(nu);
  const double s = d_nu.norm();
  const Vector3 x = unit_axes_.cwiseProduct(d_nu / s);
  const Matrix3 hessian = UnitHessian(nu, s);
  const Matrix3 third_u = UnitThird(x, hessian, s, u);
  const Matrix3 third_w = UnitThird(x, hessian, s, w);
  const Vector3 hessian_u = hessian * u, hessian_w = hessian * w;
  const Matrix3 outer = (third_w * u) * x.transpose() + hessian_u * hessian_w.transpose();
  return -(outer + outer.transpose() + u.dot(hessian_w) * hessian + x.dot(u) * third_w + x.dot(w) * third_u) *
         (scale_ / s);
}

Vector3 Ellipsoid::RollingVelocity(const Vector3& nu, const Vector3& omega) const {
  const double s = unit_axes_.cwiseProduct(nu).norm();
  const Vector3 tangent = nu.cross(omega).cross(nu);
  return nu.cross(cofactors_.cwiseProduct(tangent)) * (scale_ / (s * s * s));
}

Eigen::Matrix2d Ellipsoid::TangentHessian(const Vector3& nu, const Eigen::Matrix<double, 3, 2>& tangents) const {
  const double s = unit_axes_.cwiseProduct(nu).norm();
  Eigen::Matrix<double, 3, 2> turned;
  turned << nu.cross(tangents.col(0)), nu.cross(tangents.col(1));
  return turned.transpose() * cofactors_.asDiagonal() * turned * (scale_ / (s * s * s));
}

// T_ijk = −(the three ways of S_ij x_k)/s,  Q_ijkl = −(the four ways of T_ijk x_l + the three ways of S_ij S_kl)/s.
void Ellipsoid::Evaluate(const Vector3& nu, int order, SupportJet* jet) const {
  const Vector3 d_nu = unit_axes_.cwiseProduct(nu);
  const double s = d_nu.norm();
  const Vector3 x = unit_axes_.cwiseProduct(d_nu / s);
  jet->order = order;
  jet->h = scale_ * s;
  jet->x = semi_axes_.cwiseProduct(d_nu / s);
  if (order < 2) return;
  const Matrix3 S = UnitHessian(nu, s);
  jet->S = S * scale_;
  if (order < 3) return;
  std::array<Matrix3, 3> T;
  for (int k = 0; k < 3; ++k) {
    const Matrix3 outer = S.col(k) * x.transpose();
    T[k] = -(outer + outer.transpose() + x[k] * S) / s;
    jet->T[k] = T[k] * scale_;
  }
  if (order < 4) return;
  for (int k = 0; k < 3; ++k) {
    for (int l = k; l < 3; ++l) {
      const Matrix3 outer = T[l].col(k) * x.transpose() + S.col(k) * S.col(l).transpose();
      jet->Q[SupportJet::PairIndex(k, l)] =
          -(outer + outer.transpose() + S(k, l) * S + x[k] * T[l] + x[l] * T[k]) * (scale_ / s);
    }
  }
}

}  // namespace rollgait
