#include "core/gait/mesh_refinement.h"

#include <algorithm>
#include <cmath>

#include "core/contact/rolling_kinematics.h"
#include "core/ocp/problem.h"
#include "core/trajectory/sampling.h"

namespace rollgait {
namespace {

// An interval that asks for more parts is not near the limit in which the orders hold. bench/success_rate, six requests
// of human29: 488 iterations in all with 4 (and a mesh more to solve), 445 with 8, 474 with 12 (and intervals that
// nobody needs).
constexpr int kMostParts = 8;
// Of an interval that has no measures, since it could not be integrated.
constexpr int kPartsOfUnknown = 4;
// The next solution differs a little from this one: aim below the bound.
constexpr double kSafety = 0.5;
// Intervals that are within this share of every bound stay as they are.
constexpr double kGoodEnough = 0.8;

// Order in h of a measure of one interval, for the scheme of two points and for those of three and more. Source: orders
// of the polynomials (slip: that of the velocity; forces: that of the efforts) and of the end of a step, each less one
// where a joint may meet its limit or a force its bound inside of the interval, since the higher order is lost there.
// 0: a finer mesh is not what it takes.
struct MeasureOrder {
  Criterion criterion;
  double two_points, more;
};
constexpr MeasureOrder kOrders[] = {
    {Criterion::kSlip, 2, 3},           {Criterion::kPenetration, 2, 3},    {Criterion::kOverlap, 2, 3},
    {Criterion::kPositionDefect, 3, 4}, {Criterion::kVelocityDefect, 2, 3}, {Criterion::kPull, 2, 2},
    {Criterion::kFriction, 2, 2},       {Criterion::kEnergy, 3, 4},
};

// How often a measure is what it may be. Bodies are kept further apart at the points than they must be, and only what
// they come closer between the points falls with the length of the interval.
double ExcessOf(Criterion criterion, double measure, double bound) {
  if (criterion != Criterion::kOverlap || measure <= bound) return measure / bound;
  constexpr double kClearance = OptimalControlProblem::kPairClearance;
  return (kClearance + measure) / (kClearance + bound);
}

// Largest change of the gap of an active contact over an interval, m. The gap is the sum of these, so each may have its
// share of the bound.
double GapDrift(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory, int phase,
                int interval) {
  constexpr int kGapSamples = 8;
  double drift = 0;
  BodyDynamics::State state;
  for (int contact : trajectory.phases[phase].contacts) {
    double least = kInfinity, most = -kInfinity;
    for (int i = 0; i <= kGapSamples; ++i) {
      const MotionSample sample = Sample(trajectory, phase, interval, static_cast<double>(i) / kGapSamples);
      dynamics.ComputeState(sample.position, sample.velocity, &state);
      const RollingContact rolling = ComputeRollingContact(scene.contacts[contact], state);
      least = std::min(least, rolling.gap);
      most = std::max(most, rolling.gap);
    }
    drift = std::max(drift, most - least);
  }
  return drift;
}

int Parts(double excess, double order) {
  if (excess <= kGoodEnough) return 1;
  if (excess == kInfinity) return kPartsOfUnknown;
  return static_cast<int>(
      std::clamp(std::ceil(std::pow(excess / kSafety, 1 / order)), 2.0, static_cast<double>(kMostParts)));
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

Mesh RefineMesh(const Mesh& mesh, const GaitSpec& spec, const Trajectory& trajectory, const AccuracyReport& report,
                bool stalled) {
  const BodyDynamics dynamics(spec.scene.model);
  const bool has_two_points = TraitsOf(spec.scheme).points.size() == 2;
  Mesh finer;
  size_t interval = 0;
  for (size_t p = 0; p < mesh.fractions.size(); ++p) {
    const double share = spec.bounds[Criterion::kGap] / static_cast<double>(mesh.fractions[p].size());
    std::vector<int> parts;
    for (size_t k = 0; k < mesh.fractions[p].size(); ++k, ++interval) {
      const double drift = GapDrift(spec.scene, dynamics, trajectory, static_cast<int>(p), static_cast<int>(k));
      int count = Parts(drift / share, has_two_points ? 3 : 4);
      for (const MeasureOrder& order : kOrders) {
        // An interval that could not be integrated has no measures.
        const double measure =
            interval < report.intervals.size() ? report.intervals[interval][order.criterion] : kInfinity;
        const double excess = ExcessOf(order.criterion, measure, spec.bounds[order.criterion]);
        count = std::max(count, Parts(excess, has_two_points ? order.two_points : order.more));
      }
      parts.push_back(count);
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
