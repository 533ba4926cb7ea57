// Order of convergence under mesh refinement: the planar gait on uniform meshes, all started from one solution on a
// fine mesh.
//   convergence [--slope 10] [--base 16] [--levels 5] [--rate 0] [--smooth]
// Prints, per scheme, the error of the objective against the finest mesh of the scheme of highest order, the defects on
// re-integration, gap and slip, and the orders log2(error/next error) beside the theoretical order of the scheme.

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "core/gait/build_problem.h"
#include "core/gait/initial_guess.h"
#include "core/nlp/solve_nlp.h"
#include "core/validation/report.h"

namespace rollgait {
namespace {

struct Level {
  int intervals;
  double objective, position, velocity, gap, slip;
  Termination termination;
  int iterations;
};

// Mesh of 2^level · base intervals in single support, half of it in double support.
std::vector<Level> Run(const GaitSpec& spec, Scheme scheme, const Trajectory& start, int base, int levels) {
  const auto problem = BuildProblem(spec);
  const MotionGuess guess = GuessFromTrajectory(start);
  std::vector<Level> table;
  for (int level = 0; level < levels; ++level) {
    const int n = base << level;
    const Mesh mesh = Mesh::Uniform({n / 2, n});
    CollocationNlp nlp(*problem, scheme, mesh);
    NlpOptions options;
    options.tolerance = 1e-7;
    options.initial_barrier = 1e-4;
    const NlpResult result = SolveNlp(nlp, {nlp.MakeStart(guess), {}, {}, {}}, options, {});
    const Trajectory trajectory = nlp.Extract(result.x.data());
    ValidationOptions judge;
    judge.gravity = spec.gravity;
    judge.integrator_tolerance = 1e-12;
    const AccuracyReport report = Validate(spec.scene, trajectory, judge);
    table.push_back({n, result.objective / nlp.objective_scale(), report.max_position_defect,
                     report.max_velocity_defect, report.max_gap, report.max_slip, result.termination,
                     result.iterations});
  }
  return table;
}

void Print(const char* name, int order, const std::vector<Level>& table, double reference) {
  std::printf("%s, order %d\n  %5s %5s %14s | %10s %5s | %10s %5s | %10s %5s | %10s %5s | %10s %5s\n", name, order, "N",
              "iter", "objective", "error", "order", "defect q", "order", "defect v", "order", "gap m", "order",
              "slip m/s", "order");
  for (size_t i = 0; i < table.size(); ++i) {
    const auto order_of = [&](auto value) {
      return i == 0 ? std::nan("") : std::log2(value(table[i - 1]) / value(table[i]));
    };
    const auto error = [&](const Level& l) { return std::abs(l.objective / reference - 1); };
    const Level& l = table[i];
    std::printf("  %5d %5d %14.7f | %10.2e %5.1f | %10.2e %5.1f | %10.2e %5.1f | %10.2e %5.1f | %10.2e %5.1f%s\n",
                l.intervals, l.iterations, l.objective, error(l), order_of(error), l.position,
                order_of([](const Level& x) { return x.position; }), l.velocity,
                order_of([](const Level& x) { return x.velocity; }), l.gap,
                order_of([](const Level& x) { return x.gap; }), l.slip, order_of([](const Level& x) { return x.slip; }),
                l.termination == Termination::kOptimal ? "" : "  not optimal");
  }
}

int Main(int argc, char** argv) {
  double slope = 10, rate = 0;
  int base = 16, levels = 5;
  bool smooth = false;
  for (int i = 1; i < argc; ++i) smooth |= std::string(argv[i]) == "--smooth";
  for (int i = 1; i + 1 < argc; ++i) {
    const std::string flag = argv[i];
    if (flag == "--slope") slope = std::stod(argv[i + 1]);
    if (flag == "--base") base = std::stoi(argv[i + 1]);
    if (flag == "--levels") levels = std::stoi(argv[i + 1]);
    if (flag == "--rate") rate = std::stod(argv[i + 1]);
  }
  GaitRequest request;
  request.body.model = "planar";
  request.slope = slope * std::numbers::pi / 180;
  request.motion.speed = 1.3;
  request.costs.push_back({cost::SquaredTorque{}, 1.0});
  if (smooth) {
    // Nothing switches within a phase: limits and cones so wide that none is active.
    request.ground_contact.friction_coefficient = 5;
    request.ground_contact.swing_clearance = 0;
    for (const char* joint : {"hip_l", "knee_l", "ankle_l", "hip_r", "knee_r", "ankle_r"}) {
      request.limits.joint_position[joint] = {-2.5, 2.5};
      request.limits.joint_effort[joint] = {-2000, 2000};
      request.limits.joint_velocity[joint] = 100;
    }
  }
  if (rate > 0) request.costs.push_back({cost::SquaredTorqueRate{}, rate});
  const Result<GaitSpec> spec = CheckRequest(request);
  if (!spec.ok()) return 1;
  // All schemes start from the same solution, so that they stay in one local minimum.
  const auto problem = BuildProblem(spec.value());
  CollocationNlp nlp(*problem, Scheme::kRadau3, Mesh::Uniform({32, 64}));
  const NlpResult first =
      SolveNlp(nlp, {nlp.MakeStart(WalkingGuess(spec.value(), *problem)), {}, {}, {}}, NlpOptions(), {});
  if (first.termination != Termination::kOptimal) return 1;
  const Trajectory start = nlp.Extract(first.x.data());
  std::printf("start: radau3, N 64, objective %.7f, double support %.4f s, single support %.4f s\n",
              first.objective / nlp.objective_scale(), start.phases[0].duration, start.phases[1].duration);
  std::fflush(stdout);
  const auto radau3 = Run(spec.value(), Scheme::kRadau3, start, base, levels);
  const double reference = radau3.back().objective;
  Print("radau3", 5, radau3, reference);
  std::fflush(stdout);
  Print("hermite-simpson", 4, Run(spec.value(), Scheme::kHermiteSimpson, start, base, levels), reference);
  std::fflush(stdout);
  Print("radau2", 3, Run(spec.value(), Scheme::kRadau2, start, base, levels), reference);
  return 0;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) { return rollgait::Main(argc, argv); }
