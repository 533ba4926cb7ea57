// A gait request from the command line: the only place where degrees become radians.
#ifndef ROLLGAIT_CLIENT_SPEC_FLAGS_H_
#define ROLLGAIT_CLIENT_SPEC_FLAGS_H_

#include <optional>
#include <string>
#include <vector>

#include "rollgait/v1/solve_spec.pb.h"

namespace CLI {
class App;
}

namespace rollgait::client {

// What was given on the command line; unset values are left to the file or to the server's defaults.
struct SpecFlags {
  std::string file;
  std::string side_file;  // of a model in a URDF file; empty: none
  std::optional<std::string> model, sex, scheme, solver, cycle, accuracy, normalization;
  std::optional<std::string> preset, warm_start;
  std::optional<double> duty_factor;
  std::optional<int> starts;
  std::optional<double> stature_m, mass_kg, slope_deg, speed_m_s, step_length_m, step_duration_s;
  std::optional<std::string> from, to, semi_axes;  // "X,Y[,A,B,C]" in m and degrees, "A,B,C" in m
  std::optional<double> duration_s;
  std::optional<std::string> touch_down, touch_down_point,
      lift_off_point;  // a word; "A" or "A,B" from heel -1 to toe 1
  std::optional<double> friction, clearance_m, tolerance, max_time_s;
  std::optional<int> intervals, double_intervals, max_refinements, max_iterations;
  std::optional<std::string> feet, ranges;
  bool free_speed = false, allow_overlap = false, toes = false, sagittal = false, drop_arms = false,
       rigid_trunk = false;
  std::vector<std::string> locks, segments;            // "knee_l=20" in degrees, "thigh=0.45" in m
  std::vector<std::string> loads, strengths, springs;  // "hand_l=10", "knee_l=0.3", "ankle_l=340,0,2"
  std::vector<std::string> foot_axes;                  // "heel_l=0.03,0.02,0.025" in m
  std::vector<std::string> costs;                      // "torque", "work:0.5" …
  std::vector<std::string> bounds;                     // "max_pull_bw=1e-4" …
  bool estimate_errors = false;
  std::vector<std::string> max_errors;  // "angle=0.5" in degrees …
};

void AddSpecFlags(CLI::App& command, SpecFlags& flags);

// Whether any of AddBodyFlags, or the model, is given.
bool HasBodyFlags(const SpecFlags& flags);

// Only the flags of model selection but the name (--sex, --stature, --lock …), for other commands.
void AddBodyFlags(CLI::App& command, SpecFlags& flags);

// The model selection of the flags, on top of `selection`. Returns what reading a URDF found, lines for people; empty
// for other models. Throws Failure(kUsage) for a word that is not in a flag's list and for files that are no model.
std::string ApplyBodyFlags(const SpecFlags& flags, v1::ModelSelection& selection);

// The request: the file's content, if a file is named, overridden by the flags. Ranges are checked by the server.
// Throws Failure(kUsage) for a word that is not in a flag's list, and for a file that is not a SolveSpec.
v1::SolveSpec BuildSpec(const SpecFlags& flags);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SPEC_FLAGS_H_
