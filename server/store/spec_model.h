#ifndef ROLLGAIT_SERVER_STORE_SPEC_MODEL_H_
#define ROLLGAIT_SERVER_STORE_SPEC_MODEL_H_

#include <string>

#include "rollgait/v1/solve_spec.pb.h"

namespace rollgait::server {

// The model that lists filter by (SolveFilter::model): its name, or "own" for one that the request carries.
inline std::string ModelOf(const v1::SolveSpec& spec) { return spec.model().has_own() ? "own" : spec.model().name(); }

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SPEC_MODEL_H_
