#include "core/geometry/flattened_superellipsoid.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include "core/geometry/nested_chain.h"
#include "core/geometry/superellipsoid.h"

namespace rollgait {
namespace {

// d^k/dt^k of t^p for t ≥ 0.
double PowerDerivative(double t, double p, int k) {
  double factor = 1;
  for (int i = 0; i < k; ++i) factor *= p - i;
  if (factor == 0) return 0;
  if (p == k) return factor;
  if (t == 0) return p > k ? 0 : HUGE_VAL;
  return factor * std::pow(t, p - k);
}

}  // namespace

// Partial derivatives of Φ at one x, in t = (|x|/a, |y|/b, |z|/c).
class FlattenedSuperellipsoid::Partials {
 public:
  Partials(const FlattenedSuperellipsoid& body, const Vector3& x, int order)
      : p_1_(2 / body.exponent_1_),
        p_2_(2 / body.exponent_2_),
        delta_(body.delta_),
        t_(x.cwiseQuotient(body.semi_axes_).cwiseAbs()),
        inner_(t_.x(), t_.y(), p_2_) {
    for (int i = 0; i < 3; ++i) factor_[i] = std::copysign(1 / body.semi_axes_[i], x[i]);
    inner_.Prepare(order);
  }

  double Value() const {
    return (std::pow(inner_.value(), p_1_) + std::pow(t_.z(), p_1_) + delta_ * t_.squaredNorm()) / (1 + delta_) - 1;
  }

  // With respect to the coordinates at `count` indices.
  double operator()(const int* indices, int count) const {
    int across = 0;  // indices that are z
    for (int n = 0; n < count; ++n) across += indices[n] == 2;
    double value = 0;
    if (across == 0) {
      // m^p₁ at m = 0 is smooth only if it is a polynomial; otherwise it ends at the derivative p₁.
      const bool polynomial = std::fmod(p_2_, 2) == 0 && std::fmod(p_1_, p_2_) == 0;
      if (inner_.tip() && !polynomial && p_1_ <= count) return HUGE_VAL;
      const auto outer = [&](int blocks, int k) {
        double factor = 1;
        for (int i = 0; i < blocks; ++i) factor *= p_1_ - i;
        if (factor == 0) return 0.0;
        if (p_1_ == k) return factor;
        if (inner_.tip()) return p_1_ > k ? 0.0 : HUGE_VAL;
        return factor * std::pow(inner_.value(), p_1_ - k);
      };
      value = inner_.Derivative(outer, indices, count);
    } else if (across == count) {
      value = PowerDerivative(t_.z(), p_1_, count);
    }
    if (count == 1) value += 2 * delta_ * t_[indices[0]];
    if (count == 2 && indices[0] == indices[1]) value += 2 * delta_;
    for (int n = 0; n < count; ++n) value *= factor_[indices[n]];
    return value / (1 + delta_);
  }

 private:
  double p_1_, p_2_, delta_;
  Vector3 t_, factor_;
  NestedChain inner_;
};

Result<ImplicitSurface> FlattenedSuperellipsoid::Create(const Vector3& semi_axes, double exponent_1, double exponent_2,
                                                        double delta, const std::string& field) {
  const Result<Superellipsoid> plain = Superellipsoid::Create(semi_axes, exponent_1, exponent_2, field);
  if (!plain.ok()) return plain.violations();
  Violations violations;
  char text[200];
  const double exponents[] = {exponent_1, exponent_2};
  for (int i = 0; i < 2; ++i) {
    if (exponents[i] <= 1) continue;
    std::snprintf(text, sizeof(text),
                  "The exponent is %g; with a flattening it must be at most 1. A pinched body has edges instead of "
                  "flats: give it a rounding.",
                  exponents[i]);
    violations.push_back({field + (i == 0 ? ".exponent_1" : ".exponent_2"), text});
  }
  if (!(delta >= kMinDelta && delta <= kMaxDelta)) {
    std::snprintf(text, sizeof(text), "The flattening is %g; it must lie in %g … %g.", delta, kMinDelta, kMaxDelta);
    violations.push_back({field + ".flattening", text});
  }
  if (!violations.empty()) return violations;
  std::shared_ptr<const ConvexFunction> function(new FlattenedSuperellipsoid(semi_axes, exponent_1, exponent_2, delta));
  return ImplicitSurface::Create(std::move(function), field);
}

FlattenedSuperellipsoid::FlattenedSuperellipsoid(const Vector3& semi_axes, double exponent_1, double exponent_2,
                                                 double delta)
    : semi_axes_(semi_axes), exponent_1_(exponent_1), exponent_2_(exponent_2), delta_(delta) {}

double FlattenedSuperellipsoid::Value(const Vector3& x) const { return Partials(*this, x, 0).Value(); }

Vector3 FlattenedSuperellipsoid::Gradient(const Vector3& x) const {
  const Partials partials(*this, x, 1);
  Vector3 gradient;
  for (int i = 0; i < 3; ++i) gradient[i] = partials(&i, 1);
  return gradient;
}

Matrix3 FlattenedSuperellipsoid::Hessian(const Vector3& x) const {
  const Partials partials(*this, x, 2);
  Matrix3 hessian;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const int ij[] = {i, j};
      hessian(i, j) = hessian(j, i) = partials(ij, 2);
    }
  }
  return hessian;
}

Matrix3 FlattenedSuperellipsoid::Third(const Vector3& x, const Vector3& u) const {
  const Partials partials(*this, x, 3);
  Matrix3 third = Matrix3::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) {
        const int ijk[] = {i, j, k};
        third(i, j) += partials(ijk, 3) * u[k];
      }
      third(j, i) = third(i, j);
    }
  }
  return third;
}

Matrix3 FlattenedSuperellipsoid::Fourth(const Vector3& x, const Vector3& u, const Vector3& w) const {
  const Partials partials(*this, x, 4);
  Matrix3 fourth = Matrix3::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < 3; ++l) {
          const int ijkl[] = {i, j, k, l};
          fourth(i, j) += partials(ijkl, 4) * u[k] * w[l];
        }
      }
      fourth(j, i) = fourth(i, j);
    }
  }
  return fourth;
}

}  // namespace rollgait
