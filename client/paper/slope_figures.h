// What the paper's section 4.2 speaks of, measured on one gait.
#ifndef ROLLGAIT_CLIENT_PAPER_SLOPE_FIGURES_H_
#define ROLLGAIT_CLIENT_PAPER_SLOPE_FIGURES_H_

#include <optional>
#include <string>
#include <vector>

#include "client/report/stride.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Over one stride, of one joint.
struct JointEffort {
  std::string joint;
  double squared;                       // ∫ τ² dt, N² m² s
  double absolute;                      // ∫ |τ| dt, N m s
  double positive_work, negative_work;  // J, both ≥ 0
  double peak;                          // largest |τ|, N m
};

// A phase of the cycle by its share.
struct PhaseShare {
  double start_percent, end_percent;
  double duration_s;
  int feet;                           // of different legs on the ground
  std::vector<std::string> contacts;  // by name
};

// The events of the paper, % of the cycle from the right heel strike at 0; empty if they do not happen.
struct CycleEvents {
  std::optional<double> opposite_toe_off, opposite_heel_strike, toe_off;
};

struct SlopeFigures {
  double slope_deg = 0;
  std::string solve;
  bool solved = false;    // ended with an answer, and with a motion
  bool mirrored = false;  // half a cycle was computed, the other half is its mirror image
  double stride_time_s = 0, stride_length_m = 0;
  CycleEvents events;
  std::vector<PhaseShare> phases;
  std::vector<JointEffort> joints;  // every actuated joint
  JointEffort total{};              // sums, and the largest peak of hip, knee and ankle
  double wall_time_s = 0;
};

// Without a motion only slope, name and time are set. Throws Failure(kUsage) if the trajectory does not fit its model.
SlopeFigures MeasureSlope(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_PAPER_SLOPE_FIGURES_H_
