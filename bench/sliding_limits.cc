// What the blend of the direction of slip costs: a ball slides on a slope past zero slip, as close as 1 … 1e-8 m/s, and
// its velocity afterwards is compared with the equations of slip alone, in which nothing is blended. CSV:
// plot,series,x,y.
//   sliding_limits > sliding.csv
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/math/integrator.h"
#include "core/simulation/simulation.h"
#include "tests/support/sliding_ball.h"

namespace rollgait {
namespace {

constexpr double kFriction = 0.1, kAlong = 6.0, kAcross = 7.0;  // m/s² of gravity along x and into the plane

// Velocity of a homogeneous ball after `duration`, and the least slip on the way:
//   v̇ = g_t − μ g_n ŵ,  ẇ = g_t − 7/2 μ g_n ŵ.
struct Reference {
  Eigen::Vector2d velocity;
  double least_slip = kInfinity;
};

Reference Integrated(const Eigen::Vector2d& start, double duration) {
  Reference reference;
  const auto right_side = [](double, const VectorX& x, VectorX* derivative) {
    const Eigen::Vector2d friction = kFriction * kAcross * x.tail<2>().normalized();
    derivative->head<2>() = Eigen::Vector2d(kAlong, 0) - friction;
    derivative->tail<2>() = Eigen::Vector2d(kAlong, 0) - 3.5 * friction;
  };
  VectorX x(4);
  x << start, start;
  Dop853::Options options;
  options.tolerance = 1e-14;
  options.first_step = 1e-4;
  options.max_steps = 1'000'000;
  Dop853 integrator;
  const auto least = [&](double, const VectorX& at) {
    reference.least_slip = std::min(reference.least_slip, at.tail<2>().norm());
  };
  if (integrator.Integrate(right_side, 0, duration, options, &x, least) != IntegrationStatus::kReachedEnd) {
    std::fprintf(stderr, "the reference ended early\n");
    std::exit(1);
  }
  reference.velocity = x.head<2>();
  return reference;
}

}  // namespace
}  // namespace rollgait

int main() {
  using namespace rollgait;
  std::puts("plot,series,x,y");
  const double duration = 0.4;
  for (const double tolerance : {1e-9, 1e-12}) {
    for (double offset = 1; offset > 1e-13; offset /= 10) {
      const Eigen::Vector2d start(-1, offset);
      const Reference reference = Integrated(start, duration);
      SimulationScene scene =
          testing::Ball(kFriction, {kAlong, 0, -kAcross}, {start.x(), start.y(), 0}, Vector3::Zero());
      scene.options.tolerance = tolerance;
      scene.options.duration = scene.options.output_step = duration;
      const Result<SimulationReport> run = Simulate(scene, {});
      if (!run.ok() || run.value().end != SimulationEnd::kDuration) {
        std::fprintf(stderr, "the run at offset %g ended early\n", offset);
        return 1;
      }
      const VectorX& q = run.value().q;
      const Vector3 velocity = Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Vector3(run.value().v.tail<3>());
      std::printf("sliding,error of velocity %.0e,%.3g,%.3g\n", tolerance, reference.least_slip,
                  (velocity.head<2>() - reference.velocity).norm());
    }
  }
  return 0;
}
