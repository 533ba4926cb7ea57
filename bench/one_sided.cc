// Gaits of bodies whose left and right differ, cold: verdict, CPU time and what the two sides do.
//   one_sided [--model human29] [--preset human] [--draft | --fine] [--slope 0] [--right] [--iterations]
//             [CASE...]
//   one_sided --help   the cases and what they change

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "bench/measured_solve.h"
#include "bench/program_tally.h"
#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Subject {
  const char* name;
  const char* what;
  void (*change)(GaitRequest* request, const std::string& side);  // side: "_l" or "_r"
};

// A prosthetic foot of one ankle: a spring of 6 N m a degree with some damping in place of muscles, no inversion, and a
// foot that is a tenth shorter.
void PutProsthesis(GaitRequest* request, const std::string& side) {
  request->body.changes.strengths["ankle" + side] = 0;
  request->body.changes.springs["ankle" + side] = {.stiffness = 6 / kDegree, .rest = 0, .damping = 2};
  if (request->body.model == "human29") request->body.locked_joints["ankle_inversion" + side] = 0;
  request->body.segment_lengths["foot" + side] = 0.245;
}

constexpr Subject kSubjects[] = {
    {"half", "the body as it is, half cycle",
     [](GaitRequest* request, const std::string&) { request->cycle = Cycle::kHalf; }},
    {"full", "the body as it is, full cycle",
     [](GaitRequest* request, const std::string&) { request->cycle = Cycle::kFull; }},
    {"locked-ankle", "an ankle fixed at 0 degrees",
     [](GaitRequest* request, const std::string& side) { request->body.locked_joints["ankle" + side] = 0; }},
    {"short-thigh", "a thigh of 0.402 m",
     [](GaitRequest* request, const std::string& side) { request->body.segment_lengths["thigh" + side] = 0.402; }},
    {"load", "10 kg in a hand",
     [](GaitRequest* request, const std::string& side) {
       request->body.changes.loads.push_back({.segment = "hand" + side, .mass = 10, .position = {}});
     }},
    {"weak-knee", "a knee with 0.3 of its strength",
     [](GaitRequest* request, const std::string& side) { request->body.changes.strengths["knee" + side] = 0.3; }},
    {"prosthesis", "an ankle that is a spring of 6 N m/deg without muscles, its foot of 0.245 m", PutProsthesis},
};

void Print(const Subject& subject, const GaitSpec& spec, const MeasuredSolve& measured) {
  const GaitSolution& solution = measured.solution;
  const char* verdict = solution.verdict.kind == Verdict::Kind::kWithin     ? "within"
                        : solution.verdict.kind == Verdict::Kind::kExceeded ? "exceeded"
                                                                            : "not judged";
  std::printf("%-13s %-5s %-10s %7.2f %5d %10.6f", subject.name, spec.cycle == Cycle::kFull ? "full" : "half", verdict,
              measured.cpu, measured.iterations, solution.objective);
  if (solution.events) {
    const GaitEvents& events = *solution.events;
    std::printf(" %6.3f %6.3f %6.1f %6.1f %6.1f %6.1f", events.foot(Foot::kRight).step_length,
                events.foot(Foot::kLeft).step_length, 100 * events.foot(Foot::kRight).stance,
                100 * events.foot(Foot::kLeft).stance, 100 * events.foot(Foot::kRight).loading,
                100 * events.foot(Foot::kLeft).loading);
  }
  std::printf("\n    %s\n", solution.message.c_str());
  for (const MeshStatistics& mesh : solution.meshes) {
    const int intervals = std::accumulate(mesh.intervals.begin(), mesh.intervals.end(), 0);
    std::printf(
        "    %3d intervals, powers smoothed by %6.3g W: %3d iterations, %5.2f s, objective %.6f, slip %.2g m/s\n",
        intervals, mesh.smoothing, mesh.iterations, mesh.wall_time, mesh.objective, mesh.max_slip);
  }
  std::fflush(stdout);
}

void PrintIteration(const IterationInfo& i) {
  std::printf(
      "      %d %4d  %12.8f  infeasibility %8.1e %8.1e  barrier %7.1e  shift %7.1e  step %8.1e %6.4f %6.4f  trials "
      "%d%s\n",
      i.mesh, i.index, i.objective, i.primal_infeasibility, i.dual_infeasibility, i.barrier_parameter, i.regularization,
      i.step_norm, i.primal_step, i.dual_step, i.line_search_trials, i.restoration ? "  restoration" : "");
}

int Help() {
  std::printf(
      "Gaits of bodies whose left and right differ, cold: verdict, CPU time and what the two sides do.\n"
      "  one_sided [--model human29] [--preset human|transport|torque] [--draft | --fine] [--slope DEGREES] "
      "[--right] [--iterations] [CASE...]\n"
      "Cases, all of them by default, of the left side, or of the right one:\n");
  for (const Subject& subject : kSubjects) std::printf("  %-13s %s\n", subject.name, subject.what);
  return 0;
}

bool IsCase(const std::string& name) {
  return std::any_of(std::begin(kSubjects), std::end(kSubjects),
                     [&](const Subject& subject) { return name == subject.name; });
}

int Main(int argc, char** argv) {
  GaitRequest request;
  request.body.model = "human29";
  request.preset = Preset::kHuman;
  request.motion.speed = 1.3;
  std::vector<std::string> chosen;
  std::string side = "_l";
  SolveControl control;
  ProgramTally tally;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    if (flag == "--help" || flag == "-h") {
      return Help();
    } else if (flag == "--fine") {
      request.accuracy.level = GaitRequest::AccuracyLevel::kFine;
    } else if (flag == "--draft") {
      request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
    } else if (flag == "--right") {
      side = "_r";
    } else if (flag == "--iterations") {
      control.observer = PrintIteration;
    } else if (flag == "--model" && i + 1 < argc) {
      request.body.model = argv[++i];
    } else if (flag == "--slope" && i + 1 < argc) {
      request.slope = std::stod(argv[++i]) * kDegree;
    } else if (flag == "--preset" && i + 1 < argc) {
      const std::string name = argv[++i];
      request.preset = name == "torque" ? Preset::kTorque : name == "transport" ? Preset::kTransport : Preset::kHuman;
    } else if (IsCase(flag)) {
      chosen.push_back(flag);
    } else {
      std::fprintf(stderr, "one_sided: %s: no such flag or case, or its value is missing; see one_sided --help\n",
                   flag.c_str());
      return 2;
    }
  }
  std::printf("%-13s %-5s %-10s %7s %5s %10s %6s %6s %6s %6s %6s %6s\n", "subject", "cycle", "verdict", "cpu s", "iter",
              "objective", "step R", "L m", "stnc R", "L %", "dbl R", "L %");
  for (const Subject& subject : kSubjects) {
    bool wanted = chosen.empty();
    for (const std::string& name : chosen) wanted = wanted || name == subject.name;
    if (!wanted) continue;
    GaitRequest of_subject = request;
    subject.change(&of_subject, side);
    const Result<GaitSpec> spec = CheckRequest(of_subject);
    if (!spec.ok()) {
      std::printf("%-13s refused: %s %s\n", subject.name, spec.violations()[0].field.c_str(),
                  spec.violations()[0].message.c_str());
      continue;
    }
    const MeasuredSolve measured = Measure([&] { return OptimizingGaitSolver().Solve(spec.value(), control); });
    Print(subject, spec.value(), measured);
    tally.Add(measured.solution.meshes);
  }
  tally.Print();
  return 0;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) { return rollgait::Main(argc, argv); }
