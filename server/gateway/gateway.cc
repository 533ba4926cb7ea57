#include "server/gateway/gateway.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "generated/openapi.h"
#include "server/base/door_headers.h"
#include "server/base/listen_address.h"
#include "server/base/listen_socket.h"
#include "server/base/request_limit.h"
#include "server/base/trace_context.h"
#include "server/gateway/request_message.h"

namespace rollgait::server {
namespace {

constexpr int kThreads = 4;       // that turn short requests into messages
constexpr size_t kWaiting = 256;  // requests
constexpr char kDocument[] = "/v1/openapi.json";

Problem BadRequest(const std::string& message) { return MakeProblem(400, grpc::StatusCode::INVALID_ARGUMENT, message); }

std::string LowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return c < 128 ? std::tolower(c) : c; });
  return text;
}

// A page of this server's own address asks: http://HOST or https://HOST.
bool IsOwnOrigin(const HttpRequest& request, const std::string& origin) {
  const std::string host = LowerCase(request.Header("host"));
  return !host.empty() && (origin == "http://" + host || origin == "https://" + host);
}

bool IsJson(std::string type) {
  type = type.substr(0, type.find(';'));
  while (!type.empty() && type.back() == ' ') type.pop_back();
  return LowerCase(type) == "application/json";
}

// Says by its length that it has one.
bool HasBody(const HttpRequest& request) {
  return request.Header("content-length").find_first_not_of('0') != std::string::npos;
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
    : options_(options),
      upstream_(options.server),
      streams_(std::make_shared<Places>(
          "streams", options.streams,
          options.streams_per_peer > 0 ? options.streams_per_peer : std::max(1, options.streams / 2))),
      long_bodies_(std::make_shared<Places>("long bodies", options.long_bodies, options.long_bodies_per_peer)),
      executor_(kThreads, kWaiting),
      bodies_(1, kWaiting),
      answers_(1, kWaiting) {}

Gateway::~Gateway() {
  executor_.Stop();
  bodies_.Stop();
  for (int calls = 0; (calls = use_->calls.load()) > 0;) use_->calls.wait(calls);
}

void Gateway::Handle(HttpRequest request, std::shared_ptr<HttpAnswer> answer) {
  const HttpHeaders headers = HeadersFor(request);
  Executor& executor = request.body.size() > kLongText ? bodies_ : executor_;
  const auto shared = std::make_shared<HttpRequest>(std::move(request));
  if (executor.TryPost([this, shared, answer] { Answer(std::move(*shared), answer); })) return;
  SendProblem(MakeProblem(503, grpc::StatusCode::UNAVAILABLE, "too many requests wait; try again", 1), headers,
              *answer);
}

void Gateway::Admit(const HttpRequest& head, std::shared_ptr<HttpAnswer> answer) {
  const std::unique_ptr<Target> target = Find(head, *answer);
  if (target == nullptr) return;
  const ResolvedRoute& route = *target->match.route;
  if (route.route->body[0] == '\0') {
    return SendProblem(BadRequest("this request has no body"), target->headers, *answer);
  }
  Outcome<Place> place = long_bodies_->Take(SourceOf(head));
  if (!place.ok()) {
    return SendProblem(MakeProblem(503, grpc::StatusCode::UNAVAILABLE, place.error().message, 1), target->headers,
                       *answer);
  }
  UpstreamCall::Request call = MakeCall(route, head, "");
  call.method = "/" + route.method->service()->full_name() + "/GetServerInfo";
  call.deadline = options_.call_time;
  AskForBody({&route, std::move(target->headers), options_.behind_door, std::move(answer), use_, &answers_, nullptr,
              std::move(place).value()},
             upstream_.channel(), call);
}

HttpHeaders Gateway::HeadersFor(const HttpRequest& head) const {
  HttpHeaders headers;
  if (options_.origins.empty()) return headers;
  headers.emplace_back("Vary", "Origin");
  if (const std::string origin = head.Header("origin"); IsAllowedOrigin(origin)) {
    headers.emplace_back("Access-Control-Allow-Origin", origin);
    headers.emplace_back("Access-Control-Expose-Headers", "Allow, Retry-After");
  }
  return headers;
}

std::string Gateway::SourceOf(const HttpRequest& request) const {
  return options_.behind_door ? PeerKey(request.Header(kDoorPeer)) : request.peer;
}

bool Gateway::IsAllowedOrigin(const std::string& origin) const {
  return std::find(options_.origins.begin(), options_.origins.end(), origin) != options_.origins.end();
}

std::optional<Problem> Gateway::OriginProblem(const HttpRequest& request) const {
  const auto denied = [](const char* why) { return MakeProblem(403, grpc::StatusCode::PERMISSION_DENIED, why); };
  if (options_.names_loopback && !IsLoopbackHost(HostOf(request.Header("host")))) {
    return denied("this server answers requests to 127.0.0.1 and localhost only");
  }
  const std::string origin = request.Header("origin");
  if (origin.empty() || IsAllowedOrigin(origin) || IsOwnOrigin(request, origin)) return std::nullopt;
  return denied("pages of this origin may not ask; rollgait-gateway --allow-origin lets them");
}

std::unique_ptr<Gateway::Target> Gateway::Find(const HttpRequest& request, HttpAnswer& answer) const {
  const size_t mark = request.uri.find('?');
  const std::string path = request.uri.substr(0, mark);
  auto target = std::make_unique<Target>();
  target->query = mark == std::string::npos ? "" : request.uri.substr(mark + 1);
  target->headers = HeadersFor(request);
  if (const auto problem = OriginProblem(request); problem.has_value()) {
    SendProblem(*problem, target->headers, answer);
    return nullptr;
  }
  if (path != kDocument) {
    target->match = routes_.Match(request.verb, path);
  } else if (request.verb == "GET" || request.verb == "HEAD") {
    answer.Send({200, target->headers, "application/json", std::make_shared<const std::string>(OpenApiDocument())});
    return nullptr;
  } else {
    target->match.allowed = "GET, HEAD";
  }
  if (target->match.route == nullptr && request.verb == "OPTIONS" && !target->match.allowed.empty() &&
      IsAllowedOrigin(request.Header("origin"))) {
    target->headers.emplace_back("Access-Control-Allow-Methods", target->match.allowed);
    target->headers.emplace_back("Access-Control-Allow-Headers",
                                 "authorization, content-type, last-event-id, traceparent");
    target->headers.emplace_back("Access-Control-Max-Age", "600");
    answer.Send({204, target->headers, ""});
    return nullptr;
  }
  if (target->match.route == nullptr) {
    SendProblem(NoRoute(target->match, request), target->headers, answer);
    return nullptr;
  }
  // Also what keeps pages of other sites from sending it without asking first.
  if (HasBody(request) && !IsJson(request.Header("content-type"))) {
    SendProblem(
        MakeProblem(415, grpc::StatusCode::INVALID_ARGUMENT, "a body must have the Content-Type application/json"),
        target->headers, answer);
    return nullptr;
  }
  return target;
}

void Gateway::Answer(HttpRequest request, const std::shared_ptr<HttpAnswer>& answer) {
  const std::unique_ptr<Target> target = Find(request, *answer);
  if (target == nullptr) return;
  const RouteMatch& match = target->match;
  Outcome<std::string> message =
      MakeRequestMessage(*match.route, match.id, target->query, request.body, request.Header("last-event-id"));
  if (!message.ok()) return SendProblem(BadRequest(message.error().message), target->headers, *answer);
  if (message.value().size() > kMaxRequestBytes) {
    const std::string limit = std::to_string(kMaxRequestBytes);
    return SendProblem(MakeProblem(413, grpc::StatusCode::INVALID_ARGUMENT,
                                   "the body is a message of " + std::to_string(message.value().size()) +
                                       " bytes, the limit is " + limit + " as for the body"),
                       target->headers, *answer);
  }
  request.body = std::string();
  Begin(*target, std::move(request), std::move(message).value(), answer);
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
  for (const char* name : {kDoorPeer, kDoorCertificate}) {
    if (options_.behind_door && request.headers.count(name) > 0) call.metadata.emplace_back(name, request.Header(name));
  }
  return call;
}

void Gateway::Begin(const Target& target, HttpRequest request, std::string message,
                    const std::shared_ptr<HttpAnswer>& answer) {
  const ResolvedRoute& route = *target.match.route;
  CallContext context{&route,    target.headers, options_.behind_door,    answer, use_,
                      &answers_, nullptr,        std::move(request.place)};
  UpstreamCall::Request call = MakeCall(route, request, std::move(message));
  if (!route.streams()) {
    return AnswerOnce(std::move(context), upstream_.channel(), call, options_.answer_bytes);
  }
  Outcome<Place> place = streams_->Take(SourceOf(request));
  if (!place.ok()) {
    return SendProblem(MakeProblem(503, grpc::StatusCode::UNAVAILABLE, place.error().message, 5), target.headers,
                       *answer);
  }
  context.stream = std::move(place).value();
  AnswerWithEvents(std::move(context), upstream_.MakeChannel(), call);
}

}  // namespace rollgait::server
