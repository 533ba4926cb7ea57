#ifndef ROLLGAIT_SERVER_CONVERT_COST_CONVERT_H_
#define ROLLGAIT_SERVER_CONVERT_COST_CONVERT_H_

#include <string>

#include "core/gait/gait_spec.h"
#include "rollgait/v1/solve_spec.pb.h"

namespace rollgait::server {

// One cost term, field for field. A term that is not set is a violation at `field`.
GaitRequest::CostTerm DecodeCost(const std::string& field, const v1::CostTerm& cost, Violations* violations);

// The inverse: what is unset stays unset.
v1::CostTerm EncodeCost(const GaitRequest::CostTerm& cost);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_COST_CONVERT_H_
