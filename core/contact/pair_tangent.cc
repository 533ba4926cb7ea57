#include "core/contact/pair_tangent.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace rollgait {
namespace {

// Two unit vectors ⟂ ν, starting from the axis that is furthest from it.
Eigen::Matrix<double, 3, 2> TangentBasis(const Vector3& nu) {
  int axis;
  nu.cwiseAbs().minCoeff(&axis);
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = nu.cross(Vector3(Vector3::Unit(axis))).normalized();
  basis.col(1) = nu.cross(Vector3(basis.col(0)));
  return basis;
}

// Rotates the basis so that the symmetric matrix becomes diagonal (Jacobi; the smaller of the two angles, by Golub and
// Van Loan, Matrix Computations, 8.5.2).
void Diagonalise(const Eigen::Matrix2d& matrix, Eigen::Matrix<double, 3, 2>* basis) {
  if (matrix(0, 1) == 0) return;
  const double ratio = (matrix(1, 1) - matrix(0, 0)) / (2 * matrix(0, 1));
  const double tangent = std::copysign(1 / (std::abs(ratio) + std::sqrt(1 + ratio * ratio)), ratio);
  const double cosine = 1 / std::sqrt(1 + tangent * tangent), sine = tangent * cosine;
  const Vector3 first = basis->col(0), second = basis->col(1);
  basis->col(0) = cosine * first - sine * second;
  basis->col(1) = cosine * second + sine * first;
}

}  // namespace

PairTangent::PairTangent(const PosedSurface& body_1, const PosedSurface& body_2, const Vector3& nu, double distance) {
  const Vector3 nu_1 = body_1.R_WE.transpose() * nu, nu_2 = -(body_2.R_WE.transpose() * nu);
  basis = TangentBasis(nu);
  for (int pass = 0; pass < 2; ++pass) {
    S_1 = body_1.surface->TangentHessian(nu_1, body_1.R_WE.transpose() * basis);
    S_2 = body_2.surface->TangentHessian(nu_2, body_2.R_WE.transpose() * basis);
    finite = S_1.allFinite() && S_2.allFinite();
    if (!finite) {
      curvature.setConstant(kInfinity);
      inverse_.setZero();
      return;
    }
    if (pass == 0) Diagonalise(S_1 + S_2, &basis);
  }
  Eigen::Matrix2d sum = S_1 + S_2;
  sum.diagonal().array() += distance;
  curvature = sum.diagonal();
  inverse_ = sum.inverse();
}

}  // namespace rollgait
