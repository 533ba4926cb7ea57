#include "core/gait/judge_solution.h"

namespace rollgait {
namespace {

// Of an interval of what has not converged and is not judged. human29 that was stopped after 31 iterations, 0.6 s: its
// report took 6.3 s with 2000, since nothing moves like that, and 0.6 s with 200.
constexpr int kStepsOfNoSolution = 200;

ValidationOptions JudgeOptions(const GaitSpec& spec) {
  ValidationOptions options;
  options.gravity = spec.gravity;
  options.manoeuvre = spec.manoeuvre;
  options.friction_coefficient = spec.friction_coefficient;
  options.min_normal_force = spec.min_normal_force_bw * spec.scene.model.total_mass() * spec.gravity.norm();
  return options;
}

}  // namespace

bool Converged(Termination termination) {
  return termination == Termination::kOptimal || termination == Termination::kAcceptable;
}

bool IsWithinBounds(const GaitSpec& spec, const Trajectory& trajectory) {
  const AccuracyReport report = Validate(spec.scene, trajectory, JudgeOptions(spec));
  return JudgeFindings(report.findings, spec.bounds).kind != Verdict::Kind::kExceeded;
}

void Judge(const GaitSpec& spec, GaitSolution* solution) {
  ValidationOptions options = JudgeOptions(spec);
  const bool is_solution = Converged(solution->termination);
  if (!is_solution) options.integrator_steps = kStepsOfNoSolution;
  solution->accuracy = Validate(spec.scene, *solution->trajectory, options);
  solution->verdict = is_solution ? JudgeFindings(solution->accuracy->findings, spec.bounds) : Verdict{};
}

}  // namespace rollgait
