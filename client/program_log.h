#ifndef ROLLGAIT_CLIENT_PROGRAM_LOG_H_
#define ROLLGAIT_CLIENT_PROGRAM_LOG_H_

#include <string>
#include <vector>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// What a program of the search was and where it started, as far as that differs from the request: "from a guess, one
// step with its mirror image, powers smoothed by 40 W".
std::string ProgramWords(const v1::Solve& solve, const v1::MeshStatistics& program);

// A sentence for each program of the search, in the order in which they were solved: also what it was solved on, how it
// ended and what it reached.
std::vector<std::string> ProgramSentences(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_PROGRAM_LOG_H_
