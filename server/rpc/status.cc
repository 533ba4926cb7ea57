#include "server/rpc/status.h"

#include <string>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "server/base/utf8.h"

namespace rollgait::server {
namespace {

grpc::StatusCode Code(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidArgument:
      return grpc::StatusCode::INVALID_ARGUMENT;
    case ErrorCode::kNotFound:
      return grpc::StatusCode::NOT_FOUND;
    case ErrorCode::kAlreadyExists:
      return grpc::StatusCode::ALREADY_EXISTS;
    case ErrorCode::kFailedPrecondition:
      return grpc::StatusCode::FAILED_PRECONDITION;
    case ErrorCode::kOutOfRange:
      return grpc::StatusCode::OUT_OF_RANGE;
    case ErrorCode::kUnauthenticated:
      return grpc::StatusCode::UNAUTHENTICATED;
    case ErrorCode::kPermissionDenied:
      return grpc::StatusCode::PERMISSION_DENIED;
    case ErrorCode::kResourceExhausted:
      return grpc::StatusCode::RESOURCE_EXHAUSTED;
    case ErrorCode::kUnavailable:
      return grpc::StatusCode::UNAVAILABLE;
    case ErrorCode::kDeadlineExceeded:
      return grpc::StatusCode::DEADLINE_EXCEEDED;
    case ErrorCode::kLeaseLost:  // concerns agents only
    case ErrorCode::kInternal:
      return grpc::StatusCode::INTERNAL;
  }
  return grpc::StatusCode::INTERNAL;
}

// At most about kMaxText bytes of valid UTF-8 without control characters, as protobuf strings and terminals want it.
std::string Text(const std::string& text) {
  std::string clean;
  for (size_t i = 0; i < text.size();) {
    const size_t length = Utf8SequenceLength(text, i);
    if (clean.size() + length > kMaxText) return clean + "…";
    const bool printable = length > 1 || (length == 1 && text[i] >= ' ' && text[i] != 0x7f);
    clean += printable ? text.substr(i, length) : "?";
    i += length == 0 ? 1 : length;
  }
  return clean;
}

}  // namespace

grpc::Status ToStatus(const Error& error) {
  google::rpc::Status details;
  details.set_code(Code(error.code));
  details.set_message(Text(error.message));
  if (!error.violations.empty()) {
    google::rpc::BadRequest bad_request;
    for (const Violation& violation : error.violations) {
      if (bad_request.ByteSizeLong() > kMaxDetailBytes) break;
      auto* field = bad_request.add_field_violations();
      field->set_field(Text(violation.field));
      field->set_description(Text(violation.message));
    }
    details.add_details()->PackFrom(bad_request);
  }
  if (error.quota.has_value()) {
    google::rpc::QuotaFailure failure;
    failure.add_violations()->set_subject(Text(error.quota->subject));
    failure.mutable_violations(0)->set_description(Text(error.quota->description));
    details.add_details()->PackFrom(failure);
  }
  if (error.retry_after.has_value()) {
    google::rpc::RetryInfo retry;
    const auto milliseconds = error.retry_after->count();
    retry.mutable_retry_delay()->set_seconds(milliseconds / 1000);
    retry.mutable_retry_delay()->set_nanos(static_cast<int32_t>(milliseconds % 1000) * 1'000'000);
    details.add_details()->PackFrom(retry);
  }
  return grpc::Status(Code(error.code), details.message(),
                      details.details_size() > 0 ? details.SerializeAsString() : "");
}

}  // namespace rollgait::server
