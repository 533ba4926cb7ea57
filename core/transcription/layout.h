#ifndef ROLLGAIT_CORE_TRANSCRIPTION_LAYOUT_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_LAYOUT_H_

#include <vector>

#include "core/math/collocation.h"
#include "core/ocp/problem.h"

namespace rollgait {

// The intervals of every phase as fractions of its duration: positive, with sum 1.
struct Mesh {
  std::vector<std::vector<double>> fractions;

  static Mesh Uniform(const std::vector<int>& intervals);
  std::vector<int> Intervals() const;
};

// Unknown accelerations are in units of this, m/s² or rad/s²; efforts, forces and impulses in those of the problem's
// sizes.
inline constexpr double kAccelerationScale = 10;

// The only place that knows where unknowns sit in the decision vector. Stage order:
//   node 0, interior of interval 0, node 1, interior of interval 1, … , node N, durations T_0 … T_P−1, displacement D.
// Before the first node of a phase at whose start velocities jump: the end node of the interval before (except before
// node 0), which is otherwise the next node itself, and the impulses Λ. A node is (q, v); the interior of an interval
// is the accelerations of its first s − 2 points, then (τ, f) point by point.
class DecisionLayout {
 public:
  DecisionLayout(const OptimalControlProblem& problem, const Mesh& mesh, int points);

  int size() const { return displacement_ + 1; }
  int intervals() const { return static_cast<int>(phase_of_.size()); }
  int phases() const { return static_cast<int>(first_interval_.size()) - 1; }
  int points() const { return points_; }
  int phase(int interval) const { return phase_of_[interval]; }
  // Start and length of an interval as fractions of its phase.
  double start(int interval) const { return start_[interval]; }
  double length(int interval) const { return length_[interval]; }
  bool ends_phase(int interval) const { return interval + 1 == first_interval_[phase_of_[interval] + 1]; }
  int first_interval(int phase) const { return first_interval_[phase]; }
  int intervals_in(int phase) const { return first_interval_[phase + 1] - first_interval_[phase]; }

  int node(int k) const { return node_[k]; }
  // The node where an interval ends: node(interval + 1) unless velocities jump there.
  int end_node(int interval) const { return interior(interval) + interior_size(phase_of_[interval]); }
  bool jumps(int phase) const { return impulse_[phase] >= 0; }
  // Impulses of a phase that starts with a jump.
  int impulse(int phase) const { return impulse_[phase]; }
  int impulse_size(int phase) const { return per_point_[phase] - efforts_; }
  int interior(int interval) const { return node_[interval] + 2 * n_; }
  int interior_size(int phase) const { return (points_ - 2) * n_ + points_ * per_point_[phase]; }
  int free_acceleration(int interval, int point) const { return interior(interval) + point * n_; }
  // First unknown of a source of EliminatedScheme: node states before and after, free accelerations; and its unit.
  int source(int interval, int source) const {
    if (source >= 4) return free_acceleration(interval, source - 4);
    return (source < 2 ? node_[interval] : end_node(interval)) + source % 2 * n_;
  }
  static double source_scale(int source) { return source >= 4 ? kAccelerationScale : 1; }
  int efforts(int interval, int point) const {
    return interior(interval) + (points_ - 2) * n_ + point * per_point_[phase_of_[interval]];
  }
  int forces(int interval, int point) const { return efforts(interval, point) + efforts_; }
  // Efforts and forces of one point.
  int controls(int phase) const { return per_point_[phase]; }
  int duration(int phase) const { return durations_ + phase; }
  int displacement() const { return displacement_; }

 private:
  int n_, efforts_, points_;
  std::vector<int> phase_of_, first_interval_, per_point_, node_, impulse_;
  std::vector<double> start_, length_;
  int durations_, displacement_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_LAYOUT_H_
