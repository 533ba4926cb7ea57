#include "server/rpc/gait_service.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "server/rpc/call_record.h"
#include "server/rpc/simulation_stream.h"
#include "server/rpc/status.h"
#include "server/rpc/watch_stream.h"
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

Error TooManyCalls() {
  return {ErrorCode::kResourceExhausted,
          "the server has too many calls to answer; try again later",
          {},
          std::chrono::milliseconds(1000)};
}

}  // namespace

template <typename Request, typename Response>
grpc::ServerUnaryReactor* GaitServiceRpc::Answer(grpc::CallbackServerContext* context, const Request* request,
                                                 Response* response,
                                                 Outcome<Response> (SolveService::*method)(const Request&)) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  // The service is captured on its own: g++ 12's vptr sanitizer looks at the wrong address in (service_.*method) otherwise.
  const bool taken = executor_.TryPost([&service = service_, context, reactor, request, response, method] {
    const LogFields fields = FieldsOf(*context);
    const LogScope scope(fields);
    Outcome<Response> outcome = (service.*method)(*request);
    if (outcome.ok()) {
      *response = std::move(outcome).value();
      reactor->Finish(grpc::Status::OK);
    } else {
      reactor->Finish(Report(context->peer(), outcome.error()));
    }
  });
  if (!taken) reactor->Finish(ToStatus(TooManyCalls()));
  return reactor;
}

grpc::ServerWriteReactor<v1::SolveEvent>* GaitServiceRpc::RunSolve(grpc::CallbackServerContext*,
                                                                   const v1::RunSolveRequest* request) {
  WatchStream::Plan plan;
  plan.prepare = [this, request]() -> Outcome<WatchStream::Target> {
    v1::CreateSolveRequest create;
    *create.mutable_spec() = request->spec();
    if (!request->has_spec()) create.clear_spec();
    create.set_request_id(request->request_id());
    const Outcome<v1::Solve> solve = service_.CreateSolve(create);
    if (!solve.ok()) return solve.error();
    return WatchStream::Target{SolveId(solve.value().name()).value(), 0};
  };
  if (request->cancel_on_disconnect()) {
    plan.on_disconnect = [this](const std::string& id) {
      v1::CancelSolveRequest cancel;
      cancel.set_name(SolveName(id));
      const Outcome<v1::Solve> outcome = service_.CancelSolve(cancel);
      if (!outcome.ok()) spdlog::warn("cancelling solves/{} on disconnect failed: {}", id, outcome.error().message);
    };
  }
  return WatchStream::Start(executor_, hub_, slow_write_, std::move(plan));
}

grpc::ServerWriteReactor<v1::SolveEvent>* GaitServiceRpc::WatchSolve(grpc::CallbackServerContext*,
                                                                     const v1::WatchSolveRequest* request) {
  WatchStream::Plan plan;
  plan.prepare = [request]() -> Outcome<WatchStream::Target> {
    Outcome<std::string> id = SolveId(request->name());
    if (!id.ok()) return id.error();
    return WatchStream::Target{std::move(id).value(), request->after_sequence()};
  };
  return WatchStream::Start(executor_, hub_, slow_write_, std::move(plan));
}

grpc::ServerUnaryReactor* GaitServiceRpc::CreateSolve(grpc::CallbackServerContext* context,
                                                      const v1::CreateSolveRequest* request, v1::Solve* response) {
  return Answer(context, request, response, &SolveService::CreateSolve);
}

grpc::ServerUnaryReactor* GaitServiceRpc::GetSolve(grpc::CallbackServerContext* context,
                                                   const v1::GetSolveRequest* request, v1::Solve* response) {
  return Answer(context, request, response, &SolveService::GetSolve);
}

grpc::ServerUnaryReactor* GaitServiceRpc::ListSolves(grpc::CallbackServerContext* context,
                                                     const v1::ListSolvesRequest* request,
                                                     v1::ListSolvesResponse* response) {
  return Answer(context, request, response, &SolveService::ListSolves);
}

grpc::ServerUnaryReactor* GaitServiceRpc::CancelSolve(grpc::CallbackServerContext* context,
                                                      const v1::CancelSolveRequest* request, v1::Solve* response) {
  return Answer(context, request, response, &SolveService::CancelSolve);
}

grpc::ServerUnaryReactor* GaitServiceRpc::DeleteSolve(grpc::CallbackServerContext* context,
                                                      const v1::DeleteSolveRequest* request,
                                                      google::protobuf::Empty* response) {
  return Answer(context, request, response, &SolveService::DeleteSolve);
}

grpc::ServerUnaryReactor* GaitServiceRpc::ListModels(grpc::CallbackServerContext* context,
                                                     const v1::ListModelsRequest* request,
                                                     v1::ListModelsResponse* response) {
  return Answer(context, request, response, &SolveService::ListModels);
}

grpc::ServerUnaryReactor* GaitServiceRpc::GetModel(grpc::CallbackServerContext* context,
                                                   const v1::GetModelRequest* request, v1::Model* response) {
  return Answer(context, request, response, &SolveService::GetModel);
}

grpc::ServerUnaryReactor* GaitServiceRpc::GetServerInfo(grpc::CallbackServerContext* context,
                                                        const v1::GetServerInfoRequest* request,
                                                        v1::ServerInfo* response) {
  return Answer(context, request, response, &SolveService::GetServerInfo);
}

grpc::ServerWriteReactor<v1::SimulationMessage>* GaitServiceRpc::Simulate(grpc::CallbackServerContext* context,
                                                                          const v1::SimulateRequest* request) {
  wire::SimulatorRequest wrapped;
  *wrapped.mutable_simulate() = *request;
  return SimulationStream::Start(simulations_, context, std::move(wrapped));
}

grpc::ServerWriteReactor<v1::SimulationMessage>* GaitServiceRpc::FindPeriodicGait(
    grpc::CallbackServerContext* context, const v1::FindPeriodicGaitRequest* request) {
  wire::SimulatorRequest wrapped;
  *wrapped.mutable_find_gait() = *request;
  return SimulationStream::Start(simulations_, context, std::move(wrapped));
}

}  // namespace rollgait::server
