#include "tests/core/nlp/suite/measure.h"

#include <algorithm>
#include <cmath>

namespace rollgait::suite {

NlpStart StartOf(const SuiteRow& row) {
  return {Eigen::Map<const VectorX>(row.start.data(), static_cast<int>(row.start.size())), {}, {}, {}};
}

NlpOptions SuiteOptions() {
  NlpOptions options;
  options.tolerance = 1e-8;
  return options;
}

double SumOfViolations(NlpProblem& program, const VectorX& x) {
  VectorX g(program.constraints());
  if (!program.Constraints(x.data(), g.data())) return kInfinity;
  return (program.constraint_lower() - g).cwiseMax(g - program.constraint_upper()).cwiseMax(0).sum();
}

double ValueOf(NlpProblem& program, const NlpResult& result) {
  return result.termination == Termination::kInfeasible ? SumOfViolations(program, result.x) : result.objective;
}

double DistanceBetween(double a, double b) { return std::abs(a - b) / std::max(1.0, std::abs(b)); }

double DistanceTo(const std::vector<double>& values, double value) {
  double least = kInfinity;
  for (const double known : values) least = std::min(least, DistanceBetween(value, known));
  return least;
}

}  // namespace rollgait::suite
