#include "server/rpc/simulation_stream.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <functional>
#include <sstream>
#include <string>
#include <utility>

#include "server/rpc/door.h"
#include "server/rpc/message_memory.h"
#include "server/rpc/status.h"

namespace rollgait::server {
namespace {

constexpr double kDefaultWall = 60, kLongestWall = 600;  // s
// A client that does not take a message for so long is taken to be gone.
constexpr std::chrono::seconds kLongestWrite{30};

void CheckRange(const char* field, double value, double low, double high, Violations* violations) {
  if (value >= low && value <= high) return;  // written so that NaN fails
  std::ostringstream text;
  text << "is " << value << "; must be within [" << low << ", " << high << "]";
  violations->push_back({field, text.str()});
}

double WallTime(const wire::SimulatorRequest& request) {
  if (request.has_simulate()) {
    return request.simulate().has_max_wall_time_s() ? request.simulate().max_wall_time_s() : kDefaultWall;
  }
  return request.find_gait().has_max_wall_time_s() ? request.find_gait().max_wall_time_s() : kDefaultWall;
}

// What is wrong with the request besides its scene, which the process checks before it works.
Violations CheckRequest(const wire::SimulatorRequest& request) {
  Violations violations;
  CheckRange("max_wall_time_s", WallTime(request), 1e-3, kLongestWall, &violations);
  if (request.has_find_gait()) {
    const v1::FindPeriodicGaitRequest& find = request.find_gait();
    if (find.has_residual()) CheckRange("residual", find.residual(), 1e-14, 1e-2, &violations);
    if (find.has_max_iterations()) CheckRange("max_iterations", find.max_iterations(), 1, 1000, &violations);
  }
  const bool has_scene = request.has_simulate() ? request.simulate().has_scene() : request.find_gait().has_scene();
  if (!has_scene) violations.push_back({"scene", "is not set; give the scene to simulate"});
  return violations;
}

}  // namespace

SimulationStream* SimulationStream::Start(SimulationHost& host, Executor& executor,
                                          grpc::CallbackServerContext* context, wire::SimulatorRequest request,
                                          Admit admit, const std::string& lane) {
  std::shared_ptr<SimulationStream> stream(new SimulationStream(host, context, std::move(request)));
  stream->self_ = stream;
  if (!executor.TryPost(lane, [stream, admit = std::move(admit)] { stream->Launch(admit); })) {
    const std::lock_guard<std::mutex> lock(stream->mutex_);
    stream->End(ToStatus({ErrorCode::kResourceExhausted,
                          "the server has too many calls to answer; try again later",
                          {},
                          std::chrono::milliseconds(1000)}));
  }
  return stream.get();
}

SimulationStream* SimulationStream::Refuse(SimulationHost& host, grpc::CallbackServerContext* context,
                                           const Error& error) {
  std::shared_ptr<SimulationStream> stream(new SimulationStream(host, context, {}));
  stream->self_ = stream;
  const std::lock_guard<std::mutex> lock(stream->mutex_);
  stream->End(ToStatus(error));
  return stream.get();
}

void SimulationStream::Withdraw(const Error& error) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (ended_) return;
  withdrawn_ = error;
  client_gone_ = true;
  if (cancel_ != nullptr) cancel_->Cancel();
  if (writing_) context_->TryCancel();  // a write that nobody reads would never end
}

void SimulationStream::Launch(const Admit& admit) {
  Outcome<std::shared_ptr<Admission>> admitted = admit();
  if (!admitted.ok()) {
    const std::lock_guard<std::mutex> lock(mutex_);
    End(ToStatus(admitted.error()));
    return;
  }
  admission_ = std::move(admitted).value();
  admission_->WorkIsMade();
  admission_->WhenWithdrawn([weak = weak_from_this()](const Error& error) {
    if (const auto stream = weak.lock()) stream->Withdraw(error);
  });
  Violations violations = CheckRequest(request_);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!violations.empty()) {
    End(ToStatus({ErrorCode::kInvalidArgument, "the request cannot be served", std::move(violations)}));
    return;
  }
  Outcome<std::shared_ptr<SimulationCancel>> started =
      host_.Start([self = shared_from_this()](SimulationCancel& cancel) -> std::function<void()> {
        return [self, status = self->Run(cancel)] {
          const std::lock_guard<std::mutex> end_lock(self->mutex_);
          self->End(status);
        };
      });
  if (!started.ok()) {
    End(ToStatus(started.error()));
    return;
  }
  cancel_ = started.value();
  if (client_gone_) cancel_->Cancel();
}

grpc::Status SimulationStream::Run(SimulationCancel& cancel) {
  const Outcome<Done> outcome =
      host_.Run(request_, WallTime(request_), cancel, [this](v1::SimulationMessage&& m) { return Emit(std::move(m)); });
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!outcome.ok() && outcome.error().code == ErrorCode::kInternal) {
    spdlog::error("simulation of {}: {}", PeerOf(*context_), outcome.error().message);
  }
  if (withdrawn_) return ToStatus(*withdrawn_);
  if (client_gone_) return {grpc::StatusCode::CANCELLED, "the client has gone"};
  if (!outcome.ok() && cancel.cancelled()) return {grpc::StatusCode::UNAVAILABLE, "the server is stopping"};
  return outcome.ok() ? grpc::Status::OK : ToStatus(outcome.error());
}

bool SimulationStream::Emit(v1::SimulationMessage&& message) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (client_gone_ || ended_) return false;
  message_ = std::move(message);
  admission_->answer().Owe(MemoryOf(message_));  // one a slot at a time
  writing_ = true;
  StartWrite(&message_);
  if (!written_.wait_for(lock, kLongestWrite, [this] { return !writing_; })) {
    context_->TryCancel();  // ends the write
    client_gone_ = true;
    written_.wait(lock, [this] { return !writing_; });
  }
  return !client_gone_;
}

void SimulationStream::OnWriteDone(bool ok) {
  const std::lock_guard<std::mutex> lock(mutex_);
  writing_ = false;
  if (!ok) client_gone_ = true;
  written_.notify_all();
}

void SimulationStream::OnCancel() {
  const std::lock_guard<std::mutex> lock(mutex_);
  client_gone_ = true;
  if (cancel_ != nullptr) cancel_->Cancel();
}

void SimulationStream::End(const grpc::Status& status) {
  if (ended_) return;
  ended_ = true;
  Finish(status);
}

void SimulationStream::OnDone() { const std::shared_ptr<SimulationStream> last = std::move(self_); }

}  // namespace rollgait::server
