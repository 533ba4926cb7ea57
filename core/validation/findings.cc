#include "core/validation/findings.h"

#include <cmath>

namespace rollgait {

void RaiseTo(double value, double* worst) {
  if (!(value <= *worst)) *worst = std::isnan(value) ? kInfinity : value;
}

void FindingLog::Raise(Criterion criterion, double value, const std::string& where, const Instant& at) {
  if (at.interval != Instant::kNoInterval) RaiseInterval(criterion, value, at.interval);
  Finding& finding = findings_[static_cast<int>(criterion)];
  const double before = finding.value;
  RaiseTo(value, &finding.value);
  if (finding.value == before) return;
  finding.where = where;
  finding.phase = at.phase;
  finding.time = at.time;
}

}  // namespace rollgait
