#include "core/gait/mesh_refinement.h"

#include <algorithm>
#include <cmath>

#include "core/contact/rolling_kinematics.h"
#include "core/trajectory/sampling.h"

namespace rollgait {
namespace {

constexpr int kSamples = 8;     // per interval
constexpr int kMostParts = 4;
// The next solution differs a little from this one: aim below the bound.
constexpr double kSafety = 0.35;
// The judge samples elsewhere than this: leave it a margin.
constexpr double kGoodEnough = 0.8;

struct ContactError {
  double slip = 0;       // m/s, largest over the interval
  double gap_drift = 0;  // m, by which the gap changes over it
};

ContactError Measure(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory, int phase,
                     int interval) {
  ContactError error;
  BodyDynamics::State state;
  for (int contact : trajectory.phases[phase].contacts) {
    const ContactSurface& surface = scene.contacts[contact];
    double least = kInfinity, most = -kInfinity;
    for (int i = 0; i <= kSamples; ++i) {
      const MotionSample sample = Sample(trajectory, phase, interval, static_cast<double>(i) / kSamples);
      dynamics.ComputeState(sample.position, sample.velocity, &state);
      const RollingContact rolling = ComputeRollingContact(surface, state);
      double slip = 0;
      for (int axis : surface.directions) slip = std::hypot(slip, rolling.slip[axis]);
      error.slip = std::max(error.slip, slip);
      least = std::min(least, rolling.gap);
      most = std::max(most, rolling.gap);
    }
    error.gap_drift = std::max(error.gap_drift, most - least);
  }
  return error;
}

// Order in h of the slip between the points of a step: that of the velocity polynomial.
double SlipOrder(Scheme scheme) { return scheme == Scheme::kRadau2 ? 2 : 3; }

int Parts(double excess, double order) {
  if (excess <= kGoodEnough) return 1;
  return std::clamp(static_cast<int>(std::ceil(std::pow(excess / kSafety, 1 / order))), 2, kMostParts);
}

}  // namespace

Mesh Halved(const Mesh& mesh) {
  Mesh finer = mesh;
  for (auto& phase : finer.fractions) {
    std::vector<double> halves;
    for (double length : phase) halves.insert(halves.end(), 2, length / 2);
    phase = std::move(halves);
  }
  return finer;
}

Mesh RefineMesh(const Mesh& mesh, const GaitSpec& spec, const Trajectory& trajectory, bool stalled) {
  const BodyDynamics dynamics(spec.scene.model);
  const double order = SlipOrder(spec.scheme);
  Mesh finer;
  for (size_t p = 0; p < mesh.fractions.size(); ++p) {
    const double share = spec.bounds[Criterion::kGap] / static_cast<double>(mesh.fractions[p].size());
    std::vector<int> parts;
    for (size_t k = 0; k < mesh.fractions[p].size(); ++k) {
      const ContactError error =
          Measure(spec.scene, dynamics, trajectory, static_cast<int>(p), static_cast<int>(k));
      parts.push_back(std::max(Parts(error.slip / spec.bounds[Criterion::kSlip], order), Parts(error.gap_drift / share, order + 1)));
    }
    const bool missed = *std::max_element(parts.begin(), parts.end()) > 1;
    std::vector<double> fractions;
    for (size_t k = 0; k < parts.size(); ++k) {
      const int count = stalled && missed ? std::max(parts[k], 2) : parts[k];
      for (int i = 0; i < count; ++i) fractions.push_back(mesh.fractions[p][k] / count);
    }
    finer.fractions.push_back(std::move(fractions));
  }
  return finer;
}

}  // namespace rollgait
