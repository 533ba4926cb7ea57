#ifndef ROLLGAIT_SERVER_GATEWAY_MHD_EXCHANGE_H_
#define ROLLGAIT_SERVER_GATEWAY_MHD_EXCHANGE_H_

#include <grpcpp/support/status.h>
#include <microhttpd.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <string>

#include "server/gateway/http_server.h"

namespace rollgait::server {

// One request on a connection of libmicrohttpd, from its first line until its answer is sent. While others work on the
// answer the connection is suspended, so that no thread waits. Answers come from any thread, everything else from that
// of the server.
class MhdExchange final : public HttpAnswer, public std::enable_shared_from_this<MhdExchange> {
 public:
  using Clock = std::chrono::steady_clock;

  // An answer may outlive its server.
  MhdExchange(const HttpLimits& limits, std::string uri, std::string peer);

  // Whatever libmicrohttpd has to say of the request: headers (first call), a piece of its body, its end, and that it
  // goes on.
  MHD_Result OnData(MHD_Connection* connection, const char* verb, const char* data, size_t* size, HttpService& service);
  // The request is over, whatever came of it.
  void OnCompleted();
  // What stands in for it in the content reader of libmicrohttpd.
  ssize_t Read(char* buffer, size_t size);

  // From another thread, a few times a second. True: the connection has taken too long and must be closed.
  bool OnTick(Clock::time_point now);
  // Its request is here and its answer is not sent yet.
  bool IsUnderWay();
  // The library looks at neither reading nor writing.
  bool IsSuspended();
  // Its connection has no request after this one.
  void CloseAfterAnswer();
  // on_stop, when there is a listener, once.
  void OnStop();
  // Of the server itself, instead of an answer.
  void SendProblem(int status, grpc::StatusCode code, const std::string& message, int retry_after_s);
  // Ends the connection at the next opportunity, without an answer.
  void Abort();

  bool Listen(Listener listener) override;
  void TakeBody(Place place) override;
  void Send(HttpResponse response) override;
  void Begin(HttpHeaders headers) override;
  void Push(std::string text) override;
  void End(std::string text) override;

 private:
  enum class State { kHead, kAsking, kAdmitted, kBody, kWorking, kAnswered, kSent, kAborted };

  // mutex_ is held by `lock`; where an answer is queued, `lock` is released.
  using Lock = std::unique_lock<std::mutex>;
  MHD_Result OnHead(MHD_Connection* connection, const char* verb, HttpService& service, Lock& lock);
  MHD_Result QueueAnswer(MHD_Connection* connection, Lock& lock);
  MHD_Result Refuse(MHD_Connection* connection, int status, const std::string& message, Lock& lock);
  void AwaitBody();           // mutex_ is held
  MHD_Response* NewAnswer();  // mutex_ is held
  void Resume();              // mutex_ is held
  void NotifyClosed();        // mutex_ is not held
  std::chrono::milliseconds TimeToTake(size_t bytes) const;

  const HttpLimits limits_;

  std::mutex mutex_;  // protects what follows
  State state_ = State::kHead;
  MHD_Connection* connection_ = nullptr;     // null before the head is here and after the end
  bool suspended_ = false, closes_ = false;  // closes_: after this answer
  HttpRequest request_;
  HttpHeaders own_headers_;  // of answers of the server itself
  Listener listener_;
  Clock::time_point deadline_;
  // The answer: `response_`, or a stream of texts.
  HttpResponse response_;
  bool streams_ = false, ended_ = false, told_slow_ = false, told_wait_ = false, told_stop_ = false,
       owned_ = false;  // owned_: who reads the text tells the owner
  std::string text_;
  size_t taken_ = 0;
  Clock::time_point body_since_, working_since_, pushed_, sent_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_MHD_EXCHANGE_H_
