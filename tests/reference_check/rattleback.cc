// The stone of Kane and Levinson (1982): trajectories, and the times at which its spin changes sign.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "core/math/integrator.h"
#include "core/simulation/scene_dynamics.h"
#include "tests/reference_check/trajectory.h"

namespace rollgait::reference {
namespace rattleback {

constexpr char kColumns[] = "t,qw,qx,qy,qz,wbx,wby,wbz,px,py,gx,gy,gz,vgx,vgy,vgz,Fx,Fy,Fz,Ekin,Epot,E";
constexpr double kSearchStep = 0.001;  // s

double SpinUp(const VectorX& q, const VectorX& v) {
  return (Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized() * Vector3(v.head<3>())).z();
}
double SpinOfBody(const VectorX&, const VectorX& v) { return v[2]; }

struct Zero {
  double time, slope;
};

// Zeros of a function of the state along the motion.
std::vector<Zero> Zeros(const SimulationScene& scene, double (*spin)(const VectorX&, const VectorX&)) {
  SimulationScene fine = scene;
  fine.options.output_step = kSearchStep;
  SceneDynamics dynamics(scene);
  const Dop853::RightSide right = [&](double t, const VectorX& x, VectorX* dx) { dynamics.RightSide(t, x, dx); };
  Dop853 integrator;
  std::vector<Zero> zeros;
  SimulationSample before;
  SimulationObserver observer;
  observer.sample = [&](const SimulationSample& sample) {
    if (before.q.size() > 0 && spin(before.q, before.v) * spin(sample.q, sample.v) < 0) {
      const auto at = [&](double h) {
        VectorX x = dynamics.MakeState(before.q, before.v, 0), next = x;
        if (h > 0) integrator.Step(right, before.time, x, h, 1, &next);
        return spin(dynamics.Positions(next), dynamics.Velocities(next));
      };
      double low = 0, high = sample.time - before.time, at_low = at(low), at_high = at(high), slope = 0;
      for (int i = 0; i < 20; ++i) {
        slope = (at_high - at_low) / (high - low);
        const double h = std::clamp(high - at_high / slope, 0.0, sample.time - before.time);
        if (std::abs(h - high) < 1e-15) break;
        low = high, at_low = at_high;
        high = h, at_high = at(h);
        if (at_high == 0) break;
      }
      zeros.push_back({before.time + high, slope});
    }
    before = sample;
    return true;
  };
  const Result<SimulationReport> report = Simulate(fine, observer);
  if (!report.ok()) throw ReadError("the scene cannot be simulated: " + report.violations()[0].message);
  return zeros;
}

// The file lists changes of sign between its rows: of two zeros between two rows it has none.
std::vector<Zero> SeenBetweenRows(const std::vector<Zero>& zeros, double step) {
  std::vector<Zero> seen;
  for (size_t i = 0; i < zeros.size();) {
    const double row = std::floor(zeros[i].time / step);
    size_t end = i;
    while (end < zeros.size() && std::floor(zeros[end].time / step) == row) ++end;
    if ((end - i) % 2 == 1) seen.push_back(zeros[i]);
    i = end;
  }
  return seen;
}

void CheckEvents(const RollingCase& rolling, const std::vector<double>& growth, Fields events, CaseReport* report) {
  const struct {
    const char* field;
    double (*spin)(const VectorX&, const VectorX&);
  } kinds[] = {{"omega_up_zero", SpinUp}, {"omega_body3_zero", SpinOfBody}};
  for (const auto& kind : kinds) {
    if (!events.Has(kind.field)) continue;
    const RealVectorX expected = events.Vector(kind.field);
    const std::vector<Zero> zeros = SeenBetweenRows(Zeros(rolling.scene, kind.spin), rolling.step);
    report->Number(std::string(kind.field) + ".count", static_cast<Real>(zeros.size()),
                   static_cast<Real>(expected.size()), 0);
    for (Eigen::Index i = 0; i < expected.size() && i < static_cast<Eigen::Index>(zeros.size()); ++i) {
      const Zero& zero = zeros[static_cast<size_t>(i)];
      const double g = GrowthAt(growth, zero.time, rolling.scene.options.duration);
      // The spin's error over its slope; spins are of 10 rad/s here.
      report->Number(kind.field, zero.time, expected[i],
                     10 * kTrajectoryTolerance * g * 10 / std::abs(zero.slope) + 4 * kEpsilon * zero.time);
    }
  }
  events.Finish();
}

void CheckCase(Fields item, const std::string& directory, Report* all) {
  Fields parameters = item.Object("parameters");
  const RollingCase rolling =
      ReadRollingCase(&item, GroundMotion{}, parameters.Vector3("contact_point_initial").cast<double>(), &parameters);
  parameters.Finish();
  CaseReport report(all, "rattleback", rolling.name);
  std::vector<double> growth;
  for (const Real value : item.Vector("sensitivity_amplification_at_quarters"))
    growth.push_back(static_cast<double>(value));
  const RollingRun run = CheckTable(rolling, ReadTable(directory + item.Text("file"), kColumns), growth, &report);
  CheckEvents(rolling, growth, item.Object("events"), &report);
  const Real energy = item.Number("energy_initial");
  report.Number("energy_initial", run.report.energy_initial, energy, 100 * kEpsilon * std::abs(energy));
  report.Number("min_normal_force", run.min_normal_force, item.Number("min_normal_force"), 1e-6 * rolling.weight);
  report.Number("max_friction_ratio", run.max_friction_ratio, item.Number("max_friction_ratio"), 1e-6);
  double tilt = 0;
  for (const SimulationSample& sample : run.samples) {
    const Eigen::Quaterniond q(sample.q[0], sample.q[1], sample.q[2], sample.q[3]);
    tilt = std::max(tilt, std::acos(std::min(1.0, std::abs((q * Vector3::UnitZ()).z()))) * 180 / M_PI);
  }
  report.Number("max_tilt_deg_sampled", tilt, item.Number("max_tilt_deg_sampled"),
                10 * kTrajectoryTolerance * GrowthAt(growth, 1, 1) * 180 / M_PI);
  item.Skip("max_abs_energy_change");              // of the reference's own integration
  item.Skip("reference_error_bound_orientation");  // the same
  item.Finish();
}

}  // namespace rattleback

bool IsRattleback(const Document& document) {
  const Json item = TypicalCase(document);
  return item.is_object() && item.contains("events") && item.contains("max_tilt_deg_sampled");
}

void CheckRattleback(const Document& document, Report* report) {
  const Json cases = CasesOf(document);
  for (const Json& item : cases) rattleback::CheckCase(Fields(item, "case"), DirectoryOf(document.path), report);
}

}  // namespace rollgait::reference
