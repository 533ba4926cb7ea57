// Whether verdicts are true: draws requests, solves each, and judges every trajectory a second time by code of its own.
//   verdict_audit --requests 300 --seed 1 [--first 0] [--level draft|standard|fine|any] [--jobs 1] [--time-limit 60]
//   verdict_audit --seed 1 --only 17 [--iterations yes] [...]   one request: its meshes, the measures of both judges,
//                                                               the iterations on the standard error output
// --first N leaves out the requests before N.
// Prints a table of verdicts, what was exceeded, and for each criterion the largest measure over its bound that the
// second judge found among the trajectories that are WITHIN. Above 1.01 is a false WITHIN: exit code 1. A request that
// cannot be read: 2.

#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "bench/verdict_audit/audit.h"
#include "bench/verdict_audit/children.h"

namespace rollgait::audit {
namespace {

constexpr double kTolerance = 1.01;  // of a bound; the two judges find extrema in their own ways

struct Options {
  DrawOptions draw;
  int requests = 300, first = 0, jobs = 1, only = -1;
  bool iterations = false;
};

const char* Name(Audit::End end) {
  switch (end) {
    case Audit::End::kWithin:
      return "within";
    case Audit::End::kExceeded:
      return "exceeded";
    case Audit::End::kNotJudged:
      return "not judged";
    case Audit::End::kNoSolution:
      return "no solution";
  }
  return "?";
}

bool IsFalse(const Audit& audit) {
  Criterion worst{};
  return audit.end == Audit::End::kWithin && !(audit.Ratio(&worst) <= kTolerance);
}

void PrintMeasures(const Audit& audit) {
  std::printf("%-26s %12s %12s %12s %9s\n", "criterion", "first judge", "second", "bound", "second/b.");
  for (const CriterionTraits& traits : Criteria()) {
    const Criterion c = traits.criterion;
    std::printf("%-26s %12.4g %12.4g %12.4g %9.3f\n", traits.field, audit.first[c], audit.second[c], audit.bounds[c],
                audit.second[c] / audit.bounds[c]);
  }
}

void PrintMeshes(const std::vector<MeshStatistics>& meshes) {
  for (const MeshStatistics& mesh : meshes) {
    std::string intervals;
    for (const int count : mesh.intervals) intervals += (intervals.empty() ? "" : "+") + std::to_string(count);
    std::printf("  %s intervals, %.3g W: %d iterations, %.2f s, objective %.6g, KKT %.1e, gap %.1e m, slip %.1e m/s\n",
                intervals.c_str(), mesh.smoothing, mesh.iterations, mesh.wall_time, mesh.objective, mesh.kkt_error,
                mesh.max_gap, mesh.max_slip);
  }
}

void PrintIteration(const IterationInfo& i) {
  std::fprintf(stderr, "%2d %4d f %.8e pr %.2e du %.2e mu %.1e reg %.1e ap %.2e ad %.2e%s\n", i.mesh, i.index,
               i.objective, i.primal_infeasibility, i.dual_infeasibility, i.barrier_parameter, i.regularization,
               i.primal_step, i.dual_step, i.restoration ? " R" : "");
}

struct Row {
  std::map<Audit::End, int> ends;
  int Total() const {
    return std::accumulate(ends.begin(), ends.end(), 0, [](int sum, const auto& end) { return sum + end.second; });
  }
};

void PrintRow(const std::string& name, const Row& row) {
  const auto count = [&](Audit::End end) { return row.ends.contains(end) ? row.ends.at(end) : 0; };
  std::printf("| %-36s | %6d | %6d | %8d | %10d | %11d |\n", name.c_str(), row.Total(), count(Audit::End::kWithin),
              count(Audit::End::kExceeded), count(Audit::End::kNotJudged), count(Audit::End::kNoSolution));
}

class Report {
 public:
  explicit Report(const Options& options) : options_(options) {}

  void Add(int number, const Audit& audit) {
    const DrawnRequest drawn = Draw(options_.draw, number);
    Row& group = groups_[drawn.group];
    ++group.ends[audit.end];
    ++all_.ends[audit.end];
    std::string line = "#" + std::to_string(number) + " " + Name(audit.end) +
                       (audit.why.empty() ? "" : ": " + audit.why) + "\n  " + drawn.command;
    std::printf("%s\n", line.c_str());
    if (audit.end == Audit::End::kExceeded) exceeded_.push_back(line);
    if (audit.end == Audit::End::kNoSolution) unsolved_.push_back(line);
    if (audit.end != Audit::End::kWithin) return;
    for (const CriterionTraits& traits : Criteria()) {
      const double bound = audit.bounds[traits.criterion];
      const double ratio = bound == kInfinity ? 0 : audit.second[traits.criterion] / bound;
      if (ratio <= worst_[traits.criterion]) continue;
      worst_[traits.criterion] = ratio;
      worst_number_[traits.criterion] = number;
    }
    Criterion worst{};
    const double ratio = audit.Ratio(&worst);
    char text[200];
    std::snprintf(text, sizeof text, "  second judge: at most %.4f of a bound, %s%s", ratio, TraitsOf(worst).field,
                  IsFalse(audit) ? "  FALSE WITHIN" : "");
    std::printf("%s\n", text);
    if (IsFalse(audit)) false_.push_back(line + "\n" + text);
  }

  // The exit code.
  int Print() const {
    std::printf("\n| %-36s | number | within | exceeded | not judged | no solution |\n|---|---|---|---|---|---|\n",
                "group");
    for (const auto& [name, row] : groups_) PrintRow(name, row);
    PrintRow("all", all_);
    PrintList("Exceeded", exceeded_);
    PrintList("No solution", unsolved_);
    std::printf("\nWithin: largest measure over bound that the second judge found\n");
    for (const CriterionTraits& traits : Criteria()) {
      std::printf("  %-26s %8.4f  #%d\n", traits.field, worst_[traits.criterion],
                  static_cast<int>(worst_number_[traits.criterion]));
    }
    PrintList("FALSE WITHIN", false_);
    std::printf("%zu false WITHIN of %d\n", false_.size(),
                all_.ends.contains(Audit::End::kWithin) ? all_.ends.at(Audit::End::kWithin) : 0);
    return false_.empty() ? 0 : 1;
  }

 private:
  static void PrintList(const char* title, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    std::printf("\n%s\n", title);
    for (const std::string& line : lines) std::printf("%s\n", line.c_str());
  }

  Options options_;
  std::map<std::string, Row> groups_;
  Row all_;
  CriterionValues worst_, worst_number_;
  std::vector<std::string> exceeded_, unsolved_, false_;
};

[[noreturn]] void Refuse(const std::string& text) {
  std::fprintf(stderr, "verdict_audit: %s\n", text.c_str());
  std::exit(2);
}

Options Parse(int argc, char** argv) {
  Options options;
  using Level = GaitRequest::AccuracyLevel;
  const std::map<std::string, std::optional<Level>> levels = {
      {"any", std::nullopt}, {"draft", Level::kDraft}, {"standard", Level::kStandard}, {"fine", Level::kFine}};
  for (int i = 1; i < argc; i += 2) {
    const std::string flag = argv[i];
    if (i + 1 >= argc) Refuse(flag + " takes a value");
    const std::string value = argv[i + 1];
    if (flag == "--level" && levels.contains(value))
      options.draw.level = levels.at(value);
    else if (flag == "--requests")
      options.requests = std::stoi(value);
    else if (flag == "--seed")
      options.draw.seed = std::stoull(value);
    else if (flag == "--first")
      options.first = std::stoi(value);
    else if (flag == "--iterations" && (value == "yes" || value == "no"))
      options.iterations = value == "yes";
    else if (flag == "--jobs")
      options.jobs = std::stoi(value);
    else if (flag == "--only")
      options.only = std::stoi(value);
    else if (flag == "--time-limit")
      options.draw.time_limit = std::stod(value);
    else
      Refuse("cannot read " + flag + " " + value);
  }
  if (options.requests < 1 || options.jobs < 1) Refuse("--requests and --jobs are at least 1");
  if (options.first < 0 || options.first >= options.requests) Refuse("--first is from 0 to below --requests");
  return options;
}

int Main(int argc, char** argv) {
  const Options options = Parse(argc, argv);
  Report report(options);
  if (options.only >= 0) {
    SolveControl control;
    if (options.iterations) control.observer = PrintIteration;
    std::vector<MeshStatistics> meshes;
    const Audit audit = Judge(Draw(options.draw, options.only), control, &meshes);
    report.Add(options.only, audit);
    PrintMeshes(meshes);
    PrintMeasures(audit);
    return IsFalse(audit) ? 1 : 0;
  }
  RunInChildren(
      options.requests - options.first, options.jobs,
      [&](int place) { return ToText(Judge(Draw(options.draw, options.first + place), SolveControl())); },
      [&](int place, const std::string& text) {
        Audit audit;
        if (!FromText(text, &audit)) audit.why = "the process of the solver died";
        report.Add(options.first + place, audit);
      });
  return report.Print();
}

}  // namespace
}  // namespace rollgait::audit

int main(int argc, char** argv) { return rollgait::audit::Main(argc, argv); }
