// What each reduction of the human saves, and what it changes in the answer.
//   reductions [--preset human] [--slope 0] [--speed 1.3] [--intervals 10] [--draft] [--starts 1]
// Objective, unknowns (first mesh), iterations (all meshes), CPU time of the solve, and the largest difference of the
// angles of hip, knee and ankle over the gait cycle from those of the first row.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/gait/optimizing_gait_solver.h"
#include "core/validation/gait_cycle.h"

namespace rollgait {
namespace {

constexpr int kSamples = 101;
constexpr std::array<const char*, 3> kJoints = {"hip", "knee", "ankle"};
using Angles = std::array<std::vector<double>, 3>;  // degrees

struct Reduction {
  const char* name;
  std::function<void(BodyRequest*)> apply;
};

const std::vector<Reduction>& Reductions() {
  static const std::vector<Reduction> list = {
      {"29 DoF, two ellipsoids a foot", [](BodyRequest*) {}},
      {"arms hang", [](BodyRequest* body) { body->drop_arms = true; }},
      {"trunk rigid", [](BodyRequest* body) { body->rigid_trunk = true; }},
      {"arms and trunk one lump", [](BodyRequest* body) { body->drop_arms = body->rigid_trunk = true; }},
      {"sagittal plane", [](BodyRequest* body) { body->sagittal = true; }},
      {"sagittal, arms and trunk one lump",
       [](BodyRequest* body) { body->sagittal = body->drop_arms = body->rigid_trunk = true; }},
      {"one ellipsoid a foot", [](BodyRequest* body) { body->feet = FootShape::kOneEllipsoid; }},
      {"toe joints", [](BodyRequest* body) { body->toes = true; }},
      {"toe joints, sagittal plane", [](BodyRequest* body) { body->toes = body->sagittal = true; }},
  };
  return list;
}

std::optional<Angles> LegAngles(const Scene& scene, const Trajectory& trajectory) {
  const std::optional<GaitCycle> cycle = GaitCycle::Of(scene, trajectory);
  if (!cycle) return std::nullopt;
  Angles angles;
  for (int i = 0; i < kSamples; ++i) {
    const MotionSample sample = cycle->At(100.0 * i / (kSamples - 1));
    for (size_t j = 0; j < kJoints.size(); ++j) {
      angles[j].push_back(sample.position[LegJoint(scene.model, kJoints[j], BodySide::kRight)] * 180 /
                          std::numbers::pi);
    }
  }
  return angles;
}

double LargestDifference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

int Main(int argc, char** argv) {
  GaitRequest request;
  request.body.model = "human29";
  request.body.feet = FootShape::kTwoEllipsoids;
  request.preset = Preset::kHuman;
  request.motion.speed = 1.3;
  request.starts = 1;
  request.discretization.single_support_intervals = 10;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    if (flag == "--draft") request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
    if (i + 1 >= argc) continue;
    if (flag == "--preset") {
      const std::string name = argv[++i];
      request.preset = name == "torque" ? Preset::kTorque : name == "transport" ? Preset::kTransport : Preset::kHuman;
    }
    if (flag == "--slope") request.slope = std::stod(argv[++i]) * std::numbers::pi / 180;
    if (flag == "--speed") request.motion.speed = std::stod(argv[++i]);
    if (flag == "--intervals") request.discretization.single_support_intervals = std::stoi(argv[++i]);
    if (flag == "--starts") request.starts = std::stoi(argv[++i]);
  }
  std::printf("%-34s | %4s %8s %5s %7s %10s | %6s %6s %6s | %s\n", "body", "DoF", "unknowns", "iter", "CPU s",
              "objective", "hip", "knee", "ankle", "end");
  std::optional<Angles> whole;
  bool all = true;
  for (const Reduction& reduction : Reductions()) {
    GaitRequest reduced = request;
    reduction.apply(&reduced.body);
    const Result<GaitSpec> spec = CheckRequest(reduced);
    if (!spec.ok()) {
      for (const Violation& v : spec.violations()) std::fprintf(stderr, "%s: %s\n", v.field.c_str(), v.message.c_str());
      return 1;
    }
    const std::clock_t begin = std::clock();
    const GaitSolution solution = OptimizingGaitSolver().Solve(spec.value(), SolveControl());
    const double cpu = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    const bool optimal = solution.termination == Termination::kOptimal;
    all &= optimal;
    int iterations = 0;
    for (const MeshStatistics& mesh : solution.meshes) iterations += mesh.iterations;
    std::optional<Angles> angles;
    if (optimal) angles = LegAngles(spec.value().scene, *solution.trajectory);
    if (&reduction == &Reductions().front()) whole = angles;
    std::printf("%-34s | %4d %8d %5d %7.2f %10.4f |", reduction.name, spec.value().scene.model.size(),
                solution.meshes.empty() ? 0 : solution.meshes.front().unknowns, iterations, cpu, solution.objective);
    for (size_t j = 0; j < kJoints.size(); ++j) {
      std::printf(" %5.1f°", whole && angles ? LargestDifference((*whole)[j], (*angles)[j]) : std::nan(""));
    }
    std::printf(" | %s\n", optimal ? solution.within_requested_accuracy() ? "optimal" : "optimal, not accurate"
                                   : solution.message.c_str());
    std::fflush(stdout);
  }
  return all ? 0 : 1;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) { return rollgait::Main(argc, argv); }
