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
// of the polynomials (forces: that of the efforts) and of the end of a step, each less one where a joint may meet its
// limit or a force its bound inside of the interval, since the higher order is lost there. Slip and gap are in
// PartsForContacts.
struct MeasureOrder {
  Criterion criterion;
  double two_points, more;
};
constexpr MeasureOrder kOrders[] = {
    {Criterion::kPenetration, 2, 3},    {Criterion::kOverlap, 2, 3}, {Criterion::kPositionDefect, 3, 4},
    {Criterion::kVelocityDefect, 2, 3}, {Criterion::kPull, 2, 2},    {Criterion::kFriction, 2, 2},
    {Criterion::kEnergy, 3, 4},
};

// How often a measure is what it may be. Bodies are kept further apart at the points than they must be, and only what
// they come closer between the points falls with the length of the interval.
double ExcessOf(Criterion criterion, double measure, double bound) {
  if (criterion != Criterion::kOverlap || measure <= bound) return measure / bound;
  constexpr double kClearance = OptimalControlProblem::kPairClearance;
  return (kClearance + measure) / (kClearance + bound);
}

int Parts(double excess, double order) {
  if (excess <= kGoodEnough) return 1;
  if (excess == kInfinity) return kPartsOfUnknown;
  return static_cast<int>(
      std::clamp(std::ceil(std::pow(excess / kSafety, 1 / order)), 2.0, static_cast<double>(kMostParts)));
}

// What an interval does to its active contacts, each the worst of them.
struct ContactDrift {
  double gap = 0;   // largest change, m. The gap is the sum of these, so each may have its share of the bound
  double slip = 0;  // change from its start to its end, m/s, of which the slip is the sum where nodes may slip
  double bow = 0;   // how far the slip within it is from the line between its ends, m/s
};

ContactDrift DriftOf(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory, int phase,
                     int interval) {
  constexpr int kDriftSamples = 8;
  ContactDrift drift;
  BodyDynamics::State state;
  for (int contact : trajectory.phases[phase].contacts) {
    double least = kInfinity, most = -kInfinity;
    Vector3 slips[kDriftSamples + 1];
    for (int i = 0; i <= kDriftSamples; ++i) {
      const MotionSample sample = Sample(trajectory, phase, interval, static_cast<double>(i) / kDriftSamples);
      dynamics.ComputeState(sample.position, sample.velocity, &state);
      const RollingContact rolling = ComputeRollingContact(scene.contacts[contact], state);
      least = std::min(least, rolling.gap);
      most = std::max(most, rolling.gap);
      slips[i] = rolling.slip;
    }
    drift.gap = std::max(drift.gap, most - least);
    const Vector3 change = slips[kDriftSamples] - slips[0];
    drift.slip = std::max(drift.slip, change.norm());
    for (int i = 0; i <= kDriftSamples; ++i) {
      drift.bow = std::max(drift.bow, (slips[i] - slips[0] - i * change / kDriftSamples).norm());
    }
  }
  return drift;
}

// Parts that an interval needs for what contacts do in it. Collocation holds them at rest at the nodes: slip within an
// interval is its own. With an explicit method slip at the nodes, and with it the gap, is what all intervals before
// have added: each may add its share of the slip that neither bound forbids. Orders: a step of order 4 errs by h⁵, its
// parts together by h⁴; velocities of the dense output err by h⁴ within a step, less one as above.
int PartsForContacts(const GaitSpec& spec, const ContactDrift& drift, double slip, double duration, size_t intervals,
                     bool has_two_points) {
  const double share = 1.0 / static_cast<double>(intervals);
  const double gap_bound = spec.bounds[Criterion::kGap], slip_bound = spec.bounds[Criterion::kSlip];
  if (TraitsOf(spec.scheme).is_collocation()) {
    return std::max(Parts(drift.gap / (share * gap_bound), has_two_points ? 3 : 4),
                    Parts(slip / slip_bound, has_two_points ? 2 : 3));
  }
  const double allowed = std::min(slip_bound, gap_bound / duration);
  return std::max(Parts(drift.slip / (share * allowed), 4), Parts(drift.bow / allowed, 3));
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
  const auto measure_of = [&report](size_t interval, Criterion criterion) {
    // An interval that could not be integrated has no measures.
    return interval < report.intervals.size() ? report.intervals[interval][criterion] : kInfinity;
  };
  Mesh finer;
  size_t interval = 0;
  for (size_t p = 0; p < mesh.fractions.size(); ++p) {
    std::vector<int> parts;
    for (size_t k = 0; k < mesh.fractions[p].size(); ++k, ++interval) {
      const ContactDrift drift = DriftOf(spec.scene, dynamics, trajectory, static_cast<int>(p), static_cast<int>(k));
      int count = PartsForContacts(spec, drift, measure_of(interval, Criterion::kSlip), trajectory.phases[p].duration,
                                   mesh.fractions[p].size(), has_two_points);
      for (const MeasureOrder& order : kOrders) {
        const double measure = measure_of(interval, order.criterion);
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
