#include "server/solve/local_solve.h"

#include <google/protobuf/util/json_util.h>
#include <sys/resource.h>

#include <cstdio>
#include <ostream>

#include "server/base/solver_build.h"
#include "server/convert/gait_request_convert.h"
#include "server/convert/result_convert.h"

namespace rollgait::server {
namespace {

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

void PrintIteration(const IterationInfo& iteration, std::ostream& progress) {
  char line[200];
  std::snprintf(line, sizeof line,
                "%2d %5d  f %12.6e  primal %8.2e  dual %8.2e  mu %7.1e  step %7.1e  alpha %5.3f %s%.3f s\n",
                iteration.mesh, iteration.index, iteration.objective, iteration.primal_infeasibility,
                iteration.dual_infeasibility, iteration.barrier_parameter, iteration.step_norm, iteration.primal_step,
                iteration.restoration ? "restoration " : "", iteration.elapsed_s);
  progress << line << std::flush;
}

}  // namespace

LocalExit SolveLocally(const std::string& json, GaitSolver& solver, const StopFlag& stop, std::ostream& out,
                       std::ostream& progress) {
  v1::SolveSpec request;
  const auto parsed = google::protobuf::util::JsonStringToMessage(json, &request);
  if (!parsed.ok()) {
    progress << "not a SolveSpec in proto3 JSON: " << parsed.ToString() << "\n";
    return kLocalBadRequest;
  }
  if (!request.warm_start().empty()) {
    progress << "warm_start: is \"" << request.warm_start()
             << "\"; only a server has stored solves: ask one with `rollgait solve`\n";
    return kLocalBadRequest;
  }
  const Result<GaitSpec> spec = DecodeSpec(request);
  if (!spec.ok()) {
    for (const Violation& violation : spec.violations())
      progress << violation.field << ": " << violation.message << "\n";
    return kLocalBadRequest;
  }
  SolveControl control;
  control.stop = &stop;
  control.observer = [&](const IterationInfo& iteration) { PrintIteration(iteration, progress); };
  const GaitSolution solution = solver.Solve(spec.value(), control);

  v1::SolveResult result = EncodeResult(solution, spec.value());
  result.set_solver_build(SolverBuild());
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  result.set_cpu_time_s(Seconds(usage.ru_utime) + Seconds(usage.ru_stime));
  result.set_peak_memory_bytes(int64_t{1024} * usage.ru_maxrss);
  google::protobuf::util::JsonPrintOptions options;
  options.add_whitespace = true;
  std::string text;
  const auto printed = google::protobuf::util::MessageToJsonString(result, &text, options);
  out << text << std::flush;
  if (!printed.ok() || !out) {
    progress << "the result cannot be written: " << printed.ToString() << "\n";
    return kLocalFailed;
  }
  const bool is_judged = solution.verdict.kind != Verdict::Kind::kNotJudged;
  const bool was_cut = solution.termination == Termination::kTimeLimit && is_judged &&
                       (solution.verdict.kind == Verdict::Kind::kExceeded || solution.unmet_constraints.empty());
  const bool solved = solution.termination == Termination::kOptimal || solution.termination == Termination::kAcceptable;
  if (!solved && !was_cut) return kLocalNoSolution;
  return solution.verdict.kind == Verdict::Kind::kExceeded ? kLocalMissesBound : kLocalSolved;
}

}  // namespace rollgait::server
