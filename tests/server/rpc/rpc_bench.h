#ifndef ROLLGAIT_TESTS_SERVER_RPC_RPC_BENCH_H_
#define ROLLGAIT_TESTS_SERVER_RPC_RPC_BENCH_H_

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "rollgait/v1/gait_service.grpc.pb.h"
#include "server/rpc/rpc_server.h"
#include "tests/server/service/service_fixture.h"

namespace rollgait::server {

// A server in this process on a free port, and a client of it.
class RpcBench {
 public:
  explicit RpcBench(RpcOptions rpc_options = {}, ServiceOptions options = {},
                    std::chrono::milliseconds heartbeat = std::chrono::hours(1), const Gatekeeper::Options& gate = {})
      : bench_(heartbeat, std::move(options)),
        gatekeeper_(gate),
        server_(std::move(RpcServer::Start(rpc_options, bench_.service(), bench_.hub(), gatekeeper_).value())),
        channel_(Connect(server_->address())),
        stub_(v1::GaitService::NewStub(channel_)) {}

  ServiceBench& bench() { return bench_; }
  Gatekeeper& gatekeeper() { return gatekeeper_; }
  RpcServer& server() { return *server_; }
  v1::GaitService::Stub& stub() { return *stub_; }
  std::shared_ptr<grpc::Channel> channel() { return channel_; }

 private:
  // Flow-control windows of fixed size (64 kB): probing would let them grow by as much as the machine happens to read.
  static std::shared_ptr<grpc::Channel> Connect(const std::string& address) {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
    return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
  }

  ServiceBench bench_;
  Gatekeeper gatekeeper_;
  std::unique_ptr<RpcServer> server_;
  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<v1::GaitService::Stub> stub_;
};

// The first violation's field; empty if the status carries none.
inline std::string ViolatedField(const grpc::Status& status) {
  google::rpc::Status details;
  google::rpc::BadRequest bad_request;
  const bool parsed = details.ParseFromString(status.error_details()) && details.details_size() > 0 &&
                      details.details(0).UnpackTo(&bad_request) && bad_request.field_violations_size() > 0;
  return parsed ? bad_request.field_violations(0).field() : "";
}

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SERVER_RPC_RPC_BENCH_H_
