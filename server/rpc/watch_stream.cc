#include "server/rpc/watch_stream.h"

#include <utility>
#include <vector>

#include "server/rpc/message_memory.h"
#include "server/rpc/status.h"
#include "server/service/watch_group.h"

namespace rollgait::server {
namespace {

Error Stopping() { return {ErrorCode::kUnavailable, "the server is stopping", {}, std::chrono::milliseconds(500)}; }

}  // namespace

WatchStream* WatchStream::Start(Executor& executor, WatchHub& hub, std::chrono::milliseconds slow_write,
                                grpc::CallbackServerContext* context, Plan plan) {
  std::shared_ptr<WatchStream> stream(new WatchStream(executor, hub, slow_write, context, std::move(plan)));
  stream->self_ = stream;
  if (stream->plan_.refusal) {
    const std::lock_guard<std::mutex> lock(stream->mutex_);
    stream->End(ToStatus(*stream->plan_.refusal));
  } else if (!executor.TryPost(stream->plan_.lane, [stream] { stream->Prepare(); })) {
    const std::lock_guard<std::mutex> lock(stream->mutex_);
    stream->End(ToStatus({ErrorCode::kResourceExhausted,
                          "the server has too many calls to answer; try again later",
                          {},
                          std::chrono::milliseconds(1000)}));
  }
  return stream.get();
}

Outcome<WatchStream::Target> WatchStream::FindTarget() {
  Outcome<std::shared_ptr<Admission>> admitted = plan_.admit();
  if (!admitted.ok()) return admitted.error();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    admission_ = std::move(admitted).value();
  }
  Outcome<Target> target = plan_.find(admission_->caller());
  admission_->WorkIsMade();
  if (target.ok()) {
    const Outcome<Done> room = admission_->answer().Hold(target.value().bytes);
    if (!room.ok()) return room.error();
    admission_->answer().Owe(0);
  }
  if (target.ok()) {
    admission_->WhenWithdrawn([weak = weak_from_this()](const Error& error) {
      if (const auto stream = weak.lock()) stream->Withdraw(error);
    });
  }
  return target;
}

void WatchStream::Withdraw(const Error& error) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (ended_) return;
  withdrawn_ = error;
  if (!waiting_.empty()) {
    context_->TryCancel();  // a write that nobody reads would never end
  } else if (!pumping_) {
    End(ToStatus(error));
  }
}

Outcome<std::unique_ptr<EventSource>> WatchStream::Open(const std::vector<WatchPosition>& solves) {
  const std::weak_ptr<WatchStream> weak = weak_from_this();
  const auto wake = [weak] {
    if (const auto stream = weak.lock()) stream->Wake();
  };
  if (solves.size() > 1) return WatchGroup::Open(hub_, solves, wake);
  Outcome<std::unique_ptr<Watch>> watch = hub_.Open(solves.front(), wake);
  if (!watch.ok()) return watch.error();
  return std::unique_ptr<EventSource>(std::move(watch).value());
}

void WatchStream::Prepare() {
  const Outcome<Target> target = FindTarget();
  if (target.ok()) {
    const std::lock_guard<std::mutex> lock(mutex_);
    id_ = target.value().solves.front().id;
    if (cancelled_) EndAsDisconnected();
    if (ended_) return;
  }
  using Source = Outcome<std::unique_ptr<EventSource>>;
  Source watch = target.ok() ? Open(target.value().solves) : Source(target.error());
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!watch.ok()) {
      End(ToStatus(watch.error()));
      return;
    }
    watch_ = std::move(watch).value();
  }
  Pump();
}

void WatchStream::Wake() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (ended_) return;
  if (pumping_ || !waiting_.empty()) {
    again_ = true;
    return;
  }
  pumping_ = true;
  executor_.Post(plan_.lane, [self = shared_from_this()] { self->Pump(); });
}

void WatchStream::Pump() {
  while (true) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (ended_) return;
      again_ = false;
    }
    Outcome<WatchBatch> batch = watch_->Take();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (withdrawn_) End(ToStatus(*withdrawn_));
    if (cancelled_) EndAsDisconnected();
    if (ended_) return;
    if (!batch.ok()) {
      End(ToStatus(batch.error()));
      return;
    }
    if (batch.value().ended || !batch.value().events.empty()) {
      pumping_ = false;
      Send(std::move(batch).value());
      return;
    }
    if (!again_) {
      pumping_ = false;
      return;
    }
  }
}

void WatchStream::Send(WatchBatch batch) {
  if (slow_) batch.events = MergeIterations(batch.events);
  int64_t bytes = 0;
  for (const EventPtr& event : batch.events) bytes += MemoryOf(*event);
  const Outcome<Done> held = admission_->answer().Hold(bytes);
  if (!held.ok()) {
    End(ToStatus(held.error()));
    return;
  }
  last_batch_ = batch.ended;
  waiting_.assign(batch.events.begin(), batch.events.end());
  if (waiting_.empty()) {
    End(grpc::Status::OK);
  } else {
    StartNextWrite();
  }
}

void WatchStream::StartNextWrite() {
  write_start_ = std::chrono::steady_clock::now();
  StartWrite(waiting_.front().get());
}

void WatchStream::OnWriteDone(bool ok) {
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_.pop_front();
  if (waiting_.empty()) admission_->answer().Owe(0);
  if (ended_) return;
  if (!ok || cancelled_) {
    EndAsDisconnected();
    return;
  }
  slow_ = std::chrono::steady_clock::now() - write_start_ > slow_write_;
  if (slow_ && waiting_.size() > 1) {
    const std::vector<EventPtr> merged = MergeIterations({waiting_.begin(), waiting_.end()});
    waiting_.assign(merged.begin(), merged.end());
  }
  if (!waiting_.empty()) {
    StartNextWrite();
  } else if (last_batch_) {
    End(grpc::Status::OK);
  } else {
    pumping_ = true;
    executor_.Post(plan_.lane, [self = shared_from_this()] { self->Pump(); });
  }
}

void WatchStream::OnCancel() {
  const std::lock_guard<std::mutex> lock(mutex_);
  cancelled_ = true;
  // A write in flight ends soon, a pump sees the flag: they end the stream then.
  if (waiting_.empty() && !pumping_) EndAsDisconnected();
}

void WatchStream::EndAsDisconnected() {
  if (ended_) return;
  if (withdrawn_) {
    End(ToStatus(*withdrawn_));
    return;
  }
  const bool server_stops = hub_.stopped();  // then it is not the client that has gone
  if (plan_.on_disconnect != nullptr && !id_.empty() && !server_stops) {
    executor_.Post(plan_.lane,
                   [self = shared_from_this()] { self->plan_.on_disconnect(self->admission_->caller(), self->id_); });
  }
  End(server_stops ? ToStatus(Stopping()) : grpc::Status(grpc::StatusCode::CANCELLED, "the client has gone"));
}

void WatchStream::End(const grpc::Status& status) {
  if (ended_) return;
  ended_ = true;
  Finish(status);
}

void WatchStream::OnDone() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
  }
  const std::shared_ptr<WatchStream> last = std::move(self_);
}

}  // namespace rollgait::server
