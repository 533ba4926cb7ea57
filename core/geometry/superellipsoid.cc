#include "core/geometry/superellipsoid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/check.h"
#include "core/geometry/jet_values.h"
#include "core/geometry/nested_chain.h"

namespace rollgait {
namespace {

bool ExponentInRange(double exponent) {
  return exponent >= Superellipsoid::kMinExponent && exponent <= Superellipsoid::kMaxExponent;
}

std::string WithValue(const char* format, double value, double low, double high) {
  char text[200];
  std::snprintf(text, sizeof(text), format, value, low, high);
  return text;
}

// How often |t|^q can be differentiated at t = 0: polynomials for ever (4 stands for that).
int PowerSmoothness(double q) {
  if (std::fmod(q, 2) == 0) return 4;
  return std::min(4, static_cast<int>(std::ceil(q)) - 1);
}

// One power of t_i in  ∂^n/∂t_i^n of g(Σ t^q), where b factors of g's derivative belong to it: the Bell polynomial
// B(n, b) of the derivatives of t^q, which is coefficient · t^(b q − n).
double PowerTerm(double t, double q, int n, int b) {
  const double f_1 = q, f_2 = q * (q - 1), f_3 = f_2 * (q - 2), f_4 = f_3 * (q - 3);
  const double coefficients[5][5] = {
      {1},
      {0, f_1},
      {0, f_2, f_1 * f_1},
      {0, f_3, 3 * f_1 * f_2, f_1 * f_1 * f_1},
      {0, f_4, 4 * f_1 * f_3 + 3 * f_2 * f_2, 6 * f_1 * f_1 * f_2, f_1 * f_1 * f_1 * f_1}};
  const double coefficient = coefficients[n][b], exponent = b * q - n;
  if (coefficient == 0) return 0;
  if (exponent == 0) return coefficient;
  if (t == 0) return exponent > 0 ? 0 : std::copysign(HUGE_VAL, coefficient);
  return coefficient * std::pow(t, exponent);
}

// Derivative of (t₁^q + t₂^q + t₃^q)^(1/q) = 1, `n` times by each t. Both exponents equal: the nested form would lose
// digits of third and fourth derivatives near the poles, where terms that grow like 1/t cancel.
double PlainNormDerivative(const Vector3& t, double q, const int* n) {
  double sum = 0;
  for (int i = 0; i <= n[0]; ++i) {
    for (int j = 0; j <= n[1]; ++j) {
      for (int k = 0; k <= n[2]; ++k) {
        double factor = 1;
        for (int b = 0; b < i + j + k; ++b) factor *= 1 / q - b;
        const double a = PowerTerm(t[0], q, n[0], i), b = PowerTerm(t[1], q, n[1], j), c = PowerTerm(t[2], q, n[2], k);
        if (a != 0 && b != 0 && c != 0) sum += factor * a * b * c;
      }
    }
  }
  return sum;
}

// The support function in t = (a|ν₁|, b|ν₂|, c|ν₃|): h = N(N(t₁, t₂; q₂), t₃; q₁).
class NestedNorm {
 public:
  NestedNorm(const Vector3& t, double q_1, double q_2)
      : inner_(t.x(), t.y(), q_2), outer_(inner_.value(), t.z(), q_1), plain_q_(q_1 == q_2 ? q_1 : 0) {
    if (plain_q_ > 0) t_ = t / value();
  }

  double value() const { return outer_.value(); }
  void Prepare(int order) { inner_.Prepare(order); }

  // Derivative with respect to t at `count` indices (0, 1, 2).
  double Derivative(const int* indices, int count) const {
    const double unit = std::pow(outer_.value(), 1 - count);
    if (count > 2 && plain_q_ > 0) {
      int times[3] = {0, 0, 0};
      for (int n = 0; n < count; ++n) ++times[indices[n]];
      return PlainNormDerivative(t_, plain_q_, times) * unit;
    }
    int e[4], k = 0;
    for (int n = 0; n < count; ++n) {
      if (indices[n] < 2) e[k++] = indices[n];
    }
    const int b = count - k;
    const auto outer = [&](int blocks, int inner) { return outer_.Scaled(blocks, b, inner, b); };
    return inner_.Derivative(outer, e, k) * unit;
  }

 private:
  NestedChain inner_;
  TwoNorm outer_;
  double plain_q_;  // the exponent if there is only one, else 0
  Vector3 t_ = Vector3::Zero();
};

}  // namespace

Result<Superellipsoid> Superellipsoid::Create(const Vector3& semi_axes, double exponent_1, double exponent_2,
                                              const std::string& field) {
  Violations violations;
  for (int i = 0; i < 3; ++i) {
    if (!(std::isfinite(semi_axes[i]) && semi_axes[i] > 0)) {
      violations.push_back(
          {field + ".semi_axes_m",
           WithValue("A semi-axis is %g m; every one must be finite and greater than %g.", semi_axes[i], 0, 0)});
    }
  }
  const double exponents[] = {exponent_1, exponent_2};
  for (int i = 0; i < 2; ++i) {
    if (ExponentInRange(exponents[i])) continue;
    violations.push_back({field + (i == 0 ? ".exponent_1" : ".exponent_2"),
                          WithValue("The exponent is %g; it must lie in %g … %g (1 is the ellipsoid; outside, contact "
                                    "points are not resolved by double precision).",
                                    exponents[i], kMinExponent, kMaxExponent)});
  }
  if (!violations.empty()) return violations;
  return Superellipsoid(semi_axes, exponent_1, exponent_2);
}

Superellipsoid::Superellipsoid(const Vector3& semi_axes, double exponent_1, double exponent_2)
    : semi_axes_(semi_axes),
      scale_(semi_axes.maxCoeff()),
      unit_axes_(semi_axes / scale_),
      exponent_1_(exponent_1),
      exponent_2_(exponent_2),
      q_1_(2 / (2 - exponent_1)),
      q_2_(2 / (2 - exponent_2)) {
  ROLLGAIT_CHECK(semi_axes.allFinite() && semi_axes.minCoeff() > 0);
  ROLLGAIT_CHECK(ExponentInRange(exponent_1) && ExponentInRange(exponent_2));
}

double Superellipsoid::Support(const Vector3& nu) const {
  return scale_ * NestedNorm(unit_axes_.cwiseProduct(nu).cwiseAbs(), q_1_, q_2_).value();
}

Vector3 Superellipsoid::SupportPoint(const Vector3& nu) const {
  SupportJet jet;
  Evaluate(nu, 1, &jet);
  return jet.x;
}

Matrix3 Superellipsoid::SupportHessian(const Vector3& nu) const { return HessianByJet(*this, nu); }

Vector3 Superellipsoid::RollingVelocity(const Vector3& nu, const Vector3& omega) const {
  return RollingVelocityByJet(*this, nu, omega);
}

int Superellipsoid::Smoothness(const Vector3& nu) const {
  const bool around = nu.x() == 0 || nu.y() == 0, tip = nu.x() == 0 && nu.y() == 0, equator = nu.z() == 0;
  int order = 4;
  if (equator) order = std::min(order, PowerSmoothness(q_1_));
  if (tip) {
    // m^q₁ of the inner norm m: a polynomial if q₂ is even and q₁ a multiple of it, else as smooth as degree q₁ allows.
    const bool polynomial = std::fmod(q_2_, 2) == 0 && std::fmod(q_1_, q_2_) == 0;
    if (!polynomial) order = std::min(order, static_cast<int>(std::ceil(q_1_)) - 1);
  } else if (around) {
    order = std::min(order, PowerSmoothness(q_2_));
  }
  return order;
}

void Superellipsoid::Evaluate(const Vector3& nu, int order, SupportJet* jet) const {
  NestedNorm norm(unit_axes_.cwiseProduct(nu).cwiseAbs(), q_1_, q_2_);
  norm.Prepare(order);
  Vector3 factor;  // ∂t_i/∂ν_i; at ν_i = 0 odd derivatives vanish, so the sign of zero does not matter
  for (int i = 0; i < 3; ++i) factor[i] = std::copysign(unit_axes_[i], nu[i]);
  jet->h = scale_ * norm.value();
  for (int i = 0; i < 3; ++i) jet->x[i] = scale_ * factor[i] * norm.Derivative(&i, 1);
  jet->order = std::min(order, Smoothness(nu));

  if (order < 2) return;
  const auto entry = [&](const int* e, int count) {
    double value = scale_ * norm.Derivative(e, count);
    for (int n = 0; n < count; ++n) value *= factor[e[n]];
    return value;
  };
  // The distinct entries of the symmetric tensors are those with i ≤ j ≤ k ≤ l.
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const int ij[] = {i, j};
      jet->S(i, j) = jet->S(j, i) = entry(ij, 2);
      for (int k = j; order >= 3 && k < 3; ++k) {
        const int ijk[] = {i, j, k};
        jet->SetThird(ijk, entry(ijk, 3));
        for (int l = k; order >= 4 && l < 3; ++l) {
          const int ijkl[] = {i, j, k, l};
          jet->SetFourth(ijkl, entry(ijkl, 4));
        }
      }
    }
  }
  jet->MarkMissing(order);
}

}  // namespace rollgait
