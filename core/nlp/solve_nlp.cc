#include "core/nlp/solve_nlp.h"

#include "core/nlp/interior_point.h"
#include "core/nlp/ipopt_solver.h"
#include "core/nlp/timed_problem.h"

namespace rollgait {

namespace {

NlpResult SolveInTurn(NlpProblem& problem, const NlpStart& start, const NlpOptions& options,
                      const SolveControl& control, const Resumption& resumption) {
  if (options.solver == NlpSolver::kIpopt) return SolveWithIpopt(problem, start, options, control);
  const InteriorPointResult first = SolveWithInteriorPoint(problem, start, options, control, resumption);
  if (!first.needs_restoration || first.result.iterations >= options.max_iterations) return first.result;
  NlpOptions rest = options;
  rest.max_iterations = options.max_iterations - first.result.iterations;
  rest.max_wall_time_s = options.max_wall_time_s - first.result.wall_time_s;
  rest.worth_finishing = nullptr;  // what restoration leads to has not been asked for
  SolveControl numbered = control;
  if (control.observer) {
    numbered.observer = [&](IterationInfo info) {
      if (info.index == 0) return;  // the point where our solver found no step, which has been reported
      info.index += first.result.iterations;
      info.elapsed_s += first.result.wall_time_s;
      info.restoration = true;
      control.observer(info);
    };
  }
  NlpResult result = SolveWithIpopt(problem, {first.result.x, {}, {}, {}}, rest, numbered);
  result.restored_from = first.result.iterations;
  result.iterations += first.result.iterations;
  result.wall_time_s += first.result.wall_time_s;
  return result;
}

}  // namespace

NlpResult SolveNlp(NlpProblem& problem, const NlpStart& start, const NlpOptions& options, const SolveControl& control,
                   const Resumption& resumption) {
  TimedProblem timed(problem);
  NlpResult result = SolveInTurn(timed, start, options, control, resumption);
  result.evaluation_time_s = timed.seconds();
  return result;
}

}  // namespace rollgait
