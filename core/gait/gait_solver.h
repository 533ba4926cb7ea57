#ifndef ROLLGAIT_CORE_GAIT_GAIT_SOLVER_H_
#define ROLLGAIT_CORE_GAIT_GAIT_SOLVER_H_

#include <optional>
#include <string>
#include <vector>

#include "core/gait/gait_spec.h"
#include "core/gait/start_of.h"
#include "core/nlp/result.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/gait_events.h"
#include "core/validation/motion_difference.h"
#include "core/validation/normative.h"
#include "core/validation/report.h"

namespace rollgait {

// One term of the cost at the solution; see rollgait.v1.CostValue.
struct CostValue {
  std::string name;
  double weight = 0;
  double value = 0;
  std::string unit;
  double contribution = 0;
  double unsmoothed = 0;
};

struct UnmetConstraint {
  std::string name;
  int phase = 0;
  double time = 0;       // s
  double violation = 0;  // in unit
  std::string unit;
};

struct MeshStatistics {
  // What the program is, beside its mesh and `smoothing`, and what it started from.
  StartOf start = StartOf::kGuess;
  double slope = 0, kkt_tolerance = 0;
  Cycle cycle = Cycle::kFull;
  bool has_sides_alike = false, has_added_rates = false;  // as in GaitSpec
  // How it ended, and why in a sentence.
  Termination termination = Termination::kNumericalDifficulty;
  std::string message;
  std::vector<int> intervals;
  int unknowns = 0, constraints = 0, jacobian_nonzeros = 0, hessian_nonzeros = 0, iterations = 0;
  double wall_time = 0, evaluation_time = 0, objective = 0, kkt_error = 0, max_gap = 0, max_slip = 0;
  double smoothing = 0;     // W, of the powers in the costs; 0: none
  bool for_errors = false;  // solved to estimate the errors of a solution on a coarser mesh
};

// The solution of the same problem on a finer mesh, beside which the errors of a solution are estimated.
struct FinerSolution {
  Trajectory trajectory;
  double objective = 0, speed = 0, step_length = 0;
  std::vector<int> intervals;
};

// Estimates of |value − the value that ever finer meshes approach|; see rollgait.v1.ErrorEstimate.
struct ErrorEstimate {
  double objective = 0;                     // as a share of the objective
  double duration = 0;                      // s, of the trajectory
  std::vector<double> phase_durations;      // s
  double speed = 0, step_length = 0;        // m/s, m
  MotionDifference motion;                  // at equal fractions of the phases
  std::vector<int> finer_intervals;         // of the mesh that the solution was compared with
  std::optional<bool> is_within_max_error;  // absent: the request allows any
};

// What a solve gives back, whatever its termination.
struct GaitSolution {
  bool within_requested_accuracy() const { return verdict.kind == Verdict::Kind::kWithin; }

  Termination termination = Termination::kNumericalDifficulty;
  std::string message;
  std::string note;  // how it was reached, where not at once; the end of the message of a whole solve
  std::optional<Trajectory> trajectory;          // present if the last iterate is finite
  std::optional<AccuracyReport> accuracy;        // present with the trajectory
  std::optional<GaitEvents> events;              // present with a trajectory of a human that walks
  std::optional<NormativeComparison> normative;  // of the right leg; present with events
  // Of the left leg, from its heel strike on; present where left and right of the body differ.
  std::optional<NormativeComparison> normative_left;
  std::optional<FinerSolution> finer;   // where the request asks for errors and it was found
  std::optional<ErrorEstimate> errors;  // present with `finer`
  Verdict verdict;                      // of a converged solution; not judged otherwise
  double objective = 0;
  double kkt_error = 0;
  double constraint_violation = 0;
  std::vector<CostValue> costs;
  std::vector<UnmetConstraint> unmet_constraints;
  // Every program so far, of a solution that is given back or offered (SolveBudget::log); empty inside a search.
  std::vector<MeshStatistics> meshes;
  double speed = 0, step_length = 0;               // m/s, m; of a manoeuvre along x
  std::optional<SolutionMultipliers> multipliers;  // present with a trajectory of a gait
  AddedConstraints added;                          // of the last NLP, whose multipliers these are
  bool warm_started = false;                       // reached from the warm start of the spec
  bool used_multipliers = false;                   // whose multipliers fitted
  std::optional<Scene> scene;  // in whose joints the trajectory is, if not those of the request's scene
  double wall_time = 0;        // s
};

// Turns a checked request into a trajectory with an accuracy report. Blocks; one solve at a time in a process (MUMPS).
class GaitSolver {
 public:
  virtual ~GaitSolver() = default;
  virtual GaitSolution Solve(const GaitSpec& spec, const SolveControl& control) = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_GAIT_SOLVER_H_
