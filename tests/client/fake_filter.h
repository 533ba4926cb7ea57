// What the fake service lists.
#ifndef ROLLGAIT_TESTS_CLIENT_FAKE_FILTER_H_
#define ROLLGAIT_TESTS_CLIENT_FAKE_FILTER_H_

#include "rollgait/v1/gait_service.pb.h"

namespace rollgait::client {

// Whether a solve passes all that ListSolves asks for.
bool Passes(const v1::Solve& solve, const v1::ListSolvesRequest& request);

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_CLIENT_FAKE_FILTER_H_
