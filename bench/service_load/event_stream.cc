#include "bench/service_load/event_stream.h"

#include <stdexcept>
#include <thread>

namespace rollgait::load {
namespace {

using SystemClock = std::chrono::system_clock;

SystemClock::time_point TimeOf(const v1::SolveEvent& event) {
  return SystemClock::time_point(std::chrono::duration_cast<SystemClock::duration>(
      std::chrono::seconds(event.time().seconds()) + std::chrono::nanoseconds(event.time().nanos())));
}

v1::SolveSpec WatchedSpec(const std::string& model, int index, double seconds) {
  v1::SolveSpec spec;
  spec.mutable_model()->set_name(model);
  spec.set_slope_rad(1e-4 * index);
  spec.set_starts(32);
  spec.mutable_solver_limits()->set_max_wall_time_s(seconds);
  spec.mutable_solver_limits()->set_max_iterations(100'000);
  return spec;
}

}  // namespace

void DeliveryBoard::Add(const v1::SolveEvent& event, int64_t last, bool live, SystemClock::time_point arrival) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (event.has_heartbeat()) {
    ++seen_.heartbeats;
    if (event.sequence() != last) ++seen_.gaps;
    return;
  }
  ++seen_.events;
  seen_.skipped += event.skipped_count();
  if (event.sequence() <= last) {
    ++seen_.duplicates;
  } else if (event.sequence() != last + event.skipped_count() + 1) {
    ++seen_.gaps;
  }
  if (event.has_finished()) ++seen_.terminal;
  if (!live) return;
  (event.has_finished() ? seen_.terminal_latency : seen_.latency).Add(arrival - TimeOf(event));
}

void DeliveryBoard::Opened() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++opened_;
  changed_.notify_all();
}

void DeliveryBoard::Ended(grpc::StatusCode code) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++seen_.ends[code];
  ++ended_;
  changed_.notify_all();
}

bool DeliveryBoard::WaitOpened(int64_t streams, std::chrono::seconds at_most) {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_for(lock, at_most, [&] { return opened_ >= streams || ended_ > 0; }) && opened_ >= streams;
}

bool DeliveryBoard::WaitEnded(int64_t streams, std::chrono::seconds at_most) {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_for(lock, at_most, [&] { return ended_ >= streams; });
}

Deliveries DeliveryBoard::Get() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return seen_;
}

EventStream::EventStream(const Target& target, Stub& stub, const std::string& name, DeliveryBoard& board)
    : board_(board) {
  target.Authorize(context_);
  request_.set_name(name);
  stub.async()->WatchSolve(&context_, &request_, this);
  AddHold();  // until Read is called or the stream is cancelled
  StartCall();
}

void EventStream::Read() {
  StartRead(&event_);
  RemoveHold();
}

void EventStream::OnReadDone(bool ok) {
  if (!ok) return;
  const SystemClock::time_point arrival = SystemClock::now();
  board_.Add(event_, last_, TimeOf(event_) > start_ && opened_, arrival);
  last_ = event_.sequence();
  if (!opened_) {
    opened_ = true;
    board_.Opened();
  }
  StartRead(&event_);
}

void EventStream::OnDone(const grpc::Status& status) { board_.Ended(status.error_code()); }

std::vector<std::string> StartWatchedSolves(const Target& target, int solves, const std::string& model,
                                            double seconds) {
  const std::unique_ptr<Stub> stub = target.Connect();
  std::vector<std::string> names;
  for (int i = 0; i < solves; ++i) {
    grpc::ClientContext context;
    target.Authorize(context);
    v1::CreateSolveRequest request;
    *request.mutable_spec() = WatchedSpec(model, i, seconds * (0.6 + 0.4 * (i + 1) / solves));
    v1::Solve solve;
    const grpc::Status status = stub->CreateSolve(&context, request, &solve);
    if (!status.ok()) throw std::runtime_error("a solve to watch cannot be created: " + status.error_message());
    names.push_back(solve.name());
  }
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  while (std::chrono::steady_clock::now() < deadline) {
    grpc::ClientContext context;
    target.Authorize(context);
    v1::ServerInfo info;
    if (stub->GetServerInfo(&context, {}, &info).ok() && info.running() >= solves) return names;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  throw std::runtime_error("not all of " + std::to_string(solves) + " solves run after 120 s");
}

}  // namespace rollgait::load
