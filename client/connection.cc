#include "client/connection.h"

#include <arpa/inet.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/client_interceptor.h>

#include <charconv>
#include <chrono>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "client/failure.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

void RequireAddress(const std::string& server) {
  if (server.rfind("unix:", 0) == 0 && server.size() > 5) return;
  const size_t colon = server.rfind(':');
  int port = 0;
  if (colon != std::string::npos && colon > 0) {
    const char* end = server.data() + server.size();
    const auto parsed = std::from_chars(server.data() + colon + 1, end, port);
    if (parsed.ec == std::errc() && parsed.ptr == end && port >= 1 && port <= 65535) return;
  }
  throw Failure(ExitCode::kUsage,
                "--server " + server + ": must be HOST:PORT with a port in [1, 65535], for example 127.0.0.1:50051");
}

// Loopback and unix sockets: nobody else can listen there. Of names localhost alone, for 127.example.org is anybody's.
bool IsLocal(const std::string& server) {
  const std::string host = server.substr(0, server.rfind(':'));
  in_addr v4{};
  const bool loopback_v4 = inet_pton(AF_INET, host.c_str(), &v4) == 1 && (ntohl(v4.s_addr) >> 24) == 127;
  return server.rfind("unix:", 0) == 0 || host == "localhost" || host == "[::1]" || loopback_v4;
}

std::string ReadFile(const char* flag, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file.is_open() || text.empty()) {
    throw Failure(ExitCode::kUsage,
                  std::string(flag) + " " + path + ": " +
                      (file.is_open() ? "is empty" : "cannot be read; does it exist, and may you read it?"));
  }
  return text;
}

std::string ReadToken(const GlobalOptions& options) {
  std::string token = options.token_file.empty() ? options.token : ReadFile("--token-file", options.token_file);
  token = token.substr(0, token.find_first_of("\r\n"));
  if (token.find_first_not_of("abcdefghijklmnopqrstuvwxyz234567_") != std::string::npos) {
    throw Failure(ExitCode::kUsage,
                  (options.token_file.empty() ? "ROLLGAIT_TOKEN" : "--token-file " + options.token_file) +
                      ": is not a token; a token begins with rgt_ and has small letters and digits only");
  }
  return token;
}

// Puts the token into every call of a channel, whoever makes it.
class TokenInterceptor final : public grpc::experimental::Interceptor {
 public:
  explicit TokenInterceptor(const std::string& header) : header_(header) {}
  void Intercept(grpc::experimental::InterceptorBatchMethods* methods) override {
    if (methods->QueryInterceptionHookPoint(grpc::experimental::InterceptionHookPoints::PRE_SEND_INITIAL_METADATA)) {
      methods->GetSendInitialMetadata()->insert({"authorization", header_});
    }
    methods->Proceed();
  }

 private:
  const std::string& header_;
};

class TokenInterceptorFactory final : public grpc::experimental::ClientInterceptorFactoryInterface {
 public:
  explicit TokenInterceptorFactory(const std::string& token) : header_("Bearer " + token) {}
  grpc::experimental::Interceptor* CreateClientInterceptor(grpc::experimental::ClientRpcInfo*) override {
    return new TokenInterceptor(header_);
  }

 private:
  const std::string header_;
};

std::shared_ptr<grpc::ChannelCredentials> Credentials(const GlobalOptions& options) {
  const bool asked = !options.tls_ca.empty() || !options.tls_cert.empty();
  if (asked && options.insecure)
    throw Failure(ExitCode::kUsage, "--insecure excludes --tls-ca, --tls-cert and --tls-key");
  if (!asked && (options.insecure || IsLocal(options.server))) return grpc::InsecureChannelCredentials();
  if (options.tls_cert.empty() != options.tls_key.empty()) {
    throw Failure(ExitCode::kUsage, "--tls-cert and --tls-key belong together: give both or none");
  }
  grpc::SslCredentialsOptions tls;
  if (!options.tls_ca.empty()) tls.pem_root_certs = ReadFile("--tls-ca", options.tls_ca);
  if (!options.tls_cert.empty()) {
    tls.pem_cert_chain = ReadFile("--tls-cert", options.tls_cert);
    tls.pem_private_key = ReadFile("--tls-key", options.tls_key);
  }
  return grpc::SslCredentials(tls);
}

}  // namespace

Connection::Connection(const GlobalOptions& options) : options_(options) {
  RequireAddress(options.server);
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 30000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 10000);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 5000);  // what one attempt may take, TLS included
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 2000);
  // A server that was started again may have another address behind its name.
  arguments.SetInt(GRPC_ARG_DNS_MIN_TIME_BETWEEN_RESOLUTIONS_MS, 1000);
  arguments.SetUserAgentPrefix("rollgait/" ROLLGAIT_VERSION);
  const std::string token = ReadToken(options);
  if (!token.empty() && options.insecure && !IsLocal(options.server)) {
    throw Failure(ExitCode::kUsage,
                  "--insecure would send the token readable over the network: use TLS, or go without a token");
  }
  std::vector<std::unique_ptr<grpc::experimental::ClientInterceptorFactoryInterface>> interceptors;
  if (!token.empty()) interceptors.push_back(std::make_unique<TokenInterceptorFactory>(token));
  channel_ = grpc::experimental::CreateCustomChannelWithInterceptors(options.server, Credentials(options), arguments,
                                                                     std::move(interceptors));
  stub_ = v1::GaitService::NewStub(channel_);
}

void Connection::SetDeadline(grpc::ClientContext& context) const {
  context.set_deadline(std::chrono::system_clock::now() +
                       std::chrono::milliseconds(static_cast<int64_t>(options_.timeout_s * 1e3)));
}

v1::Solve Connection::GetSolve(const std::string& name) {
  grpc::ClientContext context;
  SetDeadline(context);
  v1::GetSolveRequest request;
  request.set_name(SolveName(name));
  v1::Solve solve;
  RequireOk(stub_->GetSolve(&context, request, &solve), "get " + request.name(), server());
  return solve;
}

}  // namespace rollgait::client
