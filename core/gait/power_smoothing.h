#ifndef ROLLGAIT_CORE_GAIT_POWER_SMOOTHING_H_
#define ROLLGAIT_CORE_GAIT_POWER_SMOOTHING_H_

#include <optional>

#include "core/gait/gait_spec.h"

namespace rollgait {

// Of a term that is a power (W); null for others. Those of a spec are filled.
std::optional<double>* SmoothingOf(GaitSpec::CostTerm* cost);

// W: the least smoothing of a power (core/ocp/costs/power_price.h) among the costs of the spec. Nothing where none is a
// power.
std::optional<double> LeastSmoothing(const GaitSpec& spec);

// The spec with powers smoothed by `smoothing`, W, at least.
GaitSpec SmoothedBy(double smoothing, GaitSpec spec);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_POWER_SMOOTHING_H_
