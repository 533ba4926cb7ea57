#include "core/contact/pair_expansion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <type_traits>

#include "core/math/assign_dual.h"
#include "core/multibody/spatial.h"

namespace rollgait {
namespace {

template <typename T>
constexpr bool kMoves = std::is_same_v<T, Dual>;

// Velocities of the two frames from the order of ζ: δp_1, δθ_1, δp_2, δθ_2.
template <typename T>
void Move(const Vector12& twist, Change<T>* change) {
  change->one.v = twist.segment<3>(0).template cast<T>();
  change->one.omega = twist.segment<3>(3).template cast<T>();
  change->two.v = twist.segment<3>(6).template cast<T>();
  change->two.omega = twist.segment<3>(9).template cast<T>();
}

// A vector fixed to a body, and its change as the body turns.
template <typename T>
Eigen::Matrix<T, 3, 1> Carried(const FrameMotion& body, const Vector3& u) {
  Eigen::Matrix<T, 3, 1> carried;
  AssignDual(carried, u, Vector3(body.w_WB.cross(u)));
  return carried;
}

template <typename T>
Eigen::Matrix<T, 3, 1> Place(const FrameMotion& body) {
  Eigen::Matrix<T, 3, 1> place;
  AssignDual(place, body.p_WB, body.v_WB);
  return place;
}

// The derivatives of a matrix of duals.
template <typename M>
Eigen::Matrix<double, M::RowsAtCompileTime, M::ColsAtCompileTime> Slopes(const M& matrix) {
  return matrix.unaryExpr([](const Dual& a) { return a.d; });
}

}  // namespace

template <typename T>
Side<T>::Side(const PlacedSurface& placed, const FrameMotion& body, const Vector3& nu, const Vector3& nu_dot,
              double sign, int order)
    : sign_(sign) {
  const Matrix3 R = body.R_WB * placed.R_BE;
  SupportJet jet;
  placed.surface.Evaluate(R.transpose() * (sign * nu), order + (kMoves<T> ? 2 : 1), &jet);
  jet_order = kMoves<T> ? jet.order - 1 : jet.order;
  const Vector3 center = body.R_WB * placed.p_BE;
  if constexpr (kMoves<T>) {
    const Vector3 y = sign * (R.transpose() * (nu_dot - body.w_WB.cross(nu)));
    Eigen::Matrix<T, 3, 1> x;
    Mat3 hessian;
    AssignDual(R_WE_, R, Matrix3(Skew(body.w_WB) * R));
    AssignDual(x, jet.x, Vector3(jet.S * y));
    AssignDual(hessian, jet.S, jet.Third(y));
    for (int j = 0; j < 3 && order > 1; ++j) AssignDual(third_[j], jet.T[j], jet.FourthOf(j, y));
    r = Carried<T>(body, center) + R_WE_ * x;
    S = R_WE_ * hessian * R_WE_.transpose();
  } else {
    R_WE_ = R;
    if (order > 1) third_ = jet.T;
    r = center + R * jet.x;
    S = R * jet.S * R.transpose();
  }
}

template <typename T>
void Side<T>::Complete(const Vec3& nu, int order, Variation<T>* a) const {
  const Vec3 y = a->nu_dot - a->omega.cross(nu), S_y = T(sign_) * (S * y);
  a->r_dot = a->omega.cross(r) + S_y;
  if (order < 2) return;
  a->y_E = R_WE_.transpose() * y;
  a->third_E = a->y_E[0] * third_[0] + a->y_E[1] * third_[1] + a->y_E[2] * third_[2];
  a->carried = a->r_dot + S_y;
  a->turned = a->nu_dot + y;
}

template <typename T>
typename Side<T>::Vec3 Side<T>::Bend(const Variation<T>& a, const Variation<T>& b) const {
  const Vec3 turned = a.omega.cross(b.turned) + b.omega.cross(a.turned);
  const Vec3 carried = a.omega.cross(b.carried) + b.omega.cross(a.carried);
  return R_WE_ * (a.third_E * b.y_E) + T(0.5) * (carried - T(sign_) * (S * turned));
}

template <typename T>
typename SurfaceExpansion<T>::Rates SurfaceExpansion<T>::AlongTwists(const PlacedSurface& surface_1,
                                                                     const FrameMotion& body_1,
                                                                     const PlacedSurface& surface_2,
                                                                     const FrameMotion& body_2,
                                                                     const Separation& separation) {
  if constexpr (kMoves<T>) {
    const SurfaceExpansion<double> at(surface_1, body_1, surface_2, body_2, separation, 1);
    if (at.order() < 1) return {};
    Vector12 twists;
    twists << body_1.v_WB, body_1.w_WB, body_2.v_WB, body_2.w_WB;
    Change<double> along;
    at.First(twists, &along);
    return {along.one.nu_dot, along.gap};
  }
  return {};
}

template <typename T>
SurfaceExpansion<T>::SurfaceExpansion(const PlacedSurface& surface_1, const FrameMotion& body_1,
                                      const PlacedSurface& surface_2, const FrameMotion& body_2,
                                      const Separation& separation, int order)
    : tangent_(Pose(surface_1, body_1), Pose(surface_2, body_2), separation.nu, separation.distance),
      rates_(AlongTwists(surface_1, body_1, surface_2, body_2, separation)),
      one_(surface_1, body_1, separation.nu, rates_.nu, 1, order),
      two_(surface_2, body_2, separation.nu, rates_.nu, -1, order),
      order_(tangent_.finite ? std::min({one_.jet_order, two_.jet_order, order + 1}) - 1 : 0) {
  const Vector3& nu = separation.nu;
  AssignDual(nu_, nu, rates_.nu);
  AssignDual(basis_, tangent_.basis, (-nu * (rates_.nu.transpose() * tangent_.basis)).eval());
  if constexpr (kMoves<T>) {
    distance_ = Dual(separation.distance, rates_.distance);
    const auto in_basis = [&](const typename Side<T>::Mat3& S) -> Eigen::Matrix2d {
      return tangent_.basis.transpose() * Slopes(S) * tangent_.basis;
    };
    AssignDual(S_1_, tangent_.S_1, in_basis(one_.S));
    AssignDual(S_2_, tangent_.S_2, in_basis(two_.S));
  } else {
    distance_ = separation.distance;
    S_1_ = tangent_.S_1;
    S_2_ = tangent_.S_2;
  }
}

// (S₁ + S₂ + d) y = z on the tangent plane.
template <typename T>
typename SurfaceExpansion<T>::Vec2 SurfaceExpansion<T>::Solve(const Vec2& z) const {
  if constexpr (kMoves<T>) {
    const Eigen::Vector2d y = tangent_.Solve(z.unaryExpr([](const Dual& a) { return a.v; }));
    Vec2 solution;
    AssignDual(solution, y, tangent_.Solve(Slopes(z) - Slopes(Mat2(S_1_ + S_2_)) * y - distance_.d * y));
    return solution;
  } else {
    return tangent_.Solve(z);
  }
}

template <typename T>
void SurfaceExpansion<T>::First(const Vector12& twist, Change<T>* change) const {
  Move(twist, change);
  Variation<T>&a = change->one, &b = change->two;
  const Vec3 slip = a.v + a.omega.cross(one_.r) - b.v - b.omega.cross(two_.r);
  // M ν̇ = S₁(ω₁×ν) + S₂(ω₂×ν) − P w
  a.nu_dot = b.nu_dot =
      basis_ * Solve(S_1_ * Components(a.omega.cross(nu_)) + S_2_ * Components(b.omega.cross(nu_)) - Components(slip));
  one_.Complete(nu_, order_, &a);
  two_.Complete(nu_, order_, &b);
  change->normal = -a.nu_dot;
  change->gap = -nu_.dot(slip);
  change->p_1 = a.v + a.r_dot;
  change->p_2 = b.v + b.r_dot;
}

template <typename T>
SecondChange<T> SurfaceExpansion<T>::Second(const Change<T>& k, const Change<T>& l) const {
  const Vec3 bend_1 = one_.Bend(k.one, l.one), bend_2 = two_.Bend(k.two, l.two);
  const Vec3 &nu_k = k.one.nu_dot, &nu_l = l.one.nu_dot;
  // (S₁ + S₂ + d) ν̈ + d̈ ν = bend₂ − bend₁ − ḋ_k ν̇_l − ḋ_l ν̇_k,  ν · ν̈ = −ν̇_k · ν̇_l
  const Vec3 right = bend_2 - bend_1 - k.gap * nu_l - l.gap * nu_k;
  const T square = nu_k.dot(nu_l);
  const Vec3 nu_second = basis_ * Solve(Components(right)) - square * nu_;
  return {-nu_second, bend_1 + one_.S * nu_second, bend_2 - two_.S * nu_second,
          nu_.dot(bend_2 - bend_1) + distance_ * square};
}

template <typename T>
PlaneExpansion<T>::PlaneExpansion(const PlacedSurface& surface, const FrameMotion& body, const PlacedPlane& plane,
                                  const FrameMotion& plane_frame, int order)
    : nu_(Carried<T>(plane_frame, -(plane_frame.R_WB * plane.n_B))),
      one_([&] {
        const Vector3 nu = -(plane_frame.R_WB * plane.n_B);
        return Side<T>(surface, body, nu, plane_frame.w_WB.cross(nu), 1, order);
      }()),
      lever_(Carried<T>(plane_frame, plane_frame.R_WB * plane.p_BO)),
      height_(Place<T>(body) + one_.r - Place<T>(plane_frame) - lever_),
      gap_(-nu_.dot(height_)),
      order_(std::min(one_.jet_order, order + 1) - 1) {}

template <typename T>
void PlaneExpansion<T>::First(const Vector12& twist, Change<T>* change) const {
  Move(twist, change);
  Variation<T>&a = change->one, &b = change->two;
  a.nu_dot = b.nu_dot = b.omega.cross(nu_);
  one_.Complete(nu_, order_, &a);
  change->height = a.v + a.r_dot - b.v - b.omega.cross(lever_);
  change->normal = -a.nu_dot;
  change->p_1 = a.v + a.r_dot;
  change->gap = -a.nu_dot.dot(height_) - nu_.dot(change->height);
  change->p_2 = change->p_1 + change->gap * nu_ + gap_ * a.nu_dot;
}

template <typename T>
SecondChange<T> PlaneExpansion<T>::Second(const Change<T>& k, const Change<T>& l) const {
  const Vec3 &nu_k = k.one.nu_dot, &nu_l = l.one.nu_dot;
  const auto twice = [&](const Vec3& u) -> Vec3 {  // second change of a vector fixed to the plane
    const Vec3 &omega_k = k.two.omega, &omega_l = l.two.omega;
    return T(0.5) * (omega_k.cross(Vec3(omega_l.cross(u))) + omega_l.cross(Vec3(omega_k.cross(u))));
  };
  const Vec3 nu_second = twice(nu_);
  const Vec3 p_1 = one_.Bend(k.one, l.one) + one_.S * nu_second;
  const T gap = -nu_second.dot(height_) - nu_k.dot(l.height) - nu_l.dot(k.height) - nu_.dot(p_1 - twice(lever_));
  return {-nu_second, p_1, p_1 + gap * nu_ + k.gap * nu_l + l.gap * nu_k + gap_ * nu_second, gap};
}

template class SurfaceExpansion<double>;
template class SurfaceExpansion<Dual>;
template class PlaneExpansion<double>;
template class PlaneExpansion<Dual>;

}  // namespace rollgait
