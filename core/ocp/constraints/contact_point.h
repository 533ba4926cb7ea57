#ifndef ROLLGAIT_CORE_OCP_CONSTRAINTS_CONTACT_POINT_H_
#define ROLLGAIT_CORE_OCP_CONSTRAINTS_CONTACT_POINT_H_

#include "core/ocp/point_function.h"

namespace rollgait {

// Gap of a contact over the ground, φ(q) = n · p, m, one row. The bound is  (4 s (1 − s))³ · clearance ≤ φ  at fraction
// s of the phase for a swinging surface, or φ = 0 where it touches down.  Source: contact-math 5. While a surface
// rolls, φ and its first two derivatives are 0, and so are those of the bound at both ends: a bound with a slope there
// could be met on a mesh only, by a foot that is stopped within the last interval, however short.
class GapConstraint : public PointConstraint {
 public:
  enum class Kind { kClearance, kTouching };
  GapConstraint(const Model& model, const std::vector<ContactSurface>& contacts, int contact, const PointLayout& layout,
                Kind kind, double clearance);
  int rows() const override { return 1; }
  std::string Name(int) const override { return (kind_ == Kind::kClearance ? "clearance " : "touch-down ") + name_; }
  std::string Unit(int) const override { return "m"; }
  double Size(int) const override { return 0.1; }
  void Bounds(double fraction, double* lower, double* upper) const override;
  // Where the surface touches down there, the next phase fixes its gap.
  bool FreeAtEndOfPhase() const override { return kind_ == Kind::kClearance; }
  Entries JacobianPattern() const override;
  Entries HessianPattern() const override;
  void Value(const PointContext& at, double* g) override;
  void Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) override;
  void AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) override;

 private:
  std::string name_;
  int contact_;
  PointLayout layout_;
  Kind kind_;
  double clearance_;
  std::vector<int> path_;
};

// Where on the surface the contact point lies: its coordinate along the first axis as a fraction of the largest one, −1
// … 1, one row with the given range.  Source: eq. (4.3).
class SurfacePointConstraint : public PointConstraint {
 public:
  SurfacePointConstraint(const Model& model, const std::vector<ContactSurface>& contacts, int contact,
                         const PointLayout& layout, double min, double max);
  int rows() const override { return 1; }
  std::string Name(int) const override { return "contact point " + name_; }
  std::string Unit(int) const override { return "1"; }
  double Size(int) const override { return 1; }
  void Bounds(double fraction, double* lower, double* upper) const override;
  Entries JacobianPattern() const override;
  Entries HessianPattern() const override;
  void Value(const PointContext& at, double* g) override;
  void Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) override;
  void AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) override;

 private:
  std::string name_;
  int contact_;
  PointLayout layout_;
  double semi_axis_, min_, max_;
  std::vector<int> path_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_CONSTRAINTS_CONTACT_POINT_H_
