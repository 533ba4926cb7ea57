#include "server/rpc/gait_service.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "server/rpc/call_record.h"
#include "server/rpc/door.h"
#include "server/rpc/message_memory.h"
#include "server/rpc/simulation_stream.h"
#include "server/rpc/status.h"
#include "server/rpc/unary_call.h"
#include "server/rpc/watch_stream.h"
#include "server/service/request_check.h"
#include "server/service/solve_message.h"

namespace rollgait::server {
namespace {

// Refused calls are logged, defects loudly.
grpc::Status Report(const std::string& peer, const Error& error) {
  if (error.code == ErrorCode::kInternal) {
    spdlog::error("call of {} failed: {}", peer, error.message);
  } else {
    spdlog::debug("call of {} refused: {}", peer, error.message);
  }
  return ToStatus(error);
}

// A slice that keeps the bytes, which are not copied.
grpc::Slice Owning(std::string bytes) {
  auto* const owned = new std::string(std::move(bytes));
  return grpc::Slice(
      owned->data(), owned->size(), [](void* text) { delete static_cast<std::string*>(text); }, owned);
}

Error TooManyCalls() {
  return {ErrorCode::kResourceExhausted,
          "the server has too many calls to answer; try again later",
          {},
          std::chrono::milliseconds(1000)};
}

}  // namespace

Outcome<GaitServiceRpc::Entry> GaitServiceRpc::Enter(const MethodRule& rule,
                                                     const grpc::CallbackServerContext& context) {
  Outcome<Presented> identity = ReadIdentity(context, identity_source_);
  if (!identity.ok()) return identity.error();
  Presented presented = std::move(identity).value();
  std::string lane = gatekeeper_.LaneOf(presented);
  Outcome<std::shared_ptr<void>> place = gatekeeper_.Check(rule, lane);
  if (!place.ok()) return place.error();
  std::shared_ptr<CallRecord> record = RecordOf(context);
  if (record != nullptr) presented.traceparent = record->origin().traceparent;
  Admit admit([this, &rule, presented = std::move(presented), held = std::move(place).value(),
               record = std::move(record)]() mutable {
    Outcome<std::shared_ptr<Admission>> admitted = gatekeeper_.Admit(rule, presented, std::exchange(held, nullptr));
    if (admitted.ok() && record != nullptr) {
      record->SetCaller(admitted.value()->caller().tenant, admitted.value()->caller().identity);
    }
    return admitted;
  });
  return Entry{std::move(admit), std::move(lane)};
}

template <typename Serve>
grpc::ServerUnaryReactor* GaitServiceRpc::AnswerBy(const MethodRule& rule, grpc::CallbackServerContext* context,
                                                   Serve serve) {
  auto* const reactor = new UnaryCall;  // deletes itself
  Outcome<Entry> entry = Enter(rule, *context);
  if (!entry.ok()) {
    reactor->Finish(Report(PeerOf(*context), entry.error()));
    return reactor;
  }
  const bool taken = executor_.TryPost(
      entry.value().lane, [decide = std::move(entry.value().admit), context, reactor, serve = std::move(serve)] {
        const Outcome<std::shared_ptr<Admission>> admitted = decide();
        const LogFields fields = FieldsOf(*context);
        const LogScope scope(fields);
        if (!admitted.ok()) {
          reactor->Finish(Report(PeerOf(*context), admitted.error()));
          return;
        }
        Admission& admission = *admitted.value();
        reactor->Keep(admitted.value());
        const Outcome<Done> served = serve(admission);
        admission.WorkIsMade();
        if (served.ok()) {
          reactor->Finish(grpc::Status::OK);
        } else {
          reactor->Finish(Report(PeerOf(*context), served.error()));
        }
      });
  if (!taken) reactor->Finish(ToStatus(TooManyCalls()));
  return reactor;
}

template <typename UseCases, typename Request, typename Response>
grpc::ServerUnaryReactor* GaitServiceRpc::Answer(const MethodRule& rule, grpc::CallbackServerContext* context,
                                                 const Request* request, Response* response, UseCases& service,
                                                 Outcome<Response> (UseCases::*method)(const Caller&, const Request&)) {
  return AnswerBy(rule, context,
                  [&service, request, response, method, changes = rule.changes](Admission& admission) -> Outcome<Done> {
                    Outcome<Response> outcome = (service.*method)(admission.caller(), *request);
                    if (!outcome.ok()) return outcome.error();
                    const int64_t bytes = MemoryOf(outcome.value());
                    if (changes) {
                      admission.answer().Owe(bytes);
                    } else if (Outcome<Done> held = admission.answer().Hold(bytes); !held.ok()) {
                      return held.error();
                    }
                    *response = std::move(outcome).value();
                    return Done{};
                  });
}

grpc::ServerWriteReactor<v1::SolveEvent>* GaitServiceRpc::Stream(const MethodRule& rule,
                                                                 grpc::CallbackServerContext* context,
                                                                 WatchStream::Find find, bool cancel_on_disconnect) {
  WatchStream::Plan plan;
  Outcome<Entry> entry = Enter(rule, *context);
  if (!entry.ok()) {
    plan.refusal = entry.error();
    return WatchStream::Start(executor_, hub_, slow_write_, context, std::move(plan));
  }
  plan.admit = std::move(entry.value().admit);
  plan.lane = std::move(entry.value().lane);
  plan.find = std::move(find);
  if (cancel_on_disconnect) {
    plan.on_disconnect = [this](const Caller& caller, const std::string& id) {
      v1::CancelSolveRequest cancel;
      cancel.set_name(SolveName(id));
      const Outcome<v1::Solve> outcome = service_.CancelSolve(caller, cancel);
      if (!outcome.ok()) spdlog::warn("cancelling solves/{} on disconnect failed: {}", id, outcome.error().message);
    };
  }
  return WatchStream::Start(executor_, hub_, slow_write_, context, std::move(plan));
}

grpc::ServerWriteReactor<v1::SolveEvent>* GaitServiceRpc::RunSolve(grpc::CallbackServerContext* context,
                                                                   const v1::RunSolveRequest* request) {
  const auto create_and_watch = [this, request](const Caller& caller) -> Outcome<WatchStream::Target> {
    v1::CreateSolveRequest create;
    *create.mutable_spec() = request->spec();
    if (!request->has_spec()) create.clear_spec();
    create.set_request_id(request->request_id());
    *create.mutable_labels() = request->labels();
    create.set_priority(request->priority());
    const Outcome<v1::Solve> solve = service_.CreateSolve(caller, create);
    if (solve.ok()) return WatchStream::Target{{{SolveId(solve.value().name()).value(), 0}}};
    return solve.error();
  };
  return Stream(RuleOf("RunSolve"), context, create_and_watch, request->cancel_on_disconnect());
}

grpc::ServerWriteReactor<v1::SolveEvent>* GaitServiceRpc::WatchSolve(grpc::CallbackServerContext* context,
                                                                     const v1::WatchSolveRequest* request) {
  const auto find = [this, request](const Caller& caller) -> Outcome<WatchStream::Target> {
    Violations refused = CheckIterates(request->iterates_per_second(), "iterates_per_second");
    if (!refused.empty()) return InvalidArgument(std::move(refused));
    Outcome<std::string> id = SolveId(request->name());
    if (!id.ok()) return id.error();
    const Outcome<SolveExtent> extent = service_.ExtentFor(caller, id.value());
    if (!extent.ok()) return extent.error();
    return WatchStream::Target{{{std::move(id).value(), request->after_sequence(), request->iterates_per_second()}},
                               extent.value().bytes};
  };
  return Stream(RuleOf("WatchSolve"), context, find, false);
}

grpc::ServerWriteReactor<v1::SolveEvent>* GaitServiceRpc::WatchSolves(grpc::CallbackServerContext* context,
                                                                      const v1::WatchSolvesRequest* request) {
  const auto find = [this, request](const Caller& caller) -> Outcome<WatchStream::Target> {
    Outcome<SolveService::Watched> watched = service_.FindWatched(caller, *request);
    if (!watched.ok()) return watched.error();
    return WatchStream::Target{std::move(watched.value().positions), watched.value().longest_bytes};
  };
  return Stream(RuleOf("WatchSolves"), context, find, false);
}

grpc::ServerUnaryReactor* GaitServiceRpc::BatchCreateSolves(grpc::CallbackServerContext* context,
                                                            const v1::BatchCreateSolvesRequest* request,
                                                            v1::BatchCreateSolvesResponse* response) {
  const auto create = [&service = service_, request, response](Admission& admission) -> Outcome<Done> {
    const int count = std::clamp(request->requests_size(), 1, SolveService::kMostAtOnce);
    admission.OweCreates(count - 1);  // one was taken when the call was admitted
    int attached = 0;
    Outcome<v1::BatchCreateSolvesResponse> solves = service.BatchCreateSolves(admission.caller(), *request, &attached);
    if (!solves.ok()) return solves.error();
    admission.OweCreates(-std::min(attached, count - 1));  // what was there costs nothing; the one taken stays
    admission.answer().Owe(MemoryOf(solves.value()));
    *response = std::move(solves).value();
    return Done{};
  };
  return AnswerBy(RuleOf("BatchCreateSolves"), context, create);
}

grpc::ServerUnaryReactor* GaitServiceRpc::CreateSolve(grpc::CallbackServerContext* context,
                                                      const v1::CreateSolveRequest* request, v1::Solve* response) {
  return Answer(RuleOf("CreateSolve"), context, request, response, service_, &SolveService::CreateSolve);
}

grpc::ServerUnaryReactor* GaitServiceRpc::GetSolve(grpc::CallbackServerContext* context,
                                                   const grpc::ByteBuffer* request, grpc::ByteBuffer* response) {
  const auto get = [&service = service_, request, response](Admission& admission) -> Outcome<Done> {
    v1::GetSolveRequest message;
    grpc::ByteBuffer copy(*request);
    if (!grpc::SerializationTraits<v1::GetSolveRequest>::Deserialize(&copy, &message).ok()) {
      return Error{ErrorCode::kInvalidArgument, "the request is not a rollgait.v1.GetSolveRequest"};
    }
    Outcome<SolveBytes> solve =
        service.GetSolve(admission.caller(), message, [&](int64_t bytes) { return admission.answer().Hold(bytes); });
    if (!solve.ok()) return solve.error();
    const grpc::Slice parts[] = {grpc::Slice(solve.value().head), Owning(std::move(solve.value().result))};
    *response = grpc::ByteBuffer(parts, std::size(parts));
    return Done{};
  };
  return AnswerBy(RuleOf("GetSolve"), context, get);
}

grpc::ServerUnaryReactor* GaitServiceRpc::ListSolves(grpc::CallbackServerContext* context,
                                                     const v1::ListSolvesRequest* request,
                                                     v1::ListSolvesResponse* response) {
  return Answer(RuleOf("ListSolves"), context, request, response, service_, &SolveService::ListSolves);
}

grpc::ServerUnaryReactor* GaitServiceRpc::CancelSolve(grpc::CallbackServerContext* context,
                                                      const v1::CancelSolveRequest* request, v1::Solve* response) {
  return Answer(RuleOf("CancelSolve"), context, request, response, service_, &SolveService::CancelSolve);
}

grpc::ServerUnaryReactor* GaitServiceRpc::SetSolvePriority(grpc::CallbackServerContext* context,
                                                           const v1::SetSolvePriorityRequest* request,
                                                           v1::Solve* response) {
  return Answer(RuleOf("SetSolvePriority"), context, request, response, service_, &SolveService::SetSolvePriority);
}

grpc::ServerUnaryReactor* GaitServiceRpc::DeleteSolve(grpc::CallbackServerContext* context,
                                                      const v1::DeleteSolveRequest* request,
                                                      google::protobuf::Empty* response) {
  return Answer(RuleOf("DeleteSolve"), context, request, response, service_, &SolveService::DeleteSolve);
}

grpc::ServerUnaryReactor* GaitServiceRpc::ListModels(grpc::CallbackServerContext* context,
                                                     const v1::ListModelsRequest* request,
                                                     v1::ListModelsResponse* response) {
  return Answer(RuleOf("ListModels"), context, request, response, service_.models(), &ModelService::ListModels);
}

grpc::ServerUnaryReactor* GaitServiceRpc::GetModel(grpc::CallbackServerContext* context,
                                                   const v1::GetModelRequest* request, v1::Model* response) {
  return Answer(RuleOf("GetModel"), context, request, response, service_.models(), &ModelService::GetModel);
}

grpc::ServerUnaryReactor* GaitServiceRpc::CreateModel(grpc::CallbackServerContext* context,
                                                      const v1::CreateModelRequest* request, v1::Model* response) {
  return Answer(RuleOf("CreateModel"), context, request, response, service_.models(), &ModelService::CreateModel);
}

grpc::ServerUnaryReactor* GaitServiceRpc::DeleteModel(grpc::CallbackServerContext* context,
                                                      const v1::DeleteModelRequest* request,
                                                      google::protobuf::Empty* response) {
  return Answer(RuleOf("DeleteModel"), context, request, response, service_.models(), &ModelService::DeleteModel);
}

grpc::ServerUnaryReactor* GaitServiceRpc::GetServerInfo(grpc::CallbackServerContext* context,
                                                        const v1::GetServerInfoRequest* request,
                                                        v1::ServerInfo* response) {
  return Answer(RuleOf("GetServerInfo"), context, request, response, service_, &SolveService::GetServerInfo);
}

grpc::ServerWriteReactor<v1::SimulationMessage>* GaitServiceRpc::Simulation(const MethodRule& rule,
                                                                            grpc::CallbackServerContext* context,
                                                                            wire::SimulatorRequest request) {
  Outcome<Entry> entry = Enter(rule, *context);
  if (!entry.ok()) return SimulationStream::Refuse(simulations_, context, entry.error());
  return SimulationStream::Start(simulations_, executor_, context, std::move(request), std::move(entry.value().admit),
                                 entry.value().lane);
}

grpc::ServerWriteReactor<v1::SimulationMessage>* GaitServiceRpc::Simulate(grpc::CallbackServerContext* context,
                                                                          const v1::SimulateRequest* request) {
  wire::SimulatorRequest wrapped;
  *wrapped.mutable_simulate() = *request;
  return Simulation(RuleOf("Simulate"), context, std::move(wrapped));
}

grpc::ServerWriteReactor<v1::SimulationMessage>* GaitServiceRpc::FindPeriodicGait(
    grpc::CallbackServerContext* context, const v1::FindPeriodicGaitRequest* request) {
  wire::SimulatorRequest wrapped;
  *wrapped.mutable_find_gait() = *request;
  return Simulation(RuleOf("FindPeriodicGait"), context, std::move(wrapped));
}

}  // namespace rollgait::server
