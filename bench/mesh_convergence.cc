// Whether the optimum of a preset is one of the motion and not of the mesh: the same request on ever finer uniform
// meshes with every scheme, at draft accuracy (no refinement).
//   mesh_convergence [--models planar,human29] [--slopes -10,0,10] [--schemes radau2,radau3,hermite-simpson]
//                    [--intervals 64,128,256,512] [--preset human] [--verbose]
// --intervals are those of each single-support phase; each double-support phase has half as many. --slopes in degrees.
// Each mesh is a request of its own: from the built-in guess on a coarse mesh, then by mesh continuation (core/gait),
// each mesh warm-started from the coarser one. Columns: intervals in all; change of the objective from the mesh before;
// KKT error; normal force of the heel that is lifted at the instant of lift-off (the largest if there are several) and
// one interval earlier, with the order log2(force before/force); iterations on the mesh asked for and with the coarser
// ones; CPU time of all. Then, for each model and slope, the largest change between the last two meshes and how far
// apart the schemes are on the finest common mesh. Exit code 1 if one of them is above 0.2 % or a mesh did not
// converge.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "bench/measured_solve.h"
#include "core/gait/judge_solution.h"
#include "core/gait/optimizing_gait_solver.h"
#include "core/trajectory/sampling.h"

namespace rollgait {
namespace {

constexpr double kMostDifference = 2e-3;  // as a share of the objective

struct Options {
  std::vector<std::string> models = {"planar", "human29"}, slopes = {"-10", "0", "10"},
                           schemes = {"radau2", "radau3", "hermite-simpson"}, intervals = {"64", "128", "256", "512"};
  Preset preset = Preset::kHuman;
  bool verbose = false;
};

std::vector<std::string> Split(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

// Scheme, preset: false if there is none of that name.
bool Find(const std::string& name, Scheme* scheme) {
  const SchemeTraits* traits = FindScheme(name);
  if (traits != nullptr) *scheme = traits->scheme;
  return traits != nullptr;
}

bool Find(const std::string& name, Preset* preset) {
  static const std::map<std::string, Preset> kPresets = {
      {"torque", Preset::kTorque}, {"transport", Preset::kTransport}, {"human", Preset::kHuman}};
  const auto found = kPresets.find(name);
  if (found == kPresets.end()) return false;
  *preset = found->second;
  return true;
}

void PrintIteration(const IterationInfo& i) {
  std::fprintf(stderr, "  %4d f %.8e pr %.2e du %.2e mu %.1e reg %.1e ap %.2e ad %.2e%s\n", i.index, i.objective,
               i.primal_infeasibility, i.dual_infeasibility, i.barrier_parameter, i.regularization, i.primal_step,
               i.dual_step, i.restoration ? " R" : "");
}

// Normal force in N of the heel that the next phase gives up, at the end of the last interval and at its start; the
// larger ones where several phases end so.
struct LiftOffForce {
  double at = 0, before = 0;
};

LiftOffForce HeelLiftOff(const Scene& scene, const Trajectory& trajectory) {
  LiftOffForce force;
  for (size_t p = 0; p + 1 < trajectory.phases.size(); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    const std::vector<int>& next = trajectory.phases[p + 1].contacts;
    const int last = static_cast<int>(phase.node_times.size()) - 2;
    for (size_t c = 0; c < phase.contacts.size(); ++c) {
      const bool is_heel = scene.contacts[phase.contacts[c]].name.find("heel") != std::string::npos;
      if (!is_heel || std::find(next.begin(), next.end(), phase.contacts[c]) != next.end()) continue;
      const int normal = 3 * static_cast<int>(c) + 2;
      force.at = std::max(force.at, std::abs(Sample(trajectory, static_cast<int>(p), last, 1).forces(normal)));
      force.before = std::max(force.before, std::abs(Sample(trajectory, static_cast<int>(p), last, 0).forces(normal)));
    }
  }
  return force;
}

struct RowOfMeshes {
  std::vector<double> objectives;
  bool all_converged = true;
};

// Every mesh with one scheme.
RowOfMeshes SolveMeshes(const Options& options, const std::string& model, const std::string& slope,
                        const std::string& scheme) {
  GaitRequest request;
  request.body.model = model;
  request.preset = options.preset;
  request.starts = 1;
  request.slope = std::stod(slope) * std::numbers::pi / 180;
  request.motion.speed = 1.3;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  RowOfMeshes row;
  LiftOffForce last_force;
  if (!Find(scheme, &request.discretization.scheme)) std::exit(2);
  for (const std::string& count : options.intervals) {
    request.discretization.single_support_intervals = std::stoi(count);
    request.discretization.double_support_intervals = std::max(1, std::stoi(count) / 2);
    const Result<GaitSpec> checked = CheckRequest(request);
    if (!checked.ok()) {
      for (const Violation& v : checked.violations())
        std::fprintf(stderr, "%s: %s\n", v.field.c_str(), v.message.c_str());
      std::exit(2);
    }
    const GaitSpec& spec = checked.value();
    SolveControl control;
    if (options.verbose) control.observer = PrintIteration;
    const MeasuredSolve measured = Measure([&] { return OptimizingGaitSolver().Solve(spec, control); });
    const GaitSolution& solution = measured.solution;
    if (!solution.trajectory) {
      std::printf("%-8s %5s %-15s %4s %s\n", model.c_str(), slope.c_str(), scheme.c_str(), count.c_str(),
                  solution.message.c_str());
      row.all_converged = false;
      return row;
    }
    const LiftOffForce force = HeelLiftOff(spec.scene, *solution.trajectory);
    int all = 0;
    for (const int in_phase : solution.meshes.back().intervals) all += in_phase;
    const bool first = row.objectives.empty();
    const double change = first ? std::nan("") : 100 * (solution.objective / row.objectives.back() - 1);
    const double order = first ? std::nan("") : std::log2(last_force.before / force.before);
    std::printf("%-8s %5s %-15s %4s %4d %10.6f %8.3f %8.1e | %8.1e %8.2f %6.2f | %5d %5d %7.1f %s\n", model.c_str(),
                slope.c_str(), scheme.c_str(), count.c_str(), all, solution.objective, change, solution.kkt_error,
                force.at, force.before, order, solution.meshes.back().iterations, measured.iterations, measured.cpu,
                solution.termination == Termination::kOptimal ? "optimal" : solution.message.c_str());
    std::fflush(stdout);
    row.all_converged &= Converged(solution.termination);
    row.objectives.push_back(solution.objective);
    last_force = force;
  }
  return row;
}

// Prints how far the optimum still moves; whether it does not.
bool Judge(const std::string& model, const std::string& slope, const std::vector<RowOfMeshes>& rows) {
  bool good = true;
  size_t common = rows.front().objectives.size();
  for (const RowOfMeshes& row : rows) {
    common = std::min(common, row.objectives.size());
    good &= row.all_converged;
  }
  double change = 0, least = kInfinity, most = -kInfinity;
  for (const RowOfMeshes& row : rows) {
    const size_t count = row.objectives.size();
    if (count > 1) change = std::max(change, std::abs(row.objectives[count - 1] / row.objectives[count - 2] - 1));
    if (common == 0) continue;
    least = std::min(least, row.objectives[common - 1]);
    most = std::max(most, row.objectives[common - 1]);
  }
  if (common == 0) return false;
  std::printf("%-8s %5s: last two meshes differ by %.3f %% at most, schemes by %.3f %%\n", model.c_str(), slope.c_str(),
              100 * change, 100 * (most / least - 1));
  std::fflush(stdout);
  return good && change <= kMostDifference && most / least - 1 <= kMostDifference;
}

int Main(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    if (flag == "--verbose") {
      options.verbose = true;
      continue;
    }
    const std::string value = i + 1 < argc ? argv[++i] : "";
    Scheme scheme;
    if (flag == "--models") {
      options.models = Split(value);
    } else if (flag == "--slopes") {
      options.slopes = Split(value);
    } else if (flag == "--schemes") {
      options.schemes = Split(value);
    } else if (flag == "--intervals") {
      options.intervals = Split(value);
    } else if (flag != "--preset" || !Find(value, &options.preset)) {
      std::fprintf(stderr, "%s %s: not understood; the flags are named at the top of bench/mesh_convergence.cc\n",
                   flag.c_str(), value.c_str());
      return 2;
    }
    for (const std::string& name : options.schemes) {
      if (Find(name, &scheme)) continue;
      std::fprintf(stderr, "--schemes %s: not known; rollgait solve --help lists them\n", name.c_str());
      return 2;
    }
  }
  std::printf("%-8s %5s %-15s %4s %4s %10s %8s %8s | %8s %8s %6s | %5s %5s %7s\n", "model", "slope", "scheme", "N",
              "all", "objective", "change %", "KKT", "heel N", "before N", "order", "iter", "total", "cpu s");
  bool good = true;
  for (const std::string& model : options.models) {
    for (const std::string& slope : options.slopes) {
      std::vector<RowOfMeshes> rows;
      for (const std::string& scheme : options.schemes) rows.push_back(SolveMeshes(options, model, slope, scheme));
      good &= Judge(model, slope, rows);
    }
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) { return rollgait::Main(argc, argv); }
