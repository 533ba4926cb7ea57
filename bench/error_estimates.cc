// Whether estimated errors are true: gaits drawn at random, each with its estimate, beside a reference on a mesh of a
// quarter of the intervals' length that is reached in two halvings, each started from the one before, so that it stays
// in the same minimum.
//   error_estimates [--requests 100] [--seed 1] [--first 0] [--time-limit 60] [--max-angle DEGREES]
// Prints for every gait estimate over true error of the objective and of the largest error of angles, torques and
// contact forces, and of all the share within 0.3 … 3 and beyond 10 (or 0.1). With --max-angle: how many reach that
// error by their own word, and how many of those by the reference.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "bench/verdict_audit/random_request.h"
#include "core/gait/build_problem.h"
#include "core/gait/error_estimate.h"
#include "core/gait/judge_solution.h"
#include "core/gait/mesh_refinement.h"
#include "core/gait/mesh_sequence.h"
#include "core/gait/meshes.h"
#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

struct Options {
  audit::DrawOptions draw;
  int requests = 100, first = 0;
  double max_angle = 0;  // degrees; 0: none
};

// An error below this share of the quantity's own size is rounding and tolerance of the reference, and has no ratio.
constexpr double kFloor = 1e-6;

struct Reference {
  bool is_found = false;
  double objective = 0;  // error, as a share
  MotionDifference motion;
};

Reference Measure(const GaitSpec& spec, const GaitSolution& solution, double time_limit) {
  GaitSpec reference = spec;
  reference.max_wall_time = time_limit;
  reference.max_iterations = 1000;
  LeaveTheRest(&reference);
  const SolveControl control;
  SolveBudget budget(reference, control);
  const auto problem = BuildProblem(reference);
  GaitSolution fine = solution;
  for (int halving = 0; halving < 2; ++halving) {
    fine = SolveFromCoarser(reference, *problem, StartFrom(reference, fine), Halved(MeshOf(*fine.trajectory)), &budget);
    if (!Converged(fine.termination)) return {};
  }
  Reference measured;
  measured.is_found = true;
  measured.objective = std::abs(fine.objective / solution.objective - 1);
  measured.motion = CompareMotions(spec.scene, *solution.trajectory, *fine.trajectory);
  return measured;
}

struct Tally {
  std::vector<double> ratios;
  void Print(const char* name) const {
    if (ratios.empty()) return;
    std::vector<double> sorted = ratios;
    std::sort(sorted.begin(), sorted.end());
    const auto within = [&](double factor) {
      return std::count_if(sorted.begin(), sorted.end(), [&](double r) { return r >= 1 / factor && r <= factor; });
    };
    const auto at = [&](double share) { return sorted[static_cast<size_t>(share * (sorted.size() - 1))]; };
    std::printf(
        "%-14s %4zu gaits: %4.0f %% within 0.33 … 3, %4.0f %% within 0.1 … 10; least %.2f, 10 %% %.2f, median %.2f, "
        "90 %% %.2f, most %.2f\n",
        name, sorted.size(), 100.0 * within(3) / sorted.size(), 100.0 * within(10) / sorted.size(), sorted.front(),
        at(0.1), at(0.5), at(0.9), sorted.back());
  }
};

int Main(const Options& options) {
  const std::vector<std::pair<const char*, MotionQuantity>> shown = {
      {"angle", MotionQuantity::kAngle}, {"torque", MotionQuantity::kTorque}, {"force", MotionQuantity::kContactForce}};
  std::setvbuf(stdout, nullptr, _IOLBF, 1 << 12);
  std::map<std::string, Tally> tallies;
  int estimated = 0, claimed = 0, kept = 0, no_reference = 0;
  std::printf("%4s %-28s %7s %7s | estimate / true: %9s %9s %9s %9s | %s\n", "no", "group", "cpu s", "angle°",
              "objective", "angle", "torque", "force", "intervals");
  for (int number = options.first; number < options.first + options.requests; ++number) {
    audit::DrawnRequest drawn = audit::Draw(options.draw, number);
    drawn.request.accuracy.estimate_errors = true;
    if (options.max_angle > 0) drawn.request.accuracy.max_error = MaxError{.angle = options.max_angle / kDegrees};
    const Result<GaitSpec> spec = CheckRequest(drawn.request);
    if (!spec.ok()) continue;
    const std::clock_t begin = std::clock();
    const GaitSolution solution = OptimizingGaitSolver().Solve(spec.value(), SolveControl());
    const double cpu = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    std::printf("%4d %-28s %7.2f ", number, drawn.group.c_str(), cpu);
    if (!solution.errors) {
      std::printf("no estimate: %s\n", solution.message.c_str());
      continue;
    }
    ++estimated;
    const Reference reference = Measure(spec.value(), solution, 2 * options.draw.time_limit);
    if (!reference.is_found) {
      ++no_reference;
      std::printf("no reference\n");
      continue;
    }
    const double angle = reference.motion[static_cast<int>(MotionQuantity::kAngle)].largest;
    const bool claims = solution.errors->is_within_max_error.value_or(false);
    claimed += claims ? 1 : 0;
    kept += claims && angle * kDegrees <= options.max_angle ? 1 : 0;
    std::printf("%7.3f |                  ", angle * kDegrees);
    const auto ratio = [&](const char* name, double estimate, double error, double size) {
      if (error < kFloor * size) {
        std::printf("%9s ", "-");
        return;
      }
      tallies[name].ratios.push_back(estimate / error);
      std::printf("%9.2f ", estimate / error);
    };
    ratio("objective", solution.errors->objective, reference.objective, 1);
    for (const auto& [name, quantity] : shown) {
      const int q = static_cast<int>(quantity);
      ratio(name, solution.errors->motion[q].largest, reference.motion[q].largest, 1);
    }
    std::printf("| ");
    for (const int n : MeshOf(*solution.trajectory).Intervals()) std::printf("%d ", n);
    std::printf("\n");
  }
  std::printf("%d requests, %d with an estimate, %d without a reference\n", options.requests, estimated, no_reference);
  for (const auto& [name, tally] : tallies) tally.Print(name.c_str());
  if (options.max_angle > 0) {
    std::printf("angles to %g°: %d say that they reach it, %d of them do by the reference\n", options.max_angle,
                claimed, kept);
  }
  return 0;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) {
  rollgait::Options options;
  options.draw.level = rollgait::GaitRequest::AccuracyLevel::kStandard;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string flag = argv[i];
    const char* const value = argv[i + 1];
    if (flag == "--requests") options.requests = std::atoi(value);
    if (flag == "--first") options.first = std::atoi(value);
    if (flag == "--seed") options.draw.seed = std::strtoull(value, nullptr, 10);
    if (flag == "--time-limit") options.draw.time_limit = std::atof(value);
    if (flag == "--max-angle") options.max_angle = std::atof(value);
  }
  return rollgait::Main(options);
}
