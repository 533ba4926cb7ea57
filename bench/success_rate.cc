// How often the built-in start converges: both sexes, statures, masses, slopes; iterations and time of each request,
// and of all programs by where they started.
//   success_rate [--model planar] [--preset human] [--starts 1] [--standard] [--intervals 10] [--scheme radau2]
//                [--slopes -10,0,10] [--statures 1.5,1.67,1.83,2.0] [--masses 45,82.5,120]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "bench/measured_solve.h"
#include "bench/program_tally.h"
#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

std::vector<double> Numbers(const std::string& text) {
  std::vector<double> numbers;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) numbers.push_back(std::stod(part));
  return numbers;
}

struct Outcome {
  bool optimal, accurate;
  int iterations;
  double cpu;  // s
};

Outcome Solve(const GaitSpec& spec, ProgramTally* tally, std::string* why) {
  const MeasuredSolve measured = Measure([&] { return OptimizingGaitSolver().Solve(spec, SolveControl()); });
  const GaitSolution& solution = measured.solution;
  const Outcome outcome{solution.termination == Termination::kOptimal, solution.within_requested_accuracy(),
                        measured.iterations, measured.cpu};
  tally->Add(solution.meshes);
  if (!outcome.optimal || !outcome.accurate) *why = solution.message;
  if (solution.message.find("continuation") != std::string::npos) *why = "by continuation";
  return outcome;
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

int Main(int argc, char** argv) {
  GaitRequest request;
  request.body.model = "planar";
  request.motion.speed = 1.3;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  std::vector<double> slopes = {-10, 0, 10}, statures = {1.5, 1.67, 1.83, 2.0}, masses = {45, 82.5, 120};
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    if (flag == "--standard") request.accuracy.level = GaitRequest::AccuracyLevel::kStandard;
    if (i + 1 >= argc) continue;
    if (flag == "--model") request.body.model = argv[++i];
    if (flag == "--preset") {
      const std::string name = argv[++i];
      request.preset = name == "torque" ? Preset::kTorque : name == "transport" ? Preset::kTransport : Preset::kHuman;
    }
    if (flag == "--scheme") {
      const SchemeTraits* traits = FindScheme(argv[++i]);
      if (traits == nullptr) {
        std::fprintf(stderr, "--scheme %s is not known\n", argv[i]);
        return 1;
      }
      request.discretization.scheme = traits->scheme;
    }
    if (flag == "--starts") request.starts = std::stoi(argv[++i]);
    if (flag == "--intervals") request.discretization.single_support_intervals = std::stoi(argv[++i]);
    if (flag == "--slopes") slopes = Numbers(argv[++i]);
    if (flag == "--statures") statures = Numbers(argv[++i]);
    if (flag == "--masses") masses = Numbers(argv[++i]);
  }
  int asked = 0, optimal = 0, accurate = 0;
  std::vector<double> iterations, times;
  ProgramTally tally;
  std::printf("%-6s %7s %6s %6s | %-7s %5s %7s\n", "sex", "stature", "mass", "slope", "end", "iter", "cpu s");
  for (const Sex sex : {Sex::kFemale, Sex::kMale}) {
    for (const double stature : statures) {
      for (const double mass : masses) {
        for (const double slope : slopes) {
          request.body.sex = sex;
          request.body.stature = stature;
          request.body.mass = mass;
          request.slope = slope * std::numbers::pi / 180;
          const Result<GaitSpec> spec = CheckRequest(request);
          if (!spec.ok()) {
            for (const Violation& v : spec.violations())
              std::fprintf(stderr, "%s: %s\n", v.field.c_str(), v.message.c_str());
            return 1;
          }
          std::string why;
          const Outcome outcome = Solve(spec.value(), &tally, &why);
          ++asked;
          optimal += outcome.optimal ? 1 : 0;
          accurate += outcome.accurate ? 1 : 0;
          iterations.push_back(outcome.iterations);
          times.push_back(outcome.cpu);
          std::printf("%-6s %7.2f %6.1f %6.0f | %-7s %5d %7.2f %s\n", sex == Sex::kFemale ? "female" : "male", stature,
                      mass, slope, outcome.optimal ? "optimal" : "none", outcome.iterations, outcome.cpu, why.c_str());
          std::fflush(stdout);
        }
      }
    }
  }
  std::printf(
      "%d requests: %d optimal, %d within the accuracy; iterations median %.0f, most %.0f; CPU median %.2f s, most "
      "%.2f s\n",
      asked, optimal, accurate, Median(iterations), *std::max_element(iterations.begin(), iterations.end()),
      Median(times), *std::max_element(times.begin(), times.end()));
  tally.Print();
  return optimal == asked ? 0 : 1;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) { return rollgait::Main(argc, argv); }
