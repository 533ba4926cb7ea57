#include "core/geometry/smooth_superellipsoid.h"

#include <cmath>
#include <cstdio>

#include "core/base/check.h"
#include "core/geometry/jet_values.h"
#include "core/geometry/superellipsoid.h"

namespace rollgait {
namespace {

// Derivatives 0 … 4 of f(p) = p^r.
std::array<double, 5> PowersOf(double p, double r) {
  std::array<double, 5> f;
  f[0] = std::pow(p, r);
  for (int n = 1; n < 5; ++n) f[n] = f[n - 1] * (r - n + 1) / p;
  return f;
}

SupportJet Zero() {
  SupportJet jet;
  jet.x.setZero();
  jet.S.setZero();
  jet.T.fill(Matrix3::Zero());
  jet.Q.fill(Matrix3::Zero());
  return jet;
}

double Third(const SupportJet& jet, int i, int j, int k) { return jet.T[k](i, j); }
double Fourth(const SupportJet& jet, int i, int j, int k, int l) { return jet.Q[SupportJet::PairIndex(k, l)](i, j); }

// Adds f(g(ν)) with its derivatives by ν up to `order` (Faà di Bruno). `sum` has zeros where nothing was added.
void AddComposed(const std::array<double, 5>& f, const SupportJet& g, int order, SupportJet* sum) {
  const Vector3& a = g.x;
  sum->h += f[0];
  sum->x += f[1] * a;
  if (order < 2) return;
  const Matrix3 slopes = a * a.transpose();  // symmetric to the bit, which f[2] · a · aᵀ is not
  sum->S += f[2] * slopes + f[1] * g.S;
  for (int i = 0; order >= 3 && i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      for (int k = j; k < 3; ++k) {
        const int ijk[] = {i, j, k};
        sum->SetThird(ijk, Third(*sum, i, j, k) + f[3] * a[i] * a[j] * a[k] +
                               f[2] * (g.S(i, j) * a[k] + g.S(i, k) * a[j] + g.S(j, k) * a[i]) +
                               f[1] * Third(g, i, j, k));
        for (int l = k; order >= 4 && l < 3; ++l) {
          const int ijkl[] = {i, j, k, l};
          const double pairs_of_slopes = g.S(i, j) * a[k] * a[l] + g.S(i, k) * a[j] * a[l] + g.S(i, l) * a[j] * a[k] +
                                         g.S(j, k) * a[i] * a[l] + g.S(j, l) * a[i] * a[k] + g.S(k, l) * a[i] * a[j];
          const double thirds =
              Third(g, i, j, k) * a[l] + Third(g, i, j, l) * a[k] + Third(g, i, k, l) * a[j] + Third(g, j, k, l) * a[i];
          const double seconds = g.S(i, j) * g.S(k, l) + g.S(i, k) * g.S(j, l) + g.S(i, l) * g.S(j, k);
          sum->SetFourth(ijkl, Fourth(*sum, i, j, k, l) + f[4] * a[i] * a[j] * a[k] * a[l] + f[3] * pairs_of_slopes +
                                   f[2] * (thirds + seconds) + f[1] * Fourth(g, i, j, k, l));
        }
      }
    }
  }
}

// The support function written anew from the definition, for Walking().
class SmoothNorm {
 public:
  SmoothNorm(const Vector3& semi_axes, double exponent_1, double exponent_2, double smoothing)
      : q_1_(2 / (2 - exponent_1)), q_2_(2 / (2 - exponent_2)), square_(smoothing * smoothing) {
    for (int i = 0; i < 3; ++i) scales_[i] = semi_axes[i] / Unscaled(Vector3::Unit(i));
  }
  double operator()(const Vector3& nu) const { return Unscaled(scales_.cwiseProduct(nu)); }

 private:
  double Unscaled(const Vector3& t) const {
    const double round = square_ * t.squaredNorm();
    const auto smoothed = [&](double of) { return std::sqrt(of * of + round); };
    const double around = std::pow(std::pow(smoothed(t.x()), q_2_) + std::pow(smoothed(t.y()), q_2_), 1 / q_2_);
    return std::pow(std::pow(around, q_1_) + std::pow(smoothed(t.z()), q_1_), 1 / q_1_);
  }

  double q_1_, q_2_, square_;
  Vector3 scales_ = Vector3::Ones();  // m
};

}  // namespace

Result<SmoothSuperellipsoid> SmoothSuperellipsoid::Create(const Vector3& semi_axes, double exponent_1,
                                                          double exponent_2, double smoothing,
                                                          const std::string& field) {
  Violations violations;
  const Result<Superellipsoid> sharp = Superellipsoid::Create(semi_axes, exponent_1, exponent_2, field);
  if (!sharp.ok()) violations = sharp.violations();
  if (!(smoothing >= kMinSmoothing && smoothing <= kMaxSmoothing)) {
    char text[100];
    std::snprintf(text, sizeof(text), "The smoothing is %g; it must lie in %g … %g.", smoothing, kMinSmoothing,
                  kMaxSmoothing);
    violations.push_back({field + ".smoothing", text});
  }
  if (!violations.empty()) return violations;
  return SmoothSuperellipsoid(semi_axes, exponent_1, exponent_2, smoothing);
}

SmoothSuperellipsoid::SmoothSuperellipsoid(const Vector3& semi_axes, double exponent_1, double exponent_2,
                                           double smoothing)
    : semi_axes_(semi_axes),
      scale_(semi_axes.maxCoeff()),
      exponent_1_(exponent_1),
      exponent_2_(exponent_2),
      smoothing_(smoothing),
      q_1_(2 / (2 - exponent_1)),
      q_2_(2 / (2 - exponent_2)) {
  ROLLGAIT_CHECK(semi_axes.allFinite() && semi_axes.minCoeff() > 0 && smoothing > 0);
  squares_ = Matrix3::Identity() + Matrix3::Constant(smoothing * smoothing);
  Vector3 units;  // h of the body with w = 1
  for (int i = 0; i < 3; ++i) units[i] = Support(Vector3::Unit(i)) / scale_;
  const Vector3 weights = (semi_axes / scale_).cwiseQuotient(units);
  squares_ = weights.cwiseAbs2().asDiagonal() * squares_;
}

double SmoothSuperellipsoid::Support(const Vector3& nu) const {
  const Vector3 p = squares_.transpose() * nu.cwiseAbs2();
  const double around = std::pow(p.x(), q_2_ / 2) + std::pow(p.y(), q_2_ / 2);
  return scale_ * std::pow(std::pow(around, q_1_ / q_2_) + std::pow(p.z(), q_1_ / 2), 1 / q_1_);
}

Vector3 SmoothSuperellipsoid::SupportPoint(const Vector3& nu) const {
  const Vector3 p = squares_.transpose() * nu.cwiseAbs2();
  const double x = std::pow(p.x(), q_2_ / 2), y = std::pow(p.y(), q_2_ / 2), z = std::pow(p.z(), q_1_ / 2);
  const double around = std::pow(x + y, q_1_ / q_2_), whole = around + z;
  const double share = around / (x + y);
  // ∂h/∂p_i = h/(2 · whole) · (share · x / p_x, share · y / p_y, z / p_z), and ∂p_i/∂ν_j = 2 squares(j, i) ν_j.
  const Vector3 by_p(share * x / p.x(), share * y / p.y(), z / p.z());
  return scale_ * std::pow(whole, 1 / q_1_ - 1) * (squares_ * by_p).cwiseProduct(nu);
}

Matrix3 SmoothSuperellipsoid::SupportHessian(const Vector3& nu) const { return HessianByJet(*this, nu); }

Vector3 SmoothSuperellipsoid::RollingVelocity(const Vector3& nu, const Vector3& omega) const {
  return RollingVelocityByJet(*this, nu, omega);
}

void SmoothSuperellipsoid::Evaluate(const Vector3& nu, int order, SupportJet* jet) const {
  SupportJet around = Zero(), whole = Zero(), square = Zero(), result = Zero();
  const auto add = [&](int i, double exponent, SupportJet* sum) {
    const Vector3 factors = squares_.col(i);
    square.h = factors.dot(nu.cwiseAbs2());
    square.x = 2 * factors.cwiseProduct(nu);
    square.S = (2 * factors).asDiagonal();
    AddComposed(PowersOf(square.h, exponent), square, order, sum);
  };
  add(0, q_2_ / 2, &around);
  add(1, q_2_ / 2, &around);
  AddComposed(PowersOf(around.h, q_1_ / q_2_), around, order, &whole);
  add(2, q_1_ / 2, &whole);
  AddComposed(PowersOf(whole.h, 1 / q_1_), whole, order, &result);
  jet->order = order;
  jet->h = scale_ * result.h;
  jet->x = scale_ * result.x;
  if (order >= 2) jet->S = scale_ * result.S;
  for (int k = 0; order >= 3 && k < 3; ++k) jet->T[k] = scale_ * result.T[k];
  for (int k = 0; order >= 4 && k < 6; ++k) jet->Q[k] = scale_ * result.Q[k];
}

WalkingShape SmoothSuperellipsoid::Walking() const {
  return {"superellipsoid",
          semi_axes_,
          {{"exponent_1", exponent_1_, kLeastWalkingExponent, kMostWalkingExponent},
           {"exponent_2", exponent_2_, kLeastWalkingExponent, kMostWalkingExponent},
           {"smoothing", smoothing_, kLeastWalkingSmoothing, kMaxSmoothing}},
          SmoothNorm(semi_axes_, exponent_1_, exponent_2_, smoothing_)};
}

}  // namespace rollgait
