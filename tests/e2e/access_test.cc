// Certificates that change, tokens that are taken away and floods of connections, against the real rollgaitd.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/e2e/daemon.h"
#include "tests/server/store/temporary_directory.h"
#include "tests/support/certificates.h"

namespace rollgait::server {
namespace {

using Stub = v1::GaitService::Stub;

bool Eventually(const std::function<bool()>& condition) {
  for (int i = 0; i < 1200; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

class AccessTest : public testing::Test {
 protected:
  AccessTest() : authority_(MakeAuthority("authority")) { Install(MakeCertificate(authority_, "localhost")); }

  std::string path(const std::string& name) const { return directory_.path() + "/" + name; }
  void Install(const Identity& identity) {
    WriteFileAtOnce(path("server.key"), identity.key);
    WriteFileAtOnce(path("server.pem"), identity.cert);
  }
  Daemon::Options Options(std::vector<std::string> flags, bool tls = true) const {
    if (tls) flags.insert(flags.end(), {"--tls-cert", path("server.pem"), "--tls-key", path("server.key")});
    Daemon::Options options;
    options.data_dir = path("data");
    options.solver = SLOW_SOLVER;
    options.flags = std::move(flags);
    return options;
  }
  // Over a connection of its own.
  static std::unique_ptr<Stub> Connect(const std::string& address, const std::string& ca) {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    return v1::GaitService::NewStub(grpc::CreateCustomChannel(
        address, ca.empty() ? grpc::InsecureChannelCredentials() : grpc::SslCredentials({ca, "", ""}), arguments));
  }
  static grpc::Status Ask(Stub& stub, const std::string& token = "", v1::ServerInfo* info = nullptr) {
    grpc::ClientContext context;
    if (!token.empty()) context.AddMetadata("authorization", "Bearer " + token);
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
    v1::ServerInfo answer;
    const grpc::Status status = stub.GetServerInfo(&context, {}, &answer);
    if (info != nullptr) *info = answer;
    return status;
  }

  TemporaryDirectory directory_;
  const Identity authority_;
};

v1::RunSolveRequest Endless() {
  v1::RunSolveRequest request;
  request.mutable_spec()->mutable_model()->set_name("planar");
  request.mutable_spec()->mutable_solver_limits()->set_max_iterations(100'000);
  request.set_cancel_on_disconnect(true);
  return request;
}

TEST_F(AccessTest, NewConnectionsSeeTheNewCertificateAndOldStreamsGoOn) {
  const Daemon daemon(Options({}));
  ASSERT_NE(daemon.address(), "");
  const auto old_stub = Connect(daemon.address(), authority_.cert);
  grpc::ClientContext context;
  const auto stream = old_stub->RunSolve(&context, Endless());
  v1::SolveEvent event;
  ASSERT_TRUE(stream->Read(&event));
  // Files that are no good are not taken.
  WriteFileAtOnce(path("server.key"), "nonsense");
  EXPECT_TRUE(Ask(*Connect(daemon.address(), authority_.cert)).ok());
  const Identity other = MakeAuthority("another authority");
  Install(MakeCertificate(other, "localhost"));
  EXPECT_TRUE(Ask(*Connect(daemon.address(), other.cert)).ok());
  EXPECT_EQ(Ask(*Connect(daemon.address(), authority_.cert)).error_code(), grpc::StatusCode::UNAVAILABLE);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(stream->Read(&event));
  EXPECT_TRUE(Ask(*old_stub).ok());
  context.TryCancel();
  stream->Finish();
}

TEST_F(AccessTest, BadTlsFilesAreRefusedAtTheStart) {
  WriteFileAtOnce(path("server.key"), MakeAuthority("another").key);
  Daemon mismatch(Options({}));
  EXPECT_EQ(mismatch.address(), "");
  EXPECT_EQ(mismatch.ExitCode(), 1);
  Install(MakeCertificate(authority_, "localhost", -7200, -3600));
  Daemon expired(Options({}));
  EXPECT_EQ(expired.address(), "");
  EXPECT_EQ(expired.ExitCode(), 1);
}

TEST_F(AccessTest, ARevokedTokenEndsItsStream) {
  const Daemon daemon(Options({"--require-token"}));
  ASSERT_NE(daemon.address(), "");
  const std::string token =
      OutputOfRollgaitd("token create --data-dir " + path("data") + " --tenant acme --scopes read,solve");
  const auto stub = Connect(daemon.address(), authority_.cert);
  v1::ServerInfo info;
  ASSERT_TRUE(Ask(*stub, token, &info).ok());
  EXPECT_EQ(info.caller().tenant(), "acme");
  EXPECT_EQ(info.caller().authentication(), v1::Caller::AUTHENTICATION_TOKEN);
  EXPECT_EQ(info.caller().limits().max_queued(), 500) << "half of the queue";
  grpc::ClientContext context;
  context.AddMetadata("authorization", "Bearer " + token);
  const auto stream = stub->RunSolve(&context, Endless());
  v1::SolveEvent event;
  ASSERT_TRUE(stream->Read(&event));
  OutputOfRollgaitd("token revoke --data-dir " + path("data") + " " + token.substr(4, 16));
  EXPECT_EQ(Ask(*stub, token).error_code(), grpc::StatusCode::UNAUTHENTICATED);
  while (stream->Read(&event)) {  // until the server ends it
  }
  const grpc::StatusCode end = stream->Finish().error_code();
  EXPECT_TRUE(end == grpc::StatusCode::UNAUTHENTICATED || end == grpc::StatusCode::CANCELLED) << end;
}

int OpenIdle(const std::string& address) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
  inet_pton(AF_INET, "127.0.0.1", &to.sin_addr);
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (fd >= 0 && connect(fd, reinterpret_cast<sockaddr*>(&to), sizeof(to)) != 0) {
    close(fd);
    return -1;
  }
  return fd;
}

// CVE-2023-4785: gRPC 1.51 by itself never accepts again after this.
TEST_F(AccessTest, AFloodOfConnectionsPasses) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
  for (const bool tls : {false, true}) {
    SCOPED_TRACE(tls ? "TLS" : "plain text");
    const Daemon daemon(Options({}, tls));
    ASSERT_NE(daemon.address(), "");
    const rlimit few{200, 200};
    ASSERT_EQ(prlimit(daemon.pid(), RLIMIT_NOFILE, &few, nullptr), 0);
    const std::string ca = tls ? authority_.cert : "";
    ASSERT_TRUE(Ask(*Connect(daemon.address(), ca)).ok());
    std::vector<int> flood;
    for (int i = 0; i < 600; ++i) flood.push_back(OpenIdle(daemon.address()));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));  // to let it run out; less only makes the test easier
    for (const int fd : flood) {
      if (fd >= 0) close(fd);
    }
    EXPECT_TRUE(Eventually([&] { return Ask(*Connect(daemon.address(), ca)).ok(); }));
  }
}

}  // namespace
}  // namespace rollgait::server
