#ifndef ROLLGAIT_CORE_VALIDATION_FINDINGS_H_
#define ROLLGAIT_CORE_VALIDATION_FINDINGS_H_

#include <array>
#include <string>
#include <vector>

#include "core/validation/criteria.h"

namespace rollgait {

// Raises *worst to value. A NaN counts as infinite, so that it cannot hide.
void RaiseTo(double value, double* worst);

// Where in a trajectory something was measured.
struct Instant {
  static constexpr int kNoInterval = -1;
  int phase = 0;
  double time = 0;             // s
  int interval = kNoInterval;  // in order of time over all phases; kNoInterval: an impact, a border, the whole motion
};

// Collects the largest measure of every criterion, over all and for every interval.
class FindingLog {
 public:
  explicit FindingLog(int intervals) : intervals_(intervals) {}

  // A measure > 0 that is larger than all before it is kept with its place, of equal ones the first. A NaN counts as
  // infinite.
  void Raise(Criterion criterion, double value, const std::string& where, const Instant& at);
  // An interval's own measure alone, which says nothing of the whole.
  void RaiseInterval(Criterion criterion, double value, int interval) {
    RaiseTo(value, &intervals_[interval][criterion]);
  }

  const Finding& operator[](Criterion criterion) const { return findings_[static_cast<int>(criterion)]; }
  const std::array<Finding, kCriterionCount>& findings() const { return findings_; }
  const std::vector<CriterionValues>& intervals() const { return intervals_; }

 private:
  std::array<Finding, kCriterionCount> findings_;
  std::vector<CriterionValues> intervals_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_FINDINGS_H_
