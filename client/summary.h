// A finished solve in words.
#ifndef ROLLGAIT_CLIENT_SUMMARY_H_
#define ROLLGAIT_CLIENT_SUMMARY_H_

#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Several lines: how it ended, speed, step length, phases, cost terms, the accuracy report, constraints that were not
// met. Colours only if `color`. Works for every state.
std::string Summarize(const v1::Solve& solve, bool color);

// One sentence on how the solve stands: "optimal, accuracy within the requested bounds: …", "failed (crash): …",
// "running".
std::string Verdict(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SUMMARY_H_
