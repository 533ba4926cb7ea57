// The second verifier: measures the criteria of a trajectory independently of core/validation, with code of its own.
#ifndef ROLLGAIT_BENCH_VERDICT_AUDIT_SECOND_JUDGE_H_
#define ROLLGAIT_BENCH_VERDICT_AUDIT_SECOND_JUDGE_H_

#include "core/gait/gait_spec.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/criteria.h"

namespace rollgait::audit {

// Instants of an interval besides its start at which everything is measured, and steps of its re-integration.
inline constexpr int kInstants = 40;

// The largest measure of each criterion at these instants: a measure of the first judge, who looks at every instant,
// may be larger, but not smaller. Contract: a gait of `spec`.
CriterionValues MeasureTrajectory(const GaitSpec& spec, const Trajectory& trajectory);

}  // namespace rollgait::audit

#endif  // ROLLGAIT_BENCH_VERDICT_AUDIT_SECOND_JUDGE_H_
