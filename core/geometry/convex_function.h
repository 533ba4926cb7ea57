#ifndef ROLLGAIT_CORE_GEOMETRY_CONVEX_FUNCTION_H_
#define ROLLGAIT_CORE_GEOMETRY_CONVEX_FUNCTION_H_

#include "core/base/types.h"

namespace rollgait {

// A smooth convex function Φ whose set Φ(x) ≤ 0 is a bounded body with the origin inside. x in m; Φ in any unit. The
// body has a unique contact point for every normal where Φ is strictly convex; where the Hessian is singular along the
// surface the body is flat and S is infinite. Implementations are immutable: any thread may share one.
class ConvexFunction {
 public:
  virtual ~ConvexFunction() = default;
  virtual double Value(const Vector3& x) const = 0;
  virtual Vector3 Gradient(const Vector3& x) const = 0;
  virtual Matrix3 Hessian(const Vector3& x) const = 0;
  // D³Φ[u] and D⁴Φ[u, w]. Called only up to derivatives(); an entry that does not exist at x is not finite.
  virtual Matrix3 Third(const Vector3& x, const Vector3& u) const = 0;
  virtual Matrix3 Fourth(const Vector3& x, const Vector3& u, const Vector3& w) const = 0;
  // How many derivatives there are: 2, 3 (T can be formed) or 4 (Q can be formed).
  virtual int derivatives() const = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_CONVEX_FUNCTION_H_
