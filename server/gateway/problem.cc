#include "server/gateway/problem.h"

#include <google/protobuf/util/json_util.h>

#include <memory>
#include <utility>

#include "google/rpc/code.pb.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "server/gateway/json.h"

namespace rollgait::server {
namespace {

// What lies in an Any, with its type in "@type"; where nobody knows the type, the type alone.
std::string DetailJson(const google::protobuf::Any& detail) {
  std::string json;
  if (google::protobuf::util::MessageToJsonString(detail, &json).ok()) return json;
  return "{\"@type\":" + JsonString(PlainText(detail.type_url())) + "}";
}

std::string ErrorJson(int http_status, grpc::StatusCode code, const std::string& message, const std::string& details) {
  return "{\"error\":{\"code\":" + std::to_string(http_status) +
         ",\"status\":" + JsonString(google::rpc::Code_Name(static_cast<google::rpc::Code>(code))) +
         ",\"message\":" + JsonString(message) + (details.empty() ? "" : ",\"details\":[" + details + "]") + "}}";
}

}  // namespace

int HttpStatusOf(grpc::StatusCode code) {
  switch (code) {
    case grpc::StatusCode::OK:
      return 200;
    case grpc::StatusCode::CANCELLED:
      return 499;
    case grpc::StatusCode::INVALID_ARGUMENT:
    case grpc::StatusCode::OUT_OF_RANGE:
      return 400;
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return 504;
    case grpc::StatusCode::NOT_FOUND:
      return 404;
    case grpc::StatusCode::ALREADY_EXISTS:
    case grpc::StatusCode::ABORTED:
      return 409;
    case grpc::StatusCode::PERMISSION_DENIED:
      return 403;
    case grpc::StatusCode::UNAUTHENTICATED:
      return 401;
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return 429;
    case grpc::StatusCode::FAILED_PRECONDITION:
      return 412;
    case grpc::StatusCode::UNIMPLEMENTED:
      return 501;
    case grpc::StatusCode::UNAVAILABLE:
      return 503;
    default:
      return 500;
  }
}

Problem ProblemOf(const grpc::Status& status) {
  Problem problem;
  problem.http_status = HttpStatusOf(status.error_code());
  google::rpc::Status whole;
  std::string message = status.error_message(), details;
  if (whole.ParseFromString(status.error_details())) {
    for (const google::protobuf::Any& detail : whole.details()) {
      google::rpc::RetryInfo retry;
      if (detail.UnpackTo(&retry)) {
        problem.retry_after_s = static_cast<int>(retry.retry_delay().seconds()) + (retry.retry_delay().nanos() > 0);
      }
      details += (details.empty() ? "" : ",") + DetailJson(detail);
    }
  }
  problem.json = ErrorJson(problem.http_status, status.error_code(), PlainText(message), details);
  return problem;
}

HttpResponse ProblemResponse(const Problem& problem, HttpHeaders headers) {
  if (problem.retry_after_s > 0) headers.emplace_back("Retry-After", std::to_string(problem.retry_after_s));
  if (!problem.allow.empty()) headers.emplace_back("Allow", problem.allow);
  if (problem.http_status == 401) headers.emplace_back("WWW-Authenticate", "Bearer");
  if (problem.refused_at_door) headers.emplace_back(kDoorRefused, "unauthenticated");
  return {problem.http_status, std::move(headers), "application/json",
          std::make_shared<const std::string>(problem.json + "\n")};
}

Problem MakeProblem(int http_status, grpc::StatusCode code, const std::string& message, int retry_after_s) {
  return {http_status, ErrorJson(http_status, code, PlainText(message), ""), retry_after_s};
}

}  // namespace rollgait::server
