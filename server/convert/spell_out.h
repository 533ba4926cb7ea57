#ifndef ROLLGAIT_SERVER_CONVERT_SPELL_OUT_H_
#define ROLLGAIT_SERVER_CONVERT_SPELL_OUT_H_

#include "core/base/result.h"
#include "rollgait/v1/solve_spec.pb.h"

namespace rollgait::server {

// The same request with what its preset stands for: every term of the cost with its weight, feet, duty factor and
// clearance. Solved, it gives the same gait. The preset itself goes where gravity is 9.81 m/s²; elsewhere it stays,
// since it also takes limits and passive torques of the body to that gravity, which no other field can say. A request
// without a preset is returned as it is. Violations are those of DecodeSpec.
Result<v1::SolveSpec> SpellOut(const v1::SolveSpec& spec);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_SPELL_OUT_H_
