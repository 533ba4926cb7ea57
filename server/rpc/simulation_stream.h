#ifndef ROLLGAIT_SERVER_RPC_SIMULATION_STREAM_H_
#define ROLLGAIT_SERVER_RPC_SIMULATION_STREAM_H_

#include <grpcpp/grpcpp.h>

#include <condition_variable>
#include <memory>
#include <mutex>

#include "rollgait/v1/simulation.pb.h"
#include "server/base/wire.pb.h"
#include "server/simulate/simulation_host.h"

namespace rollgait::server {

// The stream of one Simulate or FindPeriodicGait call. The host's thread hands message after message over and waits until each
// is written, so a slow reader slows its own simulation down and nothing piles up. A client that goes away ends the run.
class SimulationStream : public grpc::ServerWriteReactor<v1::SimulationMessage>,
                         public std::enable_shared_from_this<SimulationStream> {
 public:
  // Starts the stream; it deletes itself when gRPC is done with it. The host outlives it.
  static SimulationStream* Start(SimulationHost& host, grpc::CallbackServerContext* context,
                                 wire::SimulatorRequest request);

  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 private:
  SimulationStream(SimulationHost& host, grpc::CallbackServerContext* context, wire::SimulatorRequest request)
      : host_(host), context_(context), request_(std::move(request)) {}

  void Launch();
  // Returns the status to end with.
  grpc::Status Run(SimulationCancel& cancel);
  // Writes and waits. False: the client has gone, or does not read.
  bool Emit(v1::SimulationMessage&& message);
  void End(const grpc::Status& status);

  SimulationHost& host_;
  grpc::CallbackServerContext* const context_;
  const wire::SimulatorRequest request_;
  std::shared_ptr<SimulationStream> self_;  // until OnDone: gRPC holds a plain pointer
  v1::SimulationMessage message_;           // being written

  std::mutex mutex_;  // protects what follows
  std::condition_variable written_;
  std::shared_ptr<SimulationCancel> cancel_;
  bool writing_ = false;
  bool client_gone_ = false;
  bool ended_ = false;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_SIMULATION_STREAM_H_
