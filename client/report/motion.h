// A trajectory as a function of time, in the joint and contact order of its Model.
#ifndef ROLLGAIT_CLIENT_REPORT_MOTION_H_
#define ROLLGAIT_CLIENT_REPORT_MOTION_H_

#include <array>
#include <vector>

#include "rollgait/v1/model.pb.h"
#include "rollgait/v1/trajectory.pb.h"

namespace rollgait::client {

// The state of the walker at one instant. Vectors over joints and contacts follow Model.joints and Model.contacts.
struct Instant {
  std::vector<double> position;              // rad, m
  std::vector<double> velocity;              // rad/s, m/s
  std::vector<double> effort;                // N m, N; zero for joints without an actuator
  std::vector<std::array<double, 3>> force;  // of the ground on the body, N, world axes; zero if inactive
  std::vector<bool> active;                  // The contact rolls in this phase.
};

// Evaluates what Trajectory states: inside an interval the acceleration is the polynomial through the interval's
// points, velocity and position are its integrals from the node; efforts and forces are the polynomials through their
// points. Immutable; refers to neither message after construction.
class Motion {
 public:
  // Throws Failure(kUsage) that names the field if the trajectory does not fit itself or the model.
  Motion(const v1::Trajectory& trajectory, const v1::Model& model);

  double duration_s() const { return duration_s_; }
  double displacement_m() const { return displacement_m_; }

  struct PhaseSpan {
    double start_s, end_s;
    std::vector<int> contacts;  // indices into Model.contacts, ascending
  };
  const std::vector<PhaseSpan>& phases() const { return phase_spans_; }

  // The instant at `time_s`, clamped to [0, duration]. On a border between phases the later phase is evaluated, or the
  // earlier one if `from_left`.
  Instant At(double time_s, bool from_left = false) const;

 private:
  // Data of one interval; matrices as rows of joints or channels, one column a coefficient of θ^j.
  struct Interval {
    double start_s, length_s;
    std::vector<double> position, velocity;                 // at the node, model order
    std::vector<std::vector<double>> acceleration, effort;  // per joint, model order
    std::vector<std::array<std::vector<double>, 3>> force;  // per contact, model order
  };
  struct Phase {
    std::vector<bool> active;
    std::vector<Interval> intervals;
  };
  Phase ReadPhase(const v1::Trajectory& trajectory, int index, const v1::Model& model) const;

  double duration_s_, displacement_m_;
  std::vector<int> joints_, actuated_;  // columns -> Model.joints
  std::vector<PhaseSpan> phase_spans_;
  std::vector<Phase> phases_;
};

// Row i: the coefficients of 1, θ, … of the polynomial of degree s − 1 that is one at nodes[i] and zero at the others.
// The nodes must be distinct.
std::vector<std::vector<double>> LagrangeCoefficients(const std::vector<double>& nodes);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_MOTION_H_
