#ifndef ROLLGAIT_CORE_NLP_TERMINATION_H_
#define ROLLGAIT_CORE_NLP_TERMINATION_H_

#include <string>

#include "core/nlp/result.h"

namespace rollgait {

// A solve that can make no progress counts as acceptable up to this many times the requested tolerance.
inline constexpr double kAcceptableFactor = 100;

// One sentence for people.
std::string Explain(Termination termination);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_TERMINATION_H_
