// Errors as the service answers them.
#ifndef ROLLGAIT_TESTS_CLIENT_FAKE_STATUS_H_
#define ROLLGAIT_TESTS_CLIENT_FAKE_STATUS_H_

#include <grpcpp/support/status.h>

#include <string>
#include <utility>
#include <vector>

namespace rollgait::client {

// NOT_FOUND for a solve of this name.
grpc::Status NotFound(const std::string& name);
// INVALID_ARGUMENT with these fields and what is wrong with them.
grpc::Status Refusal(const std::vector<std::pair<std::string, std::string>>& violations);
// RESOURCE_EXHAUSTED that asks to try again after so many seconds.
grpc::Status Busy(int seconds);

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_CLIENT_FAKE_STATUS_H_
