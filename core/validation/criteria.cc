#include "core/validation/criteria.h"

#include <algorithm>
#include <sstream>

namespace rollgait {

const std::array<CriterionTraits, kCriterionCount>& Criteria() {
  using enum Criterion;
  constexpr double kDegree = 0.017453292519943295;  // rad
  static const std::array<CriterionTraits, kCriterionCount> table = {{
      {kGap, "max_gap_m", "gap of a contact that rolls", "m", 1e-4, 1e-5, 1e-9, 0.1},
      {kSlip, "max_slip_m_s", "slip of a contact that rolls", "m/s", 1e-3, 1e-4, 1e-9, 1},
      {kPenetration, "max_penetration_m", "depth of a swinging surface under the ground", "m", 1e-4, 2e-5, 1e-9, 0.1},
      {kOverlap, "max_overlap_m", "overlap of two bodies", "m", 1e-6, 2e-7, 1e-9, 0.1},
      {kPositionDefect, "max_position_defect", "difference of positions after re-integration of an interval",
       "rad or m", 5e-3, 1e-3, 1e-9, 1},
      {kVelocityDefect, "max_velocity_defect", "difference of velocities after re-integration of an interval",
       "rad/s or m/s", 0.2, 0.04, 1e-9, 100},
      {kJointRange, "max_range_excess", "joint past its range", "rad or m", 0.05 * kDegree, 0.01 * kDegree, 1e-9, 1},
      {kJointVelocity, "max_velocity_excess", "joint velocity past its limit, over the limit", "1", 0.01, 2e-3, 1e-9,
       1},
      {kJointEffort, "max_effort_excess", "effort past its limit, over the limit", "1", 0.01, 2e-3, 1e-9, 1},
      {kPull, "max_pull_bw", "normal force below its least value, over body weight", "1", 1e-3, 2e-4, 1e-9, 1},
      {kFriction, "max_friction_excess", "friction past its coefficient, over the coefficient", "1", 0.01, 2e-3, 1e-9,
       10},
      {kApproach, "max_separation_speed_m_s", "speed at which a surface rises when it is said to touch down", "m/s",
       5e-6, 1e-6, 1e-9, 1},
      {kPeriodicity, "max_periodicity_error", "difference of the end from the start", "rad, m, rad/s or m/s", 1e-4,
       2e-5, 1e-9, 1},
      {kEnergy, "max_energy_error", "energy that appears or vanishes, over the work", "1", 5e-3, 1e-3, 1e-9, 1},
      {kMomentum, "max_momentum_error_m_s", "momentum that appears or vanishes, over the mass", "m/s", 5e-3, 1e-3, 1e-9,
       1},
  }};
  return table;
}

namespace {

CriterionValues BoundsOf(double CriterionTraits::*level) {
  CriterionValues bounds;
  for (const CriterionTraits& traits : Criteria()) bounds[traits.criterion] = traits.*level;
  return bounds;
}

}  // namespace

CriterionValues StandardBounds() { return BoundsOf(&CriterionTraits::standard); }
CriterionValues FineBounds() { return BoundsOf(&CriterionTraits::fine); }

std::string Describe(const std::vector<Excess>& excesses) {
  std::ostringstream text;
  for (const Excess& excess : excesses) {
    const CriterionTraits& traits = TraitsOf(excess.criterion);
    if (&excess != &excesses.front()) text << "; ";
    text << traits.meaning;
    if (!excess.finding.where.empty()) text << " (" << excess.finding.where << " at " << excess.finding.time << " s)";
    text << ", " << excess.finding.value << " where " << excess.bound << " " << traits.unit << " was asked for";
  }
  return text.str();
}

Verdict JudgeFindings(const std::array<Finding, kCriterionCount>& findings, const CriterionValues& bounds) {
  Verdict verdict;
  for (const CriterionTraits& traits : Criteria()) {
    const double bound = bounds[traits.criterion];
    if (bound == kInfinity) continue;
    if (verdict.kind == Verdict::Kind::kNotJudged) verdict.kind = Verdict::Kind::kWithin;
    const Finding& finding = findings[static_cast<int>(traits.criterion)];
    if (finding.value <= bound) continue;
    verdict.kind = Verdict::Kind::kExceeded;
    verdict.excesses.push_back({traits.criterion, bound, finding});
  }
  std::stable_sort(verdict.excesses.begin(), verdict.excesses.end(),
                   [](const Excess& a, const Excess& b) { return a.ratio() > b.ratio(); });
  return verdict;
}

}  // namespace rollgait
