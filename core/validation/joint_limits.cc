#include "core/validation/joint_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/math/polynomial_extrema.h"
#include "core/trajectory/sampling.h"

namespace rollgait {
namespace {

// What the sum of the sizes of the coefficients already proves to be within the limits needs no extrema.
bool SurelyWithin(std::span<const double> c, double min, double max) {
  double spread = 0;
  for (size_t j = 1; j < c.size(); ++j) spread += std::abs(c[j]);
  return c[0] - spread >= min && c[0] + spread <= max;
}

class IntervalLimits {
 public:
  IntervalLimits(const IntervalPolynomials& interval, const Instant& start, FindingLog* log)
      : interval_(interval), at_(start), log_(log) {}

  // Excesses over min and over max are divided by their scales.
  void Judge(Criterion criterion, const Joint& joint, std::span<const double> polynomial, double min, double max,
             double min_scale, double max_scale) {
    if (min == -kInfinity && max == kInfinity) return;
    if (SurelyWithin(polynomial, min, max)) return;
    const PolynomialRange range = RangeOnUnitInterval(polynomial);
    Raise(criterion, joint, min - range.min, min_scale, range.min_at);
    Raise(criterion, joint, range.max - max, max_scale, range.max_at);
  }

 private:
  void Raise(Criterion criterion, const Joint& joint, double excess, double scale, double theta) {
    if (excess <= 0) return;
    at_.time = interval_.start() + theta * interval_.length();
    log_->Raise(criterion, excess / scale, joint.name, at_);
  }

  const IntervalPolynomials& interval_;
  Instant at_;
  FindingLog* log_;
};

}  // namespace

void MeasureJointLimits(const Model& model, const Trajectory& trajectory, FindingLog* log) {
  std::array<double, kLargestDegree + 1> room = {};
  int number = 0;
  for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
    for (int k = 0; k + 1 < static_cast<int>(trajectory.phases[p].node_times.size()); ++k, ++number) {
      const IntervalPolynomials interval(trajectory, p, k);
      IntervalLimits limits(interval, {p, interval.start(), number}, log);
      for (int j = 0; j < model.size(); ++j) {
        const Joint& joint = model.joint(j);
        limits.Judge(Criterion::kJointRange, joint, interval.PositionPolynomial(j, room), joint.position_min,
                     joint.position_max, 1, 1);
        const double fastest = joint.velocity_max;
        limits.Judge(Criterion::kJointVelocity, joint, interval.VelocityPolynomial(j, room), -fastest, fastest, fastest,
                     fastest);
      }
      for (int a = 0; a < static_cast<int>(model.actuated().size()); ++a) {
        const Joint& joint = model.joint(model.actuated()[a]);
        const double least = std::abs(joint.effort_min), most = std::abs(joint.effort_max);
        const double larger = std::max(least, most);
        limits.Judge(Criterion::kJointEffort, joint, interval.EffortPolynomial(a, room), joint.effort_min,
                     joint.effort_max, least > 0 ? least : larger, most > 0 ? most : larger);
      }
    }
  }
}

}  // namespace rollgait
