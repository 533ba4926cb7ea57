#ifndef ROLLGAIT_CORE_GAIT_GAIT_REQUEST_H_
#define ROLLGAIT_CORE_GAIT_GAIT_REQUEST_H_

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/gait/manoeuvre_request.h"
#include "core/models/catalog.h"
#include "core/nlp/nlp_solver.h"
#include "core/ocp/cost_table.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/criteria.h"

namespace rollgait {

// What a request leaves open, by name; see rollgait.v1.Preset.
enum class Preset { kTorque, kTransport, kHuman };

// The largest estimated errors that a request allows, each the largest over time; see rollgait.v1.MaxError.
struct MaxError {
  std::optional<double> objective = {};      // as a share
  std::optional<double> angle = {};          // rad
  std::optional<double> torque = {};         // N m
  std::optional<double> contact_force = {};  // N
};

// A gait request as it comes in: any numbers. Field for field rollgait.v1.SolveSpec, which documents meaning, unit,
// default and range. An empty optional asks for the default.
struct GaitRequest {
  struct Range {
    double min = 0, max = 0;
  };
  struct Phase {
    std::vector<std::string> contacts;
    std::optional<int> intervals;
    std::optional<double> min_duration, max_duration;  // s
  };
  struct CostTerm {
    cost::Term term;
    std::optional<double> weight;
  };
  enum class Normalization { kPerDistance, kPerTime, kNone };
  enum class TouchDown { kSmooth, kPlastic };
  enum class AccuracyLevel { kDraft, kStandard, kFine };

  BodyRequest body;
  double slope = 0;  // rad
  struct Motion {
    std::optional<double> speed, step_length, step_duration;  // m/s, m, s
    bool free_speed = false;
    std::optional<Range> duty_factor;
  } motion;
  // Default: half; full where left and right of the body differ; once with a manoeuvre.
  std::optional<Cycle> cycle;
  std::optional<ManoeuvreRequest> manoeuvre;
  std::optional<std::vector<Phase>> phases;
  std::optional<Preset> preset;
  std::vector<CostTerm> costs;
  Normalization normalization = Normalization::kPerDistance;
  struct GroundContact {
    std::optional<double> friction_coefficient, min_normal_force_bw, swing_clearance;
    std::optional<Range> touch_down_point, lift_off_point;
    TouchDown touch_down = TouchDown::kSmooth;
  } ground_contact;
  struct Limits {
    std::map<std::string, Range> joint_position;
    std::map<std::string, double> joint_velocity;
    std::map<std::string, Range> joint_effort;
    bool allow_body_overlap = false;
  } limits;
  struct Discretization {
    Scheme scheme = Scheme::kRadau2;
    std::optional<int> single_support_intervals, double_support_intervals;
  } discretization;
  struct Accuracy {
    AccuracyLevel level = AccuracyLevel::kStandard;
    std::optional<double> kkt_tolerance;
    std::map<Criterion, double> bounds;  // in place of the level's
    std::optional<int> max_refinements;
    bool estimate_errors = false;
    std::optional<MaxError> max_error;
  } accuracy;
  struct SolverLimits {
    std::optional<int> max_iterations;
    std::optional<double> max_wall_time;  // s
  } solver_limits;
  NlpSolver nlp_solver = NlpSolver::kInteriorPoint;
  std::optional<int> starts;
  bool warm_start = false;        // that one is wanted; GaitSpec::warm_start is filled where solutions are stored
  std::optional<double> gravity;  // m/s²
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_GAIT_REQUEST_H_
