#ifndef ROLLGAIT_CORE_MULTIBODY_SPATIAL_H_
#define ROLLGAIT_CORE_MULTIBODY_SPATIAL_H_

#include <Eigen/Geometry>

#include "core/base/types.h"

namespace rollgait {

// Six-vectors are [angular; linear], expressed in world axes at the world origin (Featherstone 2008, chapter 2).

// Motion cross product  X × Y.
template <typename T>
inline Eigen::Matrix<T, 6, 1> CrossMotion(const Eigen::Matrix<T, 6, 1>& x, const Eigen::Matrix<T, 6, 1>& y) {
  Eigen::Matrix<T, 6, 1> z;
  z.template head<3>() = x.template head<3>().cross(y.template head<3>());
  z.template tail<3>() =
      x.template head<3>().cross(y.template tail<3>()) + x.template tail<3>().cross(y.template head<3>());
  return z;
}

// Force cross product  X ×* F, the negative transpose of X × .
inline Vector6 CrossForce(const Vector6& x, const Vector6& f) {
  Vector6 z;
  z.head<3>() = x.head<3>().cross(f.head<3>()) + x.tail<3>().cross(f.tail<3>());
  z.tail<3>() = x.head<3>().cross(f.tail<3>());
  return z;
}

inline Matrix3 Skew(const Vector3& u) {
  Matrix3 m;
  m << 0, -u.z(), u.y(), u.z(), 0, -u.x(), -u.y(), u.x(), 0;
  return m;
}

// Spatial inertia about the world origin: mass, first moment h = m c, rotational inertia J about the origin.
// A sum of bodies is again of this form.
struct SpatialInertia {
  double mass = 0;
  Vector3 moment = Vector3::Zero();
  Matrix3 rotational = Matrix3::Zero();

  Vector6 operator*(const Vector6& x) const {
    Vector6 y;
    y.head<3>() = rotational * x.head<3>() + moment.cross(x.tail<3>());
    y.tail<3>() = mass * x.tail<3>() - moment.cross(x.head<3>());
    return y;
  }
  SpatialInertia& operator+=(const SpatialInertia& other) {
    mass += other.mass;
    moment += other.moment;
    rotational += other.rotational;
    return *this;
  }
};

// A moving composite of bodies: inertia, the Coriolis operator  B X = V ×* I X + X ×* I V − I (V × X)  summed over its
// bodies (docs/explanation/derivatives.md), which is  [b x_ω; −2 p × x_ω]  with p the momentum. Sums like the inertia.
struct CompositeMotion {
  Matrix3 coriolis = Matrix3::Zero();
  Vector3 momentum = Vector3::Zero();

  // Of one body with this inertia and twist.
  void Set(const SpatialInertia& inertia, const Vector6& twist) {
    const Vector3 w = twist.head<3>(), v = twist.tail<3>(), &h = inertia.moment;
    momentum = inertia.mass * v - h.cross(w);
    // 2 [ω] J − 2 [h][v] − tr(J) [ω], with [h][v] = v hᵀ − (h·v) 1.
    const Matrix3 doubled = 2 * inertia.rotational;
    for (int k = 0; k < 3; ++k) coriolis.col(k) = w.cross(doubled.col(k)) - (2 * h(k)) * v;
    coriolis.diagonal().array() += 2 * h.dot(v);
    coriolis -= Skew(inertia.rotational.trace() * w);
  }
  CompositeMotion& operator+=(const CompositeMotion& other) {
    coriolis += other.coriolis;
    momentum += other.momentum;
    return *this;
  }
  // B X and Bᵀ W.
  Vector6 Apply(const Vector6& x) const {
    Vector6 y;
    y.head<3>().noalias() = coriolis * x.head<3>();
    y.tail<3>() = -2 * momentum.cross(x.head<3>());
    return y;
  }
  Vector6 ApplyTranspose(const Vector6& w) const {
    Vector6 y;
    y.head<3>() = coriolis.transpose() * w.head<3>() + 2 * momentum.cross(w.tail<3>());
    y.tail<3>().setZero();
    return y;
  }
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MULTIBODY_SPATIAL_H_
