#include "server/solve/worker.h"

#include <unistd.h>

#include <cerrno>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "core/gait/newest_solution.h"
#include "core/nlp/solve_journal.h"
#include "server/base/framing.h"
#include "server/base/iterate_files.h"
#include "server/base/journal_limits.h"
#include "server/base/solver_build.h"
#include "server/base/wire.pb.h"
#include "server/convert/gait_request_convert.h"
#include "server/convert/result_convert.h"
#include "server/convert/warm_start_convert.h"
#include "server/solve/iterate_sender.h"

namespace rollgait::server {
namespace {

constexpr const char* kMemoryMessage =
    "the solver needs more memory than its limit; ask for fewer intervals or fewer refinements";

std::string EncodeError(v1::SolveError::Kind kind, const std::string& message) {
  wire::SolverMessage encoded;
  encoded.mutable_error()->set_kind(kind);
  encoded.mutable_error()->set_message(message);
  return encoded.SerializeAsString();
}

WorkerExit SendError(int fd, v1::SolveError::Kind kind, const std::string& message) {
  return WriteFrame(fd, EncodeError(kind, message)) == FrameStatus::kOk ? kWorkerDone : kWorkerNoReader;
}

// The second frame of a request with a warm start. Not read: an error, which was sent.
std::optional<wire::WarmStart> ReadWarmStart(int fd, GaitSpec* spec) {
  std::string payload;
  wire::WarmStart sent;
  if (ReadFrame(fd, &payload) != FrameStatus::kOk || !sent.ParseFromString(payload)) {
    SendError(fd, v1::SolveError::KIND_INTERNAL, "the request is not followed by its warm start");
    return std::nullopt;
  }
  if (!sent.has_trajectory()) return sent;
  Result<WarmStart> start = DecodeWarmStart(sent.trajectory(), sent.multipliers(), *spec);
  if (!start.ok()) {
    const Violation& first = start.violations().front();
    SendError(fd, v1::SolveError::KIND_INTERNAL,
              "this solver refuses the start: " + first.field + ": " + first.message);
    return std::nullopt;
  }
  spec->warm_start = std::move(start).value();
  return sent;
}

// The last frame of a request. nullopt: it is none.
std::optional<JournalRecords> ReadJournal(int fd) {
  std::string payload;
  wire::Journal sent;
  if (ReadFrame(fd, &payload) != FrameStatus::kOk || !sent.ParseFromString(payload)) {
    SendError(fd, v1::SolveError::KIND_INTERNAL, "the request is not followed by its journal");
    return std::nullopt;
  }
  JournalRecords records;
  for (std::string& record : *sent.mutable_finished()) records.finished.push_back(std::move(record));
  records.started = std::move(*sent.mutable_started());
  return records;
}

// Sends what a solve does not end with. Without a reader it stops.
class Sender {
 public:
  Sender(int fd, StopFlag& stop) : fd_(fd), stop_(stop) {}

  void Send(const IterationInfo& iteration) {
    wire::SolverMessage message;
    *message.mutable_iteration() = EncodeIteration(iteration);
    Send(message);
  }
  void Send(v1::Iterate iterate) {
    wire::SolverMessage message;
    *message.mutable_iterate() = std::move(iterate);
    Send(message);
  }
  void Send(const Continuation& continuation) {
    wire::SolverMessage message;
    message.mutable_continuation()->set_programs(continuation.programs);
    message.mutable_continuation()->set_iteration(continuation.iteration);
    message.mutable_continuation()->set_ignored(continuation.ignored);
    Send(message);
  }
  // One that is too long for a frame is not shown; the result will say so.
  void SendIntermediate(v1::SolveResult solution) {
    wire::SolverMessage message;
    *message.mutable_intermediate() = std::move(solution);
    if (message.ByteSizeLong() <= kMaxFrameBytes) Send(message);
  }
  void SendRecord(int program, bool finished, std::string record) {
    if (record.size() > kMaxRecordBytes) return;
    wire::SolverMessage message;
    message.mutable_record()->set_program(program);
    *(finished ? message.mutable_record()->mutable_finished() : message.mutable_record()->mutable_started()) =
        std::move(record);
    Send(message);
  }

 private:
  void Send(const wire::SolverMessage& message) {
    if (WriteFrame(fd_, message.SerializeAsString()) != FrameStatus::kOk) stop_.Request();
  }
  const int fd_;
  StopFlag& stop_;
};

// Sends the solutions of a search. Those that an earlier process had sent, it leaves.
class SolutionSender : public SolutionSink {
 public:
  SolutionSender(const GaitSpec& spec, Sender& sender) : spec_(spec), sender_(sender) {}

  void Pause() { paused_ = true; }
  void GoOn() { paused_ = false; }
  void Take(const GaitSolution& solution) override {
    if (paused_) return;
    v1::SolveResult encoded = EncodeResult(solution, spec_);
    encoded.clear_termination();
    encoded.set_message("The search goes on.");
    encoded.set_solver_build(SolverBuild());
    sender_.SendIntermediate(std::move(encoded));
  }

 private:
  const GaitSpec& spec_;
  Sender& sender_;
  bool paused_ = false;
};

WorkerExit SolveAndSend(int fd, const GaitSpec& spec, const v1::WarmStartSource& source, JournalRecords records,
                        GaitSolver& solver, StopFlag& stop) {
  Sender sender(fd, stop);
  SolveJournal::Sink sink;
  sink.finished = [&](int program, std::string record) { sender.SendRecord(program, true, std::move(record)); };
  sink.started = [&](int program, std::string record) { sender.SendRecord(program, false, std::move(record)); };
  const bool goes_on = !records.finished.empty() || !records.started.empty();
  SolutionSender solutions(spec, sender);
  if (goes_on) {
    solutions.Pause();
    sink.continued = [&](const Continuation& continuation) {
      sender.Send(continuation);
      solutions.GoOn();
    };
  }
  SolveJournal journal(std::move(records), std::move(sink));
  SolveControl control;
  control.stop = &stop;
  control.journal = &journal;
  control.observer = [&](const IterationInfo& iteration) { sender.Send(iteration); };
  IterateSender iterates(spec.scene, kIteratePause, [&](v1::Iterate iterate) { sender.Send(std::move(iterate)); });
  control.iterates = &iterates;
  control.solutions = &solutions;
  wire::SolverMessage message;
  const GaitSolution solution = solver.Solve(spec, control);
  *message.mutable_result() = EncodeResult(solution, spec);
  if (solution.warm_started) {
    *message.mutable_result()->mutable_warm_started_from() = source;
    message.mutable_result()->mutable_warm_started_from()->set_used_multipliers(solution.used_multipliers);
  }
  message.mutable_result()->set_solver_build(SolverBuild());
  const std::string encoded = message.SerializeAsString();
  if (encoded.size() > kMaxFrameBytes) {
    return SendError(fd, v1::SolveError::KIND_INTERNAL,
                     "the result has " + std::to_string(encoded.size()) + " bytes, more than the limit of " +
                         std::to_string(kMaxFrameBytes) + "; ask for fewer intervals");
  }
  return WriteFrame(fd, encoded) == FrameStatus::kOk ? kWorkerDone : kWorkerNoReader;
}

// What ReportMemoryLimitOn prepares, so that the handler needs no memory.
int memory_limit_fd = -1;
std::string* memory_limit_frame = nullptr;

}  // namespace

void OnFailedAllocation() {
  if (memory_limit_frame == nullptr) return;
  const char* bytes = memory_limit_frame->data();
  size_t left = memory_limit_frame->size();
  while (left > 0) {
    const ssize_t count = write(memory_limit_fd, bytes, left);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    bytes += count;
    left -= static_cast<size_t>(count);
  }
  _exit(kWorkerDone);
}

void ReportMemoryLimitOn(int fd) {
  memory_limit_fd = fd;
  delete memory_limit_frame;
  memory_limit_frame = new std::string(EncodeFrame(EncodeError(v1::SolveError::KIND_MEMORY_LIMIT, kMemoryMessage)));
  std::set_new_handler(OnFailedAllocation);
}

WorkerExit ServeOneRequest(int fd, GaitSolver& solver, StopFlag& stop,
                           const std::function<void(const GaitSpec&)>& on_request) {
  try {
    wire::SolverMessage ready;
    ready.mutable_ready();
    if (WriteFrame(fd, ready.SerializeAsString()) != FrameStatus::kOk) return kWorkerNoReader;
    std::string payload;
    const FrameStatus status = ReadFrame(fd, &payload);
    if (status == FrameStatus::kEnd) return kWorkerDone;
    if (status == FrameStatus::kOk) {
      wire::SolverMessage taken;
      taken.mutable_taken();
      if (WriteFrame(fd, taken.SerializeAsString()) != FrameStatus::kOk) return kWorkerNoReader;
    }
    v1::SolveSpec request;
    if (status != FrameStatus::kOk || !request.ParseFromString(payload)) {
      SendError(fd, v1::SolveError::KIND_INTERNAL,
                status == FrameStatus::kOk ? "the request is not a SolveSpec" : Describe(status));
      return kWorkerNoRequest;
    }
    Result<GaitSpec> spec = DecodeSpec(request);
    if (!spec.ok()) {
      const Violation& first = spec.violations().front();
      return SendError(fd, v1::SolveError::KIND_INTERNAL,
                       "this solver refuses the request: " + first.field + ": " + first.message);
    }
    GaitSpec checked = std::move(spec).value();
    wire::WarmStart start;
    if (!request.warm_start().empty()) {
      const std::optional<wire::WarmStart> sent = ReadWarmStart(fd, &checked);
      if (!sent) return kWorkerNoRequest;
      start = *sent;
    }
    std::optional<JournalRecords> records = ReadJournal(fd);
    if (!records) return kWorkerNoRequest;
    on_request(checked);
    return SolveAndSend(fd, checked, start.source(), std::move(*records), solver, stop);
  } catch (const std::bad_alloc&) {
    return SendError(fd, v1::SolveError::KIND_MEMORY_LIMIT, kMemoryMessage);
  } catch (const std::exception& exception) {
    return SendError(fd, v1::SolveError::KIND_INTERNAL, std::string("the solver failed: ") + exception.what());
  }
}

}  // namespace rollgait::server
