#ifndef ROLLGAIT_SERVER_RPC_GAIT_SERVICE_H_
#define ROLLGAIT_SERVER_RPC_GAIT_SERVICE_H_

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <functional>

#include "rollgait/v1/gait_service.grpc.pb.h"
#include "server/base/executor.h"
#include "server/service/solve_service.h"
#include "server/service/watch_hub.h"
#include "server/simulate/simulation_host.h"

namespace rollgait::server {

// rollgait.v1.GaitService on the callback API: every call is handed to the executor and answered from there.
class GaitServiceRpc final : public v1::GaitService::CallbackService {
 public:
  // All outlive the gRPC server that this is registered with.
  GaitServiceRpc(SolveService& service, WatchHub& hub, Executor& executor, SimulationHost& simulations,
                 std::chrono::milliseconds slow_write)
      : service_(service), hub_(hub), executor_(executor), simulations_(simulations), slow_write_(slow_write) {}

  grpc::ServerWriteReactor<v1::SolveEvent>* RunSolve(grpc::CallbackServerContext* context,
                                                     const v1::RunSolveRequest* request) override;
  grpc::ServerWriteReactor<v1::SolveEvent>* WatchSolve(grpc::CallbackServerContext* context,
                                                       const v1::WatchSolveRequest* request) override;
  grpc::ServerUnaryReactor* CreateSolve(grpc::CallbackServerContext* context, const v1::CreateSolveRequest* request,
                                        v1::Solve* response) override;
  grpc::ServerUnaryReactor* GetSolve(grpc::CallbackServerContext* context, const v1::GetSolveRequest* request,
                                     v1::Solve* response) override;
  grpc::ServerUnaryReactor* ListSolves(grpc::CallbackServerContext* context, const v1::ListSolvesRequest* request,
                                       v1::ListSolvesResponse* response) override;
  grpc::ServerUnaryReactor* CancelSolve(grpc::CallbackServerContext* context, const v1::CancelSolveRequest* request,
                                        v1::Solve* response) override;
  grpc::ServerUnaryReactor* DeleteSolve(grpc::CallbackServerContext* context, const v1::DeleteSolveRequest* request,
                                        google::protobuf::Empty* response) override;
  grpc::ServerUnaryReactor* ListModels(grpc::CallbackServerContext* context, const v1::ListModelsRequest* request,
                                       v1::ListModelsResponse* response) override;
  grpc::ServerUnaryReactor* GetModel(grpc::CallbackServerContext* context, const v1::GetModelRequest* request,
                                     v1::Model* response) override;
  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context, const v1::GetServerInfoRequest* request,
                                          v1::ServerInfo* response) override;
  grpc::ServerWriteReactor<v1::SimulationMessage>* Simulate(grpc::CallbackServerContext* context,
                                                            const v1::SimulateRequest* request) override;
  grpc::ServerWriteReactor<v1::SimulationMessage>* FindPeriodicGait(
      grpc::CallbackServerContext* context, const v1::FindPeriodicGaitRequest* request) override;

 private:
  // Answers a unary call with (service_.*method)(request).
  template <typename Request, typename Response>
  grpc::ServerUnaryReactor* Answer(grpc::CallbackServerContext* context, const Request* request, Response* response,
                                   Outcome<Response> (SolveService::*method)(const Request&));

  SolveService& service_;
  WatchHub& hub_;
  Executor& executor_;
  SimulationHost& simulations_;
  const std::chrono::milliseconds slow_write_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_GAIT_SERVICE_H_
