#include "server/rpc/rpc_server.h"

#include <absl/synchronization/mutex.h>
#include <arpa/inet.h>
#include <grpcpp/health_check_service_interface.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "server/rpc/answer_metrics.h"
#include "server/rpc/call_observer.h"
#include "server/rpc/tls_credentials.h"
#include "server/service/request_check.h"

namespace rollgait::server {
namespace {

// For answers on their way to clients.
constexpr std::chrono::milliseconds kFlushTime{300};

// What messages that have not come to their end may occupy: nobody has been asked for a token by then. Above it gRPC
// ends connections that are idle and calls that wait. 64 requests of the largest size.
constexpr size_t kMostReadAhead = size_t{256} << 20;

void SetLimits(grpc::ServerBuilder& builder) {
  builder.SetResourceQuota(grpc::ResourceQuota("rollgaitd").Resize(kMostReadAhead));
  // The transport takes four times what is looked at, so that a request over the limit is refused with a reason of
  // ours.
  builder.SetMaxReceiveMessageSize(static_cast<int>(4 * kMaxRequestBytes));
  // 8 KB unfold into 8 MB before anybody is asked for a token; who compresses is refused, UNIMPLEMENTED.
  builder.SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_GZIP, false);
  builder.SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_DEFLATE, false);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 20'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 10'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 5'000);
  // Who connects and says nothing is let go soon; a connection without calls after five minutes. After an hour new
  // calls go over a new connection, with the certificates of then; streams on the old one go on as long as they last.
  builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, 8'000);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_IDLE_MS, 300'000);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_AGE_MS, 3'600'000);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, 4096);
  // A second server on the same port would share its connections: refuse to start instead.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
}

}  // namespace

RpcServer::RpcServer(const RpcOptions& options, SolveService& service, WatchHub& hub, Gatekeeper& gatekeeper)
    : hub_(hub),
      gatekeeper_(gatekeeper),
      executor_(options.executor_threads, options.max_waiting_calls),
      simulations_(options.simulation),
      rpc_(service, hub, gatekeeper, executor_, simulations_, options.slow_write,
           {options.certificate_tenant, options.behind_door}),
      credentials_(grpc::InsecureServerCredentials()) {}

RpcServer::~RpcServer() { Stop(std::chrono::milliseconds(0)); }

Outcome<std::unique_ptr<RpcServer>> RpcServer::Start(const RpcOptions& options, SolveService& service, WatchHub& hub,
                                                     Gatekeeper& gatekeeper) {
  // Debian's Abseil is built to look for a deadlock at every lock taken while another is held, gRPC's own included.
  absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore);
  std::unique_ptr<RpcServer> server(new RpcServer(options, service, hub, gatekeeper));
  const Outcome<Done> open = server->Open(options);
  if (!open.ok()) return open.error();
  return server;
}

Outcome<Done> RpcServer::Open(const RpcOptions& options) {
  if (!options.tls.cert.empty()) {
    Outcome<std::shared_ptr<grpc::ServerCredentials>> tls = MakeTlsCredentials(options.tls);
    if (!tls.ok()) return tls.error();
    credentials_ = std::move(tls).value();
  }
  grpc::ServerBuilder builder;
  SetLimits(builder);
  SetDiscovery(builder, {options.discovery, options.discovery, false});
  if (options.metrics != nullptr) {
    std::vector<std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface>> observers;
    observers.push_back(std::make_unique<CallObserver>(*options.metrics, options.behind_door));
    builder.experimental().SetInterceptorCreators(std::move(observers));
    options.metrics->Collect(std::make_shared<AnswerMetrics>(gatekeeper_.answers()));
  }
  builder.RegisterService(&rpc_);
  std::unique_ptr<grpc::experimental::ExternalConnectionAcceptor> hand_over;
  int port = 0;
  const bool is_unix = options.listen.rfind("unix:", 0) == 0;
  if (is_unix) {
    builder.AddListeningPort(options.listen, credentials_, &port);
  } else {
    Outcome<std::unique_ptr<ConnectionAcceptor>> acceptor =
        ConnectionAcceptor::Listen(options.listen, options.connections);
    if (!acceptor.ok()) return acceptor.error();
    acceptor_ = std::move(acceptor).value();
    port = acceptor_->port();
    hand_over = builder.experimental().AddExternalConnectionAcceptor(
        grpc::ServerBuilder::experimental_type::ExternalConnectionType::FROM_FD, credentials_);
  }
  // Who may open the door's socket must be of its group; nobody may connect before the mode is set.
  const mode_t before = umask(is_unix ? 0177 : 0077);
  server_ = builder.BuildAndStart();
  umask(before);
  if (server_ == nullptr || port == 0) {
    return Error{ErrorCode::kUnavailable,
                 "cannot listen on " + options.listen + ": gRPC refuses; is the path writable?"};
  }
  const char* const socket_path = options.listen.c_str() + sizeof("unix:") - 1;
  if (options.behind_door && (!is_unix || chmod(socket_path, 0660) != 0)) {
    return Error{ErrorCode::kUnavailable,
                 "the door's socket " + options.listen + " cannot be given to its group: " + std::strerror(errno)};
  }
  if (options.discovery) server_->GetHealthCheckService()->SetServingStatus(v1::GaitService::service_full_name(), true);
  address_ =
      is_unix ? options.listen : options.listen.substr(0, options.listen.rfind(':')) + ":" + std::to_string(port);
  if (!options.admin_directory.empty()) {
    Outcome<std::unique_ptr<AdminServer>> admin = AdminServer::Start(options.admin_directory);
    if (!admin.ok()) return admin.error();
    admin_ = std::move(admin).value();
  }
  if (acceptor_ != nullptr) acceptor_->Start(std::move(hand_over));
  return Done{};
}

void RpcServer::Stop(std::chrono::milliseconds grace) {
  if (server_ == nullptr) return;
  gatekeeper_.Drain();
  if (auto* health = server_->GetHealthCheckService()) health->SetServingStatus(false);
  if (admin_ != nullptr) admin_->SetServing(false);
  hub_.Stop();
  simulations_.Stop();
  // Every call is answered by a task. What is left then are answers on their way and clients that do not read theirs;
  // gRPC would also wait for idle connections whose clients do not notice that they are to be closed.
  // Shutdown would end streams with CANCELLED whose last words are still to be written, so they are waited for.
  const auto deadline = std::chrono::steady_clock::now() + grace;
  const auto left = [&] {
    const auto time =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    return std::max(time, std::chrono::milliseconds(0));
  };
  const bool idle = executor_.WaitIdle(left()) && gatekeeper_.WaitUntilLeft(left());
  if (!idle) spdlog::warn("calls that were not answered within {} ms are cancelled", grace.count());
  if (acceptor_ != nullptr) acceptor_->Stop();
  server_->Shutdown(std::chrono::system_clock::now() + std::min(grace, kFlushTime));
  executor_.Stop();
  server_.reset();
  admin_.reset();
}

}  // namespace rollgait::server
