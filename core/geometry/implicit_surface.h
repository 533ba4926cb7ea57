#ifndef ROLLGAIT_CORE_GEOMETRY_IMPLICIT_SURFACE_H_
#define ROLLGAIT_CORE_GEOMETRY_IMPLICIT_SURFACE_H_

#include <memory>
#include <string>

#include "core/base/result.h"
#include "core/geometry/convex_function.h"
#include "core/geometry/support_jet.h"

namespace rollgait {

// The surface Φ(x) = 0 of a convex function. The contact point solves ∇Φ(x) = κ ν, Φ(x) = 0, κ > 0; S, T and Q come
// from the linear systems that follow by differentiating these two equations. Source: contact-math 2.3. Immutable; any
// thread may share it. Copies share the function, which may be large and is never written to.
class ImplicitSurface {
 public:
  // Refuses, naming `field`: no function; Φ(0) not negative; a ray from the origin without Φ = 0 between 1e-9 m and
  // 1e9 m; a Hessian that is not positive semidefinite on the surface; a gradient that differences of Φ contradict.
  // Checked along 26 rays, so a function that is wrong elsewhere can pass.
  static Result<ImplicitSurface> Create(std::shared_ptr<const ConvexFunction> function,
                                        const std::string& field = "implicit");

  const ConvexFunction& function() const { return *function_; }

  double Support(const Vector3& nu) const { return nu.dot(SupportPoint(nu)); }
  // Converges for every convex Φ: Newton's method on (x, κ); if its residual does not fall, minima of Φ − κ ν·x (Newton
  // with a line search on a convex function) for a bracketed κ, along which Φ grows monotonically.
  Vector3 SupportPoint(const Vector3& nu) const;
  Matrix3 SupportHessian(const Vector3& nu) const;
  Vector3 RollingVelocity(const Vector3& nu, const Vector3& omega) const;
  // See Surface::Evaluate. The order is at most derivatives().
  void Evaluate(const Vector3& nu, int order, SupportJet* jet) const;

 private:
  struct Contact {
    Vector3 x;
    double kappa = 0;
  };
  ImplicitSurface(std::shared_ptr<const ConvexFunction> function, double size);

  Contact Solve(const Vector3& nu) const;
  // Newton's method on (x, κ) while its residual falls. True at convergence.
  bool Polish(const Vector3& nu, Contact* contact) const;
  // x of the minimum of Φ − κ ν·x, from the x given.
  void Minimise(const Vector3& nu, Contact* contact) const;
  // |∇Φ − κ ν| size + |Φ|
  double Residual(const Vector3& nu, const Contact& contact) const;

  std::shared_ptr<const ConvexFunction> function_;
  double size_;  // m, largest distance of the surface from the origin along the rays looked at
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_IMPLICIT_SURFACE_H_
