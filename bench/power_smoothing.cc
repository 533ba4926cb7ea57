// What the smoothing of powers costs and hides: level walking at 1.3 m/s with each smoothing.
//   power_smoothing [--model planar] [--preset transport] [--intervals 16] [--slope 0]
// "at once" is the same program from the built-in guess, without the way down from 40 W.
#include <cstdio>
#include <numbers>
#include <string>
#include <variant>

#include "bench/measured_solve.h"
#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/gait/mesh_sequence.h"
#include "core/gait/meshes.h"
#include "core/gait/optimizing_gait_solver.h"
#include "core/gait/presets.h"

namespace rollgait {
namespace {

// The request with the costs of its preset, powers smoothed by `smoothing`.
GaitSpec Spec(GaitRequest request, double smoothing) {
  const Preset preset = *request.preset;
  FillFromPreset(&request);
  request.preset.reset();
  const GaitSpec body = CheckRequest(request).value();
  request.costs = PresetCosts(preset, body.scene, body.similarity);
  for (GaitRequest::CostTerm& cost : request.costs) {
    if (auto* work = std::get_if<cost::MuscleWork>(&cost.term)) work->smoothing = smoothing;
  }
  return CheckRequest(request).value();
}

int Main(int argc, char** argv) {
  GaitRequest request;
  request.body.model = "planar";
  request.preset = Preset::kTransport;
  request.motion.speed = 1.3;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.discretization.single_support_intervals = 16;
  request.starts = 1;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string flag = argv[i], value = argv[i + 1];
    if (flag == "--model") request.body.model = value;
    if (flag == "--preset") request.preset = value == "human" ? Preset::kHuman : Preset::kTransport;
    if (flag == "--intervals") request.discretization.single_support_intervals = std::stoi(value);
    if (flag == "--slope") request.slope = std::stod(value) * std::numbers::pi / 180;
  }
  std::printf("%8s | %5s %6s %9s %8s | %9s %9s | %7s %6s\n", "W", "iter", "cpu s", "objective", "step m", "work J",
              "unsmoothed", "at once", "cpu s");
  for (const double smoothing : {40.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5}) {
    const GaitSpec spec = Spec(request, smoothing);
    const MeasuredSolve run = Measure([&] { return OptimizingGaitSolver().Solve(spec, SolveControl()); });
    const SolveControl control;
    SolveBudget budget(spec, control);
    const MeasuredSolve at_once = Measure([&] {
      const auto problem = BuildProblem(spec);
      GaitSolution solution = SolveOnMeshes(spec, *problem, WalkingGuess(spec, *problem), RequestedMesh(spec), &budget);
      solution.meshes = budget.log();
      return solution;
    });
    std::printf("%8g | %5d %6.2f %9.4f %8.3f |", smoothing, run.iterations, run.cpu, run.solution.objective,
                run.solution.step_length);
    for (const CostValue& cost : run.solution.costs) {
      if (cost.name == "muscle work") std::printf(" %9.2f %9.2f", cost.value, cost.unsmoothed);
    }
    std::printf(" | %7d %6.2f%s%s\n", at_once.iterations, at_once.cpu,
                Converged(at_once.solution.termination) ? "" : " not converged",
                Converged(run.solution.termination) ? "" : "; the way down neither");
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) { return rollgait::Main(argc, argv); }
