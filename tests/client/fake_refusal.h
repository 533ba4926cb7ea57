#ifndef ROLLGAIT_TESTS_CLIENT_FAKE_REFUSAL_H_
#define ROLLGAIT_TESTS_CLIENT_FAKE_REFUSAL_H_

#include <google/rpc/error_details.pb.h>
#include <google/rpc/status.pb.h>
#include <grpcpp/support/status.h>

#include <string>
#include <utility>
#include <vector>

namespace rollgait::client {

// INVALID_ARGUMENT with violations, each a field and what is wrong with it, as the server answers.
inline grpc::Status Refusal(const std::vector<std::pair<std::string, std::string>>& violations) {
  google::rpc::BadRequest details;
  for (const auto& [field, description] : violations) {
    auto* const violation = details.add_field_violations();
    violation->set_field(field);
    violation->set_description(description);
  }
  google::rpc::Status rich;
  rich.set_code(static_cast<int>(grpc::StatusCode::INVALID_ARGUMENT));
  rich.set_message("the request is not valid");
  rich.add_details()->PackFrom(details);
  return {grpc::StatusCode::INVALID_ARGUMENT, rich.message(), rich.SerializeAsString()};
}

// RESOURCE_EXHAUSTED that asks to try again after so many seconds.
inline grpc::Status Busy(int seconds) {
  google::rpc::RetryInfo retry;
  retry.mutable_retry_delay()->set_seconds(seconds);
  google::rpc::Status rich;
  rich.set_code(static_cast<int>(grpc::StatusCode::RESOURCE_EXHAUSTED));
  rich.add_details()->PackFrom(retry);
  return {grpc::StatusCode::RESOURCE_EXHAUSTED, "too many a second", rich.SerializeAsString()};
}

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_CLIENT_FAKE_REFUSAL_H_
