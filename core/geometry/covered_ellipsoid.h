#ifndef ROLLGAIT_CORE_GEOMETRY_COVERED_ELLIPSOID_H_
#define ROLLGAIT_CORE_GEOMETRY_COVERED_ELLIPSOID_H_

#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include "core/base/check.h"
#include "core/base/result.h"
#include "core/geometry/ellipsoid.h"

namespace rollgait {

// A core in a cover: the Minkowski sum of two ellipsoids with the same axes, of semi-axes a − c and c. Its support
// function is the sum of theirs, h = ‖(a − c) · ν‖ + ‖c · ν‖ (component by component), and so are all derivatives; a
// are the semi-axes of the whole. Equal components of c are a ball that rolls over the core: a sole of even thickness.
// Where the core is thin the body is longer and flatter than the ellipsoid of the semi-axes a, like a capsule or a
// tablet, without an edge. c = 0 is the ellipsoid, and so is c in proportion to a. Immutable; any thread may share it.
class CoveredEllipsoid {
 public:
  static constexpr double kLargest = 1e6;        // m, of a
  static constexpr double kLeastShare = 1e-6;    // of c/a and of (a − c)/a
  static constexpr double kWalkingShare = 0.05;  // the same of a body that walks
  static constexpr char kWalks[] = "a covered ellipsoid";

  // Refuses semi-axes that are not in (0, kLargest], and a cover that is neither zero in all components nor within the
  // shares above of every semi-axis. Violations name field + ".semi_axes_m" or ".cover_m".
  static Result<CoveredEllipsoid> Create(const Vector3& semi_axes, const Vector3& cover,
                                         const std::string& field = "covered_ellipsoid") {
    const auto text = [](const Vector3& v, const char* must) {
      std::ostringstream message;
      message << "is (" << v.transpose() << ") m; " << must;
      return message.str();
    };
    if (!(semi_axes.allFinite() && semi_axes.minCoeff() > 0 && semi_axes.maxCoeff() <= kLargest)) {
      return Violations{{field + ".semi_axes_m", text(semi_axes, "each must be larger than 0 and at most 1e6 m")}};
    }
    if (!FitsInto(semi_axes, cover, cover.isZero(0) ? 0 : kLeastShare)) {
      return Violations{{field + ".cover_m", text(cover,
                                                  "each must be larger than 0 and smaller than the semi-axis, by 1e-6 "
                                                  "of it at least; or all 0, for no cover")}};
    }
    return CoveredEllipsoid(semi_axes, cover);
  }
  // Contract: what Create demands.
  CoveredEllipsoid(const Vector3& semi_axes, const Vector3& cover)
      : semi_axes_(semi_axes), cover_(cover), core_(semi_axes - cover) {
    ROLLGAIT_CHECK(FitsInto(semi_axes, cover, cover.isZero(0) ? 0 : kLeastShare));
    if (!cover.isZero(0)) around_.emplace(cover);
  }

  const Vector3& semi_axes() const { return semi_axes_; }  // a, m
  const Vector3& cover() const { return cover_; }          // c, m

  double Support(const Vector3& nu) const { return core_.Support(nu) + (around_ ? around_->Support(nu) : 0); }
  Vector3 SupportPoint(const Vector3& nu) const {
    const Vector3 x = core_.SupportPoint(nu);
    return around_ ? Vector3(x + around_->SupportPoint(nu)) : x;
  }
  Matrix3 SupportHessian(const Vector3& nu) const {
    const Matrix3 S = core_.SupportHessian(nu);
    return around_ ? Matrix3(S + around_->SupportHessian(nu)) : S;
  }
  Vector3 RollingVelocity(const Vector3& nu, const Vector3& omega) const {
    const Vector3 velocity = core_.RollingVelocity(nu, omega);
    return around_ ? Vector3(velocity + around_->RollingVelocity(nu, omega)) : velocity;
  }
  Eigen::Matrix2d TangentHessian(const Vector3& nu, const Eigen::Matrix<double, 3, 2>& tangents) const {
    const Eigen::Matrix2d block = core_.TangentHessian(nu, tangents);
    return around_ ? Eigen::Matrix2d(block + around_->TangentHessian(nu, tangents)) : block;
  }
  // See Surface::Evaluate.
  void Evaluate(const Vector3& nu, int order, SupportJet* jet) const {
    core_.Evaluate(nu, order, jet);
    if (!around_) return;
    SupportJet added;
    around_->Evaluate(nu, order, &added);
    jet->h += added.h;
    jet->x += added.x;
    if (order >= 2) jet->S += added.S;
    for (size_t k = 0; order >= 3 && k < jet->T.size(); ++k) jet->T[k] += added.T[k];
    for (size_t k = 0; order >= 4 && k < jet->Q.size(); ++k) jet->Q[k] += added.Q[k];
  }

  WalkingShape Walking() const {
    WalkingShape shape{"covered_ellipsoid", semi_axes_, {}, {}};
    static constexpr const char* kFields[] = {"cover_m.x", "cover_m.y", "cover_m.z"};
    for (int i = 0; around_ && i < 3; ++i) {
      shape.numbers.push_back(
          {kFields[i], cover_[i], kWalkingShare * semi_axes_[i], (1 - kWalkingShare) * semi_axes_[i]});
    }
    shape.support = [a = semi_axes_, c = cover_](const Vector3& nu) {
      const auto length = [&nu](const Vector3& axes) {
        return std::hypot(axes.x() * nu.x(), axes.y() * nu.y(), axes.z() * nu.z());
      };
      return length(a - c) + length(c);
    };
    return shape;
  }

 private:
  static bool FitsInto(const Vector3& semi_axes, const Vector3& cover, double share) {
    const Vector3 least = share * semi_axes;
    return (cover.array() >= least.array()).all() && ((semi_axes - cover).array() >= least.array()).all();
  }

  Vector3 semi_axes_, cover_;  // m
  Ellipsoid core_;
  std::optional<Ellipsoid> around_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GEOMETRY_COVERED_ELLIPSOID_H_
