#ifndef ROLLGAIT_SERVER_GATEWAY_GATEWAY_H_
#define ROLLGAIT_SERVER_GATEWAY_GATEWAY_H_

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/base/executor.h"
#include "server/gateway/calls.h"
#include "server/gateway/http_exchange.h"
#include "server/gateway/places.h"
#include "server/gateway/problem.h"
#include "server/gateway/routes.h"
#include "server/gateway/upstream.h"

namespace rollgait::server {

struct GatewayOptions {
  std::string server = "127.0.0.1:50051";  // rollgaitd: a loopback address or unix:PATH
  bool behind_door = false;                // x-rollgait-* headers are the door's word and go on; else they are ignored
  bool names_loopback = false;  // requests must name a loopback host: pages of other sites cannot then, by DNS either
  std::vector<std::string> origins;  // pages of these may ask from a browser; others are refused
  std::chrono::milliseconds call_time{60'000};
  std::chrono::milliseconds stream_time{3'600'000};
  int streams = 64;          // that are open at once
  int streams_per_peer = 0;  // 0: half of them, so that no one keeps all others out
  int long_bodies = 12;      // on their way or not answered yet; a long one is HttpLimits::short_body_bytes
  int long_bodies_per_peer = 4;
  int64_t answer_bytes =
      int64_t{128} << 20;  // of answers that clients have not taken; beyond, one is refused unless it is alone
};

// Requests of HTTP as calls of rollgaitd. It decides nothing that rollgaitd decides: who calls, what a request may ask
// for.
class Gateway final : public HttpService {
 public:
  explicit Gateway(const GatewayOptions& options);
  // The server that calls it is gone, with all its answers.
  ~Gateway() override;
  // Of CORS.
  HttpHeaders HeadersFor(const HttpRequest& head) const override;
  // Lets a long body come when rollgaitd knows who calls, and there is a place for it.
  void Admit(const HttpRequest& head, std::shared_ptr<HttpAnswer> answer) override;
  void Handle(HttpRequest request, std::shared_ptr<HttpAnswer> answer) override;

 private:
  // A request that names a call.
  struct Target {
    RouteMatch match;
    std::string query;
    HttpHeaders headers;  // of the answer
  };
  // Null: there is nothing to call, and `answer` has it.
  std::unique_ptr<Target> Find(const HttpRequest& request, HttpAnswer& answer) const;
  // Why a browser may not ask so.
  std::optional<Problem> OriginProblem(const HttpRequest& request) const;
  void Answer(HttpRequest request, const std::shared_ptr<HttpAnswer>& answer);
  void Begin(const Target& target, HttpRequest request, std::string message, const std::shared_ptr<HttpAnswer>& answer);
  bool IsAllowedOrigin(const std::string& origin) const;
  std::string SourceOf(const HttpRequest& request) const;
  UpstreamCall::Request MakeCall(const ResolvedRoute& route, const HttpRequest& request, std::string message) const;

  const GatewayOptions options_;
  const RouteTable routes_;
  const Upstream upstream_;
  const std::shared_ptr<GatewayUse> use_ = std::make_shared<GatewayUse>();
  const std::shared_ptr<Places> streams_, long_bodies_;
  Executor executor_;  // of short requests
  // Of long texts, one thread each, so that one at a time takes memory; who sends bodies that are slow to convert holds
  // up no answers.
  Executor bodies_, answers_;
};

// What GET /v1/openapi.json answers with.
std::string OpenApiDocument();

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_GATEWAY_H_
