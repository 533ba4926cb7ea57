#include "core/contact/pair_derivatives.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "core/base/check.h"
#include "core/contact/pair_tangent.h"
#include "core/multibody/spatial.h"

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

// A change of the configuration at first order, with everything that moves along.
struct Change {
  Variation one, two;
  Vector3 normal, p_1, p_2;
  double gap = 0;
  Vector3 height;  // planes: point of the plane -> contact point
};

struct SecondChange {
  Vector3 normal, p_1, p_2;
  double gap = 0;
};

// Velocities of the two frames from the order of ζ: δp_1, δθ_1, δp_2, δθ_2.
Change Moved(const Vector12& twist) {
  Change change;
  change.one.v = twist.segment<3>(0);
  change.one.omega = twist.segment<3>(3);
  change.two.v = twist.segment<3>(6);
  change.two.omega = twist.segment<3>(9);
  return change;
}

class SurfaceExpansion {
 public:
  SurfaceExpansion(const PlacedSurface& surface_1, const FrameMotion& body_1, const PlacedSurface& surface_2,
                   const FrameMotion& body_2, const Separation& separation, int order)
      : nu_(separation.nu), distance_(separation.distance),
        one_(surface_1, body_1, nu_, 1, order), two_(surface_2, body_2, nu_, -1, order),
        tangent_(Pose(surface_1, body_1), Pose(surface_2, body_2), nu_, distance_),
        order_(tangent_.finite ? std::min({one_.jet.order, two_.jet.order, order + 1}) - 1 : 0) {}

  int order() const { return order_; }

  Change First(const Vector12& twist) const {
    Change change = Moved(twist);
    Variation &a = change.one, &b = change.two;
    const Vector3 slip = a.v + a.omega.cross(one_.r) - b.v - b.omega.cross(two_.r);
    // M ν̇ = S₁(ω₁×ν) + S₂(ω₂×ν) − P w
    a.nu_dot = b.nu_dot =
        tangent_.basis * tangent_.Solve(tangent_.S_1 * tangent_.Components(a.omega.cross(nu_)) +
                                        tangent_.S_2 * tangent_.Components(b.omega.cross(nu_)) -
                                        tangent_.Components(slip));
    one_.Complete(nu_, order_, &a);
    two_.Complete(nu_, order_, &b);
    change.normal = -a.nu_dot;
    change.gap = -nu_.dot(slip);
    change.p_1 = a.v + a.r_dot;
    change.p_2 = b.v + b.r_dot;
    return change;
  }

  SecondChange Second(const Change& k, const Change& l) const {
    const Vector3 bend_1 = one_.Bend(k.one, l.one), bend_2 = two_.Bend(k.two, l.two);
    const Vector3 &nu_k = k.one.nu_dot, &nu_l = l.one.nu_dot;
    // (S₁ + S₂ + d) ν̈ + d̈ ν = bend₂ − bend₁ − ḋ_k ν̇_l − ḋ_l ν̇_k,  ν · ν̈ = −ν̇_k · ν̇_l
    const Vector3 right = bend_2 - bend_1 - k.gap * nu_l - l.gap * nu_k;
    const double square = nu_k.dot(nu_l);
    const Vector3 nu_second = tangent_.basis * tangent_.Solve(tangent_.Components(right)) - square * nu_;
    return {-nu_second, bend_1 + one_.S * nu_second, bend_2 - two_.S * nu_second,
            nu_.dot(bend_2 - bend_1) + distance_ * square};
  }

 private:
  const Vector3 nu_;
  const double distance_;
  const Side one_, two_;
  const PairTangent tangent_;
  const int order_;
};

class PlaneExpansion {
 public:
  PlaneExpansion(const PlacedSurface& surface, const FrameMotion& body, const PlacedPlane& plane,
                 const FrameMotion& plane_frame, int order)
      : nu_(-(plane_frame.R_WB * plane.n_B)), one_(surface, body, nu_, 1, order), lever_(plane_frame.R_WB * plane.p_BO),
        height_(body.p_WB + one_.r - plane_frame.p_WB - lever_), gap_(-nu_.dot(height_)),
        order_(std::min(one_.jet.order, order + 1) - 1) {}

  int order() const { return order_; }

  Change First(const Vector12& twist) const {
    Change change = Moved(twist);
    Variation &a = change.one, &b = change.two;
    a.nu_dot = b.nu_dot = b.omega.cross(nu_);
    one_.Complete(nu_, order_, &a);
    change.height = a.v + a.r_dot - b.v - b.omega.cross(lever_);
    change.normal = -a.nu_dot;
    change.p_1 = a.v + a.r_dot;
    change.gap = -a.nu_dot.dot(height_) - nu_.dot(change.height);
    change.p_2 = change.p_1 + change.gap * nu_ + gap_ * a.nu_dot;
    return change;
  }

  SecondChange Second(const Change& k, const Change& l) const {
    const Vector3 &nu_k = k.one.nu_dot, &nu_l = l.one.nu_dot;
    const auto twice = [&](const Vector3& u) -> Vector3 {  // second change of a vector fixed to the plane
      const Vector3 &omega_k = k.two.omega, &omega_l = l.two.omega;
      return 0.5 * (omega_k.cross(omega_l.cross(u)) + omega_l.cross(omega_k.cross(u)));
    };
    const Vector3 nu_second = twice(nu_);
    const Vector3 p_1 = one_.Bend(k.one, l.one) + one_.S * nu_second;
    const double gap =
        -nu_second.dot(height_) - nu_k.dot(l.height) - nu_l.dot(k.height) - nu_.dot(p_1 - twice(lever_));
    return {-nu_second, p_1, p_1 + gap * nu_ + k.gap * nu_l + l.gap * nu_k + gap_ * nu_second, gap};
  }

 private:
  const Vector3 nu_;
  const Side one_;
  const Vector3 lever_, height_;
  const double gap_;
  const int order_;
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

template <typename Expansion>
std::array<Change, 12> FirstChanges(const Expansion& expansion, PairDerivatives* result) {
  std::array<Change, 12> changes;
  for (int k = 0; k < 12; ++k) {
    changes[k] = expansion.First(Vector12::Unit(k));
    result->normal.col(k) = changes[k].normal;
    result->gap[k] = changes[k].gap;
    result->p_1.col(k) = changes[k].p_1;
    result->p_2.col(k) = changes[k].p_2;
  }
  return changes;
}

template <typename Expansion>
PairDerivatives Derivatives(const Expansion& expansion, int order) {
  ROLLGAIT_CHECK(order == 1 || order == 2);
  PairDerivatives result;
  result.order = expansion.order();
  MarkMissing(order, &result);
  if (result.order < 1) return result;
  const std::array<Change, 12> changes = FirstChanges(expansion, &result);
  if (result.order < 2) return result;
  for (int k = 0; k < 12; ++k) {
    for (int l = 0; l <= k; ++l) {
      const SecondChange second = expansion.Second(changes[k], changes[l]);
      Store(second.normal, k, l, &result.normal_second);
      Store(second.p_1, k, l, &result.p_1_second);
      Store(second.p_2, k, l, &result.p_2_second);
      result.gap_second(k, l) = result.gap_second(l, k) = second.gap;
    }
  }
  return result;
}

template <typename Expansion>
PairRateDerivatives RateDerivatives(const Expansion& expansion, const FrameMotion& body_1, const FrameMotion& body_2) {
  PairRateDerivatives result;
  result.first.order = expansion.order();
  MarkMissing(1, &result.first);
  result.normal_dot = result.p_dot_1 = result.p_dot_2 = Matrix3x12::Constant(kInfinity);
  if (result.first.order < 1) return result;
  const std::array<Change, 12> changes = FirstChanges(expansion, &result.first);
  if (result.first.order < 2) return result;
  Vector12 twist;
  twist << body_1.v_WB, body_1.w_WB, body_2.v_WB, body_2.w_WB;
  const Change along = expansion.First(twist);
  for (int k = 0; k < 12; ++k) {
    const SecondChange second = expansion.Second(along, changes[k]);
    result.normal_dot.col(k) = second.normal;
    result.p_dot_1.col(k) = second.p_1;
    result.p_dot_2.col(k) = second.p_2;
  }
  // The twist follows the turn: exp(ω t) exp(θ s) = exp(ω t + θ s + ½ t s ω × θ + …).
  const PairDerivatives& first = result.first;
  for (const auto& [column, omega] : {std::pair(3, &body_1.w_WB), std::pair(9, &body_2.w_WB)}) {
    const Matrix3 bracket = 0.5 * Skew(*omega);
    result.normal_dot.middleCols<3>(column) += first.normal.middleCols<3>(column) * bracket;
    result.p_dot_1.middleCols<3>(column) += first.p_1.middleCols<3>(column) * bracket;
    result.p_dot_2.middleCols<3>(column) += first.p_2.middleCols<3>(column) * bracket;
  }
  return result;
}

}  // namespace

PairDerivatives ComputeSurfacePairDerivatives(const PlacedSurface& surface_1, const FrameMotion& body_1,
                                              const PlacedSurface& surface_2, const FrameMotion& body_2,
                                              const Separation& separation, int order) {
  return Derivatives(SurfaceExpansion(surface_1, body_1, surface_2, body_2, separation, order), order);
}

PairDerivatives ComputePlaneDerivatives(const PlacedSurface& surface, const FrameMotion& body, const PlacedPlane& plane,
                                        const FrameMotion& plane_frame, int order) {
  return Derivatives(PlaneExpansion(surface, body, plane, plane_frame, order), order);
}

PairRateDerivatives ComputeSurfacePairRateDerivatives(const PlacedSurface& surface_1, const FrameMotion& body_1,
                                                      const PlacedSurface& surface_2, const FrameMotion& body_2,
                                                      const Separation& separation) {
  return RateDerivatives(SurfaceExpansion(surface_1, body_1, surface_2, body_2, separation, 2), body_1, body_2);
}

PairRateDerivatives ComputePlaneRateDerivatives(const PlacedSurface& surface, const FrameMotion& body,
                                                const PlacedPlane& plane, const FrameMotion& plane_frame) {
  return RateDerivatives(PlaneExpansion(surface, body, plane, plane_frame, 2), body, plane_frame);
}

}  // namespace rollgait
