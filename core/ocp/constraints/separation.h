#ifndef ROLLGAIT_CORE_OCP_CONSTRAINTS_SEPARATION_H_
#define ROLLGAIT_CORE_OCP_CONSTRAINTS_SEPARATION_H_

#include <optional>

#include "core/contact/body_surface.h"
#include "core/contact/pair_expansion.h"
#include "core/ocp/point_function.h"

namespace rollgait {

// Signed distance of two bodies, m, one row:  clearance ≤ d(q).  d depends on the joints between the bodies only: those
// on the two paths below the last joint that carries both; Jacobian and Hessian are dense in them. While the bodies are
// apart d is their distance, which is unique. While they overlap it is the local maximum of g (contact-math 8) that
// Newton's method reaches from the line of their centres, so d depends on q alone, never on what was evaluated before.
// Derivatives are exact: the second-order expansion of the pair (SurfaceExpansion) along the joints' twists, plus
//   d'(ζ_mk),  ζ_mk = (ω_m × ∂p/∂q_k, ½ ω_m × ω_k)  for joint m at or above joint k on one path.
// Source: contact-math 6, 8. Reads the tree and the positions of the context only. Gradient and Hessian at the same
// positions share one search for the normal and one expansion. No allocation after construction.
// Contract: bodies on different links, with smooth surfaces (SupportJet::order 3 everywhere, as ellipsoids).
class SeparationConstraint : public PointConstraint {
 public:
  SeparationConstraint(const Model& model, const BodySurface& first, const BodySurface& second,
                       const PointLayout& layout, double clearance);
  int rows() const override { return 1; }
  // "distance left_shank / right_shank".
  std::string Name(int) const override { return "distance " + first_.name + " / " + second_.name; }
  std::string Unit(int) const override { return "m"; }
  double Size(int) const override { return 0.1; }
  void Bounds(double fraction, double* lower, double* upper) const override;
  Entries JacobianPattern() const override;
  Entries HessianPattern() const override;
  void Value(const PointContext& at, double* g) override;
  void Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) override;
  void AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) override;

 private:
  // A joint that moves one of the bodies and not the other.
  struct Mover {
    int joint;
    bool moves_second;
  };
  // Poses of the links and the distance at them.
  Separation Measure(const TreeDynamics& tree);
  // Fills separation_, expansion_ and changes_, unless they are those of these positions.
  void Expand(const PointContext& at);

  BodySurface first_, second_;
  PointLayout layout_;
  double clearance_;
  std::vector<Mover> movers_;  // of the first body, root first, then of the second
  FrameMotion frame_1_, frame_2_;
  VectorX expanded_at_;  // the positions of what follows
  Separation separation_;
  std::optional<SurfaceExpansion<double>> expansion_;  // to second order
  std::vector<Change<double>> changes_;                // of the pair along every mover
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_CONSTRAINTS_SEPARATION_H_
