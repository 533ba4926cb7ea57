#ifndef ROLLGAIT_SERVER_CONVERT_GAIT_REQUEST_CONVERT_H_
#define ROLLGAIT_SERVER_CONVERT_GAIT_REQUEST_CONVERT_H_

#include "core/base/result.h"
#include "core/gait/gait_spec.h"
#include "rollgait/v1/solve_spec.pb.h"

namespace rollgait::server {

// Translates field for field. Refuses what a GaitRequest cannot say: enum values without a name, a cost without a term.
// Ranges are not checked.
Result<GaitRequest> DecodeRequest(const v1::SolveSpec& spec);

// Translates and checks. The violations are those of both steps; their fields are paths relative to the spec.
Result<GaitSpec> DecodeSpec(const v1::SolveSpec& spec);

// Translates the choice of a body, with violations relative to the selection. For GetModel.
Result<BodyRequest> DecodeBody(const v1::ModelSelection& selection);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_GAIT_REQUEST_CONVERT_H_
