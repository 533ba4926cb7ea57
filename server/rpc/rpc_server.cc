#include "server/rpc/rpc_server.h"

#include <arpa/inet.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/health_check_service_interface.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "server/rpc/call_observer.h"
#include "server/service/request_check.h"

namespace rollgait::server {
namespace {

// For answers on their way to clients.
constexpr std::chrono::milliseconds kFlushTime{300};

// HOST of "HOST:PORT", without the brackets of an IPv6 address.
std::string HostOf(const std::string& listen) {
  const size_t colon = listen.rfind(':');
  std::string host = colon == std::string::npos ? listen : listen.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  return host;
}

void SetLimits(grpc::ServerBuilder& builder) {
  // The transport takes four times what is looked at, so that a request over the limit is refused with a reason of
  // ours.
  builder.SetMaxReceiveMessageSize(static_cast<int>(4 * kMaxRequestBytes));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 20'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 10'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 5'000);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, 4096);
  // A second server on the same port would share its connections: refuse to start instead.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
}

}  // namespace

RpcServer::RpcServer(const RpcOptions& options, SolveService& service, WatchHub& hub)
    : hub_(hub),
      executor_(options.executor_threads, options.max_waiting_calls),
      simulations_(options.simulation),
      rpc_(service, hub, executor_, simulations_, options.slow_write) {}

RpcServer::~RpcServer() { Stop(std::chrono::milliseconds(0)); }

Outcome<std::unique_ptr<RpcServer>> RpcServer::Start(const RpcOptions& options, SolveService& service, WatchHub& hub) {
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  std::unique_ptr<RpcServer> server(new RpcServer(options, service, hub));
  grpc::ServerBuilder builder;
  SetLimits(builder);
  if (options.metrics != nullptr) {
    std::vector<std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface>> observers;
    observers.push_back(std::make_unique<CallObserver>(*options.metrics));
    builder.experimental().SetInterceptorCreators(std::move(observers));
  }
  int port = 0;
  builder.AddListeningPort(options.listen, grpc::InsecureServerCredentials(), &port);
  builder.RegisterService(&server->rpc_);
  server->server_ = builder.BuildAndStart();
  if (server->server_ == nullptr || port == 0) {
    return Error{ErrorCode::kUnavailable, "cannot listen on " + options.listen +
                                              ": the address is in use, not of this machine, or not HOST:PORT"};
  }
  server->server_->GetHealthCheckService()->SetServingStatus(v1::GaitService::service_full_name(), true);
  server->address_ = options.listen.substr(0, options.listen.rfind(':')) + ":" + std::to_string(port);
  return server;
}

void RpcServer::Stop(std::chrono::milliseconds grace) {
  if (server_ == nullptr) return;
  server_->GetHealthCheckService()->SetServingStatus(false);
  hub_.Stop();
  simulations_.Stop();
  // Every call is answered by a task. What is left then are answers on their way and clients that do not read theirs;
  // gRPC would also wait for idle connections whose clients do not notice that they are to be closed.
  const bool idle = executor_.WaitIdle(grace);
  if (!idle) spdlog::warn("calls that were not answered within {} ms are cancelled", grace.count());
  server_->Shutdown(std::chrono::system_clock::now() + std::min(grace, kFlushTime));
  executor_.Stop();
  server_.reset();
}

bool IsLoopback(const std::string& listen) {
  if (listen.rfind("unix:", 0) == 0) return true;
  const std::string host = HostOf(listen);
  in_addr v4{};
  if (inet_pton(AF_INET, host.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24) == 127;
  return host == "::1" || host == "localhost";
}

}  // namespace rollgait::server
