// What a warm start saves: neighbours of level walking at 1.3 m/s, from the built-in guess and from its solution.
//   warm_start [--model planar] [--preset human] [--intervals 20] [--double 10] [--standard]
// Without a preset: squared torque with a little rate. CPU time of the whole solve, judgement included.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "bench/measured_solve.h"
#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

MeasuredSolve Solve(const GaitSpec& spec) {
  return Measure([&spec] { return OptimizingGaitSolver().Solve(spec, SolveControl()); });
}

void Print(const MeasuredSolve& run) {
  std::printf(" | %4d %6.2f %12.5f%s", run.iterations, run.cpu, run.solution.objective,
              run.solution.termination == Termination::kOptimal ? "" : " not optimal");
}

int Main(int argc, char** argv) {
  GaitRequest request;
  request.body.model = "planar";
  request.motion.speed = 1.3;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.discretization.single_support_intervals = 20;
  request.discretization.double_support_intervals = 10;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    if (flag == "--standard") request.accuracy.level = GaitRequest::AccuracyLevel::kStandard;
    if (i + 1 >= argc) continue;
    const std::string value = argv[i + 1];
    if (flag == "--model") request.body.model = value;
    if (flag == "--intervals") request.discretization.single_support_intervals = std::stoi(value);
    if (flag == "--double") request.discretization.double_support_intervals = std::stoi(value);
    if (flag == "--preset") {
      request.preset = value == "human" ? Preset::kHuman : value == "transport" ? Preset::kTransport : Preset::kTorque;
    }
  }
  request.starts = 1;
  if (!request.preset) {
    request.costs = {{cost::SquaredTorque{}, 1.0}, {cost::SquaredTorqueRate{}, 1e-4}};
  }
  const Result<GaitSpec> level = CheckRequest(request);
  if (!level.ok()) {
    std::fprintf(stderr, "%s: %s\n", level.violations()[0].field.c_str(), level.violations()[0].message.c_str());
    return 2;
  }
  const MeasuredSolve base = Solve(level.value());
  std::printf("%6s %6s | %4s %6s %12s | %4s %6s %12s\n", "slope", "m/s", "cold", "cpu s", "objective", "warm", "cpu s",
              "objective");
  std::printf("%6g %6g", 0.0, 1.3);
  Print(base);
  std::printf("\n");
  const double neighbours[][2] = {{1, 0}, {-1, 0}, {0, 0.05}, {0, -0.05}, {5, 0}, {-5, 0}};
  for (const auto& [degrees, speed] : neighbours) {
    request.slope = degrees * std::numbers::pi / 180;
    request.motion.speed = 1.3 + speed;
    request.warm_start = false;
    std::printf("%6g %6g", degrees, *request.motion.speed);
    Print(Solve(CheckRequest(request).value()));
    request.warm_start = true;
    GaitSpec spec = CheckRequest(request).value();
    spec.warm_start = WarmStart{*base.solution.trajectory, base.solution.multipliers, base.solution.added};
    Print(Solve(spec));
    std::printf("\n");
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) { return rollgait::Main(argc, argv); }
