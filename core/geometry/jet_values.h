#ifndef ROLLGAIT_CORE_GEOMETRY_JET_VALUES_H_
#define ROLLGAIT_CORE_GEOMETRY_JET_VALUES_H_

#include <Eigen/Geometry>

#include "core/geometry/support_jet.h"

namespace rollgait {

// Surface::SupportHessian and Surface::RollingVelocity of a body that only has Evaluate.
template <typename Body>
Matrix3 HessianByJet(const Body& body, const Vector3& nu) {
  SupportJet jet;
  body.Evaluate(nu, 2, &jet);
  return jet.S;
}

template <typename Body>
Vector3 RollingVelocityByJet(const Body& body, const Vector3& nu, const Vector3& omega) {
  SupportJet jet;
  body.Evaluate(nu, 2, &jet);
  if (jet.order < 2) return Vector3::Constant(kInfinity);
  return jet.S * nu.cross(omega);
}

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_JET_VALUES_H_
