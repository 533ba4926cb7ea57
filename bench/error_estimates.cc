// Whether estimated errors are true: gaits drawn at random, each with its estimate, beside a reference of four times as
// many intervals and of the scheme of highest order.
//   error_estimates [--requests 100] [--seed 1] [--first 0] [--time-limit 60] [--planar 0.95] [--steepest 15]
//   error_estimates --max-error yes [...]   every request asks for an error; how often the reference says it is met
//   error_estimates --only 17 [...]         one of them, with its command
// --first N leaves out the requests before N. A row for each gait: estimate over true error of the objective and of the
// largest error of angles, torques and contact forces. Then, for each quantity, the share within 0.3 … 3 and the number
// beyond 10, either way.
// The reference is reached in small steps, so that it stays in one minimum: the answer's intervals halved twice, each
// started from the one before with its multipliers, then Radau-3 on that mesh.
//   (…)  the error is less than three times what a tolerance of 1e-8 changes on the answer's own mesh: it is that of
//        the solver's tolerance, of which the estimate says nothing. Counted apart.
//   ?    both schemes, on the finest mesh, are further apart than half of the error: the true error is not known well.
//        Counted with the others.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <optional>
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
#include "core/gait/request_check.h"

namespace rollgait {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kTolerance = 1e-8;   // of the program that tells what the tolerance of the request hides
constexpr double kOfTolerance = 3;    // below so many times the change by the tolerance, an error is the solver's
constexpr double kWellKnown = 0.5;    // of the error: how far the two schemes of the finest mesh may be apart
constexpr int kMostIterations = 500;  // of all these programs; no limit of time, so that load changes no reference

struct Options {
  audit::DrawOptions draw;
  int requests = 100, first = 0;
  std::optional<int> only;
};

// The errors of one gait, or how far two are apart, in the order of kNames.
constexpr int kCount = 4;
using Errors = std::array<double, kCount>;
constexpr std::array<const char*, kCount> kNames = {"objective", "angle", "torque", "force"};

Errors InOrder(double objective, const MotionDifference& motion) {
  const auto largest = [&](MotionQuantity quantity) { return motion[static_cast<size_t>(quantity)].largest; };
  return {objective, largest(MotionQuantity::kAngle), largest(MotionQuantity::kTorque),
          largest(MotionQuantity::kContactForce)};
}

Errors Apart(const GaitSpec& spec, const GaitSolution& one, const GaitSolution& other) {
  return InOrder(std::abs(other.objective / one.objective - 1),
                 CompareMotions(spec.scene, *one.trajectory, *other.trajectory));
}

struct Truth {
  Errors error, between_schemes;
  std::optional<Errors> of_tolerance;  // nothing: no error is known to be that of the tolerance
  std::vector<double> objectives;      // of the answer and of each step
};

// What a tolerance of 1e-8 changes of the answer on its own mesh; nothing where the solver does not reach it.
std::optional<Errors> ChangeByTolerance(GaitSpec spec, const GaitSolution& answer, SolveBudget* budget) {
  spec.kkt_tolerance = std::min(kTolerance, spec.kkt_tolerance);
  const GaitSolution exact =
      SolveFromCoarser(spec, *BuildProblem(spec), StartFrom(spec, answer), MeshOf(*answer.trajectory), budget);
  if (!Converged(exact.termination) || !exact.trajectory) return std::nullopt;
  return Apart(spec, answer, exact);
}

// Nothing where a step does not converge; `why` then says which.
std::optional<Truth> FindTruth(const GaitSpec& spec, const GaitSolution& answer, std::string* why) {
  GaitSpec reference = spec;
  reference.max_wall_time = kInfinity;
  reference.max_iterations = kMostIterations;
  LeaveTheRest(&reference);
  const SolveControl control;
  SolveBudget budget(reference, control);
  const auto problem = BuildProblem(reference);
  Truth truth;
  truth.objectives = {answer.objective};
  GaitSolution last = answer;
  const auto step = [&](const char* name, const WarmStart& start, const Mesh& mesh) {
    last = SolveFromCoarser(reference, *problem, start, mesh, &budget);
    truth.objectives.push_back(last.objective);
    if (Converged(last.termination) && last.trajectory) return true;
    const MeshStatistics& mesh_of_it = budget.log().back();
    *why = std::string(name) + ", " + std::to_string(mesh_of_it.iterations) + " iterations, KKT error " +
           FormatNumber(mesh_of_it.kkt_error) + ": " + last.message;
    return false;
  };
  for (const char* name : {"half the intervals' length", "a quarter"}) {
    if (!step(name, StartFrom(reference, last), Halved(MeshOf(*last.trajectory)))) return std::nullopt;
  }
  const GaitSolution same_scheme = last;
  if (spec.scheme != Scheme::kRadau3) {
    reference.scheme = Scheme::kRadau3;
    WarmStart start = StartFrom(reference, last);
    start.multipliers.reset();  // those of the other scheme's rows
    if (!step("Radau-3", start, MeshOf(*last.trajectory))) return std::nullopt;
  }
  truth.error = Apart(spec, answer, last);
  reference.scheme = spec.scheme;
  truth.of_tolerance = ChangeByTolerance(reference, answer, &budget);
  truth.between_schemes = Apart(spec, same_scheme, last);
  return truth;
}

// Ratios of one quantity over all gaits.
class Tally {
 public:
  void Add(double ratio, bool well_known) {
    ratios_.push_back(ratio);
    if (well_known) well_known_.push_back(ratio);
  }
  void AddOfTolerance() { ++of_tolerance_; }
  void Print(const char* name) const {
    Print(name, "all", ratios_);
    Print(name, "without ?", well_known_);
    std::printf("%-10s %-10s %4d\n", name, "tolerance", of_tolerance_);
  }

 private:
  static void Print(const char* name, const char* which, std::vector<double> sorted) {
    if (sorted.empty()) return;
    std::sort(sorted.begin(), sorted.end());
    const auto within = [&](double low, double high) {
      return std::count_if(sorted.begin(), sorted.end(), [&](double r) { return r >= low && r <= high; });
    };
    const auto at = [&](double share) { return sorted[static_cast<size_t>(share * (sorted.size() - 1))]; };
    std::printf(
        "%-10s %-10s %4zu gaits: %5.1f %% within 0.3 … 3, %ld beyond 10; least %.2f, 10 %% %.2f, "
        "median %.2f, 90 %% %.2f, most %.2f\n",
        name, which, sorted.size(), 100.0 * within(0.3, 3) / sorted.size(),
        static_cast<long>(sorted.size()) - within(0.1, 10), sorted.front(), at(0.1), at(0.5), at(0.9), sorted.back());
  }
  std::vector<double> ratios_, well_known_;
  int of_tolerance_ = 0;
};

// Of requests for an error: what the answers say, and what the reference says.
struct Kept {
  int asked = 0, not_reached = 0, unknown = 0, met = 0, missed = 0;
};

// The true error over the allowed one, of the quantity that is asked for.
double ShareOfAllowed(const MaxError& allowed, const Errors& error) {
  if (allowed.objective) return error[0] / *allowed.objective;
  if (allowed.angle) return error[1] / *allowed.angle;
  return error[2] / *allowed.torque;
}

class Report {
 public:
  explicit Report(const Options& options) : options_(options) {}

  static void PrintHead() {
    std::printf("%4s %-26s %-9s %6s %5s %8s %8s %8s | estimate / true: %7s %8s %8s %8s | %s\n", "no", "group", "scheme",
                "CPU s", "iter", "obj. %", "angle °", "Nm", kNames[0], kNames[1], kNames[2], kNames[3], "intervals");
  }

  void Add(int number) {
    audit::DrawnRequest drawn = audit::Draw(options_.draw, number);
    drawn.request.accuracy.estimate_errors = true;
    if (options_.only) std::printf("%s --errors\n", drawn.command.c_str());
    const Result<GaitSpec> checked = CheckRequest(drawn.request);
    if (!checked.ok()) {
      ++refused_;
      return;
    }
    const GaitSpec& spec = checked.value();
    const std::clock_t begin = std::clock();
    const GaitSolution answer = OptimizingGaitSolver().Solve(spec, SolveControl());
    const double cpu = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    int iterations = 0;
    for (const MeshStatistics& mesh : answer.meshes) iterations += mesh.iterations;
    constexpr std::array<const char*, 3> kSchemes = {"radau2", "radau3", "hermite-s"};
    std::printf("%4d %-26s %-9s %6.2f %5d ", number, drawn.group.c_str(), kSchemes[static_cast<size_t>(spec.scheme)],
                cpu, iterations);
    const bool is_solved = Converged(answer.termination) && answer.trajectory;
    if (is_solved && spec.max_error) ++kept_.asked;
    if (!answer.errors) {
      (is_solved ? no_estimate_ : unsolved_) += 1;
      kept_.not_reached += is_solved && spec.max_error ? 1 : 0;
      std::printf("%s: %s\n", is_solved ? "no estimate" : "no solution", answer.message.c_str());
      return;
    }
    std::string why;
    const std::optional<Truth> truth = FindTruth(spec, answer, &why);
    if (spec.max_error) Judge(*spec.max_error, answer, truth);
    if (!truth) {
      ++no_reference_;
      std::printf("no reference: %s\n", why.c_str());
      return;
    }
    PrintRow(spec, answer, *truth);
  }

  void Print() const {
    std::printf(
        "requests of seed %llu: %d refused, %d without a solution, %d without an estimate, %d without a "
        "reference\n",
        static_cast<unsigned long long>(options_.draw.seed), refused_, unsolved_, no_estimate_, no_reference_);
    for (int q = 0; q < kCount; ++q) tallies_[q].Print(kNames[q]);
    if (kept_.asked == 0) return;
    const int told = kept_.met + kept_.missed;
    std::printf(
        "max_error: %d solved; %d say that they do not reach it, %d say so without a reference; of %d that say "
        "that they reach it %d do (%.1f %%)\n",
        kept_.asked, kept_.not_reached, kept_.unknown, told, kept_.met, 100.0 * kept_.met / std::max(1, told));
  }

 private:
  void Judge(const MaxError& allowed, const GaitSolution& answer, const std::optional<Truth>& truth) {
    if (!answer.errors->is_within_max_error.value_or(false)) {
      ++kept_.not_reached;
    } else if (!truth) {
      ++kept_.unknown;
    } else {
      (ShareOfAllowed(allowed, truth->error) <= 1 ? kept_.met : kept_.missed) += 1;
    }
  }

  void PrintRow(const GaitSpec& spec, const GaitSolution& answer, const Truth& truth) {
    const Errors estimate = InOrder(answer.errors->objective, answer.errors->motion);
    std::printf("%8.4f %8.4f %8.3f |                ", 100 * truth.error[0], kDegrees * truth.error[1], truth.error[2]);
    bool is_outlier = false;
    for (int q = 0; q < kCount; ++q) {
      const double ratio = estimate[q] / truth.error[q];
      const bool of_tolerance = truth.of_tolerance && truth.error[q] < kOfTolerance * (*truth.of_tolerance)[q];
      const bool well_known = truth.between_schemes[q] <= kWellKnown * truth.error[q];
      is_outlier = is_outlier || (!of_tolerance && !(ratio >= 0.3 && ratio <= 3));
      char text[32];
      std::snprintf(text, sizeof text, of_tolerance ? "(%.2f)" : well_known ? "%.2f" : "?%.2f", ratio);
      std::printf("%8s ", text);
      if (of_tolerance) {
        tallies_[q].AddOfTolerance();
      } else {
        tallies_[q].Add(ratio, well_known);
      }
    }
    std::printf("|");
    for (const int n : MeshOf(*answer.trajectory).Intervals()) std::printf(" %d", n);
    if (spec.max_error) {
      std::printf("; error / allowed: %.2f%s", ShareOfAllowed(*spec.max_error, truth.error),
                  answer.errors->is_within_max_error.value_or(false) ? "" : ", as it says");
    }
    if (is_outlier || options_.only) {
      std::printf("; objectives %.8g, finer %.8g; reference", answer.objective, answer.finer->objective);
      for (const double objective : truth.objectives) std::printf(" %.8g", objective);
    }
    std::printf("\n");
  }

  Options options_;
  std::array<Tally, kCount> tallies_;
  Kept kept_;
  int refused_ = 0, unsolved_ = 0, no_estimate_ = 0, no_reference_ = 0;
};

[[noreturn]] void Refuse(const std::string& text) {
  std::fprintf(stderr, "error_estimates: %s\n", text.c_str());
  std::exit(2);
}

Options Parse(int argc, char** argv) {
  Options options;
  options.draw.level = GaitRequest::AccuracyLevel::kStandard;
  options.draw.planar = 0.95;
  options.draw.steepest = 15;
  for (int i = 1; i < argc; i += 2) {
    const std::string flag = argv[i];
    if (i + 1 >= argc) Refuse(flag + " takes a value");
    const std::string value = argv[i + 1];
    if (flag == "--requests")
      options.requests = std::stoi(value);
    else if (flag == "--first")
      options.first = std::stoi(value);
    else if (flag == "--only")
      options.only = std::stoi(value);
    else if (flag == "--seed")
      options.draw.seed = std::stoull(value);
    else if (flag == "--time-limit")
      options.draw.time_limit = std::stod(value);
    else if (flag == "--planar")
      options.draw.planar = std::stod(value);
    else if (flag == "--steepest")
      options.draw.steepest = std::stod(value);
    else if (flag == "--max-error" && (value == "yes" || value == "no"))
      options.draw.max_error = value == "yes";
    else
      Refuse("cannot read " + flag + " " + value);
  }
  if (options.requests < 1) Refuse("--requests is at least 1");
  if (options.first < 0 || options.first >= options.requests) Refuse("--first is from 0 to below --requests");
  return options;
}

int Main(int argc, char** argv) {
  const Options options = Parse(argc, argv);
  std::setvbuf(stdout, nullptr, _IOLBF, 1 << 12);
  Report report(options);
  Report::PrintHead();
  const int first = options.only.value_or(options.first);
  const int end = options.only ? first + 1 : options.requests;
  for (int number = first; number < end; ++number) report.Add(number);
  report.Print();
  return 0;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) { return rollgait::Main(argc, argv); }
