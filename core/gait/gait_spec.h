#ifndef ROLLGAIT_CORE_GAIT_GAIT_SPEC_H_
#define ROLLGAIT_CORE_GAIT_GAIT_SPEC_H_

#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/gait/gait_request.h"
#include "core/gait/similarity.h"
#include "core/gait/warm_start.h"
#include "core/models/catalog.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/criteria.h"

namespace rollgait {

// A request that has been checked and completed: every default filled in, every name resolved, the scene built.
// Made only by CheckRequest, without a warm start. Immutable value.
struct GaitSpec {
  struct Phase {
    std::vector<int> contacts;  // indices into scene.contacts
    int intervals;
    double min_duration, max_duration;
  };
  struct CostTerm {
    cost::Term term;  // optionals inside are filled
    double weight;
  };
  Scene scene;            // limits of the request already applied to its joints
  Similarity similarity;  // of the body and the gravity, which defaults and presets followed
  Units units = {};       // that the numbers here count (InUnits)
  double passive_scale;   // factor on measured passive torques: a preset takes them to the gravity of the request
  double slope;
  Vector3 gravity;                                          // world axes, m/s²
  std::optional<double> speed, step_length, step_duration;  // prescribed ones
  GaitRequest::Range speed_range, step_length_range, step_duration_range;
  std::optional<GaitRequest::Range> duty_factor;
  Cycle cycle;
  bool is_full_by_body = false;        // the request left the cycle open, and left and right of its body differ
  std::optional<Manoeuvre> manoeuvre;  // of a rolling body, in one phase; the motion prescribed above means nothing
  std::vector<Phase> phases;
  std::vector<CostTerm> costs;
  GaitRequest::Normalization normalization;
  double friction_coefficient, min_normal_force_bw, swing_clearance;
  std::optional<GaitRequest::Range> touch_down_point, lift_off_point;
  GaitRequest::TouchDown touch_down;
  Scheme scheme;
  double kkt_tolerance;
  bool allow_body_overlap;  // bodies may pass through each other; the bound of the overlap is then infinite
  CriterionValues bounds;   // all infinite: the trajectory is not judged
  int max_refinements;
  bool estimate_errors = false;       // true with a max_error
  std::optional<MaxError> max_error;  // at least one is set
  // Its solution only starts another program: what it violates is left to that one (LeaveTheRest).
  bool is_only_a_start = false;
  // What its program differs by from that of the request, for the log of programs.
  bool has_sides_alike = false;  // the body lacks what makes its sides differ
  bool has_added_rates = false;  // squared rates of torques were added to the costs
  NlpSolver nlp_solver;
  int max_iterations;
  double max_wall_time;
  int starts;
  std::optional<WarmStart> warm_start;  // passes CheckWarmStart
  // Of a body whose left and right differ, in full cycles: the same request for the body without what
  // makes them differ (WithSidesAlike), where there is one. Shared: it does not change, and specs are copied often.
  std::shared_ptr<const GaitSpec> symmetric = nullptr;
};

// Makes it a spec whose solution only starts another program.
inline void LeaveTheRest(GaitSpec* spec) {
  spec->max_refinements = 0;
  spec->is_only_a_start = true;
}

// Checks every field before any work starts. Violations name the fields as in the proto, relative to the spec.
Result<GaitSpec> CheckRequest(const GaitRequest& request);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_GAIT_SPEC_H_
