#ifndef ROLLGAIT_SERVER_CONVERT_SCHEME_CONVERT_H_
#define ROLLGAIT_SERVER_CONVERT_SCHEME_CONVERT_H_

#include <optional>

#include "core/math/scheme.h"
#include "rollgait/v1/solve_spec.pb.h"

namespace rollgait {

v1::Discretization::Scheme EncodeScheme(Scheme scheme);
// Empty for SCHEME_UNSPECIFIED and for what this server does not know.
std::optional<Scheme> DecodeScheme(v1::Discretization::Scheme scheme);

}  // namespace rollgait

#endif  // ROLLGAIT_SERVER_CONVERT_SCHEME_CONVERT_H_
