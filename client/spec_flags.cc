#include "client/spec_flags.h"

#include <CLI/CLI.hpp>
#include <cmath>

#include "client/bound_flags.h"
#include "client/failure.h"
#include "client/flag_values.h"
#include "client/json.h"
#include "client/repeated_flags.h"
#include "client/spec_words.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

double ParseWeight(const std::string& cost, const std::string& text) {
  try {
    size_t used = 0;
    const double weight = std::stod(text, &used);
    if (used == text.size()) return weight;
  } catch (const std::logic_error&) {
    // Not a number; said below.
  }
  throw Failure(ExitCode::kUsage,
                "--cost " + cost + ": the weight after the colon must be a number, for example work:0.5");
}

v1::CostTerm ParseCost(const std::string& cost) {
  // As other flags have it.
  if (cost.find('=') != std::string::npos) {
    throw Failure(ExitCode::kUsage, "--cost " + cost + ": the weight stands after a colon, for example work:0.5");
  }
  const size_t colon = cost.find(':');
  v1::CostTerm term = Lookup("--cost", cost.substr(0, colon), CostWords());
  if (colon != std::string::npos) term.set_weight(ParseWeight(cost, cost.substr(colon + 1)));
  return term;
}

// Another weight for the file's term of that kind, or one more term.
void ApplyCost(const std::string& cost, v1::SolveSpec& spec) {
  const v1::CostTerm term = ParseCost(cost);
  v1::CostTerm* same = nullptr;
  for (v1::CostTerm& given : *spec.mutable_costs()) {
    if (given.term_case() != term.term_case()) continue;
    if (same != nullptr) {
      throw Failure(ExitCode::kUsage, "--cost " + cost +
                                          ": the file has two terms of this kind, so that it is not clear which is "
                                          "meant; change the file");
    }
    same = &given;
  }
  if (same == nullptr) {
    *spec.add_costs() = term;
  } else if (term.has_weight()) {
    same->set_weight(term.weight());
  }
}

// "A" or "A,B": one value or the range between two.
void ApplyRange(const std::string& flag, const std::string& text, v1::Range& range) {
  const std::vector<double> numbers =
      ParseNumbers(flag, text, "A or A,B along the surface, from -1 (heel) to 1 (toe)", {1, 2});
  range.set_min(numbers.front());
  range.set_max(numbers.back());
}

void ApplyGround(const SpecFlags& flags, v1::SolveSpec& spec) {
  if (flags.friction) spec.mutable_ground_contact()->set_friction_coefficient(*flags.friction);
  if (flags.clearance_m) spec.mutable_ground_contact()->set_swing_clearance_m(*flags.clearance_m);
  if (flags.touch_down) {
    spec.mutable_ground_contact()->set_touch_down(Lookup("--touch-down", *flags.touch_down, TouchDownWords()));
  }
  if (flags.allow_overlap) spec.mutable_limits()->set_allow_body_overlap(true);
  if (flags.touch_down_point) {
    ApplyRange("--touch-down-point", *flags.touch_down_point,
               *spec.mutable_ground_contact()->mutable_touch_down_point());
  }
  if (flags.lift_off_point) {
    ApplyRange("--lift-off-point", *flags.lift_off_point, *spec.mutable_ground_contact()->mutable_lift_off_point());
  }
}

// "X,Y" or "X,Y,A,B,C": the place, and the rotation vector (A, B, C) in degrees.
void ApplyState(const std::string& flag, const std::string& text, v1::Manoeuvre::State& state) {
  const std::vector<double> numbers =
      ParseNumbers(flag, text, "X,Y in m, or X,Y,A,B,C with the orientation as a rotation vector in degrees", {2, 5});
  state.set_x_m(numbers[0]);
  state.set_y_m(numbers[1]);
  if (numbers.size() == 2) return;
  const double degrees = std::hypot(numbers[2], numbers[3], numbers[4]), half = degrees * kPi / 360;
  const double scale = degrees > 0 ? std::sin(half) / degrees : 0;
  v1::Quaternion& q = *state.mutable_orientation();
  q.set_w(std::cos(half));
  q.set_x(scale * numbers[2]);
  q.set_y(scale * numbers[3]);
  q.set_z(scale * numbers[4]);
}

void ApplyManoeuvre(const SpecFlags& flags, v1::SolveSpec& spec) {
  if (flags.from) ApplyState("--from", *flags.from, *spec.mutable_manoeuvre()->mutable_start());
  if (flags.to) ApplyState("--to", *flags.to, *spec.mutable_manoeuvre()->mutable_end());
  if (flags.duration_s) spec.mutable_manoeuvre()->set_duration_s(*flags.duration_s);
}

void ApplyMotion(const SpecFlags& flags, v1::SolveSpec& spec) {
  if (!flags.speed_m_s && !flags.step_length_m && !flags.step_duration_s && !flags.free_speed && !flags.duty_factor)
    return;
  v1::Motion& motion = *spec.mutable_motion();
  if (flags.free_speed) {
    motion.set_free_speed(true);
    motion.clear_speed_m_s();
  }
  if (flags.speed_m_s) {
    motion.set_speed_m_s(*flags.speed_m_s);
    if (!flags.free_speed) motion.set_free_speed(false);
  }
  if (flags.step_length_m) motion.set_step_length_m(*flags.step_length_m);
  if (flags.step_duration_s) motion.set_step_duration_s(*flags.step_duration_s);
  if (flags.duty_factor) {
    motion.mutable_duty_factor()->set_min(*flags.duty_factor);
    motion.mutable_duty_factor()->set_max(*flags.duty_factor);
  }
}

void ApplyNumerics(const SpecFlags& flags, v1::SolveSpec& spec) {
  if (flags.scheme) {
    spec.mutable_discretization()->set_scheme(Lookup("--scheme", *flags.scheme, SchemeWords()));
  }
  if (flags.solver) spec.set_nlp_solver(Lookup("--solver", *flags.solver, SolverWords()));
  if (flags.intervals) spec.mutable_discretization()->set_single_support_intervals(*flags.intervals);
  if (flags.double_intervals) spec.mutable_discretization()->set_double_support_intervals(*flags.double_intervals);
  if (flags.accuracy) {
    spec.mutable_accuracy()->set_level(Lookup("--accuracy", *flags.accuracy, AccuracyWords()));
  }
  if (!flags.bounds.empty()) ApplyBounds(flags.bounds, *spec.mutable_accuracy());
  if (flags.estimate_errors) spec.mutable_accuracy()->set_estimate_errors(true);
  if (!flags.max_errors.empty()) ApplyMaxErrors(flags.max_errors, *spec.mutable_accuracy());
  if (flags.tolerance) spec.mutable_accuracy()->set_kkt_tolerance(*flags.tolerance);
  if (flags.max_refinements) spec.mutable_accuracy()->set_max_refinements(*flags.max_refinements);
  if (flags.max_iterations) spec.mutable_solver_limits()->set_max_iterations(*flags.max_iterations);
  if (flags.max_time_s) spec.mutable_solver_limits()->set_max_wall_time_s(*flags.max_time_s);
}

}  // namespace

void AddSpecFlags(CLI::App& command, SpecFlags& flags) {
  command.add_option("--spec", flags.file,
                     "Request as proto3 JSON of rollgait.v1.SolveSpec, - for standard input; flags override it, those "
                     "that may be repeated name by name (`rollgait help repeated-flags`); `rollgait spec` writes it");
  command
      .add_option("--model", flags.model,
                  "Model name, see `rollgait models`; models/ID is one of your own on the server, FILE.json, .urdf, "
                  ".xml (MJCF) or .osim "
                  "one in a file")
      ->group("Body");
  AddBodyFlags(command, flags);
  const auto add = [&command](const std::string& name, auto& value, const std::string& group, const std::string& help) {
    return command.add_option(name, value, help)->group(group);
  };
  add("--slope", flags.slope_deg, "Motion", "Inclination of the ground in degrees, [-45, 45]; positive is uphill");
  add("--speed", flags.speed_m_s, "Motion", "Mean speed along the slope in m/s, (0, 4]");
  add("--step-length", flags.step_length_m, "Motion", "Distance of a step in m, (0, 2]");
  add("--step-duration", flags.step_duration_s, "Motion", "Duration of a step in s, [0.1, 5]");
  add("--duty-factor", flags.duty_factor, "Motion", "Share of the cycle that a foot stands, [0.5, 0.95]");
  command.add_flag("--free-speed", flags.free_speed, "Optimise the speed")->group("Motion");
  add("--cycle", flags.cycle, "Motion", "half (one step and its mirror image) or full (two steps)");
  add("--friction", flags.friction, "Motion", "Coulomb coefficient of the ground, (0, 5]");
  add("--clearance", flags.clearance_m, "Motion", "Height of the swing foot in mid-swing in m, [0, 0.3]");
  add("--touch-down", flags.touch_down, "Motion",
      "How feet come down: smooth (at rest) or plastic (an impact stops them)");
  add("--touch-down-point", flags.touch_down_point, "Motion",
      "Where a surface touches down: A or A,B from -1 (heel) to 1 (toe)");
  add("--lift-off-point", flags.lift_off_point, "Motion", "Where a surface lifts off, likewise");
  command.add_flag("--allow-overlap", flags.allow_overlap, "Legs, feet and arms may pass through each other")
      ->group("Motion");
  add("--from", flags.from, "Manoeuvre",
      "Where the ball starts: X,Y in m, or X,Y,A,B,C with a rotation vector in degrees");
  add("--to", flags.to, "Manoeuvre", "Where it is to come to rest, likewise; X,Y alone leaves the orientation free");
  add("--duration", flags.duration_s, "Manoeuvre", "Duration in s, [0.01, 100]");
  add("--preset", flags.preset, "Cost", "Costs by name: torque, transport or human (closest to people)");
  AddRepeatedFlag(
      command, "--cost", flags.costs,
      CostWordList() + ", with [:WEIGHT]; added to those of preset and file, or another weight for their term", "cost")
      ->group("Cost");
  add("--normalize", flags.normalization, "Cost", "Divide the cost by: distance, time or none");
  add("--starts", flags.starts, "Numerics", "Guesses to start from; the cheapest solution is kept, [1, 32]");
  add("--warm-start", flags.warm_start, "Numerics",
      "Start from a stored solve, solves/ID, or from the nearest one: nearest");
  add("--scheme", flags.scheme, "Numerics", "Collocation, or direct multiple shooting: " + Listed(SchemeWords()));
  add("--solver", flags.solver, "Numerics", "interior-point, or ipopt for the same search by Ipopt alone");
  add("--intervals", flags.intervals, "Numerics", "Mesh intervals of a single-support phase, [1, 1000]");
  add("--double-intervals", flags.double_intervals, "Numerics", "Mesh intervals of a double-support phase, [1, 1000]");
  add("--accuracy", flags.accuracy, "Numerics", "draft, standard or fine");
  AddRepeatedFlag(command, "--bound", flags.bounds,
                  "NAME=NUMBER: largest admissible measure of the trajectory, a field of rollgait.v1.Accuracy, for "
                  "example max_pull_bw=1e-4",
                  "measure")
      ->group("Numerics");
  command.add_flag("--errors", flags.estimate_errors, "Estimate the errors of objective, angles, torques and forces")
      ->group("Numerics");
  AddRepeatedFlag(command, "--max-error", flags.max_errors,
                  "NAME=NUMBER: refine until this estimated error is reached: angle in degrees, torque in N m, "
                  "contact-force in N, objective as a share",
                  "error")
      ->group("Numerics");
  add("--tolerance", flags.tolerance, "Numerics", "Scaled KKT error to stop at, [1e-12, 1e-2]");
  add("--max-refinements", flags.max_refinements, "Numerics", "How often the mesh may be refined, [0, 20]");
  add("--max-iterations", flags.max_iterations, "Numerics", "Iterations over all meshes, [1, 100000]");
  add("--max-time,--time-limit", flags.max_time_s, "Numerics",
      "Wall time of the solve in s, or with a unit: 90s, 5m, 2h, 1d; [0.01, 86400] s; then it ends with the newest "
      "gait that converged")
      ->transform(CLI::AsNumberWithUnit(std::map<std::string, double>{{"s", 1}, {"m", 60}, {"h", 3600}, {"d", 86400}},
                                        CLI::AsNumberWithUnit::CASE_SENSITIVE))
      ->transform(CLI::Validator(
          [](std::string& text) -> std::string {  // a unit alone would be one of it
            return text.find_first_of("0123456789") == std::string::npos ? text + " is no time; give 90s, 5m or 2h"
                                                                         : "";
          },
          ""));
}

v1::SolveSpec BuildSpec(const SpecFlags& flags) {
  v1::SolveSpec spec;
  if (!flags.file.empty()) ReadJsonFile(flags.file, spec);
  if (HasBodyFlags(flags)) ApplyBodyFlags(flags, *spec.mutable_model());
  if (flags.slope_deg) spec.set_slope_rad(*flags.slope_deg * kPi / 180.0);
  ApplyMotion(flags, spec);
  ApplyManoeuvre(flags, spec);
  if (flags.cycle) {
    spec.set_cycle(Lookup("--cycle", *flags.cycle, CycleWords()));
  }
  ApplyGround(flags, spec);
  if (flags.preset) spec.clear_costs();  // another cost than the file's
  for (const std::string& cost : flags.costs) ApplyCost(cost, spec);
  if (flags.preset) {
    spec.set_preset(Lookup("--preset", *flags.preset, PresetWords()));
  }
  if (flags.starts) spec.set_starts(*flags.starts);
  if (flags.warm_start) spec.set_warm_start(*flags.warm_start);
  if (flags.normalization) {
    spec.set_cost_normalization(Lookup("--normalize", *flags.normalization, NormalizationWords()));
  }
  ApplyNumerics(flags, spec);
  return spec;
}

}  // namespace rollgait::client
