#ifndef ROLLGAIT_SERVER_RPC_SIMULATION_STREAM_H_
#define ROLLGAIT_SERVER_RPC_SIMULATION_STREAM_H_

#include <grpcpp/grpcpp.h>

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "rollgait/v1/simulation.pb.h"
#include "server/access/gatekeeper.h"
#include "server/base/executor.h"
#include "server/base/wire.pb.h"
#include "server/simulate/simulation_host.h"

namespace rollgait::server {

// The stream of one Simulate or FindPeriodicGait call. The host's thread hands message after message over and waits
// until each is written, so a slow reader slows its own simulation down and nothing piles up. A client that goes away
// ends the run.
class SimulationStream : public grpc::ServerWriteReactor<v1::SimulationMessage>,
                         public std::enable_shared_from_this<SimulationStream> {
 public:
  using Admit = std::function<Outcome<std::shared_ptr<Admission>>()>;

  // Starts the stream; it deletes itself when gRPC is done with it. Host and executor outlive it.
  // `admit` runs on the executor, in this lane, and decides whether the call is served.
  static SimulationStream* Start(SimulationHost& host, Executor& executor, grpc::CallbackServerContext* context,
                                 wire::SimulatorRequest request, Admit admit, const std::string& lane);
  // A stream that only ends.
  static SimulationStream* Refuse(SimulationHost& host, grpc::CallbackServerContext* context, const Error& error);

  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 private:
  SimulationStream(SimulationHost& host, grpc::CallbackServerContext* context, wire::SimulatorRequest request)
      : host_(host), context_(context), request_(std::move(request)) {}

  void Launch(const Admit& admit);
  void Withdraw(const Error& error);
  // Returns the status to end with.
  grpc::Status Run(SimulationCancel& cancel);
  // Writes and waits. False: the client has gone, or does not read.
  bool Emit(v1::SimulationMessage&& message);
  void End(const grpc::Status& status);

  SimulationHost& host_;
  grpc::CallbackServerContext* const context_;
  const wire::SimulatorRequest request_;
  std::shared_ptr<Admission> admission_;
  std::shared_ptr<SimulationStream> self_;  // until OnDone: gRPC holds a plain pointer
  v1::SimulationMessage message_;           // being written

  std::mutex mutex_;  // protects what follows
  std::condition_variable written_;
  std::shared_ptr<SimulationCancel> cancel_;
  std::optional<Error> withdrawn_;
  bool writing_ = false;
  bool client_gone_ = false;
  bool ended_ = false;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_SIMULATION_STREAM_H_
