// One request: solved, judged by the solver's judge and by the second one.
#ifndef ROLLGAIT_BENCH_VERDICT_AUDIT_AUDIT_H_
#define ROLLGAIT_BENCH_VERDICT_AUDIT_AUDIT_H_

#include <string>
#include <vector>

#include "bench/verdict_audit/random_request.h"
#include "core/gait/gait_solver.h"
#include "core/validation/criteria.h"

namespace rollgait::audit {

struct Audit {
  // kNoSolution: refused, infeasible, not converged, or the process died.
  enum class End { kWithin, kExceeded, kNotJudged, kNoSolution };
  End end = End::kNoSolution;
  std::string why;        // exceeded: criterion, measure, place; no solution: the reason
  double cpu = 0;         // s
  CriterionValues first;  // measures of the two judges; zero without a solution
  CriterionValues second;
  CriterionValues bounds;  // infinite: none
  // The second judge's largest measure over its bound, and whose it is. Zero without bounds.
  double Ratio(Criterion* worst) const;
};

// In this process. `meshes` may be null; else it receives those that were solved.
Audit Judge(const DrawnRequest& drawn, const SolveControl& control, std::vector<MeshStatistics>* meshes = nullptr);

// Audits as text and back: what a process of its own hands over.
std::string ToText(const Audit& audit);
bool FromText(const std::string& text, Audit* audit);

}  // namespace rollgait::audit

#endif  // ROLLGAIT_BENCH_VERDICT_AUDIT_AUDIT_H_
