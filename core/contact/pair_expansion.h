#ifndef ROLLGAIT_CORE_CONTACT_PAIR_EXPANSION_H_
#define ROLLGAIT_CORE_CONTACT_PAIR_EXPANSION_H_

#include <array>

#include "core/base/dual.h"
#include "core/contact/pair_derivatives.h"
#include "core/contact/pair_tangent.h"

namespace rollgait {

// How contact points, normal and gap of a pair answer to changes of the two frames, to second order. T = double: at the
// frames' poses. T = Dual: the same and how it changes along the frames' twists (w_WB, v_WB), for third derivatives.
// Source: contact-math 6, 8.

// One variable's share of a configuration change: velocities of a body's frame, and what follows from them at first
// order.
template <typename T>
struct Variation {
  using Vec3 = Eigen::Matrix<T, 3, 1>;
  Vec3 v, omega;  // of this body
  Vec3 nu_dot;    // of the normal that leaves body 1, world
  Vec3 r_dot;     // frame origin -> contact point
  // With y = ν̇ − ω × ν, the rate of that normal as seen from this body:
  Vec3 y_E;                        // y in surface axes
  Eigen::Matrix<T, 3, 3> third_E;  // T[y], surface axes
  Vec3 carried;                    // ṙ ± S y
  Vec3 turned;                     // ν̇ + y
};

// A change of the configuration at first order, with everything that moves along.
template <typename T>
struct Change {
  Variation<T> one, two;
  Eigen::Matrix<T, 3, 1> normal, p_1, p_2;
  T gap = 0;
  Eigen::Matrix<T, 3, 1> height;  // planes: point of the plane -> contact point
};

template <typename T>
struct SecondChange {
  Eigen::Matrix<T, 3, 1> normal, p_1, p_2;
  T gap = 0;
};

// A surface at its contact point. `sign` is 1 if ν leaves it (body 1), −1 for body 2: its outward normal is sign · ν.
template <typename T>
class Side {
 public:
  using Vec3 = Eigen::Matrix<T, 3, 1>;
  using Mat3 = Eigen::Matrix<T, 3, 3>;

  // `nu_dot` is the rate of ν along the frames' twists; only T = Dual reads it.
  Side(const PlacedSurface& placed, const FrameMotion& body, const Vector3& nu, const Vector3& nu_dot, double sign,
       int order);

  // With v, omega and nu_dot given. `order` 2: also what Bend needs.
  void Complete(const Vec3& nu, int order, Variation<T>* change) const;
  // Second derivative of r along a and b without the part sign S ν̈: T[y_a] y_b and the symmetric part of
  // ω_a × (ṙ_b ± S y_b) ∓ S (ω_a × (ν̇_b + y_b)).
  Vec3 Bend(const Variation<T>& a, const Variation<T>& b) const;

  Mat3 S;         // world axes
  Vec3 r;         // frame origin -> contact point, world
  int jet_order;  // SupportJet::order, less one for T = Dual: what exists together with its change

 private:
  Mat3 R_WE_;
  double sign_;
  std::array<Mat3, 3> third_;  // T[e_j], surface axes
};

template <typename T>
class SurfaceExpansion {
 public:
  SurfaceExpansion(const PlacedSurface& surface_1, const FrameMotion& body_1, const PlacedSurface& surface_2,
                   const FrameMotion& body_2, const Separation& separation, int order);

  // The highest order that exists, at most the one asked for.
  int order() const { return order_; }
  // Contract: order() ≥ 1, ≥ 2.
  void First(const Vector12& twist, Change<T>* change) const;
  SecondChange<T> Second(const Change<T>& k, const Change<T>& l) const;

 private:
  using Vec3 = Eigen::Matrix<T, 3, 1>;
  using Vec2 = Eigen::Matrix<T, 2, 1>;
  using Mat2 = Eigen::Matrix<T, 2, 2>;
  Vec2 Components(const Vec3& u) const { return basis_.transpose() * u; }
  Vec2 Solve(const Vec2& z) const;

  // Rates along the frames' twists, for T = Dual.
  struct Rates {
    Vector3 nu = Vector3::Zero();
    double distance = 0;
  };
  static Rates AlongTwists(const PlacedSurface& surface_1, const FrameMotion& body_1, const PlacedSurface& surface_2,
                           const FrameMotion& body_2, const Separation& separation);

  const PairTangent tangent_;
  const Rates rates_;
  Vec3 nu_;
  T distance_;
  const Side<T> one_, two_;
  Eigen::Matrix<T, 3, 2> basis_;  // moves along with ν
  Mat2 S_1_, S_2_;                // in that basis
  const int order_;
};

template <typename T>
class PlaneExpansion {
 public:
  PlaneExpansion(const PlacedSurface& surface, const FrameMotion& body, const PlacedPlane& plane,
                 const FrameMotion& plane_frame, int order);

  int order() const { return order_; }
  void First(const Vector12& twist, Change<T>* change) const;
  SecondChange<T> Second(const Change<T>& k, const Change<T>& l) const;

 private:
  using Vec3 = Eigen::Matrix<T, 3, 1>;

  Vec3 nu_;
  const Side<T> one_;
  Vec3 lever_, height_;
  T gap_;
  const int order_;
};

extern template class SurfaceExpansion<double>;
extern template class SurfaceExpansion<Dual>;
extern template class PlaneExpansion<double>;
extern template class PlaneExpansion<Dual>;

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_PAIR_EXPANSION_H_
