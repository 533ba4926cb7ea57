// Drift of energy, gap and slip over 1e4 revolutions of a ball with spin, a triaxial ellipsoid and an oblate one on a
// level plane, without and with drift control: worst so far, ten points a decade, as CSV: plot,series,x,y
// (docs/plot_limits.py). Steps and times go to stderr.
//   long_rolling [REVOLUTIONS] > long.csv
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "core/simulation/simulation.h"
#include "tests/support/rolling_scenes.h"

namespace rollgait {
namespace {

Matrix3 HomogeneousInertia(double mass, const Vector3& a) {
  return (mass / 5 * Vector3(a.y() * a.y() + a.z() * a.z(), a.x() * a.x() + a.z() * a.z(), a.x() * a.x() + a.y() * a.y()))
      .asDiagonal();
}

BodyOnPlane Body(const Vector3& axes, const Vector3& omega) {
  BodyOnPlane body;
  body.surface = Ellipsoid(axes);
  body.inertia = HomogeneousInertia(1, axes);
  body.orientation = Eigen::Quaterniond(0.9, 0.2, 0.1, 0.3);
  body.omega_body = omega;
  return body;
}

void Run(const char* name, const BodyOnPlane& body, DriftControl drift, double tolerance, double revolutions) {
  SimulationScene scene = SceneOf(body);
  const double rate = body.omega_body.norm();
  scene.options.duration = revolutions * 2 * M_PI / rate;
  scene.options.tolerance = tolerance;
  scene.options.drift = drift;
  scene.options.max_steps = 1'000'000'000;
  scene.options.output_step = scene.options.duration / 100'000;
  char series[64];
  std::snprintf(series, sizeof series, "%s %.0e%s", name, tolerance, drift == DriftControl::kNone ? "" : " projected");
  double energy = 0, gap = 0, slip = 0, next = 1, initial = 0;
  SimulationObserver observer;
  observer.sample = [&](const SimulationSample& sample) {
    const double now = sample.kinetic_energy + sample.potential_energy - sample.work;
    if (sample.time == 0) initial = now;
    energy = std::max(energy, std::abs(now / initial - 1));
    gap = std::max(gap, std::abs(sample.contacts[0].gap));
    slip = std::max(slip, sample.contacts[0].slip.norm());
    const double turned = sample.time * rate / (2 * M_PI);
    if (turned >= 0.999999 * next) {
      for (const auto& [plot, value] : {std::pair("long_energy", energy), {"long_gap", gap}, {"long_slip", slip}}) {
        std::printf("%s,%s,%.4g,%.3g\n", plot, series, turned, std::max(value, 1e-18));
      }
      next *= std::pow(10, 0.1);
    }
    return true;
  };
  const auto start = std::chrono::steady_clock::now();
  const Result<SimulationReport> report = Simulate(scene, observer);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!report.ok() || report.value().end != SimulationEnd::kDuration) {
    std::fprintf(stderr, "%s ended early\n", series);
    std::exit(1);
  }
  std::fprintf(stderr, "%s: %.1f s, %d steps, %d rejected, %.2f us an evaluation\n", series, seconds,
               report.value().steps, report.value().rejected_steps, 1e6 * seconds / report.value().evaluations);
}

}  // namespace
}  // namespace rollgait

// long_rolling [REVOLUTIONS]
int main(int argc, char** argv) {
  using namespace rollgait;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const double revolutions = argc > 1 ? std::atof(argv[1]) : 1e4;
  std::puts("plot,series,x,y");
  for (const double tolerance : {1e-9, 1e-12}) {
    for (const DriftControl drift : {DriftControl::kNone, DriftControl::kProjection}) {
      Run("ball", Body(Vector3(0.1, 0.1, 0.1), Vector3(3, 5, 20)), drift, tolerance, revolutions);
      Run("triaxial", Body(Vector3(0.12, 0.1, 0.08), Vector3(3, 5, 8)), drift, tolerance, revolutions);
      Run("oblate", Body(Vector3(0.1, 0.1, 0.03), Vector3(1, 2, 12)), drift, tolerance, revolutions);
    }
  }
  return 0;
}
