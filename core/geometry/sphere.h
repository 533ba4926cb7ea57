#ifndef ROLLGAIT_CORE_GEOMETRY_SPHERE_H_
#define ROLLGAIT_CORE_GEOMETRY_SPHERE_H_

#include "core/geometry/support_jet.h"

namespace rollgait {

// Sphere about the origin. Immutable. Contract: radius finite and > 0.
class Sphere {
 public:
  explicit Sphere(double radius);

  double radius() const { return radius_; }  // m

  double Support(const Vector3& nu) const { return radius_ * nu.norm(); }
  Vector3 SupportPoint(const Vector3& nu) const { return nu * (radius_ / nu.norm()); }
  Matrix3 SupportHessian(const Vector3& nu) const;
  Vector3 RollingVelocity(const Vector3& nu, const Vector3& omega) const;
  // See Surface::Evaluate.
  void Evaluate(const Vector3& nu, int order, SupportJet* jet) const;

 private:
  double radius_;
};

// Adds the derivatives of ρ‖ν‖ (a ball of radius ρ) up to `order` to what the jet holds.
void AddBall(const Vector3& nu, double radius, int order, SupportJet* jet);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_SPHERE_H_
