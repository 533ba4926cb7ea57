#include <chrono>
#include <stdexcept>
#include <thread>

#include "bench/service_load/scenarios.h"

namespace rollgait::load {
namespace {

using Clock = std::chrono::steady_clock;

// Waits until at most `busy` solves run: then a slot is free.
void WaitForFreeSlot(const Target& target, Stub& stub, int busy) {
  const Clock::time_point deadline = Clock::now() + std::chrono::seconds(60);
  while (Clock::now() < deadline) {
    grpc::ClientContext context;
    target.Authorize(context);
    v1::ServerInfo info;
    if (stub.GetServerInfo(&context, {}, &info).ok() && info.running() <= busy && info.queued() == 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  throw std::runtime_error("no slot became free within 60 s");
}

// From the call to the first iteration; the solve is cancelled then.
std::chrono::nanoseconds TimeToFirstIteration(const Target& target, Stub& stub, const std::string& model, int number) {
  grpc::ClientContext context;
  target.Authorize(context);
  v1::RunSolveRequest request;
  request.mutable_spec()->mutable_model()->set_name(model);
  request.mutable_spec()->set_slope_rad(1e-5 * (number + 1));
  request.set_cancel_on_disconnect(true);
  const Clock::time_point start = Clock::now();
  const auto stream = stub.RunSolve(&context, request);
  v1::SolveEvent event;
  while (stream->Read(&event)) {
    if (!event.has_iteration()) continue;
    const Clock::duration passed = Clock::now() - start;
    context.TryCancel();
    stream->Finish();
    return passed;
  }
  throw std::runtime_error("a solve ended without an iteration: " + stream->Finish().error_message());
}

}  // namespace

Row FirstIterationScenario(const LoadOptions& options) {
  const int samples = options.solves > 0 ? options.solves : 100;
  TargetOptions own = options.target;
  const int busy_slots = options.idle_cores ? 0 : own.solver_slots;
  own.solver_slots = busy_slots + 1;
  const Target target(own);
  const std::unique_ptr<Stub> stub = target.Connect();
  BusySlots busy(target, busy_slots);
  const std::string model = options.model.empty() ? "planar" : options.model;
  Latencies latencies;
  for (int i = 0; i < samples; ++i) {
    WaitForFreeSlot(target, *stub, busy_slots);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));  // between two requests of one person
    latencies.Add(TimeToFirstIteration(target, *stub, model, i));
  }
  const bool still_busy = busy.StillBusy();
  const double p99 = latencies.PercentileMs(99);
  Row row{"first iteration, free slot", "p99 ≤ 300 ms after the request", "", false, {}};
  row.measured = "p99 " + Number(p99) + " ms, median " + Number(latencies.PercentileMs(50)) + " ms of " +
                 std::to_string(samples) + " " + model + (still_busy ? "" : "; the cores did not solve throughout");
  row.met = still_busy && p99 <= 300;
  row.figures["latency"] = LatencyFigures(latencies);
  row.figures["model"] = model;
  row.figures["busy_slots"] = busy_slots;
  return row;
}

}  // namespace rollgait::load
