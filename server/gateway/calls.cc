#include "server/gateway/calls.h"

#include <mutex>
#include <utility>

#include "server/base/logging.h"
#include "server/base/rate_limit.h"
#include "server/gateway/event_text.h"
#include "server/gateway/json.h"

namespace rollgait::server {
namespace {

// The call of an answer: cancelled when the client goes, even if it goes before the call has begun.
class Session {
 public:
  explicit Session(CallContext context) : context_(std::move(context)) {}
  virtual ~Session() = default;

  void Attach(std::shared_ptr<UpstreamCall> call) {
    bool gone = false, reads = false;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      call_ = call;
      gone = closed_;
      reads = reads_;
    }
    if (gone) call->Cancel();
    if (reads) call->ReadNext();
  }
  void Cancel() {
    std::shared_ptr<UpstreamCall> call;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      closed_ = true;
      call = call_;
    }
    if (call != nullptr) call->Cancel();
  }
  void ReadNext() {
    std::shared_ptr<UpstreamCall> call;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      call = call_;
      reads_ = call == nullptr;  // the first message came before Attach, which then asks for the next one
    }
    if (call != nullptr) call->ReadNext();
  }

 protected:
  Problem ProblemOfEnd(const CallEnd& end) const {
    Problem problem = ProblemOf(end.status);
    problem.refused_at_door = context_.behind_door && end.refused_at_door;
    return problem;
  }

  const CallContext context_;
  std::mutex mutex_;  // protects what follows
  std::shared_ptr<UpstreamCall> call_;
  bool closed_ = false, reads_ = false;
};

class UnarySession final : public Session {
 public:
  UnarySession(CallContext context, int64_t most) : Session(std::move(context)), most_(most) {}
  ~UnarySession() override { context_.use->answer_bytes -= bytes_; }

  void OnMessage(std::string message) {
    // JSON takes about three times the wire format, and both are held for a moment.
    Hold(4 * static_cast<int64_t>(message.size()));
    if (!too_much_) {
      readable_ = WireToJson(message, *context_.route->method->output_type(), &json_);
      json_ += '\n';
      Hold(static_cast<int64_t>(json_.size()));
    }
    ReadNext();
  }

  void OnEnd(const CallEnd& end) {
    if (!end.status.ok()) return SendProblem(ProblemOfEnd(end), context_.headers, *context_.answer);
    if (too_much_) {
      return SendProblem(
          MakeProblem(503, grpc::StatusCode::UNAVAILABLE, "too many long answers are under way; try again", 1),
          context_.headers, *context_.answer);
    }
    if (!readable_) {
      return SendProblem(MakeProblem(500, grpc::StatusCode::INTERNAL, "rollgaitd's answer cannot be read"),
                         context_.headers, *context_.answer);
    }
    context_.answer->Send(
        {200, context_.headers, "application/json", std::make_shared<const std::string>(std::move(json_))});
  }

 private:
  void Hold(int64_t bytes) {
    const int64_t all = context_.use->answer_bytes += bytes - std::exchange(bytes_, bytes);
    too_much_ = all > most_ && all != bytes;
  }

  const int64_t most_;
  int64_t bytes_ = 0;
  bool too_much_ = false, readable_ = false;
  std::string json_;
};

class StreamSession final : public Session {
 public:
  explicit StreamSession(CallContext context) : Session(std::move(context)) {}
  ~StreamSession() override { --context_.use->streams; }

  void OnWait() { BeginOnce(); }

  void OnMessage(std::string message) {
    const auto text = EventText(*context_.route, message);
    BeginOnce();
    if (!text.has_value()) {
      context_.answer->End(
          EndText(MakeProblem(500, grpc::StatusCode::INTERNAL, "rollgaitd's event cannot be read").json));
      return Cancel();
    }
    context_.answer->Push(*text);
  }

  void OnSlow() {
    static RateLimit limit(1);
    if (const auto others = limit.Take()) {
      LogEvent(
          spdlog::level::warn, "stream.dropped",
          {{"reason", "the client does not read"}, {"method", context_.route->route->method}, {"suppressed", *others}});
    }
    const Problem problem =
        MakeProblem(503, grpc::StatusCode::UNAVAILABLE, "the client has not read in time; the stream ends here");
    context_.answer->End(EndText(problem.json));
    Cancel();
  }

  void OnEnd(const CallEnd& end) {
    const Problem problem = ProblemOfEnd(end);
    bool begun = false;
    {
      const std::lock_guard<std::mutex> lock(begin_mutex_);
      begun = std::exchange(begun_, true);
    }
    if (begun) return context_.answer->End(EndText(end.status.ok() ? "" : problem.json));
    // Nothing more will come: the answer that keeps an EventSource from asking again.
    if (end.status.ok()) return context_.answer->Send({204, context_.headers, ""});
    SendProblem(problem, context_.headers, *context_.answer);
  }

 private:
  void BeginOnce() {
    const std::lock_guard<std::mutex> lock(begin_mutex_);
    if (std::exchange(begun_, true)) return;
    context_.answer->Begin(context_.headers);
  }

  std::mutex begin_mutex_;
  bool begun_ = false;
};

}  // namespace

void SendProblem(const Problem& problem, HttpHeaders headers, HttpAnswer& answer) {
  if (problem.retry_after_s > 0) headers.emplace_back("Retry-After", std::to_string(problem.retry_after_s));
  if (!problem.allow.empty()) headers.emplace_back("Allow", problem.allow);
  if (problem.http_status == 401) headers.emplace_back("WWW-Authenticate", "Bearer");
  if (problem.refused_at_door) headers.emplace_back("x-rollgait-refused", "unauthenticated");
  answer.Send({problem.http_status, std::move(headers), "application/json",
               std::make_shared<const std::string>(problem.json + "\n")});
}

void AnswerOnce(const CallContext& context, const std::shared_ptr<grpc::Channel>& channel,
                UpstreamCall::Request request, int64_t most) {
  const auto session = std::make_shared<UnarySession>(context, most);
  if (!context.answer->Listen({{}, {}, {}, [session] { session->Cancel(); }})) return;
  session->Attach(UpstreamCall::Start(channel, std::move(request),
                                      {[session](std::string message) { session->OnMessage(std::move(message)); },
                                       [session](const CallEnd& end) { session->OnEnd(end); }}));
}

void AnswerWithEvents(const CallContext& context, const std::shared_ptr<grpc::Channel>& channel,
                      UpstreamCall::Request request) {
  const auto session = std::make_shared<StreamSession>(context);
  if (!context.answer->Listen({[session] { session->OnWait(); }, [session] { session->ReadNext(); },
                               [session] { session->OnSlow(); }, [session] { session->Cancel(); }})) {
    return;
  }
  session->Attach(UpstreamCall::Start(channel, std::move(request),
                                      {[session](std::string message) { session->OnMessage(std::move(message)); },
                                       [session](const CallEnd& end) { session->OnEnd(end); }}));
}

}  // namespace rollgait::server
