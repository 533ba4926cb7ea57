// Gaits on feet of superellipsoids beside those on ellipsoids, cold: verdict, what the second judge of verdict_audit
// finds, cost and iterations.
//   foot_exponents [--model planar] [--preset human] [--draft | --fine] [--slopes -10,0,10] [EXPONENT...]
// Without exponents: the ellipsoid, 0.6, 0.8, 1, 1.2 and 1.6.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "bench/measured_solve.h"
#include "bench/verdict_audit/second_judge.h"
#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

void SetExponent(double exponent, GaitRequest* request) {
  const bool two = request->body.feet == FootShape::kTwoEllipsoids;
  for (const char* name : {"heel", "forefoot"}) {
    if (two) request->body.changes.foot_exponents[name] = exponent;
  }
  if (!two) request->body.changes.foot_exponents["foot"] = exponent;
}

// The largest share of its bound that a criterion takes by the second judge.
std::string SecondJudge(const GaitSpec& spec, const GaitSolution& solution) {
  const CriterionValues values = audit::MeasureTrajectory(spec, *solution.trajectory);
  double largest = 0;
  const char* field = "";
  for (const CriterionTraits& traits : Criteria()) {
    const double share = values[traits.criterion] / spec.bounds[traits.criterion];
    if (!(share > largest)) continue;
    largest = share;
    field = traits.field;
  }
  char text[100];
  std::snprintf(text, sizeof text, "%.2f %s", largest, field);
  return text;
}

void Print(const std::string& exponent, const GaitSpec& spec, const MeasuredSolve& measured, double ellipsoid) {
  const GaitSolution& solution = measured.solution;
  const char* verdict = solution.verdict.kind == Verdict::Kind::kWithin     ? "within"
                        : solution.verdict.kind == Verdict::Kind::kExceeded ? "exceeded"
                                                                            : "not judged";
  int intervals = 0;
  if (!solution.meshes.empty()) {
    for (const int count : solution.meshes.back().intervals) intervals += count;
  }
  std::printf("%6.0f  %-9s %-10s %7.2f %5d %5d %10.6f %8.2f  %s\n", spec.slope / kDegree, exponent.c_str(), verdict,
              measured.cpu, measured.iterations, intervals, solution.objective,
              100 * (solution.objective / ellipsoid - 1),
              solution.trajectory ? SecondJudge(spec, solution).c_str() : solution.message.c_str());
  std::fflush(stdout);
}

std::vector<double> Numbers(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) numbers.push_back(std::stod(part));
  return numbers;
}

int Main(int argc, char** argv) {
  GaitRequest request;
  request.body.model = "planar";
  request.body.feet = FootShape::kTwoEllipsoids;
  request.preset = Preset::kHuman;
  request.motion.speed = 1.3;
  std::vector<double> slopes = {-10, 0, 10}, exponents;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    const bool has_value = i + 1 < argc;
    if (flag == "--fine") {
      request.accuracy.level = GaitRequest::AccuracyLevel::kFine;
    } else if (flag == "--draft") {
      request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
    } else if (flag == "--one") {
      request.body.feet = FootShape::kOneEllipsoid;
    } else if (flag == "--model" && has_value) {
      request.body.model = argv[++i];
    } else if (flag == "--slopes" && has_value) {
      slopes = Numbers(argv[++i]);
    } else if (flag == "--preset" && has_value) {
      const std::string name = argv[++i];
      request.preset = name == "torque" ? Preset::kTorque : name == "transport" ? Preset::kTransport : Preset::kHuman;
    } else if (flag.starts_with("-")) {
      std::printf(
          "Gaits on feet of superellipsoids beside those on ellipsoids, cold.\n"
          "  foot_exponents [--model planar] [--preset human|transport|torque] [--one] [--draft | --fine]\n"
          "                 [--slopes -10,0,10] [EXPONENT...]\n"
          "--one   feet of one surface in place of heel and forefoot\n");
      return flag == "--help" || flag == "-h" ? 0 : 2;
    } else {
      exponents.push_back(std::stod(flag));
    }
  }
  if (exponents.empty()) exponents = {0.6, 0.8, 1, 1.2, 1.6};
  std::printf("%6s  %-9s %-10s %7s %5s %5s %10s %8s  %s\n", "slope", "exponent", "verdict", "cpu s", "iter", "int",
              "objective", "change %", "second judge: largest share of a bound");
  for (const double slope : slopes) {
    request.slope = slope * kDegree;
    std::optional<double> ellipsoid;
    for (size_t i = 0; i <= exponents.size(); ++i) {
      GaitRequest of_feet = request;
      char name[32] = "ellipsoid";
      if (i > 0) {
        SetExponent(exponents[i - 1], &of_feet);
        std::snprintf(name, sizeof name, "%g", exponents[i - 1]);
      }
      const Result<GaitSpec> spec = CheckRequest(of_feet);
      if (!spec.ok()) {
        std::printf("%6.0f  %-9s refused: %s %s\n", slope, name, spec.violations()[0].field.c_str(),
                    spec.violations()[0].message.c_str());
        continue;
      }
      const MeasuredSolve measured =
          Measure([&] { return OptimizingGaitSolver().Solve(spec.value(), SolveControl()); });
      if (!ellipsoid) ellipsoid = measured.solution.objective;
      Print(name, spec.value(), measured, *ellipsoid);
    }
  }
  return 0;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) { return rollgait::Main(argc, argv); }
