#include "tests/e2e/guarded_server.h"

#include <grpcpp/generic/generic_stub.h>

#include "tests/support/certificates.h"

namespace rollgait::server {
void GuardedServer::SetUp() {
  const Identity authority = MakeAuthority("authority"), stranger = MakeAuthority("authority");
  const Identity server = MakeCertificate(authority, "localhost"), client = MakeCertificate(authority, "client");
  const Identity foreign = MakeCertificate(stranger, "client");
  const Identity expired = MakeCertificate(authority, "client", -7200, -3600);
  WriteFileAtOnce(path("ca.pem"), authority.cert);
  WriteFileAtOnce(path("server.pem"), server.cert);
  WriteFileAtOnce(path("server.key"), server.key);
  Daemon::Options options;
  options.data_dir = path("data");
  options.solver = SLOW_SOLVER;
  options.flags = {"--tls-cert",   path("server.pem"), "--tls-key",   path("server.key"), "--tls-client-ca",
                   path("ca.pem"), "--metrics-listen", "127.0.0.1:0", "--require-token"};
  options.log_file = path("log");
  daemon_ = std::make_unique<Daemon>(options);
  ASSERT_NE(daemon_->address(), "");
  const std::string good = Token("acme", "read,solve,admin"), revoked = Token("acme", "read,solve");
  OutputOfRollgaitd("token revoke --data-dir " + path("data") + " " + revoked.substr(4, 16));
  const auto shows = [&](const Identity& identity) {
    return grpc::SslCredentialsOptions{authority.cert, identity.key, identity.cert};
  };
  good_ = {"good token", shows(client), good};
  other_ = {"other tenant", shows(client), Token("rival", "read,solve")};
  reader_ = {"scope", shows(client), Token("acme", "read")};
  solver_ = {"scope", shows(client), Token("acme", "solve")};
  strangers_ = {{"no certificate", {authority.cert, "", ""}, good},
                {"wrong CA", shows(foreign), good},
                {"expired certificate", shows(expired), good}};
  unknown_ = {{"no token", shows(client), ""},
              {"garbage", shows(client), "rgt_nonsense"},
              {"revoked", shows(client), revoked},
              {"expired token", shows(client), Token("acme", "read,solve", "1s")}};
}

std::string GuardedServer::Token(const std::string& tenant, const std::string& scopes, const std::string& expires) {
  return OutputOfRollgaitd("token create --data-dir " + path("data") + " --tenant " + tenant + " --scopes " + scopes +
                           " --expires " + expires);
}

grpc::StatusCode GuardedServer::Call(const Visitor& visitor, const std::string& method, const std::string& bytes) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  auto& channel = channels_[visitor.name + visitor.token];
  if (channel == nullptr)
    channel = grpc::CreateCustomChannel(daemon_->address(), grpc::SslCredentials(visitor.tls), arguments);
  return Call(channel, visitor.token, method, bytes);
}

grpc::StatusCode GuardedServer::Call(const std::shared_ptr<grpc::Channel>& channel, const std::string& token,
                                     const std::string& method, const std::string& bytes) {
  grpc::GenericStub stub(channel);
  grpc::ClientContext context;
  if (!token.empty()) context.AddMetadata("authorization", "Bearer " + token);
  grpc::CompletionQueue queue;
  const auto call = stub.PrepareCall(&context, method, &queue);
  const auto wait = [&] {
    void* tag = nullptr;
    bool ok = false;
    return queue.Next(&tag, &ok) && ok;
  };
  call->StartCall(nullptr);
  grpc::Status status;
  if (wait()) {
    grpc::Slice slice(bytes);
    call->WriteLast(grpc::ByteBuffer(&slice, 1), grpc::WriteOptions(), nullptr);
    wait();
    grpc::ByteBuffer answer;
    call->Read(&answer, nullptr);
    if (wait()) {  // the first answer says enough
      context.TryCancel();
      call->Finish(&status, nullptr);
      wait();
      return grpc::StatusCode::OK;
    }
  }
  call->Finish(&status, nullptr);
  wait();
  return status.error_code();
}

std::unique_ptr<v1::GaitService::Stub> GuardedServer::GoodStub() const {
  return v1::GaitService::NewStub(grpc::CreateChannel(daemon_->address(), grpc::SslCredentials(good_.tls)));
}

std::unique_ptr<grpc::ClientContext> GuardedServer::GoodContext() const {
  auto context = std::make_unique<grpc::ClientContext>();
  context->AddMetadata("authorization", "Bearer " + good_.token);
  return context;
}

std::string GuardedServer::EndedSolve() {
  v1::RunSolveRequest request;
  request.mutable_spec()->mutable_model()->set_name("planar");
  request.mutable_spec()->mutable_solver_limits()->set_max_iterations(3);
  const auto context = GoodContext();
  const auto stub = GoodStub();
  const auto stream = stub->RunSolve(context.get(), request);
  v1::SolveEvent event;
  while (stream->Read(&event)) {
  }
  const grpc::Status status = stream->Finish();
  EXPECT_TRUE(status.ok()) << status.error_message();
  return event.name();
}

}  // namespace rollgait::server
