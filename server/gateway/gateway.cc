#include "server/gateway/gateway.h"

#include <algorithm>
#include <cctype>
#include <mutex>
#include <utility>

#include "generated/openapi.h"
#include "server/base/listen_address.h"
#include "server/base/trace_context.h"
#include "server/gateway/request_message.h"

namespace rollgait::server {
namespace {

constexpr int kThreads = 6;       // that turn requests into messages: more than there are long bodies at a time
constexpr size_t kWaiting = 256;  // requests
constexpr size_t kLongBody = 1 << 16;
constexpr size_t kMostMessage = size_t{16} << 20;  // that rollgaitd reads

Problem BadRequest(const std::string& message) { return MakeProblem(400, grpc::StatusCode::INVALID_ARGUMENT, message); }

// A page of this server's own address asks: http://HOST or https://HOST.
bool IsOwnOrigin(const HttpRequest& request, const std::string& origin) {
  const std::string host = request.Header("host");
  return !host.empty() && (origin == "http://" + host || origin == "https://" + host);
}

bool IsJson(std::string type) {
  type = type.substr(0, type.find(';'));
  while (!type.empty() && type.back() == ' ') type.pop_back();
  std::transform(type.begin(), type.end(), type.begin(), [](unsigned char c) { return c < 128 ? std::tolower(c) : c; });
  return type == "application/json";
}

Problem NoRoute(const RouteMatch& match, const HttpRequest& request) {
  if (match.allowed.empty()) {
    return MakeProblem(404, grpc::StatusCode::NOT_FOUND, "nothing is here; /v1/openapi.json says what there is");
  }
  Problem problem =
      MakeProblem(405, grpc::StatusCode::UNIMPLEMENTED, request.verb + " is not answered here, but " + match.allowed);
  problem.allow = match.allowed;
  return problem;
}

}  // namespace

std::string OpenApiDocument() { return kOpenApi; }

Gateway::Gateway(const GatewayOptions& options)
    : options_(options), upstream_(options.server), executor_(kThreads, kWaiting) {}

void Gateway::Handle(HttpRequest request, std::shared_ptr<HttpAnswer> answer) {
  const auto shared = std::make_shared<HttpRequest>(std::move(request));
  const bool taken = executor_.TryPost([this, shared, answer] {
    Answer(*shared, answer);
    shared->body = std::string();
  });
  if (!taken) {
    SendProblem(MakeProblem(503, grpc::StatusCode::UNAVAILABLE, "too many requests wait; try again", 1), {}, *answer);
  }
}

bool Gateway::IsAllowedOrigin(const std::string& origin) const {
  return std::find(options_.origins.begin(), options_.origins.end(), origin) != options_.origins.end();
}

void Gateway::Answer(const HttpRequest& request, const std::shared_ptr<HttpAnswer>& answer) {
  const std::string origin = request.Header("origin");
  HttpHeaders headers;
  if (options_.names_loopback && !IsLoopbackHost(HostOf(request.Header("host")))) {
    return SendProblem(MakeProblem(403, grpc::StatusCode::PERMISSION_DENIED,
                                   "this server answers requests to 127.0.0.1 and localhost only"),
                       headers, *answer);
  }
  if (!options_.origins.empty()) headers.emplace_back("Vary", "Origin");
  if (!origin.empty() && IsAllowedOrigin(origin)) {
    headers.emplace_back("Access-Control-Allow-Origin", origin);
  } else if (!origin.empty() && !IsOwnOrigin(request, origin)) {
    return SendProblem(MakeProblem(403, grpc::StatusCode::PERMISSION_DENIED,
                                   "pages of this origin may not ask; rollgait-gateway --allow-origin lets them"),
                       headers, *answer);
  }
  const size_t mark = request.uri.find('?');
  const std::string path = request.uri.substr(0, mark);
  const std::string query = mark == std::string::npos ? "" : request.uri.substr(mark + 1);
  if (path == "/v1/openapi.json" && request.verb == "GET") {
    HttpResponse response{200, headers, "application/json", std::make_shared<const std::string>(OpenApiDocument())};
    return answer->Send(std::move(response));
  }
  const RouteMatch match = routes_.Match(request.verb, path);
  if (match.route == nullptr) {
    if (request.verb == "OPTIONS" && !match.allowed.empty() && IsAllowedOrigin(origin)) {
      headers.emplace_back("Access-Control-Allow-Methods", match.allowed);
      headers.emplace_back("Access-Control-Allow-Headers", "authorization, content-type, last-event-id");
      headers.emplace_back("Access-Control-Max-Age", "600");
      return answer->Send({204, headers, ""});
    }
    return SendProblem(NoRoute(match, request), headers, *answer);
  }
  // Also what keeps pages of other sites from sending it without asking first.
  if (!request.body.empty() && !IsJson(request.Header("content-type"))) {
    return SendProblem(
        MakeProblem(415, grpc::StatusCode::INVALID_ARGUMENT, "a body must have the Content-Type application/json"),
        headers, *answer);
  }
  static std::mutex one_long_body;  // what it takes while it is turned into a message, once
  std::unique_lock<std::mutex> turn(one_long_body, std::defer_lock);
  if (request.body.size() > kLongBody) turn.lock();
  Outcome<std::string> message =
      MakeRequestMessage(*match.route, match.id, query, request.body, request.Header("last-event-id"));
  if (!message.ok()) return SendProblem(BadRequest(message.error().message), headers, *answer);
  if (message.value().size() > kMostMessage) {
    return SendProblem(
        MakeProblem(413, grpc::StatusCode::INVALID_ARGUMENT, "the body is a message of more than 16 MiB"), headers,
        *answer);
  }
  Begin(match, request, std::move(message).value(), std::move(headers), answer);
}

UpstreamCall::Request Gateway::MakeCall(const ResolvedRoute& route, const HttpRequest& request,
                                        std::string message) const {
  UpstreamCall::Request call;
  call.method = route.MethodPath();
  call.message = std::move(message);
  call.deadline = route.streams() ? options_.stream_time : options_.call_time;
  if (request.headers.count("authorization") > 0) {
    call.metadata.emplace_back("authorization", request.Header("authorization"));
  }
  if (IsTraceparent(request.Header("traceparent"))) {
    call.metadata.emplace_back("traceparent", request.Header("traceparent"));
  }
  for (const char* name : {"x-rollgait-peer", "x-rollgait-client-certificate"}) {
    if (options_.behind_door && request.headers.count(name) > 0) call.metadata.emplace_back(name, request.Header(name));
  }
  return call;
}

void Gateway::Begin(const RouteMatch& match, const HttpRequest& request, std::string message, HttpHeaders headers,
                    const std::shared_ptr<HttpAnswer>& answer) {
  const CallContext context{match.route, std::move(headers), options_.behind_door, answer, use_};
  UpstreamCall::Request call = MakeCall(*match.route, request, std::move(message));
  if (!match.route->streams()) {
    return AnswerOnce(context, upstream_.channel(), std::move(call), options_.answer_bytes);
  }
  if (++use_->streams > options_.streams) {
    --use_->streams;
    return SendProblem(MakeProblem(503, grpc::StatusCode::UNAVAILABLE,
                                   std::to_string(options_.streams) + " streams are open already; try again later", 5),
                       context.headers, *answer);
  }
  AnswerWithEvents(context, upstream_.MakeChannel(), std::move(call));
}

}  // namespace rollgait::server
