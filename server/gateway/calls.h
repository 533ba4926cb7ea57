// What becomes of a call of rollgaitd: one answer, or server-sent events.
#ifndef ROLLGAIT_SERVER_GATEWAY_CALLS_H_
#define ROLLGAIT_SERVER_GATEWAY_CALLS_H_

#include <atomic>
#include <cstdint>
#include <memory>

#include "server/gateway/http_exchange.h"
#include "server/gateway/problem.h"
#include "server/gateway/routes.h"
#include "server/gateway/upstream.h"

namespace rollgait::server {

// What all answers of a gateway take together. Calls that end late keep it alive.
struct GatewayUse {
  std::atomic<int> streams{0};
  std::atomic<int64_t> answer_bytes{0};  // that are not taken yet
};

struct CallContext {
  const ResolvedRoute* route;
  HttpHeaders headers;  // of the answer, whatever it is
  bool behind_door;     // the door is told of refusals
  std::shared_ptr<HttpAnswer> answer;
  std::shared_ptr<GatewayUse> use;
};

void SendProblem(const Problem& problem, HttpHeaders headers, HttpAnswer& answer);

// An answer that would make GatewayUse::answer_bytes more than `most`, and is not the only one, becomes a 503.
void AnswerOnce(const CallContext& context, const std::shared_ptr<grpc::Channel>& channel,
                UpstreamCall::Request request, int64_t most);

// The stream is counted already, and is one less when it is over. One message is held at a time: the next one is read
// when the client has taken it. A client that does not take it in time is told why in the last event, for when it reads
// on, and so is the log.
void AnswerWithEvents(const CallContext& context, const std::shared_ptr<grpc::Channel>& channel,
                      UpstreamCall::Request request);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_CALLS_H_
