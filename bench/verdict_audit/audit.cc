#include "bench/verdict_audit/audit.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "bench/measured_solve.h"
#include "bench/verdict_audit/second_judge.h"
#include "core/gait/optimizing_gait_solver.h"

namespace rollgait::audit {
namespace {

std::string Text(const Excess& excess) {
  char text[400];
  std::snprintf(text, sizeof text, "%s = %.3g, %.3g times its bound (%s, phase %d, %.4f s)",
                TraitsOf(excess.criterion).field, excess.finding.value, excess.ratio(), excess.finding.where.c_str(),
                excess.finding.phase, excess.finding.time);
  return text;
}

}  // namespace

double Audit::Ratio(Criterion* worst) const {
  double largest = 0;
  for (const CriterionTraits& traits : Criteria()) {
    const double ratio =
        bounds[traits.criterion] == kInfinity ? 0 : second[traits.criterion] / bounds[traits.criterion];
    if (ratio <= largest) continue;
    largest = ratio;
    *worst = traits.criterion;
  }
  return largest;
}

Audit Judge(const DrawnRequest& drawn, const SolveControl& control, std::vector<MeshStatistics>* meshes) {
  Audit audit;
  const Result<GaitSpec> spec = CheckRequest(drawn.request);
  if (!spec.ok()) {
    audit.why = "refused: " + spec.violations().front().field + " " + spec.violations().front().message;
    return audit;
  }
  const MeasuredSolve solve = Measure([&] { return OptimizingGaitSolver().Solve(spec.value(), control); });
  const GaitSolution& solution = solve.solution;
  if (meshes != nullptr) *meshes = solution.meshes;
  audit.cpu = solve.cpu;
  audit.bounds = spec.value().bounds;
  const bool solved = solution.termination == Termination::kOptimal || solution.termination == Termination::kAcceptable;
  if (!solved || !solution.trajectory || !solution.accuracy) {
    audit.why = solution.message;
    return audit;
  }
  audit.end = solution.verdict.kind == Verdict::Kind::kWithin     ? Audit::End::kWithin
              : solution.verdict.kind == Verdict::Kind::kExceeded ? Audit::End::kExceeded
                                                                  : Audit::End::kNotJudged;
  for (const Excess& excess : solution.verdict.excesses) audit.why += (audit.why.empty() ? "" : "; ") + Text(excess);
  for (const CriterionTraits& traits : Criteria()) {
    audit.first[traits.criterion] = solution.accuracy->findings[static_cast<size_t>(traits.criterion)].value;
  }
  audit.second = MeasureTrajectory(spec.value(), *solution.trajectory);
  return audit;
}

std::string ToText(const Audit& audit) {
  std::ostringstream text;
  text.precision(17);
  text << static_cast<int>(audit.end) << ' ' << audit.cpu;
  for (const CriterionValues* values : {&audit.first, &audit.second, &audit.bounds}) {
    for (const CriterionTraits& traits : Criteria()) text << ' ' << (*values)[traits.criterion];
  }
  std::string why = audit.why;
  std::replace(why.begin(), why.end(), '\n', ' ');
  text << ' ' << why;
  return text.str();
}

bool FromText(const std::string& text, Audit* audit) {
  std::istringstream stream(text);
  int end = 0;
  if (!(stream >> end >> audit->cpu)) return false;
  audit->end = static_cast<Audit::End>(end);
  for (CriterionValues* values : {&audit->first, &audit->second, &audit->bounds}) {
    for (const CriterionTraits& traits : Criteria()) {
      std::string number;  // streams read neither inf nor nan
      if (!(stream >> number)) return false;
      (*values)[traits.criterion] = std::strtod(number.c_str(), nullptr);
    }
  }
  std::getline(stream >> std::ws, audit->why);
  return true;
}

}  // namespace rollgait::audit
