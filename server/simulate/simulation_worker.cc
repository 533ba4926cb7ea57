#include "server/simulate/simulation_worker.h"

#include <chrono>
#include <ctime>
#include <exception>
#include <new>
#include <string>

#include "core/base/check.h"
#include "core/base/stop.h"
#include "core/simulation/initial_state.h"
#include "server/base/framing.h"
#include "server/base/wire.pb.h"
#include "server/convert/scene_convert.h"

namespace rollgait::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kBatchSize = 64;
constexpr std::chrono::milliseconds kBatchTime{50};
constexpr int kNoRequest = 4;

// Of this process so far, user and system, s.
double CpuTime() {
  timespec time{};
  ROLLGAIT_CHECK(clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time) == 0);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

class SimulationWorker {
 public:
  explicit SimulationWorker(int fd) : fd_(fd) {}

  int Serve() {
    std::string payload;
    const FrameStatus status = ReadFrame(fd_, &payload);
    if (status == FrameStatus::kEnd) return 0;
    wire::SimulatorRequest request;
    if (status != FrameStatus::kOk || !request.ParseFromString(payload) ||
        request.request_case() == wire::SimulatorRequest::REQUEST_NOT_SET) {
      SendError(v1::SolveError::KIND_INTERNAL, "what came is no simulation request");
      return kNoRequest;
    }
    const v1::SimulationScene& message =
        request.has_simulate() ? request.simulate().scene() : request.find_gait().scene();
    const Result<SimulationScene> scene = DecodeScene(message);
    Violations violations;
    if (!scene.ok()) {
      violations = scene.violations();
    } else if (request.simulate().validate_only()) {
      SceneDynamics dynamics(scene.value());
      const Result<VectorX> start = InitialState(scene.value(), &dynamics);
      if (!start.ok()) violations = start.violations();
    } else if (request.has_simulate()) {
      violations = RunSimulation(scene.value());
    } else {
      violations = RunSearch(scene.value(), request.find_gait());
    }
    wire::SimulatorMessage last;
    last.mutable_done();
    for (const Violation& violation : violations) {
      wire::SimulatorMessage::Refusal::Violation* refused = last.mutable_refusal()->add_violations();
      refused->set_field("scene." + violation.field);
      refused->set_message(violation.message);
    }
    Send(last);
    return 0;
  }

  void SendError(v1::SolveError::Kind kind, const std::string& text) {
    wire::SimulatorMessage message;
    message.mutable_error()->set_kind(kind);
    message.mutable_error()->set_message(text);
    Send(message);
  }

 private:
  bool Send(const wire::SimulatorMessage& message) {
    if (WriteFrame(fd_, message.SerializeAsString()) != FrameStatus::kOk) stop_.Request();
    return !stop_.requested();
  }

  bool Flush() {
    if (batch_.content().samples().samples_size() == 0) return true;
    const bool sent = Send(batch_);
    batch_.Clear();
    batch_start_ = Clock::now();
    return sent;
  }

  Violations RunSimulation(const SimulationScene& scene) {
    const Clock::time_point start = batch_start_ = Clock::now();
    const double cpu_start = CpuTime();
    SimulationObserver observer;
    observer.sample = [this](const SimulationSample& sample) {
      v1::SampleBatch* samples = batch_.mutable_content()->mutable_samples();
      *samples->add_samples() = EncodeSample(sample);
      const bool full = samples->samples_size() >= kBatchSize || Clock::now() - batch_start_ >= kBatchTime;
      return !full || Flush();
    };
    observer.event = [&](const SimulationEvent& event) {
      wire::SimulatorMessage message;
      *message.mutable_content()->mutable_event() = EncodeEvent(event, scene);
      return Flush() && Send(message);
    };
    const Result<SimulationReport> report = Simulate(scene, observer, &stop_);
    if (!report.ok()) return report.violations();
    Flush();
    wire::SimulatorMessage message;
    *message.mutable_content()->mutable_report() = EncodeReport(report.value(), scene);
    v1::SimulationReport& encoded = *message.mutable_content()->mutable_report();
    encoded.set_wall_time_s(std::chrono::duration<double>(Clock::now() - start).count());
    encoded.set_cpu_time_s(CpuTime() - cpu_start);
    Send(message);
    return {};
  }

  Violations RunSearch(const SimulationScene& scene, const v1::FindPeriodicGaitRequest& request) {
    PeriodicGaitOptions options;
    if (request.has_residual()) options.residual = request.residual();
    if (request.has_max_iterations()) options.max_iterations = request.max_iterations();
    const PeriodicGaitObserver observer = [this](int iteration, double residual) {
      wire::SimulatorMessage message;
      message.mutable_content()->mutable_gait_iteration()->set_index(iteration);
      message.mutable_content()->mutable_gait_iteration()->set_residual(residual);
      return Send(message);
    };
    const Result<PeriodicGait> gait = FindPeriodicGait(scene, options, observer, &stop_);
    if (!gait.ok()) return gait.violations();
    wire::SimulatorMessage message;
    *message.mutable_content()->mutable_gait() = EncodeGait(gait.value(), scene);
    Send(message);
    return {};
  }

  const int fd_;
  StopFlag stop_;
  wire::SimulatorMessage batch_;
  Clock::time_point batch_start_;
};

}  // namespace

int ServeOneSimulation(int fd) {
  SimulationWorker worker(fd);
  try {
    return worker.Serve();
  } catch (const std::bad_alloc&) {
    worker.SendError(v1::SolveError::KIND_MEMORY_LIMIT,
                     "the simulation needs more memory than its limit; ask for fewer samples");
  } catch (const std::exception& exception) {
    worker.SendError(v1::SolveError::KIND_INTERNAL, std::string("the simulation failed: ") + exception.what());
  }
  return 0;
}

}  // namespace rollgait::server
