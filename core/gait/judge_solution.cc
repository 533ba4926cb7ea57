#include "core/gait/judge_solution.h"

namespace rollgait {
namespace {

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
  solution->accuracy = Validate(spec.scene, *solution->trajectory, JudgeOptions(spec));
  solution->verdict =
      Converged(solution->termination) ? JudgeFindings(solution->accuracy->findings, spec.bounds) : Verdict{};
}

}  // namespace rollgait
