#ifndef ROLLGAIT_SERVER_RPC_GAIT_SERVICE_H_
#define ROLLGAIT_SERVER_RPC_GAIT_SERVICE_H_

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <functional>
#include <memory>

#include "rollgait/v1/gait_service.grpc.pb.h"
#include "server/access/gatekeeper.h"
#include "server/base/executor.h"
#include "server/rpc/call_identity.h"
#include "server/rpc/watch_stream.h"
#include "server/service/solve_service.h"
#include "server/service/watch_hub.h"
#include "server/simulate/simulation_host.h"

namespace rollgait::server {

// rollgait.v1.GaitService on the callback API. Every call passes the gatekeeper: Check at once, Admit on the executor,
// where it is answered.
class GaitServiceRpc final : public v1::GaitService::WithRawCallbackMethod_GetSolve<v1::GaitService::CallbackService> {
 public:
  // All outlive the gRPC server that this is registered with.
  GaitServiceRpc(SolveService& service, WatchHub& hub, Gatekeeper& gatekeeper, Executor& executor,
                 SimulationHost& simulations, std::chrono::milliseconds slow_write, IdentitySource identity_source)
      : service_(service),
        hub_(hub),
        gatekeeper_(gatekeeper),
        executor_(executor),
        simulations_(simulations),
        slow_write_(slow_write),
        identity_source_(identity_source) {}

  grpc::ServerWriteReactor<v1::SolveEvent>* RunSolve(grpc::CallbackServerContext* context,
                                                     const v1::RunSolveRequest* request) override;
  grpc::ServerWriteReactor<v1::SolveEvent>* WatchSolve(grpc::CallbackServerContext* context,
                                                       const v1::WatchSolveRequest* request) override;
  grpc::ServerWriteReactor<v1::SolveEvent>* WatchSolves(grpc::CallbackServerContext* context,
                                                        const v1::WatchSolvesRequest* request) override;
  grpc::ServerUnaryReactor* BatchCreateSolves(grpc::CallbackServerContext* context,
                                              const v1::BatchCreateSolvesRequest* request,
                                              v1::BatchCreateSolvesResponse* response) override;
  grpc::ServerUnaryReactor* CreateSolve(grpc::CallbackServerContext* context, const v1::CreateSolveRequest* request,
                                        v1::Solve* response) override;
  // The answer is put together from bytes: stored results go out without being read.
  grpc::ServerUnaryReactor* GetSolve(grpc::CallbackServerContext* context, const grpc::ByteBuffer* request,
                                     grpc::ByteBuffer* response) override;
  grpc::ServerUnaryReactor* ListSolves(grpc::CallbackServerContext* context, const v1::ListSolvesRequest* request,
                                       v1::ListSolvesResponse* response) override;
  grpc::ServerUnaryReactor* CancelSolve(grpc::CallbackServerContext* context, const v1::CancelSolveRequest* request,
                                        v1::Solve* response) override;
  grpc::ServerUnaryReactor* SetSolvePriority(grpc::CallbackServerContext* context,
                                             const v1::SetSolvePriorityRequest* request, v1::Solve* response) override;
  grpc::ServerUnaryReactor* DeleteSolve(grpc::CallbackServerContext* context, const v1::DeleteSolveRequest* request,
                                        google::protobuf::Empty* response) override;
  grpc::ServerUnaryReactor* ListModels(grpc::CallbackServerContext* context, const v1::ListModelsRequest* request,
                                       v1::ListModelsResponse* response) override;
  grpc::ServerUnaryReactor* CreateModel(grpc::CallbackServerContext* context, const v1::CreateModelRequest* request,
                                        v1::Model* response) override;
  grpc::ServerUnaryReactor* DeleteModel(grpc::CallbackServerContext* context, const v1::DeleteModelRequest* request,
                                        google::protobuf::Empty* response) override;
  grpc::ServerUnaryReactor* GetModel(grpc::CallbackServerContext* context, const v1::GetModelRequest* request,
                                     v1::Model* response) override;
  grpc::ServerUnaryReactor* GetServerInfo(grpc::CallbackServerContext* context, const v1::GetServerInfoRequest* request,
                                          v1::ServerInfo* response) override;
  grpc::ServerWriteReactor<v1::SimulationMessage>* Simulate(grpc::CallbackServerContext* context,
                                                            const v1::SimulateRequest* request) override;
  grpc::ServerWriteReactor<v1::SimulationMessage>* FindPeriodicGait(
      grpc::CallbackServerContext* context, const v1::FindPeriodicGaitRequest* request) override;

 private:
  // Decides, on the executor, whether a call is served.
  using Admit = std::function<Outcome<std::shared_ptr<Admission>>()>;

  // The first half of the decision; an error of the gatekeeper becomes the answer of the second.
  struct Entry {
    Admit admit;
    std::string lane;  // of the executor
  };
  Outcome<Entry> Enter(const MethodRule& rule, const grpc::CallbackServerContext& context);
  // Answers a unary call: `serve` is called on the executor with the admission, whose budget it asks, fills
  // the response and returns Outcome<Done>. The admission lasts until gRPC has written the answer.
  template <typename Serve>
  grpc::ServerUnaryReactor* AnswerBy(const MethodRule& rule, grpc::CallbackServerContext* context, Serve serve);
  // Answers a unary call with (service_.*method)(caller, request). An answer beyond the budget is refused, unless the
  // method changes something.
  template <typename UseCases, typename Request, typename Response>
  grpc::ServerUnaryReactor* Answer(const MethodRule& rule, grpc::CallbackServerContext* context, const Request* request,
                                   Response* response, UseCases& service,
                                   Outcome<Response> (UseCases::*method)(const Caller&, const Request&));
  grpc::ServerWriteReactor<v1::SolveEvent>* Stream(const MethodRule& rule, grpc::CallbackServerContext* context,
                                                   WatchStream::Find find, bool cancel_on_disconnect);
  grpc::ServerWriteReactor<v1::SimulationMessage>* Simulation(const MethodRule& rule,
                                                              grpc::CallbackServerContext* context,
                                                              wire::SimulatorRequest request);

  SolveService& service_;
  WatchHub& hub_;
  Gatekeeper& gatekeeper_;
  Executor& executor_;
  SimulationHost& simulations_;
  const std::chrono::milliseconds slow_write_;
  const IdentitySource identity_source_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_GAIT_SERVICE_H_
