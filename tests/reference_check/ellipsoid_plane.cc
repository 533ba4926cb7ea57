// Pointwise kinematics of an ellipsoid over a fixed or moving plane, and the rolling of the same body on the fixed
// plane.
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

#include "core/contact/pair_kinematics.h"
#include "tests/reference_check/families.h"

namespace rollgait::reference {
namespace ellipsoid_plane {

constexpr double kGravity = 9.81;  // m/s², along −n

struct Input {
  Vector3 axes;
  double mass;
  PlacedSurface surface;
  FrameMotion body, ground;
  PlacedPlane plane;
  RealMatrix3 R;  // what body.R_WB and plane.n_B are rounded from
  RealVector3 n;
};

Input ReadInput(Fields* item) {
  const auto vector = [&](const char* name) { return Vector3(item->Vector3(name).cast<double>()); };
  Input input;
  input.axes = vector("semi_axes");
  if (!(input.axes.minCoeff() > 0)) throw ReadError(item->where() + ".semi_axes must be > 0");
  input.mass = item->Double("mass");
  input.surface.surface = Ellipsoid(input.axes);
  input.R = item->Rotation("quat_wxyz");
  input.n = item->Vector3("plane_normal").normalized();
  input.body = {input.R.cast<double>(), vector("center"), vector("omega"),
                vector("v_center"),     vector("alpha"),  vector("a_center")};
  // The plane's frame stands at its point with world axes.
  input.plane.n_B = input.n.cast<double>();
  input.ground = {Matrix3::Identity(), vector("plane_point"), vector("plane_omega"),
                  vector("plane_v"),   vector("plane_alpha"), vector("plane_a")};
  return input;
}

Matrix3 Skew(const Vector3& u) {
  Matrix3 matrix;
  matrix << 0, -u.z(), u.y(), u.z(), 0, -u.x(), -u.y(), u.x(), 0;
  return matrix;
}

// The body alone on the fixed plane, homogeneous, v = −ω × r: moments about the contact point in body axes,
// (I + m (r² − r rᵀ)) ω̇ = −ω × I ω + r × m (g n − b), b = ω × ṙ. World axes are turned into the body's first, with the
// digits of long double: a needle's spin answers to the last digit of ν across it.
void CheckRolling(const Input& input, Fields expect, CaseReport* report) {
  const double m = input.mass, k = input.axes.maxCoeff() / input.axes.minCoeff();
  const RealMatrix3& R = input.R;
  const RealVector3 n_b = R.transpose() * input.n, omega_b = R.transpose() * input.body.w_WB.cast<Real>();
  PlacedPlane plane;
  plane.n_B = n_b.cast<double>();
  FrameMotion body, ground;
  body.w_WB = omega_b.cast<double>();
  const Vector3 r = input.surface.surface.SupportPoint(-plane.n_B);
  body.v_WB = -body.w_WB.cross(r);
  const Vector3 b = ComputePlaneContact(input.surface, body, plane, ground).drift;

  const Vector3 squares = input.axes.cwiseAbs2();
  const Vector3 inertia =
      m / 5 * Vector3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y());
  Matrix3 about_point = m * Skew(r).transpose() * Skew(r);
  about_point.diagonal() += inertia;
  const Vector3 gravity = kGravity * plane.n_B;
  const Vector3 moment = m * r.cross(gravity - b) - body.w_WB.cross(Vector3(inertia.cwiseProduct(body.w_WB)));
  const Vector3 omega_dot = about_point.llt().solve(moment);
  const Vector3 a_center = -omega_dot.cross(r) - b;
  const Vector3 force = m * (a_center + gravity);

  const double rate = body.w_WB.squaredNorm() + kGravity / r.norm();
  const RealVector3 expected_force = expect.Vector3("contact_force");
  const auto world = [&](const Vector3& vector) -> RealVector3 { return R * vector.cast<Real>(); };
  report->Norm("rolling.v_center", world(body.v_WB), expect.Vector3("v_center"),
               4 * kEpsilon * (1 + k) * body.w_WB.norm() * r.norm());
  report->Norm("rolling.omega_dot", world(omega_dot), expect.Vector3("omega_dot"), 1e-15 * k * k * rate);
  report->Norm("rolling.a_center", world(a_center), expect.Vector3("a_center"), 1e-15 * k * k * rate * r.norm());
  report->Norm("rolling.contact_force", world(force), expected_force, 2e-12 * expected_force.norm());
  expect.Finish();
}

void CheckCase(Fields item, Report* all) {
  const Input input = ReadInput(&item);
  CaseReport report(all, "ellipsoid_plane", item.Text("family") + " " + item.Get("id").dump());
  Fields expect = item.Object("expect");
  const PairKinematics pair = ComputePlaneContact(input.surface, input.body, input.plane, input.ground);
  const FrameMotion& body = input.body;
  const FrameMotion& ground = input.ground;

  const Vector3 n = pair.normal, omega = body.w_WB, omega_2 = ground.w_WB;
  const Vector3 nu = -(body.R_WB.transpose() * n);
  // From the surface, not as p_1 − center: the subtraction would bring the rounding of the centre into r.
  const Vector3 r = body.R_WB * input.surface.surface.SupportPoint(nu);
  const Matrix3 S = body.R_WB * input.surface.surface.SupportHessian(nu) * body.R_WB.transpose();
  const Vector3 x_rel =
      body.R_WB * input.surface.surface.RollingVelocity(nu, body.R_WB.transpose() * (omega - omega_2));
  const Vector3 r_dot = omega.cross(r) + x_rel;
  const Vector3 lever = pair.p_1 - ground.p_WB;
  const Vector3 bias = omega.cross(r_dot) - omega_2.cross(pair.p_dot_1 - ground.v_WB);

  const RealVector3 r_expected = expect.Vector3("r"), x_rel_expected = expect.Vector3("x_rel_world");
  const RealMatrix3 S_expected = expect.Matrix3("S_world");
  const double k = input.axes.maxCoeff() / input.axes.minCoeff();
  // Near a principal axis the contact point moves by up to k |r| per radian, elsewhere by about |r|.
  const Real size = r_expected.norm();
  const Real turning = (omega.norm() + omega_2.norm()) * size, speed = x_rel_expected.norm() + turning;
  const Real velocity = body.v_WB.norm() + ground.v_WB.norm() + omega.norm() * size + omega_2.norm() * lever.norm();
  const Real centripetal = omega.norm() * speed + omega_2.norm() * (body.v_WB.norm() + ground.v_WB.norm() + speed);
  const Real acceleration = body.a_WB.norm() + body.alpha_WB.norm() * size + ground.a_WB.norm() +
                            ground.alpha_WB.norm() * lever.norm() + centripetal;
  const Real point = 4 * kEpsilon * k * size;

  report.Norm("r", r, r_expected, point);
  report.Norm("contact_point", pair.p_1, expect.Vector3("contact_point"), point + kEpsilon * body.p_WB.norm());
  report.Number("gap", pair.gap, expect.Number("gap"), 10 * kEpsilon * ((body.p_WB - ground.p_WB).norm() + size));
  report.Norm("S_world", S, S_expected, 300 * kEpsilon * S_expected.norm());
  report.Norm("x_rel_world", x_rel, x_rel_expected, 300 * kEpsilon * x_rel_expected.norm());
  report.Norm("r_dot", r_dot, expect.Vector3("r_dot"), 300 * kEpsilon * speed);
  report.Norm("contact_point_velocity", pair.p_dot_1, expect.Vector3("contact_point_velocity"),
              300 * kEpsilon * (speed + body.v_WB.norm()));
  report.Norm("slip_velocity", pair.slip, expect.Vector3("slip_velocity"), 200 * kEpsilon * velocity);
  report.Norm("bias", bias, expect.Vector3("bias"), 200 * kEpsilon * centripetal);
  report.Norm("slip_velocity_dot", pair.drift, expect.Vector3("slip_velocity_dot"), 200 * kEpsilon * acceleration);
  report.Number("gap_dot", pair.gap_rate, expect.Number("gap_dot"), 200 * kEpsilon * velocity);
  report.Number("gap_ddot", pair.gap_acceleration, expect.Number("gap_ddot"),
                200 * kEpsilon * (acceleration + omega_2.norm() * velocity));
  report.Norm("dr_dtheta_world", -Skew(r) - S * Skew(n), expect.Matrix3("dr_dtheta_world"),
              300 * kEpsilon * (size + S_expected.norm()));
  CheckRolling(input, expect.Object("rolling_dynamics_fixed_plane"), &report);
  item.Finish();
  expect.Finish();
}

}  // namespace ellipsoid_plane

bool IsEllipsoidPlane(const Document& document) { return FirstCaseHas(document, "plane_omega", "S_world"); }

void CheckEllipsoidPlane(const Document& document, Report* report) {
  CheckCases(document, ellipsoid_plane::CheckCase, report);
}

}  // namespace rollgait::reference
