// Pointwise kinematics of a superellipsoid over a fixed plane.
//
// The README of the reference folder gives no figures for this family but says what limits it: the conditioning of
// x_rel follows S. Tolerances used here, with q = the larger dual exponent 2/(2 − ε) (a power q − 1 multiplies relative
// errors of ν by it) and a = the largest semi-axis: points 16 ε q a, gap 10 ε (|c − o| + a), S 300 ε q relative to its
// norm, x_rel and velocities 300 ε q relative to |S| |ω| + |ω| |r|.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/contact/pair_kinematics.h"
#include "tests/reference_check/families.h"

namespace rollgait::reference {
namespace superellipsoid_plane {

void CheckCase(Fields item, Report* all) {
  CaseReport report(all, "superellipsoid_plane", item.Text("family") + " " + item.Get("id").dump());
  const auto vector = [&](const char* name) { return Vector3(item.Vector3(name).cast<double>()); };
  const Vector3 axes = vector("semi_axes"), omega = vector("omega");
  const double eps1 = item.Double("eps1"), eps2 = item.Double("eps2");
  const Result<Superellipsoid> created = Superellipsoid::Create(axes, eps1, eps2);
  if (!created.ok()) throw ReadError(item.where() + ": " + created.violations()[0].message);
  PlacedSurface placed;
  placed.surface = created.value();
  const Surface& surface = placed.surface;

  // Near a pole the contact point answers to the last digit of small components of ν: world axes are turned into the
  // body's with the digits of long double.
  const RealMatrix3 R = item.Rotation("quat_wxyz");
  const RealVector3 n = item.Vector3("plane_normal_unnormalised").normalized();
  const RealVector3 n_b = R.transpose() * n;
  const RealVector3 omega_b = R.transpose() * omega.cast<Real>();
  const RealVector3 offset_b = R.transpose() * (item.Vector3("center") - item.Vector3("plane_point"));
  FrameMotion body, ground;
  body.p_WB = offset_b.cast<double>();
  body.w_WB = omega_b.cast<double>();
  PlacedPlane plane;
  plane.n_B = n_b.cast<double>();
  const PairKinematics pair = ComputePlaneContact(placed, body, plane, ground);

  Fields expect = item.Object("expect");
  const double q = 2 / (2 - std::max(eps1, eps2)), size = axes.maxCoeff();
  const double point = 16 * kEpsilon * q * size;
  const Vector3 x = surface.SupportPoint(-plane.n_B);
  const RealVector3 r = R * x.cast<Real>();
  report.Norm("body_point", x, expect.Vector3("body_point"), point);
  report.Norm("r", r, expect.Vector3("r"), point);
  const RealVector3 world_point = R * pair.p_1.cast<Real>() + item.Vector3("plane_point");
  report.Norm("contact_point", world_point, expect.Vector3("contact_point"),
              point + 4 * kEpsilon * item.Vector3("center").norm());
  report.Number("gap", pair.gap, expect.Number("gap"), 10 * kEpsilon * (body.p_WB.norm() + size));

  if (expect.Has("note")) {
    // No second derivative, or one that is 0 for a reason that the file does not go into: S ends up missing or
    // singular.
    expect.Skip("note");
    SupportJet jet;
    surface.Evaluate(-plane.n_B, 4, &jet);
    report.Number("order at a pole < 4", jet.order < 4, 1, 0);
  } else {
    const RealMatrix3 S = expect.Matrix3("S_body");
    const RealVector3 x_rel = expect.Vector3("x_rel_body");
    const double velocity = 300 * kEpsilon * q * body.w_WB.norm();
    report.Norm("S_body", surface.SupportHessian(-plane.n_B), S, 300 * kEpsilon * q * S.norm());
    report.Norm("x_rel_body", surface.RollingVelocity(-plane.n_B, body.w_WB), x_rel, velocity * S.norm());
    const RealVector3 r_dot = R * pair.p_dot_1.cast<Real>();
    report.Norm("r_dot", r_dot, expect.Vector3("r_dot"), velocity * (S.norm() + r.norm()));
    const Real S_max = surface.SupportHessian(-plane.n_B).cwiseAbs().maxCoeff() / size;
    const Real S_max_expected = expect.Number("S_max_over_size");  // six digits
    report.Number("S_max_over_size", S_max, S_max_expected, 1e-5L * S_max_expected);
  }
  expect.Finish();
  item.Finish();
}

}  // namespace superellipsoid_plane

bool IsSuperellipsoidPlane(const Document& document) { return FirstCaseHas(document, "eps1", "body_point"); }

void CheckSuperellipsoidPlane(const Document& document, Report* report) {
  CheckCases(document, superellipsoid_plane::CheckCase, report);
}

}  // namespace rollgait::reference
