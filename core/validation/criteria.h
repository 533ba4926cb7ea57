#ifndef ROLLGAIT_CORE_VALIDATION_CRITERIA_H_
#define ROLLGAIT_CORE_VALIDATION_CRITERIA_H_

#include <array>
#include <string>
#include <vector>

#include "core/base/types.h"

namespace rollgait {

// What a trajectory is judged by, at every instant. kCriteria says what each measures; every measure is >= 0 and 0 is
// perfect.
enum class Criterion {
  kGap,
  kSlip,
  kPenetration,
  kOverlap,
  kPositionDefect,
  kVelocityDefect,
  kJointRange,
  kJointVelocity,
  kJointEffort,
  kPull,
  kFriction,
  kApproach,
  kPeriodicity,
  kEnergy,
  kMomentum,
};
inline constexpr int kCriterionCount = 15;

// One row of the table of criteria. Bounds are the largest admissible measures, in `unit`.
struct CriterionTraits {
  Criterion criterion;
  const char* field;    // of rollgait.v1.Accuracy
  const char* meaning;  // of the measure, for messages: "gap of a contact that rolls"
  const char* unit;
  double standard, fine;  // bounds of the two levels
  double least, most;     // range that a request may give
};

// In the order of the enumeration.
const std::array<CriterionTraits, kCriterionCount>& Criteria();
inline const CriterionTraits& TraitsOf(Criterion criterion) { return Criteria()[static_cast<int>(criterion)]; }

// One number for each criterion: bounds (infinite: not judged), or measures.
class CriterionValues {
 public:
  explicit CriterionValues(double value = 0) { values_.fill(value); }
  double& operator[](Criterion criterion) { return values_[static_cast<int>(criterion)]; }
  double operator[](Criterion criterion) const { return values_[static_cast<int>(criterion)]; }
  friend bool operator==(const CriterionValues&, const CriterionValues&) = default;

 private:
  std::array<double, kCriterionCount> values_;
};

CriterionValues StandardBounds();
CriterionValues FineBounds();
inline CriterionValues NoBounds() { return CriterionValues(kInfinity); }

// The largest measure of one criterion, and where it was found.
struct Finding {
  double value = 0;   // unit of the criterion; infinite if it could not be measured
  std::string where;  // joint, contact, pair of bodies or impact; empty: the whole motion, or nothing was found
  int phase = 0;
  double time = 0;  // s
};

// A bound that is exceeded.
struct Excess {
  Criterion criterion;
  double bound;
  Finding finding;
  // Over the bound; infinite if the bound is zero or the measure is not a number.
  double ratio() const { return bound > 0 && finding.value >= 0 ? finding.value / bound : kInfinity; }
};

// kNotJudged: no criterion has a bound. kExceeded: `excesses` has every bound that is exceeded, largest ratio first.
struct Verdict {
  enum class Kind { kNotJudged, kWithin, kExceeded };
  Kind kind = Kind::kNotJudged;
  std::vector<Excess> excesses;
};

// "slip of a contact that rolls (left_heel at 0.31 s), 0.002 where 0.001 m/s was asked for; …".
std::string Describe(const std::vector<Excess>& excesses);

// A measure that is not a number exceeds every bound.
Verdict JudgeFindings(const std::array<Finding, kCriterionCount>& findings, const CriterionValues& bounds);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_CRITERIA_H_
