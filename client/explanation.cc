#include "client/explanation.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "client/accuracy_table.h"
#include "client/failure.h"
#include "client/limit_use.h"
#include "client/program_log.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

using Sentences = std::vector<std::string>;

constexpr int kMostLines = 10;  // under one heading
// Beyond this share of the time on one limit the motion is shaped by it.
constexpr double kLongOnALimit = 0.1;

std::string Heading(const std::string& title, const Sentences& sentences) {
  if (sentences.empty()) return "";
  std::string text = "\n" + title + "\n";
  for (size_t i = 0; i < sentences.size() && i < kMostLines; ++i) text += "  " + sentences[i] + "\n";
  if (sentences.size() > kMostLines) {
    text += "  … and " + std::to_string(sentences.size() - kMostLines) + " more.\n";
  }
  return text;
}

std::string Percent(double share) { return FormatNumber(100 * share, 2) + " %"; }

std::string Ending(const v1::Solve& solve) {
  const double tolerance = solve.spec().accuracy().has_kkt_tolerance() ? solve.spec().accuracy().kkt_tolerance() : 1e-6;
  switch (solve.result().termination()) {
    case v1::TERMINATION_OPTIMAL:
      return "The solver found a local optimum: no small change of the motion that keeps every constraint is cheaper "
             "(KKT error within " +
             FormatNumber(tolerance) + ").";
    case v1::TERMINATION_ACCEPTABLE:
      return "The solver made no further progress near an optimum: the KKT error is " +
             FormatNumber(solve.result().accuracy().kkt_error(), 2) + ", the tolerance " + FormatNumber(tolerance) +
             ".";
    case v1::TERMINATION_INFEASIBLE:
      return "The solver found no motion that meets every constraint, only one from which no small change brings it "
             "closer to that.";
    case v1::TERMINATION_ITERATION_LIMIT:
      return "The limit on iterations ended the solver before it had converged.";
    case v1::TERMINATION_TIME_LIMIT:
      return HasSolution(solve) ? "The limit on wall time ended the search; the gait is the newest that had converged."
                                : "The limit on wall time ended the solver before it had converged.";
    case v1::TERMINATION_NUMERICAL_DIFFICULTY:
      return "The solver could not go on for numerical reasons before it had converged.";
    case v1::TERMINATION_CANCELLED:
      return "It was cancelled before the solver had converged.";
    default:
      return "The server does not say how the solver ended.";
  }
}

Sentences HowItEnded(const v1::Solve& solve) {
  if (!solve.has_result()) {
    return {"It " + StateName(solve.state()) + " without an answer" +
            (solve.error().kind() == v1::SolveError::KIND_UNSPECIFIED
                 ? ""
                 : " (" + ErrorKindName(solve.error().kind()) + ")") +
            (solve.error().message().empty() ? "." : ": " + solve.error().message())};
  }
  Sentences sentences = {Ending(solve)};
  if (!solve.result().message().empty()) sentences.push_back("The solver says: " + solve.result().message());
  if (HasSolution(solve)) sentences.push_back("Accuracy of the trajectory: " + AccuracyVerdict(solve) + ".");
  return sentences;
}

Sentences WhatIsNotMet(const v1::Solve& solve) {
  Sentences sentences;
  // The server has the worst first: of each constraint the first one is the worst.
  std::map<std::string, int> others;
  for (const v1::UnmetConstraint& unmet : solve.result().unmet_constraints()) ++others[unmet.name()];
  for (const v1::UnmetConstraint& unmet : solve.result().unmet_constraints()) {
    const auto left = others.extract(unmet.name());
    if (left.empty()) continue;
    sentences.push_back("The constraint \"" + unmet.name() + "\" is missed by " + FormatNumber(unmet.violation(), 3) +
                        (unmet.unit().empty() || unmet.unit() == "1" ? "" : " " + unmet.unit()) + " in phase " +
                        std::to_string(unmet.phase()) + " at " + FormatNumber(unmet.time_s(), 3) + " s" +
                        (left.mapped() > 1 ? ", and by less at " + std::to_string(left.mapped() - 1) +
                                                 (left.mapped() == 2 ? " other instant." : " other instants.")
                                           : "."));
  }
  for (const AccuracyLine& line : AccuracyLines(solve)) {
    if (!solve.result().has_accuracy() || !line.exceeded || !line.bound) continue;
    const std::string unit = line.unit.empty() ? "" : " " + line.unit;
    sentences.push_back("The " + line.name + " is " + FormatNumber(line.value, 3) + unit + ", its bound " +
                        FormatNumber(*line.bound, 3) + unit + (line.where.empty() ? "." : " (" + line.where + ")."));
  }
  return sentences;
}

// The multipliers are in the order of the solver's unknowns, which only it knows by name; they tell how many of the
// bounds the cost leans on, not which.
std::string ActiveBounds(const v1::Multipliers& multipliers) {
  double largest = 0;
  for (const float multiplier : multipliers.bounds()) largest = std::max(largest, std::abs(double{multiplier}));
  if (largest <= 0) return "";
  const auto active = std::count_if(multipliers.bounds().begin(), multipliers.bounds().end(),
                                    [&](float multiplier) { return std::abs(double{multiplier}) > 1e-3 * largest; });
  return "Active bounds: " + std::to_string(active) + " of " + std::to_string(multipliers.bounds_size()) +
         " unknowns of the last program are held by theirs (multiplier above a thousandth of the largest); the cost "
         "would fall if those were wider.";
}

Sentences WhereItIsOnLimits(const v1::Solve& solve, const std::vector<LimitUse>& uses) {
  Sentences sentences;
  for (const LimitUse& use : uses) {
    const bool ground = use.kind == LimitKind::kFriction;
    sentences.push_back(use.where + " is on its " + use.limit + " for " + Percent(use.share) +
                        (ground ? " of its stance" : " of the motion") + ", first at " + FormatNumber(use.from_s, 3) +
                        " s.");
  }
  // Before convergence multipliers say nothing.
  const std::string active = HasSolution(solve) ? ActiveBounds(solve.result().multipliers()) : "";
  if (!active.empty()) sentences.insert(sentences.begin(), active);
  if (uses.empty() && solve.result().has_trajectory()) {
    sentences.push_back("No joint is on a limit of position, speed or effort, and no contact on its friction.");
  }
  return sentences;
}

// What of the log tells of difficulties.
void AddFromLog(const std::vector<v1::Iteration>& log, Sentences* sentences) {
  constexpr double kShort = 0.1;
  int shortened = 0, restorations = 0, regularised = 0;
  for (const v1::Iteration& iteration : log) {
    // The first line of a mesh has no step.
    shortened += iteration.primal_step() > 0 && iteration.primal_step() < kShort ? 1 : 0;
    restorations += iteration.restoration() ? 1 : 0;
    regularised += iteration.regularization() > 0 ? 1 : 0;
  }
  const std::string of = " of the " + std::to_string(log.size()) + " iterations in the log ";
  if (shortened > 0) {
    sentences->push_back("In " + std::to_string(shortened) + of + "less than a tenth of the step could be taken.");
  }
  if (regularised > 0) {
    sentences->push_back("In " + std::to_string(regularised) + of +
                         "the problem had to be made convex (regularisation).");
  }
  if (restorations > 0) {
    sentences->push_back(
        "In " + std::to_string(restorations) + of +
        "the solver sought feasibility alone (restoration): constraints contradict each other nearly.");
  }
}

Sentences HowTheIterationsWent(const v1::Solve& solve, const std::vector<v1::Iteration>& log) {
  const v1::SolveResult& result = solve.result();
  if (result.meshes().empty()) return {};
  int iterations = 0;
  for (const v1::MeshStatistics& mesh : result.meshes()) iterations += mesh.iterations();
  Sentences sentences = {std::to_string(iterations) + " iterations in " + std::to_string(result.meshes_size()) +
                         (result.meshes_size() == 1 ? " program" : " programs") + " took " +
                         FormatDuration(result.wall_time_s()) + "."};
  for (std::string& sentence : ProgramSentences(solve)) sentences.push_back(std::move(sentence));
  AddFromLog(log, &sentences);
  return sentences;
}

// What helps against a constraint that cannot be met, by the word that its name begins with.
std::string Remedy(const std::string& constraint) {
  const struct {
    const char* word;
    const char* remedy;
  } kRemedies[] = {
      {"speed", "Ask for a lower --speed, or leave it to the optimiser with --free-speed."},
      {"duty", "Leave --duty-factor out or ask for another one."},
      {"friction", "Raise --friction, or make the ground less steep (--slope)."},
      {"effort", "Widen limits.joint_effort in the request's file, or ask for a slower or flatter walk."},
      {"range", "Widen limits.joint_position in the request's file, or take --ranges anatomical."},
      {"velocity", "Widen limits.joint_velocity in the request's file, or ask for a slower walk."},
      {"clearance", "Lower --clearance."},
      {"rolling", "Take more --intervals, and start from elsewhere: --starts 4 or --warm-start nearest."},
      {"periodicity", "Start from elsewhere: --starts 4 or --warm-start nearest; or ask for another speed or slope."},
      {"dynamics", "Start from elsewhere: --starts 4 or --warm-start nearest; or take more --intervals."},
  };
  for (const auto& [word, remedy] : kRemedies) {
    if (constraint.rfind(word, 0) == 0) return remedy;
  }
  return "";
}

void AddOnce(const std::string& sentence, Sentences* sentences) {
  const bool known = std::find(sentences->begin(), sentences->end(), sentence) != sentences->end();
  if (!sentence.empty() && !known) sentences->push_back(sentence);
}

void AddForAccuracy(const v1::Solve& solve, Sentences* changes) {
  const v1::AccuracyReport& report = solve.result().accuracy();
  if (!HasSolution(solve)) return;
  if (report.verdict() == v1::VERDICT_NOT_JUDGED) {
    AddOnce("Ask for --accuracy standard (or --bound NAME=NUMBER) to have the trajectory judged.", changes);
  }
  if (report.verdict() != v1::VERDICT_EXCEEDED) return;
  AddOnce("Let the mesh be refined more often (--max-refinements, at most 20) or start with a finer one (--intervals).",
          changes);
  for (const v1::CriterionResult& criterion : report.criteria()) {
    if (!criterion.exceeded() || !std::isfinite(criterion.value())) continue;
    AddOnce("Or accept it with --bound " + criterion.criterion() + "=" + FormatNumber(1.1 * criterion.value(), 2) + ".",
            changes);
  }
}

void AddForLimits(const std::vector<LimitUse>& uses, Sentences* changes) {
  for (const LimitUse& use : uses) {
    if (use.share < kLongOnALimit) continue;
    const char* const field = use.kind == LimitKind::kPosition   ? "limits.joint_position"
                              : use.kind == LimitKind::kVelocity ? "limits.joint_velocity"
                              : use.kind == LimitKind::kEffort   ? "limits.joint_effort"
                                                                 : "--friction";
    AddOnce("The motion leans on " + use.where + ": if that limit is not meant, widen " + field + ".", changes);
  }
}

Sentences WhatToChange(const v1::Solve& solve, const std::vector<LimitUse>& uses) {
  Sentences changes;
  switch (solve.result().termination()) {
    case v1::TERMINATION_ITERATION_LIMIT:
      AddOnce("Raise --max-iterations, or start from a solve nearby with --warm-start nearest.", &changes);
      break;
    case v1::TERMINATION_TIME_LIMIT:
      AddOnce("Raise --max-time, or ask for less: --accuracy draft, fewer --intervals.", &changes);
      break;
    case v1::TERMINATION_NUMERICAL_DIFFICULTY:
      AddOnce("Start from elsewhere: --starts 4 or --warm-start nearest; or take another number of --intervals.",
              &changes);
      break;
    default:
      break;
  }
  for (const v1::UnmetConstraint& unmet : solve.result().unmet_constraints()) AddOnce(Remedy(unmet.name()), &changes);
  if (solve.error().kind() == v1::SolveError::KIND_TIME_LIMIT ||
      solve.error().kind() == v1::SolveError::KIND_MEMORY_LIMIT)
    AddOnce("Ask for less: fewer --intervals, --starts or --max-refinements.", &changes);
  AddForAccuracy(solve, &changes);
  AddForLimits(uses, &changes);
  return changes;
}

}  // namespace

std::string Explain(const v1::Solve& solve, const std::vector<v1::Iteration>& iterations) {
  const std::vector<LimitUse> uses = FindLimitUse(solve);
  return solve.name() + "\n" + Heading("How it ended", HowItEnded(solve)) +
         Heading("What is not met", WhatIsNotMet(solve)) +
         Heading("Where it is on its limits", WhereItIsOnLimits(solve, uses)) +
         Heading("How the iterations went", HowTheIterationsWent(solve, iterations)) +
         Heading("What to change", WhatToChange(solve, uses));
}

}  // namespace rollgait::client
