#include "core/validation/contact_residuals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/check.h"
#include "core/contact/rolling_kinematics.h"
#include "core/math/maximum.h"
#include "core/math/polynomial_extrema.h"
#include "core/trajectory/sampling.h"
#include "core/validation/pieces.h"

namespace rollgait {
namespace {

constexpr int kGapDegree = 10, kGapGrid = 48, kGapHalvings = 10;
constexpr double kGapResolved = 1e-4;   // of the largest value
constexpr double kGapRounding = 1e-12;  // m, m/s: above what rounding does to positions of metres and velocities of m/s
constexpr double kPointResolved = 1e-5;  // m, of contact points, which say only where forces act

// The contacts of one phase. Rows of the functions of time: the gap of every contact of the scene, then of every active
// one its slip x y z (zero where not forbidden), then of every active one the rows of ForceJudge.
class PhaseContacts {
 public:
  PhaseContacts(const Scene& scene, const BodyDynamics& dynamics, const TrajectoryPhase& phase, int index,
                const ForceBounds& bounds, ForceExtremes* forces)
      : scene_(scene),
        dynamics_(dynamics),
        phase_(index),
        active_(phase.contacts),
        place_(scene.contacts.size(), -1),
        judge_(scene, phase.contacts, bounds, forces) {
    for (int a = 0; a < active(); ++a) place_[active_[a]] = a;
  }

  void Judge(const IntervalPolynomials& interval, int number, Pieces* pieces, FindingLog* log, ContactResiduals* result,
             double* depth) {
    const auto sample = [&](double theta, MatrixX* values, int column) { Sample(interval, theta, values, column); };
    const auto resolved = [&] { return Resolved(*pieces); };
    const auto visit = [&](double from, double to) {
      Instant at{phase_, 0, number};
      const double start = interval.start() + from * interval.length(), length = (to - from) * interval.length();
      JudgeGaps(*pieces, start, length, at, log, result, depth);
      judge_.JudgeFriction(pieces->basis(), pieces->coefficients(), pieces->samples(), ForceRow(0), start, length, at,
                           log);
    };
    pieces->Cover(ForceRow(active()), 0, 1, kGapHalvings, sample, resolved, visit);
    JudgeNormals(interval, number, log);
  }

 private:
  int contacts() const { return static_cast<int>(place_.size()); }
  int active() const { return static_cast<int>(active_.size()); }
  int SlipRow(int a) const { return contacts() + 3 * a; }
  int ForceRow(int a) const { return contacts() + 3 * active() + ForceJudge::kRows * a; }

  void Sample(const IntervalPolynomials& interval, double theta, MatrixX* values, int column) {
    interval.Evaluate(theta, &sample_);
    dynamics_.ComputeState(sample_.position, sample_.velocity, &state_);
    for (int c = 0; c < contacts(); ++c) {
      const RollingContact contact = ComputeRollingContact(scene_.contacts[c], state_);
      (*values)(c, column) = contact.gap;
      const int a = place_[c];
      if (a < 0) continue;
      auto slip = values->col(column).segment<3>(SlipRow(a));
      slip.setZero();
      for (int axis : scene_.contacts[c].directions) slip[axis] = contact.slip[axis];
      auto rows = values->col(column).segment<ForceJudge::kRows>(ForceRow(a));
      rows << sample_.forces.segment<3>(3 * a), contact.p_WP.head<2>();
    }
  }

  // Whether a row's last coefficients are at most `share` of `size`.
  static bool Small(const Pieces& pieces, int row, double size) {
    return ChebyshevBasis::Tail(pieces.coefficients(), row) <= kGapResolved * size + kGapRounding;
  }

  bool Resolved(const Pieces& pieces) const {
    const MatrixX& values = pieces.values();
    for (int c = 0; c < contacts(); ++c) {
      // What matters of a swinging surface is how far it is from the ground where it is lowest.
      const double size = place_[c] >= 0 ? values.row(c).cwiseAbs().maxCoeff() : std::abs(values.row(c).minCoeff());
      if (!Small(pieces, c, size)) return false;
    }
    for (int a = 0; a < active(); ++a) {
      const double size = values.middleRows<3>(SlipRow(a)).cwiseAbs().maxCoeff();
      for (int axis = 0; axis < 3; ++axis) {
        if (!Small(pieces, SlipRow(a) + axis, size)) return false;
        if (axis < 2 && !(ChebyshevBasis::Tail(pieces.coefficients(), ForceRow(a) + 3 + axis) <= kPointResolved))
          return false;
      }
    }
    return true;
  }

  // The largest of a function of the interpolants over the piece at hand; `at` gets its time. `value` takes a functor
  // that gives row -> number.
  template <class Value>
  double Largest(const Pieces& pieces, const Value& value, double start, double length, Instant* at) const {
    const std::vector<double>& grid = pieces.basis().grid();
    std::array<double, kGapGrid + 1> samples = {};
    for (int k = 0; k <= kGapGrid; ++k) {
      samples[k] = value([&](int row) { return pieces.samples()(row, k); });
      if (!std::isfinite(samples[k])) {
        at->time = start + grid[k] * length;
        return kInfinity;
      }
    }
    const Maximum peak = MaximumOverGrid(
        [&](double theta) {
          return value([&](int row) { return ChebyshevBasis::Evaluate(pieces.coefficients(), row, theta); });
        },
        grid, samples);
    at->time = start + peak.at * length;
    return peak.value;
  }

  void JudgeGaps(const Pieces& pieces, double start, double length, Instant at, FindingLog* log,
                 ContactResiduals* result, double* depth) const {
    for (int c = 0; c < contacts(); ++c) {
      const std::string& name = scene_.contacts[c].name;
      const int a = place_[c];
      if (a < 0) {
        const double deep = Largest(
            pieces, [c](const auto& row) { return -row(c); }, start, length, &at);
        RaiseTo(deep, depth);
        log->Raise(Criterion::kPenetration, std::max(deep, 0.0), name, at);
        continue;
      }
      const double gap = Largest(
          pieces, [c](const auto& row) { return std::abs(row(c)); }, start, length, &at);
      RaiseTo(gap, &result->max_gap);
      log->Raise(Criterion::kGap, gap, name, at);
      const int r = SlipRow(a);
      const auto size = [r](const auto& row) { return std::hypot(row(r), row(r + 1), row(r + 2)); };
      const double slip = Largest(pieces, size, start, length, &at);
      RaiseTo(slip, &result->max_slip);
      log->Raise(Criterion::kSlip, slip, name, at);
    }
  }

  void JudgeNormals(const IntervalPolynomials& interval, int number, FindingLog* log) const {
    std::array<double, kLargestDegree + 1> coefficients = {};
    for (int a = 0; a < active(); ++a) {
      const PolynomialRange range = RangeOnUnitInterval(interval.ForcePolynomial(3 * a + 2, coefficients));
      judge_.AddNormal(a, range.min, {phase_, interval.start() + range.min_at * interval.length(), number}, log);
    }
  }

  const Scene& scene_;
  const BodyDynamics& dynamics_;
  int phase_;
  std::vector<int> active_;
  std::vector<int> place_;  // of a contact of the scene among the active ones, -1: swings
  ForceJudge judge_;
  MotionSample sample_;
  BodyDynamics::State state_;
};

}  // namespace

ContactResiduals MeasureContacts(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                                 const ForceBounds& bounds, ForceExtremes* forces, FindingLog* log) {
  static const ChebyshevBasis basis(kGapDegree, kGapGrid);
  ContactResiduals residuals;
  double depth = -kInfinity;  // −gap of inactive contacts
  Pieces pieces(basis);
  int number = 0;
  for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    PhaseContacts contacts(scene, dynamics, phase, p, bounds, forces);
    for (int k = 0; k + 1 < static_cast<int>(phase.node_times.size()); ++k, ++number) {
      contacts.Judge(IntervalPolynomials(trajectory, p, k), number, &pieces, log, &residuals, &depth);
    }
  }
  residuals.min_swing_clearance = depth == -kInfinity ? 0 : -depth;
  return residuals;
}

}  // namespace rollgait
