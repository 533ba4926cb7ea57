// Scenarios of single calls: results, creates, overload.
#include <grpcpp/generic/generic_stub.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <future>
#include <memory>
#include <mutex>
#include <set>
#include <stdexcept>

#include "bench/service_load/open_loop.h"
#include "bench/service_load/scenarios.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace rollgait::load {
namespace {

constexpr double kLatencyLimitMs = 50;
constexpr char kGetSolve[] = "/rollgait.v1.GaitService/GetSolve";

template <typename Request>
struct Call {
  grpc::ClientContext context;
  Request request;
  v1::Solve response;
};

template <typename Request>
std::shared_ptr<Call<Request>> NewCall(const Target& target) {
  auto call = std::make_shared<Call<Request>>();
  target.Authorize(call->context);
  call->context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
  return call;
}

// Solves of the planar body that differ in their slope by so little that all are alike to the solver and none is
// answered from another.
v1::CreateSolveRequest DifferentSolve(int64_t number) {
  v1::CreateSolveRequest request;
  request.mutable_spec()->mutable_model()->set_name("planar");
  request.mutable_spec()->set_slope_rad(1e-9 * static_cast<double>(number + 1));
  request.set_request_id("load-" + std::to_string(number));
  return request;
}

// Names of finished solves with results.
std::vector<std::string> FinishedSolves(const Target& target, int count) {
  const std::unique_ptr<Stub> stub = target.Connect();
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) {
    grpc::ClientContext context;
    target.Authorize(context);
    v1::RunSolveRequest request;
    request.mutable_spec()->mutable_model()->set_name("planar");
    request.mutable_spec()->set_slope_rad(0.002 * i);
    const auto stream = stub->RunSolve(&context, request);
    v1::SolveEvent event;
    while (stream->Read(&event)) {
      if (event.has_finished() && event.finished().has_result()) names.push_back(event.name());
    }
    const grpc::Status status = stream->Finish();
    if (!status.ok()) throw std::runtime_error("a solve to read failed: " + status.error_message());
  }
  if (static_cast<int>(names.size()) != count) throw std::runtime_error("not every solve to read ended with a result");
  return names;
}

bool HasRetryInfo(const grpc::Status& status) {
  google::rpc::Status details;
  if (!details.ParseFromString(status.error_details())) return false;
  for (const google::protobuf::Any& detail : details.details()) {
    google::rpc::RetryInfo retry;
    if (detail.UnpackTo(&retry)) return true;
  }
  return false;
}

// What was asked for at a rate, and whether it came.
void Judge(const OpenLoopResult& run, grpc::StatusCode wanted, double rate, bool busy, Row* row) {
  const auto found = run.by_code.find(wanted);
  const Latencies latencies = found == run.by_code.end() ? Latencies() : found->second;
  const double p99 = latencies.PercentileMs(99);
  row->measured = Number(run.Rate(wanted)) + "/s, p99 " + Number(p99) + " ms (" + CodesText(run) + ")" +
                  (busy ? "" : "; the cores did not solve throughout");
  // Arrivals are random: their number scatters by its root.
  const double expected = rate * run.seconds;
  row->met = busy && !run.gave_up && run.Count(wanted) == run.sent &&
             static_cast<double>(run.sent) >= expected - 3 * std::sqrt(expected) && p99 <= kLatencyLimitMs;
  row->figures["rate_asked"] = rate;
  row->figures["rate"] = run.Rate(wanted);
  row->figures["latency"] = LatencyFigures(latencies);
  row->figures["sent_late"] = LatencyFigures(run.lag);
  for (const auto& [code, all] : run.by_code) row->figures["answers"][CodeName(code)] = all.count();
}

std::set<std::string> ListedNames(const Target& target) {
  const std::unique_ptr<Stub> stub = target.Connect();
  std::set<std::string> names;
  v1::ListSolvesRequest request;
  request.set_page_size(1000);
  do {
    grpc::ClientContext context;
    target.Authorize(context);
    v1::ListSolvesResponse page;
    const grpc::Status status = stub->ListSolves(&context, request, &page);
    if (!status.ok()) throw std::runtime_error("the solves cannot be listed: " + status.error_message());
    for (const v1::Solve& solve : page.solves()) names.insert(solve.name());
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  return names;
}

// The cores solve while a scenario runs, unless it is told otherwise.
std::unique_ptr<BusySlots> KeepBusy(const LoadOptions& options, const Target& target) {
  return options.idle_cores ? nullptr : std::make_unique<BusySlots>(target, options.target.solver_slots);
}

// A finished solve, and what GetSolve answers about it from now on.
struct Finished {
  grpc::ByteBuffer request;
  std::string answer;
};

// A call that is not decoded.
struct RawCall {
  grpc::ClientContext context;
  grpc::ByteBuffer response;
};

Finished ReadOnce(const Target& target, grpc::GenericStub& stub, const std::string& name) {
  v1::GetSolveRequest request;
  request.set_name(name);
  const grpc::Slice bytes(request.SerializeAsString());
  Finished finished{grpc::ByteBuffer(&bytes, 1), ""};
  RawCall call;
  target.Authorize(call.context);
  std::promise<grpc::Status> ended;
  stub.UnaryCall(&call.context, kGetSolve, {}, &finished.request, &call.response,
                 [&](const grpc::Status& status) { ended.set_value(status); });
  const grpc::Status status = ended.get_future().get();
  if (!status.ok()) throw std::runtime_error("a solve cannot be read: " + status.error_message());
  std::vector<grpc::Slice> slices;
  if (!call.response.Dump(&slices).ok()) throw std::runtime_error("an answer cannot be read");
  for (const grpc::Slice& slice : slices)
    finished.answer.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  v1::Solve solve;
  if (!solve.ParseFromString(finished.answer) || solve.name() != name || !solve.has_result())
    throw std::runtime_error("the answer about " + name + " is not that solve with its result");
  return finished;
}

bool IsSame(const grpc::ByteBuffer& answer, const std::string& bytes) {
  std::vector<grpc::Slice> slices;
  if (!answer.Dump(&slices).ok()) return false;
  size_t at = 0;
  for (const grpc::Slice& slice : slices) {
    if (slice.size() > bytes.size() - at || std::memcmp(slice.begin(), bytes.data() + at, slice.size()) != 0)
      return false;
    at += slice.size();
  }
  return at == bytes.size();
}

}  // namespace

Row ResultsScenario(const LoadOptions& options) {
  const double rate = options.rate > 0 ? options.rate : 2000;
  const Target target(options.target);
  std::vector<std::unique_ptr<grpc::GenericStub>> stubs;
  for (int i = 0; i < (options.connections > 0 ? options.connections : 8); ++i) {
    stubs.push_back(std::make_unique<grpc::GenericStub>(target.Open()));
  }
  std::vector<Finished> solves;
  for (const std::string& name : FinishedSolves(target, options.solves > 0 ? options.solves : 20)) {
    solves.push_back(ReadOnce(target, *stubs[0], name));
  }
  const std::unique_ptr<BusySlots> busy = KeepBusy(options, target);
  std::atomic<int64_t> wrong{0}, bytes{0};
  const OpenLoopResult run = RunOpenLoop({.rate = rate, .seconds = options.seconds}, [&](int64_t number, auto done) {
    auto call = std::make_shared<RawCall>();
    target.Authorize(call->context);
    call->context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(30));
    const Finished& solve = solves[static_cast<size_t>(number) % solves.size()];
    grpc::GenericStub& stub = *stubs[static_cast<size_t>(number) % stubs.size()];
    stub.UnaryCall(&call->context, kGetSolve, {}, &solve.request, &call->response,
                   [&, call, done](const grpc::Status& status) {
                     if (status.ok() && !IsSame(call->response, solve.answer)) ++wrong;
                     bytes += static_cast<int64_t>(call->response.Length());
                     done(status.error_code());
                   });
  });
  Row row{"results from the store", "≥ 2000/s, p99 ≤ 50 ms", "", false, {}};
  Judge(run, grpc::StatusCode::OK, rate, busy == nullptr || busy->StillBusy(), &row);
  row.met = row.met && wrong == 0;
  row.measured += "; " + std::to_string(wrong.load()) + " differ from the first answer";
  row.figures["wrong_answers"] = wrong.load();
  row.figures["bytes_an_answer"] = run.sent > 0 ? bytes.load() / run.sent : 0;
  return row;
}

Row CreatesScenario(const LoadOptions& options) {
  const double rate = options.rate > 0 ? options.rate : 300;
  TargetOptions own = options.target;
  own.flags.insert(own.flags.end(), {"--max-queued", "1000000"});
  const Target target(own);
  const auto stubs = target.Connect(options.connections > 0 ? options.connections : 8);
  const std::unique_ptr<BusySlots> busy = KeepBusy(options, target);
  std::mutex mutex;
  std::set<std::string> acknowledged;
  int64_t duplicates = 0;
  const OpenLoopResult run = RunOpenLoop({.rate = rate, .seconds = options.seconds}, [&](int64_t number, auto done) {
    auto call = NewCall<v1::CreateSolveRequest>(target);
    call->request = DifferentSolve(number);
    Stub& stub = *stubs[static_cast<size_t>(number) % stubs.size()];
    stub.async()->CreateSolve(&call->context, &call->request, &call->response,
                              [&, call, done](const grpc::Status& status) {
                                if (status.ok()) {
                                  const std::lock_guard<std::mutex> lock(mutex);
                                  if (!acknowledged.insert(call->response.name()).second) ++duplicates;
                                }
                                done(status.error_code());
                              });
  });
  Row row{"durable creates", "≥ 300/s, p99 ≤ 50 ms", "", false, {}};
  Judge(run, grpc::StatusCode::OK, rate, busy == nullptr || busy->StillBusy(), &row);
  const std::set<std::string> listed = ListedNames(target);
  int64_t lost = 0;
  for (const std::string& name : acknowledged) lost += listed.count(name) == 0 ? 1 : 0;
  row.met = row.met && lost == 0 && duplicates == 0;
  row.measured += "; of " + std::to_string(acknowledged.size()) + " acknowledged " + std::to_string(lost) + " lost";
  row.figures["acknowledged"] = acknowledged.size();
  row.figures["lost"] = lost;
  row.figures["duplicates"] = duplicates;
  return row;
}

Row OverloadScenario(const LoadOptions& options) {
  const double rate = options.rate > 0 ? options.rate : 3000;
  constexpr int kQueue = 100;
  TargetOptions own = options.target;
  own.flags.insert(own.flags.end(), {"--max-queued", std::to_string(kQueue)});
  const Target target(own);
  const auto stubs = target.Connect(options.connections > 0 ? options.connections : 8);
  const BusySlots busy_slots(target, own.solver_slots);
  for (int i = 0; i < kQueue; ++i) {
    auto call = NewCall<v1::CreateSolveRequest>(target);
    call->request = DifferentSolve(i);
    if (!stubs[0]->CreateSolve(&call->context, call->request, &call->response).ok()) break;
  }
  MemoryWatch memory(target);
  std::atomic<int64_t> without_retry{0};
  const OpenLoopResult run = RunOpenLoop({.rate = rate, .seconds = options.seconds}, [&](int64_t number, auto done) {
    auto call = NewCall<v1::CreateSolveRequest>(target);
    call->request = DifferentSolve(kQueue + number);
    Stub& stub = *stubs[static_cast<size_t>(number) % stubs.size()];
    stub.async()->CreateSolve(
        &call->context, &call->request, &call->response, [&, call, done](const grpc::Status& status) {
          if (status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED && !HasRetryInfo(status)) ++without_retry;
          done(status.error_code());
        });
  });
  const double growth_mb = static_cast<double>(memory.Growth()) / 1e6;
  Row row{"overload × 10", "RESOURCE_EXHAUSTED with RetryInfo, p99 ≤ 50 ms, memory flat", "", false, {}};
  Judge(run, grpc::StatusCode::RESOURCE_EXHAUSTED, rate, true, &row);
  row.measured +=
      "; " + std::to_string(without_retry.load()) + " without RetryInfo; memory " + Number(growth_mb) + " MB";
  row.met = row.met && without_retry == 0 && growth_mb <= 5;
  row.figures["without_retry_info"] = without_retry.load();
  row.figures["megabytes_grown"] = growth_mb;
  row.figures["megabytes_largest"] = static_cast<double>(memory.Largest()) / 1e6;
  return row;
}

}  // namespace rollgait::load
