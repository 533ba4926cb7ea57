#include "core/math/collocation.h"

#include <Eigen/LU>
#include <cmath>

#include "core/base/check.h"

namespace rollgait {
namespace {

// Coefficients (ascending powers) of the Lagrange polynomials through c: column j belongs to point j.
MatrixX LagrangeCoefficients(const VectorX& c) {
  const int s = static_cast<int>(c.size());
  MatrixX vandermonde(s, s);
  for (int i = 0; i < s; ++i) {
    for (int p = 0; p < s; ++p) vandermonde(i, p) = std::pow(c(i), p);
  }
  return vandermonde.inverse();
}

VectorX Integrate(const VectorX& c, double theta, int times) {
  const MatrixX coefficients = LagrangeCoefficients(c);
  VectorX values = VectorX::Zero(c.size());
  for (int p = 0; p < c.size(); ++p) {
    double factor = std::pow(theta, p + times);
    for (int t = 1; t <= times; ++t) factor /= p + t;
    values += factor * coefficients.row(p).transpose();
  }
  return values;
}

// Rounding noise of the elimination is a structural zero.
void Clean(MatrixX& m) {
  for (double& value : m.reshaped()) {
    if (std::abs(value) < 1e-12) value = 0;
    if (std::abs(value - 1) < 1e-12) value = 1;
  }
}

}  // namespace

VectorX LagrangeValues(const VectorX& c, double theta) { return Integrate(c, theta, 0); }
VectorX LagrangeIntegrals(const VectorX& c, double theta) { return Integrate(c, theta, 1); }
VectorX LagrangeSecondIntegrals(const VectorX& c, double theta) { return Integrate(c, theta, 2); }

Tableau CollocationTableau(const VectorX& c, int order) {
  const int s = static_cast<int>(c.size());
  Tableau tableau;
  tableau.c = c;
  tableau.order = order;
  tableau.effort_degree = s - 1;
  tableau.A.resize(s, s);
  for (int i = 0; i < s; ++i) tableau.A.row(i) = LagrangeIntegrals(c, c(i)).transpose();
  tableau.b = LagrangeIntegrals(c, 1);
  return tableau;
}

Tableau ExplicitTableau(const VectorX& c, const std::vector<double>& stages, int order, int effort_degree) {
  const Eigen::Index s = c.size();
  ROLLGAIT_CHECK(static_cast<Eigen::Index>(stages.size()) == s * (s - 1) / 2);
  Tableau tableau{MatrixX::Zero(s, s), LagrangeIntegrals(c, 1), c, order, effort_degree, true};
  auto next = stages.begin();
  for (Eigen::Index i = 1; i < s; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) tableau.A(i, j) = *next++;
  }
  return tableau;
}

EliminatedScheme::EliminatedScheme(const Tableau& tableau)
    : tableau_(tableau), points_(tableau.points()), sources_(tableau.points() + 2) {
  const int s = points_, free = s - 2;
  // With h = 1. Rows of `a` express the accelerations in the sources (q₀, v₀, q_e, v_e, a_1 … a_{s−2}).
  MatrixX a = MatrixX::Zero(s, sources_);
  for (int j = 0; j < free; ++j) a(j, 4 + j) = 1;
  const VectorX velocity_weights = tableau.b;
  const VectorX position_weights = tableau.A.transpose() * tableau.b;
  Eigen::Matrix2d lhs;
  lhs << velocity_weights.tail<2>().transpose(), position_weights.tail<2>().transpose();
  MatrixX rhs = MatrixX::Zero(2, sources_);
  rhs.row(0) << 0, -1, 0, 1, -velocity_weights.head(free).transpose();
  rhs.row(1) << -1, -1, 1, 0, -position_weights.head(free).transpose();
  a.bottomRows(2) = lhs.inverse() * rhs;
  MatrixX v = tableau.A * a;
  v.col(1).array() += 1;
  MatrixX q = tableau.A * tableau.A * a;
  q.col(0).array() += 1;
  q.col(1) += tableau.c;
  coefficient_[kPosition] = q;
  coefficient_[kVelocity] = v;
  coefficient_[kAcceleration] = a;
  for (MatrixX& m : coefficient_) Clean(m);
}

// Powers of h by dimension: a source of position (0), velocity (1) or acceleration (2) enters quantity k with h^(order
// − k).
int EliminatedScheme::Power(Kind kind, int source) const {
  const int order = source >= 4 ? 2 : source % 2;
  return order - static_cast<int>(kind);
}

double EliminatedScheme::Value(Kind kind, int i, int source, double h) const {
  return coefficient_[kind](i, source) * std::pow(h, Power(kind, source));
}

double EliminatedScheme::First(Kind kind, int i, int source, double h) const {
  const int p = Power(kind, source);
  return p == 0 ? 0 : coefficient_[kind](i, source) * p * std::pow(h, p - 1);
}

double EliminatedScheme::Second(Kind kind, int i, int source, double h) const {
  const int p = Power(kind, source);
  return p * (p - 1) == 0 ? 0 : coefficient_[kind](i, source) * p * (p - 1) * std::pow(h, p - 2);
}

}  // namespace rollgait
