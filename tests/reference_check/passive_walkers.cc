// Periodic gaits of planar passive walkers: fixed point, heel strike, step map and trajectory.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>

#include "core/simulation/periodic_gait.h"
#include "tests/reference_check/families.h"
#include "tests/support/passive_walker.h"

namespace rollgait::reference {
namespace passive_walkers {

constexpr double kFixedPoint = 2e-11, kEigenvalue = 1e-8;
// The limit of massless feet: what feet of m and 2 m give, extrapolated to 0. Feet of this many hip masses change the
// gait by about as much, their square is below rounding.
constexpr double kLightFoot = 1e-8;

// "(0.34 - 0.18j)" or "4.0".
std::complex<double> ParseComplex(const std::string& text, const std::string& where) {
  std::string digits;
  for (const char c : text) {
    if (c != '(' && c != ')' && c != ' ') digits += c;
  }
  if (digits.empty() || digits.back() != 'j') return static_cast<double>(ParseReal(digits, where));
  digits.pop_back();
  size_t sign = digits.size();
  for (size_t i = 1; i < digits.size(); ++i) {
    if ((digits[i] == '+' || digits[i] == '-') && digits[i - 1] != 'e') sign = i;
  }
  if (sign == digits.size()) throw ReadError(where + " is not a complex number: " + text);
  const std::string imaginary = digits[sign] == '+' ? digits.substr(sign + 1) : digits.substr(sign);
  return {static_cast<double>(ParseReal(digits.substr(0, sign), where)),
          static_cast<double>(ParseReal(imaginary, where))};
}

PassiveWalker ReadWalker(Fields parameters, bool* massless) {
  PassiveWalker walker;
  walker.hip_mass = parameters.Double("hip_mass");
  walker.leg_mass = parameters.Double("leg_mass");
  walker.leg_inertia = parameters.Double("leg_inertia_about_leg_com");
  walker.hip_to_com = parameters.Double("hip_to_leg_com");
  walker.hip_to_foot = parameters.Double("hip_to_foot_ellipse_center");
  walker.foot_fore_aft = parameters.Double("foot_semi_axis_fore_aft");
  walker.foot_along_leg = parameters.Double("foot_semi_axis_along_leg");
  walker.foot_offset = parameters.Double("foot_center_forward_offset");
  walker.gravity = parameters.Double("gravity");
  walker.slope = parameters.Double("slope_rad");
  *massless = parameters.Bool("massless_feet_limit");
  parameters.Finish();
  return walker;
}

// Everything that a file states about a gait, computed.
struct Observed {
  // Fixed point and state before the heel strike (φ stance, φ̇ stance, φ swing, φ̇ swing each), period, step length,
  // impulse x, z, lift velocity, energy loss, least normal force.
  VectorX numbers;
  Eigen::Matrix3d jacobian;  // of the step map in (φ stance, φ̇ stance, φ̇ swing)
  MatrixX samples;           // without the row at the heel strike
};

// The step map's derivative in the coordinates (φ stance, φ̇ stance, φ̇ swing) of the section.
Eigen::Matrix3d JacobianOfAngles(const SimulationScene& scene, const PeriodicGait& gait) {
  GaitSection section(scene, gait.q);
  const VectorX y = section.Coordinates(gait.q, gait.v);
  Eigen::Matrix3d to_angles;
  const double h = 1e-4;
  for (int j = 0; j < 3; ++j) {
    Eigen::Vector3d slope = Eigen::Vector3d::Zero();
    for (const auto& [shift, weight] : {std::pair(1, 45.0), {-1, -45.0}, {2, -9.0}, {-2, 9.0}, {3, 1.0}, {-3, -1.0}}) {
      VectorX q, v;
      section.State(y + shift * h * VectorX::Unit(3, j), &q, &v);
      slope += weight / (60 * h) * Eigen::Vector3d(q[2], v[2], v[3]);
    }
    to_angles.col(j) = slope;
  }
  return to_angles * gait.jacobian * to_angles.inverse();
}

// Rows t, φ stance, φ̇ stance, φ swing, φ̇ swing, x hip, y hip, x contact, Fx, Fy at equal parts of the step.
MatrixX SampleStep(const SimulationScene& scene, const PeriodicGait& gait, double x_hip, Eigen::Index rows) {
  SimulationScene step = scene;
  step.q = gait.q, step.v = gait.v;
  step.adjusted_joints.clear();
  step.q[0] = x_hip;
  step.options.stop_after_impacts = 1;
  step.options.output_step = gait.period / static_cast<double>(rows);
  MatrixX samples(rows, 10);
  Eigen::Index row = 0;
  SimulationObserver observer;
  observer.sample = [&](const SimulationSample& s) {
    if (row == rows) return true;
    const ContactSample& foot = s.contacts[0];
    samples.row(row++) << s.time, s.q[2], s.v[2], s.q[3], s.v[3], s.q[0], s.q[1], foot.point.x(), foot.force.x(),
        foot.force.z();
    return true;
  };
  const Result<SimulationReport> result = Simulate(step, observer);
  if (!result.ok()) throw ReadError("the periodic step cannot be simulated: " + result.violations()[0].message);
  if (row != rows) throw ReadError("the periodic step ended early");
  return samples;
}

Observed Observe(const PassiveWalker& walker, double x_hip, Eigen::Index rows) {
  const SimulationScene scene = SceneOf(walker);
  const Violations wrong = CheckScene(scene);
  if (!wrong.empty()) throw ReadError(wrong[0].field + " " + wrong[0].message);
  const Result<PeriodicGait> found = FindPeriodicGait(scene, {});
  if (!found.ok()) throw ReadError(found.violations()[0].message);
  const PeriodicGait& gait = found.value();
  const SimulationEvent& strike = gait.heel_strike;
  const Vector3& impulse = strike.impulses[1];
  const double lift = strike.released_gap_rates.empty() ? std::nan("") : strike.released_gap_rates[0];
  Observed observed;
  observed.numbers.resize(15);
  observed.numbers << gait.q[2], gait.v[2], gait.q[3], gait.v[3], strike.q[2], strike.velocity_before[2], strike.q[3],
      strike.velocity_before[3], gait.period, gait.step_length, impulse.x(), impulse.z(), lift, strike.energy_loss,
      gait.report.min_normal_force;
  observed.jacobian = JacobianOfAngles(scene, gait);
  observed.samples = SampleStep(scene, gait, x_hip, rows);
  return observed;
}

// In the limit of massless feet, with the masses at the feet.
Observed ObserveMassless(PassiveWalker walker, double x_hip, Eigen::Index rows) {
  walker.hip_to_com = walker.hip_to_foot;
  walker.leg_inertia = 0;
  walker.leg_mass = kLightFoot * walker.hip_mass;
  Observed light = Observe(walker, x_hip, rows);
  walker.leg_mass *= 2;
  const Observed heavy = Observe(walker, x_hip, rows);
  light.numbers = 2 * light.numbers - heavy.numbers;
  light.jacobian = (2 * light.jacobian - heavy.jacobian).eval();
  light.samples = 2 * light.samples - heavy.samples;
  return light;
}

void CheckState(const std::string& prefix, Fields state, const VectorX& numbers, double rate, CaseReport* report) {
  report->Number(prefix + ".phi_stance", numbers[0], state.Number("phi_stance"), kFixedPoint);
  report->Number(prefix + ".phi_stance_dot", numbers[1], state.Number("phi_stance_dot"), kFixedPoint * rate);
  report->Number(prefix + ".phi_swing", numbers[2], state.Number("phi_swing"), kFixedPoint);
  report->Number(prefix + ".phi_swing_dot", numbers[3], state.Number("phi_swing_dot"), kFixedPoint * rate);
  state.Finish();
}

void CheckEigenvalues(Fields* item, const Eigen::Matrix3d& jacobian, CaseReport* report) {
  const Eigen::Vector3cd computed = Eigen::EigenSolver<Eigen::Matrix3d>(jacobian, false).eigenvalues();
  double largest = 0;
  const Json& list = item->Get("eigenvalues");
  if (list.size() != 3) throw ReadError(item->where() + ".eigenvalues must have 3 entries");
  for (const Json& value : list) {
    if (!value.is_string()) throw ReadError(item->where() + ".eigenvalues must be strings");
    const std::complex<double> expected = ParseComplex(value.get<std::string>(), item->where() + ".eigenvalues");
    const double nearest = (computed.array() - expected).abs().minCoeff();
    report->Number("eigenvalues", nearest, 0, kEigenvalue * (1 + std::abs(expected)));
    largest = std::max(largest, std::abs(expected));
  }
  report->Number("stable", largest < 1 ? 1 : 0, item->Bool("stable") ? 1 : 0, 0);
}

void CheckSamples(const RealMatrixX& expected, const MatrixX& computed, double rate, double length, double weight,
                  CaseReport* report) {
  const double position = 10 * kFixedPoint * length, force = 1e-8 * weight;
  const struct {
    const char* field;
    double tolerance;
  } columns[] = {{"t", 10 * kFixedPoint / rate},
                 {"phi_stance", kFixedPoint},
                 {"phi_stance_dot", kFixedPoint * rate},
                 {"phi_swing", kFixedPoint},
                 {"phi_swing_dot", kFixedPoint * rate},
                 {"x_hip", position},
                 {"y_hip", position},
                 {"x_contact", position},
                 {"Fx", force},
                 {"Fy", force}};
  for (Eigen::Index row = 0; row < computed.rows(); ++row) {
    for (int c = 0; c < 10; ++c) {
      report->Number(std::string("samples.") + columns[c].field, computed(row, c), expected(row, c),
                     columns[c].tolerance);
    }
  }
}

void CheckCase(Fields item, Report* all) {
  CaseReport report(all, "passive_walkers", item.Text("name"));
  bool massless = false;
  PassiveWalker walker = ReadWalker(item.Object("parameters"), &massless);
  {
    // A start beside the fixed point, so that the search has to find it.
    Fields fixed = item.Object("fixed_point_after_heelstrike");
    walker.stance = fixed.Double("phi_stance") * (1 + 1e-4);
    walker.stance_rate = fixed.Double("phi_stance_dot") * (1 - 1e-4);
    walker.swing = fixed.Double("phi_swing");
    walker.swing_rate = fixed.Double("phi_swing_dot");
  }
  const std::vector<std::string> columns = {"t",     "phi_stance", "phi_stance_dot", "phi_swing", "phi_swing_dot",
                                            "x_hip", "y_hip",      "x_contact",      "Fx",        "Fy"};
  if (item.Get("samples_columns") != Json(columns)) throw ReadError(item.where() + ".samples_columns are not known");
  const RealMatrixX samples = item.Matrix("samples");
  if (samples.cols() != 10 || samples.rows() < 3) throw ReadError(item.where() + ".samples must have 10 columns");
  // The last row is at the heel strike itself.
  const double x_hip = static_cast<double>(samples(0, 5));
  const Observed observed =
      massless ? ObserveMassless(walker, x_hip, samples.rows() - 1) : Observe(walker, x_hip, samples.rows() - 1);
  const VectorX& numbers = observed.numbers;
  const double length = walker.hip_to_foot, rate = std::max(1.0, std::abs(walker.stance_rate)), speed = rate * length;
  const double mass = walker.hip_mass + (massless ? 0 : 2 * walker.leg_mass), weight = mass * walker.gravity;

  CheckState("fixed_point", item.Object("fixed_point_after_heelstrike"), numbers.head(4), rate, &report);
  CheckState("before_heelstrike", item.Object("state_before_heelstrike"), numbers.segment(4, 4), rate, &report);
  report.Number("step_period", numbers[8], item.Number("step_period"), 10 * kFixedPoint * numbers[8]);
  report.Number("step_length", numbers[9], item.Number("step_length"), kFixedPoint * length);
  const RealVectorX impulse = item.Vector("heelstrike_impulse_xy"),
                    energies = item.Vector("kinetic_energy_before_after");
  if (impulse.size() != 2 || energies.size() != 2)
    throw ReadError(item.where() + ": impulse and energies have 2 entries");
  report.Norm("heelstrike_impulse_xy", numbers.segment(10, 2), impulse, 10 * kFixedPoint * mass * speed);
  report.Number("old_foot_lift_velocity_after_impact", numbers[12], item.Number("old_foot_lift_velocity_after_impact"),
                kFixedPoint * speed);
  report.Number("kinetic_energy_loss", numbers[13], energies[0] - energies[1], kFixedPoint * mass * speed * speed);
  report.Number("min_normal_force", numbers[14], item.Number("min_normal_force"), 0.01 * weight);
  report.Norm("return_map_jacobian", observed.jacobian, item.Matrix("return_map_jacobian_phi_phidot_phiswingdot"),
              kEigenvalue * (1 + observed.jacobian.norm()));
  CheckEigenvalues(&item, observed.jacobian, &report);
  CheckSamples(samples, observed.samples, rate, length, weight, &report);
  item.Finish();
}

}  // namespace passive_walkers

bool IsPassiveWalkers(const Document& document) {
  if (!document.json.is_object() || !document.json.contains("cases")) return false;
  const Json& cases = document.json["cases"];
  return cases.is_array() && !cases.empty() && cases[0].is_object() &&
         cases[0].contains("fixed_point_after_heelstrike");
}

void CheckPassiveWalkers(const Document& document, Report* report) {
  Fields root(document.json, "file");
  root.Skip("description");
  for (Fields& item : root.List("cases")) passive_walkers::CheckCase(item, report);
  root.Finish();
}

}  // namespace rollgait::reference
