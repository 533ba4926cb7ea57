// Errors as JSON: {"error": {"code": 404, "status": "NOT_FOUND", "message": "...", "details": [...]}} (AIP-193).
#ifndef ROLLGAIT_SERVER_GATEWAY_PROBLEM_H_
#define ROLLGAIT_SERVER_GATEWAY_PROBLEM_H_

#include <grpcpp/support/status.h>

#include <string>

#include "server/gateway/http_exchange.h"

namespace rollgait::server {

// Why a request was not answered with what it asked for.
struct Problem {
  int http_status = 500;
  std::string json;        // one line
  int retry_after_s = 0;   // 0: the answer does not say when to try again
  std::string allow = {};  // verbs, with 405
  bool refused_at_door = false;
};

// Of a call: its code, message and details (google.rpc.Status in grpc-status-details-bin; RetryInfo becomes
// retry_after_s). 499 stands for CANCELLED, 412 for FAILED_PRECONDITION, 409 for ALREADY_EXISTS and ABORTED.
Problem ProblemOf(const grpc::Status& status);
int HttpStatusOf(grpc::StatusCode code);

// Of the gateway itself. `message` is valid UTF-8, one sentence.
Problem MakeProblem(int http_status, grpc::StatusCode code, const std::string& message, int retry_after_s = 0);

// Its answer: status, JSON and the headers that go with it, besides `headers`.
HttpResponse ProblemResponse(const Problem& problem, HttpHeaders headers);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_PROBLEM_H_
