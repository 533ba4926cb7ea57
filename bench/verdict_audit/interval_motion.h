// The polynomials of one interval, evaluated by the audit from what rollgait::Trajectory says of them.
#ifndef ROLLGAIT_BENCH_VERDICT_AUDIT_INTERVAL_MOTION_H_
#define ROLLGAIT_BENCH_VERDICT_AUDIT_INTERVAL_MOTION_H_

#include "core/trajectory/trajectory.h"

namespace rollgait::audit {

class IntervalMotion {
 public:
  // Contract: indices in range.
  IntervalMotion(const Trajectory& trajectory, const TrajectoryPhase& phase, int interval);

  double start() const { return start_; }    // s
  double length() const { return length_; }  // s
  // At fraction θ ∈ [0, 1].
  VectorX Position(double theta) const;
  VectorX Velocity(double theta) const;
  VectorX Efforts(double theta) const;
  VectorX Forces(double theta) const;  // 3 a contact of the phase

 private:
  double start_, length_;
  VectorX position_, velocity_;              // at the node
  MatrixX acceleration_, efforts_, forces_;  // coefficients of 1, θ, θ² …, a column each
};

}  // namespace rollgait::audit

#endif  // ROLLGAIT_BENCH_VERDICT_AUDIT_INTERVAL_MOTION_H_
