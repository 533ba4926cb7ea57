#include "server/simulate/simulation_host.h"

#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "server/agent/solver_process.h"
#include "server/base/supervisor.h"

namespace rollgait::server {
namespace {

using Clock = std::chrono::steady_clock;

// CPU time beyond the wall time that was asked for: the kernel's limit is only for a host that has lost its clock.
constexpr int64_t kCpuGraceSeconds = 5;

Error FromProcess(const v1::SolveError& error) {
  const bool memory = error.kind() == v1::SolveError::KIND_MEMORY_LIMIT;
  return {memory ? ErrorCode::kResourceExhausted : ErrorCode::kInternal, error.message()};
}

Error FromRefusal(const wire::SimulatorMessage::Refusal& refusal) {
  Error error{ErrorCode::kInvalidArgument, "the scene cannot be simulated"};
  for (const auto& violation : refusal.violations())
    error.violations.push_back({violation.field(), violation.message()});
  return error;
}

// One process, from its request to its end.
class Exchange {
 public:
  Exchange(SolverProcess& process, SimulationCancel& cancel, const SimulationHost::Emit& emit, double max_wall_s)
      : process_(process),
        cancel_(cancel),
        emit_(emit),
        max_wall_s_(max_wall_s),
        deadline_(Clock::now() +
                  std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(max_wall_s))) {}

  Outcome<Done> Serve() {
    while (true) {
      if (cancel_.cancelled()) return Error{ErrorCode::kUnavailable, "the simulation was cancelled"};
      if (Clock::now() >= deadline_) {
        return Error{ErrorCode::kDeadlineExceeded, "the run needed more than its wall time of " +
                                                       std::to_string(max_wall_s_) +
                                                       " s; shorten duration_s or raise max_wall_time_s"};
      }
      Wait();
      process_.ReadOutput();
      process_.Write();
      std::vector<std::string> payloads;
      const FrameStatus status = process_.Receive(&payloads);
      for (const std::string& payload : payloads) {
        std::optional<Outcome<Done>> end = Take(payload);
        if (end) return *std::move(end);
      }
      if (status != FrameStatus::kNeedMore) return Crash();
    }
  }

 private:
  void Wait() {
    pollfd watched[3] = {
        {process_.stream_fd(), static_cast<short>(process_.wants_to_write() ? POLLIN | POLLOUT : POLLIN), 0},
        {cancel_.fd(), POLLIN, 0},
        {process_.output_fd(), POLLIN, 0}};
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now()).count() + 1;
    poll(watched, process_.output_fd() >= 0 ? 3 : 2, static_cast<int>(std::clamp<int64_t>(left, 0, 60'000)));
  }

  std::optional<Outcome<Done>> Take(const std::string& payload) {
    wire::SimulatorMessage message;
    if (!message.ParseFromString(payload)) return Error{ErrorCode::kInternal, "the simulation process sent garbage"};
    switch (message.message_case()) {
      case wire::SimulatorMessage::kContent:
        if (emit_(std::move(*message.mutable_content()))) return std::nullopt;
        return Error{ErrorCode::kUnavailable, "the client has gone"};
      case wire::SimulatorMessage::kRefusal:
        return FromRefusal(message.refusal());
      case wire::SimulatorMessage::kError:
        return FromProcess(message.error());
      case wire::SimulatorMessage::kDone:
        return Outcome<Done>(Done{});
      case wire::SimulatorMessage::MESSAGE_NOT_SET:
        break;
    }
    return Error{ErrorCode::kInternal, "the simulation process sent an empty message"};
  }

  Outcome<Done> Crash() {
    process_.Kill(SIGKILL);
    std::optional<ProcessEnd> end = process_.Reap();
    for (int i = 0; !end && i < 100; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      end = process_.Reap();
    }
    process_.ReadOutput();
    std::string text = "the simulation process died";
    if (end) text += " with " + DescribeWaitStatus(end->wait_status);
    const std::string output = process_.LastOutput();
    return Error{ErrorCode::kInternal, output.empty() ? text : text + ": " + output};
  }

  SolverProcess& process_;
  SimulationCancel& cancel_;
  const SimulationHost::Emit& emit_;
  const double max_wall_s_;
  const Clock::time_point deadline_;
};

}  // namespace

SimulationCancel::SimulationCancel() : fd_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

SimulationCancel::~SimulationCancel() {
  if (fd_ >= 0) close(fd_);
}

void SimulationCancel::Cancel() {
  cancelled_.store(true);
  if (fd_ >= 0) eventfd_write(fd_, 1);
}

Outcome<std::shared_ptr<SimulationCancel>> SimulationHost::Start(Job job) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (options_.program.empty()) return Error{ErrorCode::kUnavailable, "this server has no program to simulate with"};
  if (stopping_) return Error{ErrorCode::kUnavailable, "the server is stopping"};
  for (auto running = running_.begin(); running != running_.end();) {
    if (!running->done->load()) {
      ++running;
      continue;
    }
    running->thread.join();
    running = running_.erase(running);
  }
  if (static_cast<int>(running_.size()) >= options_.slots) {
    return Error{ErrorCode::kResourceExhausted,
                 "all " + std::to_string(options_.slots) + " simulation slots are taken; try again later",
                 {},
                 std::chrono::milliseconds(1000)};
  }
  Running& running = running_.emplace_back();
  running.cancel = std::make_shared<SimulationCancel>();
  running.done = std::make_shared<std::atomic<bool>>(false);
  running.thread = std::thread([job = std::move(job), cancel = running.cancel, done = running.done] {
    const std::function<void()> finish = job(*cancel);
    done->store(true);
    finish();
  });
  return running.cancel;
}

Outcome<Done> SimulationHost::Run(const wire::SimulatorRequest& request, double max_wall_s, SimulationCancel& cancel,
                                  const Emit& emit) const {
  SolverProcess::Options options;
  options.program = options_.program;
  options.memory_limit_mb = options_.memory_limit_mb;
  options.unconfined = options_.unconfined;
  options.cpu_limit_s = static_cast<int64_t>(std::ceil(max_wall_s)) + kCpuGraceSeconds;
  Outcome<SolverProcess> process = SolverProcess::Spawn(options);
  if (!process.ok()) return process.error();
  process.value().Send(request.SerializeAsString());
  return Exchange(process.value(), cancel, emit, max_wall_s).Serve();
}

void SimulationHost::Stop() {
  std::list<Running> running;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    running.swap(running_);
  }
  for (Running& one : running) one.cancel->Cancel();
  for (Running& one : running) one.thread.join();
}

}  // namespace rollgait::server
