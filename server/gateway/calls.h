// What becomes of a call of rollgaitd: one answer, or server-sent events.
#ifndef ROLLGAIT_SERVER_GATEWAY_CALLS_H_
#define ROLLGAIT_SERVER_GATEWAY_CALLS_H_

#include <atomic>
#include <cstdint>
#include <memory>

#include "server/base/executor.h"
#include "server/gateway/http_exchange.h"
#include "server/gateway/places.h"
#include "server/gateway/problem.h"
#include "server/gateway/routes.h"
#include "server/gateway/upstream.h"

namespace rollgait::server {

// What is longer is turned into JSON, or from it, in threads for that alone.
inline constexpr size_t kLongText = 64 << 10;

// What all answers of a gateway share. Calls that end late keep it alive; whoever ends the gateway waits for `calls`.
struct GatewayUse {
  std::atomic<int> calls{0};             // that have not ended
  std::atomic<int64_t> answer_bytes{0};  // that are not taken yet
};

struct CallContext {
  const ResolvedRoute* route;
  HttpHeaders headers;  // of the answer, whatever it is
  bool behind_door;     // the door is told of refusals
  std::shared_ptr<HttpAnswer> answer;
  std::shared_ptr<GatewayUse> use;
  Executor* conversions;  // of long answers, so that they take no thread of gRPC; outlives the calls
  Place stream;           // until it is over
  Place body;             // of a long body, until rollgaitd answers
};

void SendProblem(const Problem& problem, HttpHeaders headers, HttpAnswer& answer);

// Lets the body come (HttpAnswer::TakeBody) if `request`, a call that costs rollgaitd little, is not refused for who
// calls or how often; a caller who only may not make this call is one that is known.
void AskForBody(CallContext context, const std::shared_ptr<grpc::Channel>& channel,
                const UpstreamCall::Request& request);

// An answer that would make GatewayUse::answer_bytes more than `most`, and is not the only one, becomes a 503.
void AnswerOnce(CallContext context, const std::shared_ptr<grpc::Channel>& channel,
                const UpstreamCall::Request& request, int64_t most);

// One message is held at a time: the next one is read when the client has taken it. A client that does not take it in
// time is told why in the last event, for when it reads on, and so is the log.
void AnswerWithEvents(CallContext context, const std::shared_ptr<grpc::Channel>& channel,
                      const UpstreamCall::Request& request);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_CALLS_H_
