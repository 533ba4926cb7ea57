#ifndef ROLLGAIT_SERVER_GATEWAY_GATEWAY_H_
#define ROLLGAIT_SERVER_GATEWAY_GATEWAY_H_

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "server/base/executor.h"
#include "server/gateway/calls.h"
#include "server/gateway/http_exchange.h"
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
  int streams = 64;  // that are open at once
  int64_t answer_bytes =
      int64_t{128} << 20;  // of answers that clients have not taken; beyond, one is refused unless it is alone
};

// Requests of HTTP as calls of rollgaitd. It decides nothing that rollgaitd decides: who calls, what a request may ask
// for.
class Gateway {
 public:
  explicit Gateway(const GatewayOptions& options);
  // Answers in its own time; never blocks. The gateway outlives the server that calls it.
  void Handle(HttpRequest request, std::shared_ptr<HttpAnswer> answer);

 private:
  void Answer(const HttpRequest& request, const std::shared_ptr<HttpAnswer>& answer);
  void Begin(const RouteMatch& match, const HttpRequest& request, std::string message, HttpHeaders headers,
             const std::shared_ptr<HttpAnswer>& answer);
  bool IsAllowedOrigin(const std::string& origin) const;
  UpstreamCall::Request MakeCall(const ResolvedRoute& route, const HttpRequest& request, std::string message) const;

  const GatewayOptions options_;
  const RouteTable routes_;
  const Upstream upstream_;
  const std::shared_ptr<GatewayUse> use_ = std::make_shared<GatewayUse>();
  Executor executor_;
};

// What GET /v1/openapi.json answers with.
std::string OpenApiDocument();

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_GATEWAY_H_
