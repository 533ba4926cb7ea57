#include "core/contact/pair_derivatives.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "core/base/check.h"
#include "core/contact/pair_tangent.h"

namespace rollgait {
namespace {

// One variable's share of a configuration change: velocities of a body's frame, and what follows from them at first
// order.
struct Variation {
  Vector3 v = Vector3::Zero(), omega = Vector3::Zero();  // of this body
  Vector3 nu_dot = Vector3::Zero();                      // of the normal that leaves body 1, world
  Vector3 r_dot;                                         // frame origin -> contact point
  // With y = ν̇ − ω × ν, the rate of that normal as seen from this body:
  Vector3 y_E;           // y in surface axes
  Matrix3 third_E;       // T[y], surface axes
  Vector3 carried;       // ṙ ± S y
  Vector3 turned;        // ν̇ + y
};

// A surface at its contact point. `sign` is 1 if ν leaves it (body 1), −1 for body 2: its outward normal is sign · ν.
struct Side {
  Matrix3 R_WE, S;  // S in world axes
  Vector3 r;        // frame origin -> contact point, world
  double sign;
  SupportJet jet;

  Side(const PlacedSurface& placed, const FrameMotion& body, const Vector3& nu, double sign_of_nu, int order)
      : R_WE(body.R_WB * placed.R_BE), sign(sign_of_nu) {
    placed.surface.Evaluate(R_WE.transpose() * (sign * nu), order + 1, &jet);
    r = body.R_WB * placed.p_BE + R_WE * jet.x;
    S = R_WE * jet.S * R_WE.transpose();
  }

  // With v, omega and nu_dot given. `order` 2: also what Bend needs.
  void Complete(const Vector3& nu, int order, Variation* a) const {
    const Vector3 y = a->nu_dot - a->omega.cross(nu), S_y = sign * (S * y);
    a->r_dot = a->omega.cross(r) + S_y;
    if (order < 2) return;
    a->y_E = R_WE.transpose() * y;
    a->third_E = jet.Third(a->y_E);
    a->carried = a->r_dot + S_y;
    a->turned = a->nu_dot + y;
  }
  // Second derivative of r along a and b without the part sign S ν̈: T[y_a] y_b and the symmetric part of
  // ω_a × (ṙ_b ± S y_b) ∓ S (ω_a × (ν̇_b + y_b)).
  Vector3 Bend(const Variation& a, const Variation& b) const {
    const Vector3 turned = a.omega.cross(b.turned) + b.omega.cross(a.turned);
    const Vector3 carried = a.omega.cross(b.carried) + b.omega.cross(a.carried);
    return R_WE * (a.third_E * b.y_E) + 0.5 * (carried - sign * (S * turned));
  }
};

void Store(const Vector3& value, int k, int l, std::array<Matrix12, 3>* second) {
  for (int i = 0; i < 3; ++i) (*second)[i](k, l) = (*second)[i](l, k) = value[i];
}

void MarkMissing(int asked, PairDerivatives* result) {
  if (result->order < 1) {
    result->normal = result->p_1 = result->p_2 = Matrix3x12::Constant(kInfinity);
    result->gap.setConstant(kInfinity);
  }
  if (asked == 2 && result->order < 2) {
    const Matrix12 missing = Matrix12::Constant(kInfinity);
    result->normal_second.fill(missing);
    result->p_1_second.fill(missing);
    result->p_2_second.fill(missing);
    result->gap_second = missing;
  }
}

// Twist of the two frames for variable k: δp_1, δθ_1, δp_2, δθ_2.
void Unit(int k, Variation* one, Variation* two) {
  Variation* const moved = k < 6 ? one : two;
  (k % 6 < 3 ? moved->v : moved->omega) = Vector3::Unit(k % 3);
}

}  // namespace

PairDerivatives ComputeSurfacePairDerivatives(const PlacedSurface& surface_1, const FrameMotion& body_1,
                                              const PlacedSurface& surface_2, const FrameMotion& body_2,
                                              const Separation& separation, int order) {
  ROLLGAIT_CHECK(order == 1 || order == 2);
  const Vector3& nu = separation.nu;
  const double d = separation.distance;
  const Side one(surface_1, body_1, nu, 1, order), two(surface_2, body_2, nu, -1, order);
  const PairTangent tangent(Pose(surface_1, body_1), Pose(surface_2, body_2), nu, d);
  PairDerivatives result;
  result.order = tangent.finite ? std::min({one.jet.order, two.jet.order, order + 1}) - 1 : 0;
  MarkMissing(order, &result);
  if (result.order < 1) return result;

  std::array<Variation, 12> a_1, a_2;
  for (int k = 0; k < 12; ++k) {
    Variation &a = a_1[k], &b = a_2[k];
    Unit(k, &a, &b);
    const Vector3 slip = a.v + a.omega.cross(one.r) - b.v - b.omega.cross(two.r);
    // M ν̇ = S₁(ω₁×ν) + S₂(ω₂×ν) − P w
    a.nu_dot = b.nu_dot =
        tangent.basis * tangent.Solve(tangent.S_1 * tangent.Components(a.omega.cross(nu)) +
                                      tangent.S_2 * tangent.Components(b.omega.cross(nu)) - tangent.Components(slip));
    one.Complete(nu, result.order, &a);
    two.Complete(nu, result.order, &b);
    result.normal.col(k) = -a.nu_dot;
    result.gap[k] = -nu.dot(slip);
    result.p_1.col(k) = a.v + a.r_dot;
    result.p_2.col(k) = b.v + b.r_dot;
  }
  if (result.order < 2) return result;
  for (int k = 0; k < 12; ++k) {
    for (int l = 0; l <= k; ++l) {
      const Vector3 bend_1 = one.Bend(a_1[k], a_1[l]), bend_2 = two.Bend(a_2[k], a_2[l]);
      const Vector3 &nu_k = a_1[k].nu_dot, &nu_l = a_1[l].nu_dot;
      // (S₁ + S₂ + d) ν̈ + d̈ ν = bend₂ − bend₁ − ḋ_k ν̇_l − ḋ_l ν̇_k,  ν · ν̈ = −ν̇_k · ν̇_l
      const Vector3 right = bend_2 - bend_1 - result.gap[k] * nu_l - result.gap[l] * nu_k;
      const double square = nu_k.dot(nu_l);
      const Vector3 nu_second = tangent.basis * tangent.Solve(tangent.Components(right)) - square * nu;
      Store(-nu_second, k, l, &result.normal_second);
      Store(bend_1 + one.S * nu_second, k, l, &result.p_1_second);
      Store(bend_2 - two.S * nu_second, k, l, &result.p_2_second);
      result.gap_second(k, l) = result.gap_second(l, k) = nu.dot(bend_2 - bend_1) + d * square;
    }
  }
  return result;
}

PairDerivatives ComputePlaneDerivatives(const PlacedSurface& surface, const FrameMotion& body, const PlacedPlane& plane,
                                        const FrameMotion& plane_frame, int order) {
  ROLLGAIT_CHECK(order == 1 || order == 2);
  const Vector3 nu = -(plane_frame.R_WB * plane.n_B);
  const Side one(surface, body, nu, 1, order);
  PairDerivatives result;
  result.order = std::min(one.jet.order, order + 1) - 1;
  MarkMissing(order, &result);
  if (result.order < 1) return result;

  const Vector3 lever = plane_frame.R_WB * plane.p_BO;
  const Vector3 height = body.p_WB + one.r - plane_frame.p_WB - lever;  // point of the plane -> contact point
  const double gap = -nu.dot(height);
  std::array<Variation, 12> a_1, a_2;
  std::array<Vector3, 12> height_dot;
  for (int k = 0; k < 12; ++k) {
    Variation &a = a_1[k], &b = a_2[k];
    Unit(k, &a, &b);
    a.nu_dot = b.nu_dot = b.omega.cross(nu);
    one.Complete(nu, result.order, &a);
    height_dot[k] = a.v + a.r_dot - b.v - b.omega.cross(lever);
    result.normal.col(k) = -a.nu_dot;
    result.p_1.col(k) = a.v + a.r_dot;
    result.gap[k] = -a.nu_dot.dot(height) - nu.dot(height_dot[k]);
    result.p_2.col(k) = result.p_1.col(k) + result.gap[k] * nu + gap * a.nu_dot;
  }
  if (result.order < 2) return result;
  const auto twice = [&](int k, int l, const Vector3& u) -> Vector3 {  // second change of a vector fixed to the plane
    const Vector3 &omega_k = a_2[k].omega, &omega_l = a_2[l].omega;
    return 0.5 * (omega_k.cross(omega_l.cross(u)) + omega_l.cross(omega_k.cross(u)));
  };
  for (int k = 0; k < 12; ++k) {
    for (int l = 0; l <= k; ++l) {
      const Vector3 nu_second = twice(k, l, nu);
      const Vector3 p_1_second = one.Bend(a_1[k], a_1[l]) + one.S * nu_second;
      const double gap_second = -nu_second.dot(height) - a_1[k].nu_dot.dot(height_dot[l]) -
                                a_1[l].nu_dot.dot(height_dot[k]) - nu.dot(p_1_second - twice(k, l, lever));
      Store(-nu_second, k, l, &result.normal_second);
      Store(p_1_second, k, l, &result.p_1_second);
      Store(p_1_second + gap_second * nu + result.gap[k] * a_1[l].nu_dot + result.gap[l] * a_1[k].nu_dot +
                gap * nu_second,
            k, l, &result.p_2_second);
      result.gap_second(k, l) = result.gap_second(l, k) = gap_second;
    }
  }
  return result;
}

}  // namespace rollgait
