#ifndef ROLLGAIT_CORE_NLP_TERMINATION_H_
#define ROLLGAIT_CORE_NLP_TERMINATION_H_

#include <algorithm>
#include <string>

#include "core/nlp/result.h"

namespace rollgait {

// A solve that can make no progress counts as acceptable up to this error: 100 times the requested tolerance, but never
// more than 1e-3 where less was asked for. Beyond that it is no solution to start from either.
inline double AcceptableError(double tolerance) { return std::max(tolerance, std::min(100 * tolerance, 1e-3)); }

// One word for tables: "optimal", "acceptable", "infeasible", "iterations", "time", "numerics", "cancelled".
const char* WordOf(Termination termination);
// One sentence for people.
std::string Explain(Termination termination);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_TERMINATION_H_
