// Signed distance of two ellipsoids: normal, points, their motion.
//
// Tolerances of the reference folder's README, with k the larger axis ratio: distance and points 10 ε (|c₂−c₁| +
// a_max), normal 10 ε k, normal_dot 50 ε k and point velocity 10 ε k relative. For what it does not name: slip and
// distance_dot like points times the spins plus ε of the velocities; S 300 ε relative plus k times the normal's
// tolerance; accelerations follow the points' velocities.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/contact/pair_tangent.h"
#include "core/contact/surface_pair.h"
#include "tests/reference_check/families.h"

namespace rollgait::reference {
namespace ellipsoid_pair {

struct Body {
  Vector3 axes;
  PlacedSurface surface;
  FrameMotion frame;
};

Body ReadBody(Fields* item, const std::string& number) {
  const auto vector = [&](const std::string& name) { return Vector3(item->Vector3(name + number).cast<double>()); };
  Body body;
  body.axes = vector("semi_axes_");
  if (!(body.axes.minCoeff() > 0)) throw ReadError(item->where() + ".semi_axes_" + number + " must be > 0");
  body.surface.surface = Ellipsoid(body.axes);
  body.frame = {item->Rotation("quat_wxyz_" + number).cast<double>(),
                vector("center_"),
                vector("omega_"),
                vector("v_center_"),
                vector("alpha_"),
                vector("a_center_")};
  return body;
}

Matrix3 WorldHessian(const Body& body, const Vector3& nu) {
  return body.frame.R_WB * body.surface.surface.SupportHessian(body.frame.R_WB.transpose() * nu) *
         body.frame.R_WB.transpose();
}

void CheckCase(Fields item, Report* all) {
  CaseReport report(all, "ellipsoid_pair", item.Text("family") + " " + item.Get("id").dump());
  const Body one = ReadBody(&item, "1"), two = ReadBody(&item, "2");
  Fields expect = item.Object("expect");
  SurfacePair pair(one.surface, two.surface);
  // A cold start finds the distance of disjoint bodies; of overlapping ones a file may give another way to part them.
  if (!expect.Bool("is_global_maximum_of_separation")) {
    pair.StartFrom(expect.Vector3("normal_1_to_2").normalized().cast<double>());
  }
  const PairKinematics at = pair.Compute(one.frame, two.frame);
  const Separation& separation = pair.separation();

  const double k = std::max(one.axes.maxCoeff() / one.axes.minCoeff(), two.axes.maxCoeff() / two.axes.minCoeff());
  const double length = (two.frame.p_WB - one.frame.p_WB).norm() + std::max(one.axes.maxCoeff(), two.axes.maxCoeff());
  const double origin = one.frame.p_WB.norm();
  const double point = 10 * kEpsilon * length;
  const RealVector3 nu_dot = expect.Vector3("normal_dot");
  const RealVector3 v_1 = expect.Vector3("point_1_velocity"), v_2 = expect.Vector3("point_2_velocity");
  const double spin = one.frame.w_WB.norm() + two.frame.w_WB.norm();
  const double speed = one.frame.v_WB.norm() + two.frame.v_WB.norm() + spin * length;
  const Real centripetal = one.frame.w_WB.norm() * (v_1.norm() + one.frame.v_WB.norm()) +
                           two.frame.w_WB.norm() * (v_2.norm() + two.frame.v_WB.norm());
  const Real acceleration =
      one.frame.a_WB.norm() + two.frame.a_WB.norm() + (one.frame.alpha_WB.norm() + two.frame.alpha_WB.norm()) * length;

  report.Norm("normal_1_to_2", separation.nu, expect.Vector3("normal_1_to_2"), 10 * kEpsilon * k);
  report.Number("distance", at.gap, expect.Number("distance"), point);
  report.Norm("point_1", at.p_1, expect.Vector3("point_1"), point + kEpsilon * origin);
  report.Norm("point_2", at.p_2, expect.Vector3("point_2"), point + kEpsilon * origin);
  report.Norm("normal_dot", -at.normal_dot, nu_dot, 50 * kEpsilon * k * nu_dot.norm());
  report.Norm("point_1_velocity", at.p_dot_1, v_1, 10 * kEpsilon * k * v_1.norm());
  report.Norm("point_2_velocity", at.p_dot_2, v_2, 10 * kEpsilon * k * v_2.norm());
  report.Number("distance_dot", at.gap_rate, expect.Number("distance_dot"), 10 * kEpsilon * k * speed);
  report.Norm("slip_velocity_1_minus_2", at.slip, expect.Vector3("slip_velocity_1_minus_2"), 10 * kEpsilon * speed);
  report.Norm("slip_velocity_dot", at.drift, expect.Vector3("slip_velocity_dot"),
              10 * kEpsilon * (acceleration + k * centripetal));
  report.Number("distance_ddot", at.gap_acceleration, expect.Number("distance_ddot"),
                50 * kEpsilon * k * (acceleration + centripetal + nu_dot.norm() * speed));

  const RealMatrix3 S_1 = expect.Matrix3("S_1"), S_2 = expect.Matrix3("S_2");
  // S answers to the normal's error by a factor of up to k.
  const double bend = 300 * kEpsilon + 10 * kEpsilon * k * k;
  report.Norm("S_1", WorldHessian(one, separation.nu), S_1, bend * S_1.norm());
  report.Norm("S_2", WorldHessian(two, -separation.nu), S_2, bend * S_2.norm());
  const PairTangent tangent(Pose(one.surface, one.frame), Pose(two.surface, two.frame), separation.nu, at.gap);
  const Real condition = expect.Number("tangent_condition");  // follows S
  report.Number("tangent_condition", tangent.curvature.maxCoeff() / tangent.curvature.minCoeff(), condition,
                (1e-5 + bend) * condition);
  report.Number("tangent_positive_definite", tangent.curvature.minCoeff() > 0, expect.Bool("tangent_positive_definite"),
                0);
  expect.Finish();
  item.Finish();
}

}  // namespace ellipsoid_pair

bool IsEllipsoidPair(const Document& document) { return FirstCaseHas(document, "semi_axes_1", "normal_1_to_2"); }

void CheckEllipsoidPair(const Document& document, Report* report) {
  CheckCases(document, ellipsoid_pair::CheckCase, report);
}

}  // namespace rollgait::reference
