#include "core/ocp/costs/body_torque.h"

#include <cmath>

#include "core/base/check.h"

namespace rollgait {
namespace {

// N / c² with N = τ₁² + τ₃² − 2 s τ₁ τ₃, c² = 1 − s², and its derivatives by s = sin β.
struct Quotient {
  Quotient(double first, double third, double beta)
      : s(std::sin(beta)),
        c(std::cos(beta)),
        c2(c * c),
        slope(-2 * first * third),
        numerator(first * first + third * third + s * slope) {}
  double Value() const { return numerator / c2; }
  double First() const { return slope / c2 + 2 * s * numerator / (c2 * c2); }
  double Second() const { return (4 * s * slope + 2 * numerator) / (c2 * c2) + 8 * s * s * numerator / (c2 * c2 * c2); }
  double s, c, c2;
  double slope;  // dN/ds
  double numerator;
};

}  // namespace

BodyTorqueCost::BodyTorqueCost(int middle_joint, const PointLayout& layout, double typical)
    : beta_(layout.q() + middle_joint), tau_(layout.tau()), typical_(typical) {
  ROLLGAIT_CHECK(layout.efforts == 3);
}

Entries BodyTorqueCost::HessianPattern() const {
  return {{tau_, tau_},  {tau_ + 1, tau_ + 1}, {tau_ + 2, tau_ + 2}, {tau_, tau_ + 2},
          {beta_, tau_}, {beta_, tau_ + 2},    {beta_, beta_}};
}

double BodyTorqueCost::Value(const PointContext& at) {
  const double* const tau = at.z + tau_;
  return Quotient(tau[0], tau[2], at.z[beta_]).Value() + tau[1] * tau[1];
}

void BodyTorqueCost::AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) {
  const double* const tau = at.z + tau_;
  const Quotient q(tau[0], tau[2], at.z[beta_]);
  gradient(tau_) += weight * 2 * (tau[0] - q.s * tau[2]) / q.c2;
  gradient(tau_ + 1) += weight * 2 * tau[1];
  gradient(tau_ + 2) += weight * 2 * (tau[2] - q.s * tau[0]) / q.c2;
  gradient(beta_) += weight * q.First() * q.c;
}

void BodyTorqueCost::AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) {
  const double* const tau = at.z + tau_;
  const Quotient q(tau[0], tau[2], at.z[beta_]);
  const auto mixed = [&](double mine, double other) {
    return weight * q.c * (-2 * other / q.c2 + 4 * q.s * (mine - q.s * other) / (q.c2 * q.c2));
  };
  hessian(tau_, tau_) += weight * 2 / q.c2;
  hessian(tau_ + 1, tau_ + 1) += weight * 2;
  hessian(tau_ + 2, tau_ + 2) += weight * 2 / q.c2;
  hessian(tau_, tau_ + 2) -= weight * 2 * q.s / q.c2;
  hessian(tau_ + 2, tau_) -= weight * 2 * q.s / q.c2;
  hessian(beta_, tau_) += mixed(tau[0], tau[2]);
  hessian(beta_, tau_ + 2) += mixed(tau[2], tau[0]);
  hessian(beta_, beta_) += weight * (q.Second() * q.c2 - q.First() * q.s);
}

}  // namespace rollgait
