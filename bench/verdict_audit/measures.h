// The parts of the second judge. Each raises the measures that it is about.
#ifndef ROLLGAIT_BENCH_VERDICT_AUDIT_MEASURES_H_
#define ROLLGAIT_BENCH_VERDICT_AUDIT_MEASURES_H_

#include <vector>

#include "core/gait/gait_spec.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/criteria.h"

namespace rollgait::audit {

class Measures {
 public:
  // A value that is not a number counts as infinite.
  void Raise(Criterion criterion, double value) {
    if (!(value <= values_[criterion])) values_[criterion] = value == value ? value : kInfinity;
  }
  const CriterionValues& values() const { return values_; }

 private:
  CriterionValues values_;
};

// Gap, slip, penetration, overlap, range, velocity, effort, pull and friction, on the polynomials.
void MeasurePath(const GaitSpec& spec, const Trajectory& trajectory, Measures* measures);
// Defects, pull and friction, on the re-integrated motion.
void MeasureMotion(const GaitSpec& spec, const Trajectory& trajectory, Measures* measures);
// Where phases and cycles meet: approach, periodicity, defects between phases, and impacts.
void MeasureJoins(const GaitSpec& spec, const Trajectory& trajectory, Measures* measures);
// Energy and momentum over the whole motion.
void MeasureBalances(const GaitSpec& spec, const Trajectory& trajectory, Measures* measures);

// A normal force below this share of body weight (N) counts as that much where friction is judged.
inline constexpr double kFrictionFloor = 1e-3;
double BodyWeight(const GaitSpec& spec);
// Raises pull and friction by forces (N) that act at points (m) on contacts of the scene.
void MeasureForces(const GaitSpec& spec, const std::vector<int>& contacts, const std::vector<Vector3>& points,
                   const std::vector<Vector3>& forces, Measures* measures);

}  // namespace rollgait::audit

#endif  // ROLLGAIT_BENCH_VERDICT_AUDIT_MEASURES_H_
