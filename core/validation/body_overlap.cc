#include "core/validation/body_overlap.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace rollgait {
namespace {

constexpr double kDeep = 1e-3;      // m, overlap from which other ways out are looked for
constexpr double kFirstStep = 0.2;  // rad, of the direct search
constexpr double kLastStep = 1e-6;  // rad; g is flat to the square of it at a maximum
constexpr int kBracketSteps = 200;
constexpr double kBracketWidth = 1e-14;

Matrix3 ShapeOf(const PosedBody& body) {
  return body.R_WE * body.semi_axes.cwiseAbs2().asDiagonal() * body.R_WE.transpose();
}

double Support(const PosedBody& body, const Vector3& nu) {
  const Vector3 local = body.R_WE.transpose() * nu;
  return body.norm ? (*body.norm)(local) : body.semi_axes.cwiseProduct(local).norm();
}

// The eight directions of direct searches in a plane.
constexpr double kDiagonal = 0.70710678118654752;
constexpr double kCos[] = {1, -1, 0, 0, kDiagonal, -kDiagonal, kDiagonal, -kDiagonal};
constexpr double kSin[] = {0, 0, 1, -1, kDiagonal, -kDiagonal, -kDiagonal, kDiagonal};

// Climbs from nu in eight directions of the tangent plane, with steps that double on success and halve on failure.
double Climb(const PosedBody& a, const PosedBody& b, Vector3 nu) {
  double best = PlaneDistance(a, b, nu);
  for (double step = kFirstStep; step > kLastStep;) {
    const Vector3 t_1 = nu.unitOrthogonal(), t_2 = nu.cross(t_1);
    bool climbed = false;
    for (int i = 0; i < 8 && !climbed; ++i) {
      const Vector3 next = (nu + step * (kCos[i] * t_1 + kSin[i] * t_2)).normalized();
      const double value = PlaneDistance(a, b, next);
      if (!(value > best)) continue;  // nor where it is no number
      best = value;
      nu = next;
      climbed = true;
    }
    step = climbed ? std::min(2 * step, kFirstStep) : step / 2;
  }
  return best;
}

}  // namespace

double PlaneDistance(const PosedBody& a, const PosedBody& b, const Vector3& nu) {
  return nu.dot(b.p_WE - a.p_WE) - Support(a, nu) - Support(b, -nu);
}

namespace {

// The derivative of the concave function is  (1 − s)² xᵀ Q_a x − s² xᵀ Q_b x  with x = M(s)⁻¹ r: regula falsi with
// Illinois' rule.
ScaledContact FindScaledContactOfEllipsoids(const PosedBody& a, const PosedBody& b) {
  const Matrix3 Q_a = ShapeOf(a), Q_b = ShapeOf(b);
  const Vector3 r = b.p_WE - a.p_WE;
  ScaledContact contact;
  if (r.isZero(0)) return contact;
  Vector3 x;
  const auto slope = [&](double s) {
    x = ((1 - s) * Q_a + s * Q_b).inverse() * r;
    return (1 - s) * (1 - s) * x.dot(Q_a * x) - s * s * x.dot(Q_b * x);
  };
  double low = 0, high = 1, at_low = slope(0), at_high = slope(1), s = 0.5;
  int side = 0;
  for (int i = 0; i < kBracketSteps && high - low > kBracketWidth; ++i) {
    s = (low * at_high - high * at_low) / (at_high - at_low);
    const double value = slope(s);
    if (value == 0) break;
    if (value > 0) {
      low = s;
      at_low = value;
      if (side == 1) at_high /= 2;
      side = 1;
    } else {
      high = s;
      at_high = value;
      if (side == -1) at_low /= 2;
      side = -1;
    }
    if (std::abs(value) <= 1e-15 * x.dot(r)) break;
  }
  contact.scale = std::sqrt(s * (1 - s) * x.dot(r));
  contact.nu = x.normalized();
  return contact;
}

}  // namespace

ScaledContact FindScaledContact(const PosedBody& a, const PosedBody& b) {
  ScaledContact contact = FindScaledContactOfEllipsoids(a, b);
  const Vector3 r = b.p_WE - a.p_WE;
  if ((!a.norm && !b.norm) || r.isZero(0)) return contact;
  const auto sum = [&](const Vector3& nu) { return Support(a, nu) + Support(b, -nu); };
  Vector3 nu = contact.nu / contact.nu.dot(r);
  const Vector3 t_1 = r.unitOrthogonal(), t_2 = r.normalized().cross(t_1);
  const double unit = nu.norm();
  double least = sum(nu);
  for (double step = kFirstStep; step > kLastStep;) {
    bool fell = false;
    for (int i = 0; i < 8 && !fell; ++i) {
      const Vector3 next = nu + step * unit * (kCos[i] * t_1 + kSin[i] * t_2);
      const double value = sum(next);
      if (!(value < least)) continue;
      least = value;
      nu = next;
      fell = true;
    }
    step = fell ? std::min(2 * step, kFirstStep) : step / 2;
  }
  return {1 / least, nu.normalized()};
}

double OverlapDepth(const PosedBody& a, const PosedBody& b) {
  const ScaledContact contact = FindScaledContact(a, b);
  if (PlaneDistance(a, b, contact.nu) >= 0) return 0;
  double best = Climb(a, b, contact.nu);
  if (best < -kDeep) {
    for (const PosedBody* body : {&a, &b}) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) best = std::max(best, Climb(a, b, sign * body->R_WE.col(axis)));
      }
    }
  }
  return std::isnan(best) ? kInfinity : std::max(0.0, -best);
}

}  // namespace rollgait
