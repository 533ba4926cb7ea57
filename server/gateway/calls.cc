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
class Session : public std::enable_shared_from_this<Session> {
 public:
  explicit Session(CallContext context) : context_(std::move(context)), body_(std::move(context_.body)) {
    ++context_.use->calls;
  }
  virtual ~Session() {
    if (--context_.use->calls == 0) context_.use->calls.notify_all();
  }

  void Attach(const std::shared_ptr<UpstreamCall>& call) {
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
  // The client is gone, or has been told that it gets nothing more.
  bool IsCancelled() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return closed_;
  }
  // rollgaitd has the request.
  void GiveBodyBack() {
    Place last;
    const std::lock_guard<std::mutex> lock(mutex_);
    last.swap(body_);
  }
  // Work with a text of so many bytes.
  void Convert(size_t bytes, std::function<void()> work) {
    if (bytes <= kLongText) return work();
    context_.conversions->Post([self = shared_from_this(), work = std::move(work)] { work(); });
  }
  Problem ProblemOfEnd(const CallEnd& end) const {
    Problem problem = ProblemOf(end.status);
    problem.refused_at_door = context_.behind_door && end.refused_at_door;
    return problem;
  }

  CallContext context_;  // not changed after construction
  std::mutex mutex_;     // protects what follows
  Place body_;
  std::shared_ptr<UpstreamCall> call_;
  bool closed_ = false, reads_ = false;
};

class UnarySession final : public Session {
 public:
  UnarySession(CallContext context, int64_t most) : Session(std::move(context)), most_(most) {}
  ~UnarySession() override { context_.use->answer_bytes -= bytes_; }

  void OnMessage(std::string message) {
    GiveBodyBack();
    // JSON takes about three times the wire format, and both are held for a moment.
    Hold(4 * static_cast<int64_t>(message.size()));
    if (too_much_) return ReadNext();
    const size_t bytes = message.size();
    Convert(bytes, [this, message = std::move(message)] {
      readable_ = WireToJson(message, *context_.route->method->output_type(), &json_);
      json_ += '\n';
      Hold(static_cast<int64_t>(json_.size()));
      ReadNext();  // the end comes after it, but that of a call that is cancelled
    });
  }

  void OnEnd(const CallEnd& end) {
    GiveBodyBack();
    if (IsCancelled()) return;
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

  void OnWait() { BeginOnce(); }

  void OnMessage(std::string message) {
    GiveBodyBack();
    const size_t bytes = message.size();
    Convert(bytes, [this, message = std::move(message)] {
      const auto text = EventText(*context_.route, message);
      if (!text.has_value()) {
        return EndWith(MakeProblem(500, grpc::StatusCode::INTERNAL, "rollgaitd's event cannot be read"));
      }
      BeginOnce();
      context_.answer->Push(*text);
    });
  }

  void OnStop() { EndWith(MakeProblem(503, grpc::StatusCode::UNAVAILABLE, "the gateway stops; ask again", 1)); }

  void OnSlow() {
    static RateLimit limit(1);
    if (const auto others = limit.Take()) {
      LogEvent(
          spdlog::level::warn, "stream.dropped",
          {{"reason", "the client does not read"}, {"method", context_.route->route->method}, {"suppressed", *others}});
    }
    EndWith(MakeProblem(503, grpc::StatusCode::UNAVAILABLE, "the client has not read in time; the stream ends here"));
  }

  void OnEnd(const CallEnd& end) {
    GiveBodyBack();
    // Nothing more will come: the answer that keeps an EventSource from asking again.
    if (end.status.ok() && !WasBegun()) return context_.answer->Send({204, context_.headers, ""});
    if (end.status.ok()) return context_.answer->End(EndText(""));
    Finish(ProblemOfEnd(end));
  }

 private:
  // Before this; from now on it is.
  bool WasBegun() {
    const std::lock_guard<std::mutex> lock(begin_mutex_);
    return std::exchange(begun_, true);
  }

  // As the last event, or instead of a first one.
  void Finish(const Problem& problem) {
    if (WasBegun()) return context_.answer->End(EndText(problem.json));
    SendProblem(problem, context_.headers, *context_.answer);
  }

  void EndWith(const Problem& problem) {
    Finish(problem);
    Cancel();
  }

  void BeginOnce() {
    const std::lock_guard<std::mutex> lock(begin_mutex_);
    if (std::exchange(begun_, true)) return;
    context_.answer->Begin(context_.headers);
  }

  std::mutex begin_mutex_;
  bool begun_ = false;
};

// The call that asks whether a body may come.
class BodySession final : public Session {
 public:
  using Session::Session;

  void OnMessage(const std::string&) { ReadNext(); }

  void OnEnd(const CallEnd& end) {
    Place place;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      place.swap(body_);
    }
    if (end.status.ok() || end.status.error_code() == grpc::StatusCode::PERMISSION_DENIED) {
      return context_.answer->TakeBody(std::move(place));
    }
    SendProblem(ProblemOfEnd(end), context_.headers, *context_.answer);
  }
};

// Begins the call of a session whose listener is set.
template <typename AnySession>
void Start(const std::shared_ptr<AnySession>& session, const std::shared_ptr<grpc::Channel>& channel,
           const UpstreamCall::Request& request) {
  session->Attach(UpstreamCall::Start(channel, request,
                                      {[session](std::string message) { session->OnMessage(std::move(message)); },
                                       [session](const CallEnd& end) { session->OnEnd(end); }}));
}

}  // namespace

void SendProblem(const Problem& problem, HttpHeaders headers, HttpAnswer& answer) {
  answer.Send(ProblemResponse(problem, std::move(headers)));
}

void AskForBody(CallContext context, const std::shared_ptr<grpc::Channel>& channel,
                const UpstreamCall::Request& request) {
  const std::shared_ptr<HttpAnswer> answer = context.answer;
  const auto session = std::make_shared<BodySession>(std::move(context));
  if (!answer->Listen({{}, {}, {}, {}, [session] { session->Cancel(); }})) return;
  Start(session, channel, request);
}

void AnswerOnce(CallContext context, const std::shared_ptr<grpc::Channel>& channel,
                const UpstreamCall::Request& request, int64_t most) {
  const std::shared_ptr<HttpAnswer> answer = context.answer;
  const auto session = std::make_shared<UnarySession>(std::move(context), most);
  if (!answer->Listen({{}, {}, {}, {}, [session] { session->Cancel(); }})) return;
  Start(session, channel, request);
}

void AnswerWithEvents(CallContext context, const std::shared_ptr<grpc::Channel>& channel,
                      const UpstreamCall::Request& request) {
  const std::shared_ptr<HttpAnswer> answer = context.answer;
  const auto session = std::make_shared<StreamSession>(std::move(context));
  if (!answer->Listen({[session] { session->OnWait(); }, [session] { session->ReadNext(); },
                       [session] { session->OnSlow(); }, [session] { session->OnStop(); },
                       [session] { session->Cancel(); }})) {
    return;
  }
  Start(session, channel, request);
}

}  // namespace rollgait::server
