#include "server/gateway/mhd_exchange.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <utility>

#include "server/gateway/body_length.h"
#include "server/gateway/problem.h"

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;
using Holder = std::shared_ptr<MhdExchange>;

constexpr int64_t kSlowestBytesPerMs = 128;  // of a client that takes a long text: 1 Mbit/s
constexpr size_t kBlock = 16 << 10;          // that the library asks for at once

ssize_t ReadStream(void* holder, uint64_t, char* buffer, size_t size) {
  return (*static_cast<Holder*>(holder))->Read(buffer, size);
}
void FreeStream(void* holder) { delete static_cast<Holder*>(holder); }
void FreeBody(void* body) { delete static_cast<std::shared_ptr<const std::string>*>(body); }

// Headers as they come; `twice` is set to a name that came twice.
struct HeadersRead {
  std::map<std::string, std::string>& headers;
  std::string twice = "";
};

MHD_Result ReadHeader(void* cls, MHD_ValueKind, const char* name, const char* value) {
  auto& read = *static_cast<HeadersRead*>(cls);
  std::string key = name == nullptr ? "" : name;
  std::transform(key.begin(), key.end(), key.begin(), [](unsigned char c) { return c < 128 ? std::tolower(c) : c; });
  const auto known =
      std::find_if(std::begin(kHeadersRead), std::end(kHeadersRead), [&](const char* header) { return key == header; });
  if (known == std::end(kHeadersRead)) return MHD_YES;
  if (!read.headers.emplace(key, value == nullptr ? "" : value).second) read.twice = key;
  return MHD_YES;
}

}  // namespace

MhdExchange::MhdExchange(const HttpLimits& limits, std::string uri, std::string peer)
    : limits_(limits), deadline_(Clock::now() + limits.head_time) {
  request_.uri = std::move(uri);
  request_.peer = std::move(peer);
}

MHD_Result MhdExchange::OnData(MHD_Connection* connection, const char* verb, const char* data, size_t* size,
                               HttpService& service) {
  Lock lock(mutex_);
  switch (state_) {
    case State::kHead: {
      const MHD_Result result = OnHead(connection, verb, service, lock);
      if (!lock.owns_lock()) return result;  // refused
      const bool asks = state_ == State::kAsking;
      lock.unlock();
      // Nobody but this thread writes the request before the body is let in.
      if (asks) service.Admit(request_, shared_from_this());
      return result;
    }
    case State::kAdmitted:
      AwaitBody();
      return MHD_YES;
    case State::kBody:
      if (*size > 0) {
        request_.body.append(data, *size);
        deadline_ =
            body_since_ + limits_.body_time + milliseconds(1000 * request_.body.size() / limits_.body_bytes_per_s);
        *size = 0;
        return MHD_YES;
      }
      state_ = State::kWorking;
      working_since_ = Clock::now();
      deadline_ = Clock::time_point::max();
      suspended_ = true;
      MHD_suspend_connection(connection);
      lock.unlock();
      service.Handle(std::move(request_), shared_from_this());
      return MHD_YES;
    case State::kAnswered:
      return QueueAnswer(connection, lock);
    case State::kSent:
      *size = 0;  // the rest of a body that was refused
      return MHD_YES;
    case State::kAsking:
    case State::kWorking:
    case State::kAborted:
      return MHD_NO;
  }
  return MHD_NO;
}

MHD_Result MhdExchange::OnHead(MHD_Connection* connection, const char* verb, HttpService& service, Lock& lock) {
  connection_ = connection;
  request_.verb = verb;
  HeadersRead read{request_.headers};
  MHD_get_connection_values(connection, MHD_HEADER_KIND, ReadHeader, &read);
  own_headers_ = service.HeadersFor(request_);
  if (!read.twice.empty()) return Refuse(connection, 400, "the header " + read.twice + " is given twice", lock);
  const BodyLength length = BodyLengthOf(request_, limits_.body_bytes);
  if (length.status != 0) return Refuse(connection, length.status, length.message, lock);
  if (length.bytes > limits_.short_body_bytes) {
    state_ = State::kAsking;
    deadline_ = Clock::time_point::max();
    suspended_ = true;
    MHD_suspend_connection(connection);
    return MHD_YES;
  }
  AwaitBody();
  return MHD_YES;
}

void MhdExchange::AwaitBody() {
  state_ = State::kBody;
  body_since_ = Clock::now();
  deadline_ = body_since_ + limits_.body_time;
}

MHD_Result MhdExchange::Refuse(MHD_Connection* connection, int status, const std::string& message, Lock& lock) {
  response_ = ProblemResponse(MakeProblem(status, grpc::StatusCode::INVALID_ARGUMENT, message), own_headers_);
  closes_ = true;  // what is left of the body is not read
  return QueueAnswer(connection, lock);
}

void MhdExchange::SendProblem(int status, grpc::StatusCode code, const std::string& message, int retry_after_s) {
  Send(ProblemResponse(MakeProblem(status, code, message, retry_after_s), own_headers_));
}

MHD_Response* MhdExchange::NewAnswer() {
  if (streams_) {
    response_.content_type = "text/event-stream";
    response_.status = 200;
    sent_ = Clock::now();
    return MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, kBlock, &ReadStream, new Holder(shared_from_this()),
                                             &FreeStream);
  }
  deadline_ = Clock::now() + TimeToTake(response_.body->size());
  auto* body = new std::shared_ptr<const std::string>(response_.body);
  return MHD_create_response_from_buffer_with_free_callback_cls((*body)->size(), const_cast<char*>((*body)->data()),
                                                                &FreeBody, body);
}

MHD_Result MhdExchange::QueueAnswer(MHD_Connection* connection, Lock& lock) {
  state_ = State::kSent;
  MHD_Response* const answer = NewAnswer();
  if (answer != nullptr) {
    if (!response_.content_type.empty()) {
      MHD_add_response_header(answer, "Content-Type", response_.content_type.c_str());
    }
    if (closes_) MHD_add_response_header(answer, "Connection", "close");
    MHD_add_response_header(answer, "Cache-Control", "no-store");
    MHD_add_response_header(answer, "X-Content-Type-Options", "nosniff");
    for (const auto& [name, value] : response_.headers) {
      MHD_add_response_header(answer, name.c_str(), value.c_str());
    }
  }
  const auto status = static_cast<unsigned>(response_.status);
  // The library holds a lock of the answer while it calls Read, and takes it to queue one.
  lock.unlock();
  if (answer == nullptr) return MHD_NO;
  const MHD_Result queued = MHD_queue_response(connection, status, answer);
  MHD_destroy_response(answer);
  return queued;
}

ssize_t MhdExchange::Read(char* buffer, size_t size) {
  std::function<void()> on_read;
  size_t count = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (state_ != State::kSent) return MHD_CONTENT_READER_END_WITH_ERROR;
    count = std::min(size, text_.size() - taken_);
    if (count == 0) {
      if (ended_) return MHD_CONTENT_READER_END_OF_STREAM;
      suspended_ = true;
      MHD_suspend_connection(connection_);
      return 0;
    }
    std::memcpy(buffer, text_.data() + taken_, count);
    taken_ += count;
    sent_ = Clock::now();
    if (taken_ == text_.size()) {
      text_ = std::string();
      taken_ = 0;
      if (std::exchange(owned_, false) && !ended_) on_read = listener_.on_read;
    }
  }
  if (on_read) on_read();
  return static_cast<ssize_t>(count);
}

void MhdExchange::OnCompleted() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    connection_ = nullptr;
    suspended_ = false;
    state_ = State::kAborted;
    text_ = std::string();
  }
  NotifyClosed();
}

bool MhdExchange::OnTick(Clock::time_point now) {
  std::function<void()> tell;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (now > deadline_) return true;
    // Who has not begun to listen yet is told later.
    if (state_ == State::kWorking && !told_wait_ && listener_.on_wait && now > working_since_ + limits_.patience) {
      told_wait_ = true;
      tell = listener_.on_wait;
    }
    const bool is_open = streams_ && state_ == State::kSent && !ended_;
    if (is_open && !text_.empty() && !told_slow_ && now > pushed_ + TimeToTake(text_.size())) {
      told_slow_ = true;
      deadline_ = now + limits_.read_time;
      tell = listener_.on_slow;
    } else if (is_open && text_.empty() && suspended_ && now > sent_ + limits_.heartbeat) {
      text_ = ": heartbeat\n\n";
      pushed_ = now;
      Resume();
    }
  }
  if (tell) tell();
  return false;
}

bool MhdExchange::IsUnderWay() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return state_ == State::kWorking || state_ == State::kAnswered || state_ == State::kSent;
}

bool MhdExchange::IsSuspended() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return suspended_;
}

void MhdExchange::CloseAfterAnswer() {
  const std::lock_guard<std::mutex> lock(mutex_);
  closes_ = true;
}

void MhdExchange::OnStop() {
  std::function<void()> tell;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!told_stop_ && listener_.on_stop) {
      told_stop_ = true;
      tell = listener_.on_stop;
    }
  }
  if (tell) tell();
}

void MhdExchange::Abort() {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_ = State::kAborted;
  ended_ = true;
  Resume();
}

bool MhdExchange::Listen(Listener listener) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (state_ == State::kAborted) return false;
  listener_ = std::move(listener);
  return true;
}

void MhdExchange::TakeBody(Place place) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (state_ != State::kAsking) return;
  request_.place = std::move(place);
  state_ = State::kAdmitted;
  Resume();
}

void MhdExchange::Send(HttpResponse response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (state_ != State::kWorking && state_ != State::kAsking) return;
  closes_ = closes_ || state_ == State::kAsking;  // the body is not read
  response_ = std::move(response);
  state_ = State::kAnswered;
  Resume();
}

void MhdExchange::Begin(HttpHeaders headers) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (state_ != State::kWorking) return;
  streams_ = true;
  response_.headers = std::move(headers);
  state_ = State::kAnswered;
  Resume();
}

void MhdExchange::Push(std::string text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!streams_ || ended_ || state_ == State::kAborted) return;
  if (text_.empty()) {
    text_ = std::move(text);
  } else {
    text_ += text;
  }
  owned_ = true;
  pushed_ = Clock::now();
  Resume();
}

void MhdExchange::End(std::string text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!streams_ || ended_ || state_ == State::kAborted) return;
  text_ += text;
  ended_ = true;
  deadline_ = std::min(deadline_, Clock::now() + TimeToTake(text_.size()));
  Resume();
}

void MhdExchange::Resume() {
  if (connection_ != nullptr && std::exchange(suspended_, false)) MHD_resume_connection(connection_);
}

void MhdExchange::NotifyClosed() {
  Listener last;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last = std::exchange(listener_, {});
  }
  if (last.on_closed) last.on_closed();
}

milliseconds MhdExchange::TimeToTake(size_t bytes) const {
  return limits_.read_time + milliseconds(static_cast<int64_t>(bytes) / kSlowestBytesPerMs);
}

}  // namespace rollgait::server
