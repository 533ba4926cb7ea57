#include "server/rpc/door.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "server/rpc/rpc_server.h"
#include "tests/server/service/service_fixture.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

// CN=lab, DER in base64, with the URI urn:lab; made by openssl, valid for ever: the door verifies, not we.
constexpr char kCertificate[] =
    "MIIBkjCCATigAwIBAgIUPNpvCpRgsmj+ed2p0ZmpZk0Fa04wCgYIKoZIzj0EAwIwDjEMMAoGA1UEAwwDbGFiMCAXDTI2MTEyNDE2"
    "MjYwNVoYDzIxMjYxMDMxMTYyNjA1WjAOMQwwCgYDVQQDDANsYWIwWTATBgcqhkjOPQIBBggqhkjOPQMBBwNCAAQvXQ833wZO9g9X"
    "UODvxNXyUxB6emp+vtT9mQIPmb/hFT+RvaqjrGLmmYU/lCz7VMNn8nu9mhFjxOZAroP2DB8Xo3IwcDAdBgNVHQ4EFgQUm6YQctB0"
    "Lg4U13nFpy4Lk2UcmC4wHwYDVR0jBBgwFoAUm6YQctB0Lg4U13nFpy4Lk2UcmC4wDwYDVR0TAQH/BAUwAwEB/zAdBgNVHREEFjAU"
    "hgd1cm46bGFigglsb2NhbGhvc3QwCgYIKoZIzj0EAwIDSAAwRQIhANcOzt99ZiL4pROOWAvFcFN+/a6yafqLonRbNiwPnuMpAiAu"
    "TrPCe8QvQ/5RNWv0RbVaQekTpJpfd9zmpWTJhjOcmw==";

CallMetadata With(const char* name, std::initializer_list<const char*> values) {
  CallMetadata metadata;
  for (const char* value : values) metadata.emplace(name, value);
  return metadata;
}

TEST(DoorTest, ThePeerIsStatedExactlyOnce) {
  EXPECT_EQ(PeerBehindDoor(With(kDoorPeer, {"ipv4:192.0.2.1:4711"})).value(), "ipv4:192.0.2.1:4711");
  const std::string long_text(200, 'x');
  for (const CallMetadata& bad : {CallMetadata(), With(kDoorPeer, {""}), With(kDoorPeer, {"a", "b"}),
                                  With(kDoorPeer, {"two words"}), With(kDoorPeer, {long_text.c_str()})}) {
    const Outcome<std::string> peer = PeerBehindDoor(bad);
    ASSERT_FALSE(peer.ok());
    EXPECT_EQ(peer.error().code, ErrorCode::kFailedPrecondition);
    EXPECT_NE(peer.error().message.find("docs/explanation/door.md"), std::string::npos);
  }
}

TEST(DoorTest, TheNameIsReadFromTheCertificate) {
  const CallMetadata shown = With(kDoorCertificate, {kCertificate});
  EXPECT_EQ(CertificateNameBehindDoor(shown, CertificateTenant::kCommonName).value(), "lab");
  EXPECT_EQ(CertificateNameBehindDoor(shown, CertificateTenant::kUri).value(), "urn:lab");
  EXPECT_EQ(CertificateNameBehindDoor({}, CertificateTenant::kCommonName).value(), "");
}

TEST(DoorTest, WhatIsNoCertificateIsRefused) {
  const std::string cut = std::string(kCertificate).substr(0, 100);
  for (const CallMetadata& bad :
       {With(kDoorCertificate, {kCertificate, kCertificate}), With(kDoorCertificate, {"AAAA"}),
        With(kDoorCertificate, {"!"}), With(kDoorCertificate, {"===="}), With(kDoorCertificate, {cut.c_str()})}) {
    EXPECT_FALSE(CertificateNameBehindDoor(bad, CertificateTenant::kCommonName).ok());
  }
}

// The door's socket: for its group, and no call without the door's word.
TEST(DoorTest, TheSocketIsForTheDoorAlone) {
  const TemporaryDirectory directory;
  ServiceBench bench;
  Gatekeeper gatekeeper({});
  RpcOptions options;
  options.listen = "unix:" + directory.path() + "/door.sock";
  options.behind_door = true;
  const auto server = RpcServer::Start(options, bench.service(), bench.hub(), gatekeeper);
  ASSERT_TRUE(server.ok()) << server.error().message;
  struct stat is {};
  ASSERT_EQ(stat((directory.path() + "/door.sock").c_str(), &is), 0);
  EXPECT_EQ(is.st_mode & 0777, 0660u);
  const auto stub = v1::GaitService::NewStub(grpc::CreateChannel(options.listen, grpc::InsecureChannelCredentials()));
  for (const bool told : {false, true}) {
    grpc::ClientContext context;
    if (told) context.AddMetadata(kDoorPeer, "ipv4:192.0.2.1:4711");
    v1::ServerInfo info;
    const grpc::Status status = stub->GetServerInfo(&context, {}, &info);
    EXPECT_EQ(status.error_code(), told ? grpc::StatusCode::OK : grpc::StatusCode::FAILED_PRECONDITION)
        << status.error_message();
  }
}

}  // namespace
}  // namespace rollgait::server
