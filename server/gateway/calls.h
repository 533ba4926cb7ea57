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

struct CallContext {
  const ResolvedRoute* route;
  HttpHeaders headers;  // of the answer, whatever it is
  bool behind_door;     // the door is told of refusals
  std::shared_ptr<HttpAnswer> answer;
};

void SendProblem(const Problem& problem, HttpHeaders headers, HttpAnswer& answer);

// `held` counts bytes of answers that are not taken yet; an answer that would make them more than `most`, and is not
// the only one, becomes a 503. It outlives the answer.
void AnswerOnce(const CallContext& context, const std::shared_ptr<grpc::Channel>& channel,
                UpstreamCall::Request request, std::atomic<int64_t>& held, int64_t most);

// `streams` is one less when the stream is over. One message is held at a time: the next one is read when the client
// has taken it. A client that does not take it in time is told why in the last event, for when it reads on, and so is
// the log.
void AnswerWithEvents(const CallContext& context, const std::shared_ptr<grpc::Channel>& channel,
                      UpstreamCall::Request request, std::atomic<int>& streams);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_CALLS_H_
