#include "client/sweep/group_follower.h"

#include <chrono>
#include <memory>
#include <utility>

#include "client/failure.h"
#include "client/text.h"

namespace rollgait::client {

GroupFollower::GroupFollower(Connection& connection, std::map<std::string, int64_t> after, double reconnect_s)
    : connection_(connection), after_(std::move(after)), reconnect_s_(reconnect_s) {}

void GroupFollower::Follow(const std::function<void(const v1::SolveEvent&)>& on_event,
                           const std::function<void(const std::string&)>& on_note) {
  StreamBreaks breaks;
  breaks.reconnect_s = reconnect_s_;
  breaks.read = [&] { return ReadStream(on_event); };
  breaks.on_break = [&] { on_note("connection lost; trying again for " + FormatDuration(reconnect_s_)); };
  breaks.wait = [this](double seconds) { WaitBeforeRetry(seconds); };
  breaks.give_up = [this](const grpc::Status& broken) {
    throw Failure(ExitCode::kUnreachable, "the connection to " + connection_.server() + " broke (" +
                                              broken.error_message() + ") and could not be made again within " +
                                              FormatDuration(reconnect_s_) +
                                              ". The solves go on; the same command goes on with them");
  };
  ReadThroughBreaks(breaks);
}

StreamEnd GroupFollower::ReadStream(const std::function<void(const v1::SolveEvent&)>& on_event) {
  if (after_.empty()) return {true, false, grpc::Status::OK};
  grpc::ClientContext context;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopped_) throw Failure(ExitCode::kCancelled, "");
    context_ = &context;
  }
  // Also when on_event throws.
  const std::shared_ptr<void> forget(nullptr, [this](void*) {
    const std::lock_guard<std::mutex> lock(mutex_);
    context_ = nullptr;
  });
  v1::WatchSolvesRequest request;
  for (const auto& [name, sequence] : after_) {
    v1::WatchSolveRequest* const one = request.add_solves();
    one->set_name(name);
    one->set_after_sequence(sequence);
  }
  bool heard = false;
  const auto reader = connection_.stub().WatchSolves(&context, request);
  v1::SolveEvent event;
  while (!after_.empty() && reader->Read(&event)) {
    heard = true;
    const auto known = after_.find(event.name());
    const bool heartbeat = event.has_heartbeat() || event.event_case() == v1::SolveEvent::EVENT_NOT_SET;
    if (heartbeat || known == after_.end() || event.sequence() <= known->second) continue;
    known->second = event.sequence();
    if (event.has_finished()) after_.erase(known);
    on_event(event);
  }
  if (after_.empty()) context.TryCancel();  // The server may close the stream when it likes; nothing follows.
  const grpc::Status status = reader->Finish();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (after_.empty()) return {true, heard, grpc::Status::OK};
    if (stopped_) throw Failure(ExitCode::kCancelled, "");
  }
  if (!IsBroken(status)) RequireOk(status, "watch the solves", connection_.server());
  const grpc::Status early(grpc::StatusCode::UNAVAILABLE, "the stream ended before the solves");
  return {false, heard, status.ok() ? early : status};
}

void GroupFollower::Stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  stopped_ = true;
  if (context_ != nullptr) context_->TryCancel();
  stopped_changed_.notify_all();
}

void GroupFollower::WaitBeforeRetry(double seconds) {
  std::unique_lock<std::mutex> lock(mutex_);
  stopped_changed_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return stopped_; });
}

}  // namespace rollgait::client
