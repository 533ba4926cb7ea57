// Balls that roll on a tilted plane, a turntable, an accelerated plane: closed forms.
#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "core/math/integrator.h"
#include "core/simulation/initial_state.h"
#include "tests/reference_check/families.h"
#include "tests/support/rolling_scenes.h"

namespace rollgait::reference {
namespace ball_analytic {

constexpr double kTolerance = 1e-12;  // of the integration
// Nothing grows: errors of the integration and of the data's rounding to double at the start add up linearly in time.
constexpr double kAllowed = 10 * kTolerance;

// Numbers that a case states and that follow from its input: compared with what they should be.
void CheckStated(Fields* item, const std::string& type, double kappa, const Vector3& gravity, double omega,
                 CaseReport* report) {
  if (type == "tilted_plane") {
    const Vector3 along(gravity.x(), gravity.y(), 0);
    report->Norm("acceleration", along / (1 + kappa), item->Vector3("acceleration"), 8 * kEpsilon * gravity.norm());
  } else if (type == "turntable") {
    report->Number("precession_rate", kappa / (1 + kappa) * omega, item->Number("precession_rate"),
                   8 * kEpsilon * std::abs(omega));
    item->Skip("drift_velocity");  // describe the path that the samples are on
    item->Skip("circle_center_t0");
    item->Skip("circle_radius");
  }
}

void CheckSamples(const SimulationScene& scene, std::vector<Fields> samples, double radius, CaseReport* report) {
  SceneDynamics dynamics(scene);
  Result<VectorX> start = InitialState(scene, &dynamics);
  if (!start.ok()) throw ReadError("the ball does not roll at the start: " + start.violations()[0].message);
  VectorX x = start.value();
  double t = 0;
  for (Fields& sample : samples) {
    const double time = sample.Double("t");
    SimulationScene part = scene;
    if (time > t) {
      Dop853 integrator;
      integrator.SetQuadratures(SceneDynamics::kQuadratures);
      Dop853::Options options;
      options.tolerance = kTolerance;
      options.max_steps = 1'000'000;
      const IntegrationStatus status = integrator.Integrate(
          [&](double at, const VectorX& y, VectorX* dy) { dynamics.RightSide(at, y, dy); }, t, time, options, &x);
      if (status != IntegrationStatus::kReachedEnd) throw ReadError(sample.where() + ": the integration failed");
      t = time;
    }
    VectorX derivative(x.size());
    dynamics.RightSide(t, x, &derivative);
    const VectorX q = dynamics.Positions(x), v = dynamics.Velocities(x);
    const Eigen::Quaterniond rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
    const RealVector3 omega = sample.Vector3("omega_world"), speed = sample.Vector3("v"),
                      center = sample.Vector3("center"), force = sample.Vector3("force_on_ball");
    const double m = scene.model.total_mass();
    const Real rate = omega.norm() + speed.norm() / radius + std::sqrt(scene.gravity.norm() / radius);
    const Real unit = kAllowed * (1 + t) * (1 + rate * t);
    report->Norm("center", q.tail<3>(), center, unit * (center.norm() + radius));
    if (sample.Has("contact")) {
      report->Norm("contact", dynamics.contacts().Kinematics(0).p_1, sample.Vector3("contact"),
                   unit * (center.norm() + radius));
    }
    report->Norm("v", rotation * Vector3(v.tail<3>()), speed, unit * (speed.norm() + rate * radius));
    report->Norm("omega_world", rotation * Vector3(v.head<3>()), omega, unit * rate);
    if (sample.Has("plane_v")) {
      report->Norm("plane_v", MotionAt(scene.ground[1], t).v_WB, sample.Vector3("plane_v"), 8 * kEpsilon * (1 + t));
    }
    report->Norm("force_on_ball", dynamics.contacts().Force(0), force,
                 unit * (force.norm() + m * scene.gravity.norm()));
    sample.Finish();
  }
}

void CheckCase(Fields item, Report* all) {
  const std::string type = item.Text("type");
  const double kappa = item.Double("kappa"), radius = item.Double("radius"), mass = item.Double("mass");
  if (!(radius > 0 && mass > 0 && kappa > 0)) throw ReadError(item.where() + ": radius, mass and kappa must be > 0");
  CaseReport report(all, "ball_analytic", item.Text("name"));
  BodyOnPlane ball;
  ball.surface = Sphere(radius);
  ball.mass = mass;
  ball.inertia = kappa * mass * radius * radius * Matrix3::Identity();
  ball.gravity = item.Vector3("gravity_world").cast<double>();
  Vector3 v = Vector3::Zero();
  double spin = 0;
  if (type == "turntable") {
    ball.ground.rate = item.Double("plane_omega_z");
    ball.contact_point = item.Vector3("p0").cast<double>();
  } else if (type == "translating_plane") {
    ball.ground.acceleration = item.Vector3("plane_acceleration").cast<double>();
  } else if (type != "tilted_plane") {
    throw ReadError(item.where() + ".type \"" + type + "\" is not known");
  }
  if (type != "translating_plane") v = item.Vector3("v0").cast<double>(), spin = item.Double("spin_z");
  // v + ω × (−radius z) is the plane's velocity at the contact point.
  const Vector3 relative = v - ball.ground.rate * Vector3::UnitZ().cross(ball.contact_point);
  ball.omega_body = Vector3(-relative.y() / radius, relative.x() / radius, spin);
  ball.contact_point.z() = 0;
  SimulationScene scene = SceneOf(ball);
  const Violations wrong = CheckScene(scene);
  if (!wrong.empty()) throw ReadError(item.where() + ": " + wrong[0].field + " " + wrong[0].message);
  CheckStated(&item, type, kappa, ball.gravity, ball.ground.rate, &report);
  CheckSamples(scene, item.List("samples"), radius, &report);
  item.Finish();
}

}  // namespace ball_analytic

bool IsBallAnalytic(const Document& document) {
  if (!document.json.is_object() || !document.json.contains("cases")) return false;
  const Json& cases = document.json["cases"];
  return cases.is_array() && !cases.empty() && cases[0].is_object() && cases[0].contains("kappa");
}

void CheckBallAnalytic(const Document& document, Report* report) {
  Fields root(document.json, "file");
  root.Skip("description");
  for (Fields& item : root.List("cases")) ball_analytic::CheckCase(item, report);
  root.Finish();
}

}  // namespace rollgait::reference
