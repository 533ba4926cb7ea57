// Drift over 1e4 revolutions: energy, gap, slip and quaternion norm against time, for a ball with spin on a slope-free
// plane, a triaxial ellipsoid and an oblate one, without and with drift control. Prints one line per decade of revolutions.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

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
  scene.options.output_step = scene.options.duration / 1000;
  scene.options.tolerance = tolerance;
  scene.options.drift = drift;
  scene.options.max_steps = 1'000'000'000;
  double energy = 0, gap = 0, slip = 0, next = revolutions / 1000, initial = 0;
  SimulationObserver observer;
  observer.sample = [&](const SimulationSample& sample) {
    const double now = sample.kinetic_energy + sample.potential_energy - sample.work;
    if (sample.time == 0) initial = now;
    energy = std::max(energy, std::abs(now / initial - 1));
    gap = std::max(gap, std::abs(sample.contacts[0].gap));
    slip = std::max(slip, sample.contacts[0].slip.norm());
    const double turned = sample.time * rate / (2 * M_PI);
    if (turned >= 0.999999 * next) {
      std::printf("%-10s %-10s %8.0e %10.0f %12.2e %12.2e %12.2e\n", name,
                  drift == DriftControl::kNone ? "none" : "projection", tolerance, turned, energy, gap, slip);
      next *= 10;
    }
    return true;
  };
  const auto start = std::chrono::steady_clock::now();
  const Result<SimulationReport> report = Simulate(scene, observer);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!report.ok() || report.value().end != SimulationEnd::kDuration) {
    std::printf("%s ended early\n", name);
    std::exit(1);
  }
  std::printf("%-10s %.1f s, %d steps, %d rejected, %.2f us an evaluation\n", name, seconds, report.value().steps,
              report.value().rejected_steps, 1e6 * seconds / report.value().evaluations);
}

}  // namespace
}  // namespace rollgait

// long_rolling [REVOLUTIONS]
int main(int argc, char** argv) {
  using namespace rollgait;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const double revolutions = argc > 1 ? std::atof(argv[1]) : 1e4;
  std::printf("%-10s %-10s %8s %10s %12s %12s %12s\n", "body", "drift", "tol", "turns", "energy (rel)", "gap m", "slip m/s");
  for (const double tolerance : {1e-9, 1e-12}) {
    for (const DriftControl drift : {DriftControl::kNone, DriftControl::kProjection}) {
      Run("ball", Body(Vector3(0.1, 0.1, 0.1), Vector3(3, 5, 20)), drift, tolerance, revolutions);
      Run("triaxial", Body(Vector3(0.12, 0.1, 0.08), Vector3(3, 5, 8)), drift, tolerance, revolutions);
      Run("oblate", Body(Vector3(0.1, 0.1, 0.03), Vector3(1, 2, 12)), drift, tolerance, revolutions);
    }
  }
  return 0;
}
