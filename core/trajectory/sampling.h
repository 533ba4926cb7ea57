#ifndef ROLLGAIT_CORE_TRAJECTORY_SAMPLING_H_
#define ROLLGAIT_CORE_TRAJECTORY_SAMPLING_H_

#include <span>

#include "core/trajectory/trajectory.h"

namespace rollgait {

// The motion at one instant.
struct MotionSample {
  VectorX position;      // nq
  VectorX velocity;      // nq
  VectorX acceleration;  // nq
  VectorX efforts;       // n_actuated
  VectorX forces;        // 3 · active contacts
};

// The polynomials of one interval by the rule that Trajectory states, ready to be evaluated often.
// Immutable value; it does not refer to the trajectory after construction.
class IntervalPolynomials {
 public:
  // Contract: phase and interval in range, point_fractions distinct.
  IntervalPolynomials(const Trajectory& trajectory, int phase, int interval);

  double start() const { return start_; }    // s
  double length() const { return length_; }  // s
  // At fraction θ ∈ [0, 1] of the interval. No allocation if the vectors already have their size.
  void Evaluate(double theta, MotionSample* sample) const;
  void EvaluateEfforts(double theta, VectorX* efforts) const;

  // One of the polynomials: the coefficients of 1, θ, θ², …, written to the front of `room`. Row: joint, joint, index
  // of the actuated joint, component of the forces. Contract: room for s + 2, s + 1, s and s numbers.
  std::span<const double> PositionPolynomial(int row, std::span<double> room) const;
  std::span<const double> VelocityPolynomial(int row, std::span<double> room) const;
  std::span<const double> EffortPolynomial(int row, std::span<double> room) const;
  std::span<const double> ForcePolynomial(int row, std::span<double> room) const;

 private:
  double start_, length_;
  VectorX position_, velocity_;  // at the node
  // Coefficients of 1, θ, …, θ^(s−1), one column each.
  MatrixX acceleration_, efforts_, forces_;
};

// Evaluates the trajectory in interval `interval` of phase `phase` at fraction θ ∈ [0, 1] of the interval, by the rule
// that Trajectory states. Contract: indices in range.
MotionSample Sample(const Trajectory& trajectory, int phase, int interval, double theta);

// Sets point_positions and point_velocities of every phase to the values of those polynomials, from the nodes, the
// accelerations and times that are there. Contract: as IntervalPolynomials, for every interval.
void FillPointStates(Trajectory* trajectory);

// Efforts alone.
VectorX SampleEfforts(const Trajectory& trajectory, int phase, int interval, double theta);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRAJECTORY_SAMPLING_H_
