#ifndef ROLLGAIT_CORE_GAIT_RATE_COSTS_H_
#define ROLLGAIT_CORE_GAIT_RATE_COSTS_H_

#include <string>
#include <vector>

#include "core/gait/gait_spec.h"

namespace rollgait {

// Whether rates of efforts or forces have a price: a term with the weight 0 has none. Efforts change fastest where feet
// come down and lift off, and how fast, only short intervals tell.
bool HasRates(const std::vector<GaitSpec::CostTerm>& costs);
inline bool HasRates(const GaitSpec& spec) { return HasRates(spec.costs); }

// The fields of the terms of rates that have a price, "squared_torque_rate and squared_force_rate"; empty: none has.
std::string NamesOfRates(const std::vector<GaitSpec::CostTerm>& costs);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_RATE_COSTS_H_
