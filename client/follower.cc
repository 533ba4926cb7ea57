#include "client/follower.h"

#include <memory>

#include "client/failure.h"
#include "client/stream_breaks.h"
#include "client/text.h"

namespace rollgait::client {
SolveFollower::SolveFollower(Connection& connection, std::string name, const FollowOptions& options)
    : connection_(connection), name_(std::move(name)), options_(options), last_sequence_(options.after_sequence) {}

v1::Solve SolveFollower::Follow(const std::function<void(const v1::SolveEvent&)>& on_event,
                                const std::function<void(const std::string&)>& on_note) {
  StreamBreaks breaks;
  breaks.reconnect_s = options_.reconnect_s;
  breaks.read = [&] { return ReadStream(on_event, on_note); };
  breaks.on_break = [&] {
    on_note("connection lost after event " + std::to_string(last_sequence_) + "; trying again for " +
            FormatDuration(options_.reconnect_s));
  };
  breaks.wait = [this](double seconds) { WaitBeforeRetry(seconds); };
  breaks.give_up = [this](const grpc::Status& broken) {
    throw Failure(ExitCode::kUnreachable,
                  "the connection to " + connection_.server() + " broke (" + broken.error_message() +
                      ") and could not be made again within " + FormatDuration(options_.reconnect_s) +
                      ". The solve is not cancelled; go on with\n  rollgait watch " + name_ + " --after-sequence " +
                      std::to_string(last_sequence_) + " --server " + connection_.server());
  };
  ReadThroughBreaks(breaks);
  return finished_;
}

StreamEnd SolveFollower::ReadStream(const std::function<void(const v1::SolveEvent&)>& on_event,
                                    const std::function<void(const std::string&)>& on_note) {
  grpc::ClientContext context;
  {
    std::lock_guard<std::mutex> lock(mutex_);
    if (stopped_) throw Failure(ExitCode::kCancelled, "");
    context_ = &context;
  }
  // Also when a callback throws.
  const std::shared_ptr<void> forget(nullptr, [this](void*) {
    const std::lock_guard<std::mutex> lock(mutex_);
    context_ = nullptr;
  });
  v1::WatchSolveRequest request;
  request.set_name(name_);
  request.set_after_sequence(last_sequence_);
  request.set_iterates_per_second(options_.iterates_per_second);
  heard_ = false;
  auto reader = connection_.stub().WatchSolve(&context, request);
  v1::SolveEvent event;
  bool finished = false;
  while (!finished && reader->Read(&event)) {
    if (!heard_ && cancel_pending_) Cancel();
    heard_ = true;
    if (!Accept(event, on_note)) continue;
    on_event(event);
    if (event.has_finished()) {
      finished_ = event.finished();
      finished = true;
    }
  }
  if (finished) context.TryCancel();  // The server may close the stream when it likes; nothing follows.
  const grpc::Status status = reader->Finish();
  {
    std::lock_guard<std::mutex> lock(mutex_);
    if (finished) return {true, heard_, grpc::Status::OK};
    if (stopped_) throw Failure(ExitCode::kCancelled, "");
  }
  if (!IsBroken(status)) RequireOk(status, "watch " + name_, connection_.server());
  const grpc::Status early(grpc::StatusCode::UNAVAILABLE, "the stream ended before the solve");
  return {false, heard_, status.ok() ? early : status};
}

bool SolveFollower::Accept(const v1::SolveEvent& event, const std::function<void(const std::string&)>& on_note) {
  if (event.has_heartbeat() || event.event_case() == v1::SolveEvent::EVENT_NOT_SET) return false;
  if (event.has_iterate()) return true;
  if (event.sequence() <= last_sequence_) return event.has_finished();
  // An event may stand for itself and the skipped ones merged into it.
  const int64_t missing = event.sequence() - last_sequence_ - 1 - event.skipped_count();
  if (missing > 0) {
    on_note("warning: " + std::to_string(missing) + " events before number " + std::to_string(event.sequence()) +
            " were not delivered");
  }
  last_sequence_ = event.sequence();
  return true;
}

grpc::Status SolveFollower::Cancel() {
  cancel_pending_ = true;
  grpc::ClientContext context;
  connection_.SetDeadline(context);
  v1::CancelSolveRequest request;
  request.set_name(name_);
  v1::Solve solve;
  grpc::Status status = connection_.stub().CancelSolve(&context, request, &solve);
  if (status.ok()) cancel_pending_ = false;
  return status;
}

void SolveFollower::Stop() {
  std::lock_guard<std::mutex> lock(mutex_);
  stopped_ = true;
  if (context_ != nullptr) context_->TryCancel();
  stopped_changed_.notify_all();
}

void SolveFollower::WaitBeforeRetry(double seconds) {
  std::unique_lock<std::mutex> lock(mutex_);
  stopped_changed_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return stopped_; });
}

}  // namespace rollgait::client
