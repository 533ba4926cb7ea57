// Drift of energy, gap and slip over 1e4 revolutions of a ball with spin, a triaxial ellipsoid and an oblate one on a
// level plane, without and with drift control: worst so far, ten points a decade, as CSV: plot,series,x,y
// (docs/plot_limits.py). At the end of each series its law of growth, value ~ revolutions^exponent over the last two
// decades, as a row of <plot>_exponent. Steps and times go to stderr.
//   long_rolling [REVOLUTIONS] > long.csv
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "core/simulation/simulation.h"
#include "tests/support/rolling_scenes.h"

namespace rollgait {
namespace {

Matrix3 HomogeneousInertia(double mass, const Vector3& a) {
  return (mass / 5 *
          Vector3(a.y() * a.y() + a.z() * a.z(), a.x() * a.x() + a.z() * a.z(), a.x() * a.x() + a.y() * a.y()))
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

// The worst so far of one quantity, at times that are even in the logarithm.
class Growth {
 public:
  explicit Growth(const char* plot) : plot_(plot) {}

  void Add(double value) { worst_ = std::max(worst_, value); }
  void Print(const char* series, double x) {
    const double y = std::max(worst_, 1e-18);
    std::printf("%s,%s,%.4g,%.3g\n", plot_, series, x, y);
    log_x_.push_back(std::log10(x));
    log_y_.push_back(std::log10(y));
  }
  // Slope of the line of least squares through the logarithms.
  void PrintExponent(const char* series) const {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (size_t i = 0; i < log_x_.size(); ++i) {
      if (log_x_[i] < log_x_.back() - 2.01) continue;
      n += 1, x += log_x_[i], y += log_y_[i], xx += log_x_[i] * log_x_[i], xy += log_x_[i] * log_y_[i];
    }
    std::printf("%s_exponent,%s,%.4g,%.3f\n", plot_, series, std::pow(10, log_x_.back()),
                (n * xy - x * y) / (n * xx - x * x));
  }

 private:
  const char* plot_;
  double worst_ = 0;
  std::vector<double> log_x_, log_y_;
};

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
  Growth energy("long_energy"), gap("long_gap"), slip("long_slip");
  double next = 1, initial = 0;
  SimulationObserver observer;
  observer.sample = [&](const SimulationSample& sample) {
    const double now = sample.kinetic_energy + sample.potential_energy - sample.work;
    if (sample.time == 0) initial = now;
    energy.Add(std::abs(now / initial - 1));
    gap.Add(std::abs(sample.contacts[0].gap));
    slip.Add(sample.contacts[0].slip.norm());
    const double turned = sample.time * rate / (2 * M_PI);
    if (turned >= 0.999999 * next) {
      for (Growth* growth : {&energy, &gap, &slip}) growth->Print(series, turned);
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
  for (const Growth* growth : {&energy, &gap, &slip}) growth->PrintExponent(series);
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
