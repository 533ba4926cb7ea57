#ifndef ROLLGAIT_CLIENT_EXPLANATION_H_
#define ROLLGAIT_CLIENT_EXPLANATION_H_

#include <string>
#include <vector>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// A finished solve in sentences, under headings: how it ended; which constraints are not met and which accuracy bounds
// are exceeded; which limits the motion sits on; how the iterations went; what to change. A heading that there is
// nothing to say under is left out.
//   iterations  the solver's log; empty: only the meshes are told of
std::string Explain(const v1::Solve& solve, const std::vector<v1::Iteration>& iterations);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_EXPLANATION_H_
