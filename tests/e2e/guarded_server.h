#ifndef ROLLGAIT_TESTS_E2E_GUARDED_SERVER_H_
#define ROLLGAIT_TESTS_E2E_GUARDED_SERVER_H_

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/e2e/daemon.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {

// A caller: how he connects and what he shows.
struct Visitor {
  std::string name;
  grpc::SslCredentialsOptions tls;
  std::string token;
};

// A server that asks for certificates and tokens and shows its metrics, and those who call it. Its solver is
// rollgait_slow_solver.
class GuardedServer : public testing::Test {
 protected:
  void SetUp() override;

  std::string path(const std::string& name) const { return directory_.path() + "/" + name; }
  // A new one, made by `rollgaitd token create`.
  std::string Token(const std::string& tenant, const std::string& scopes, const std::string& expires = "1d");
  // Sends one message and returns how the call ended; one that is answered is left after its first answer.
  grpc::StatusCode Call(const Visitor& visitor, const std::string& method, const std::string& bytes);
  static grpc::StatusCode Call(const std::shared_ptr<grpc::Channel>& channel, const std::string& token,
                               const std::string& method, const std::string& bytes);
  // The good caller's stub, on a connection of its own, and what each of his calls carries.
  std::unique_ptr<v1::GaitService::Stub> GoodStub() const;
  std::unique_ptr<grpc::ClientContext> GoodContext() const;
  // A new solve of the good caller's that has ended.
  std::string EndedSolve();

  TemporaryDirectory directory_;
  std::unique_ptr<Daemon> daemon_;
  Visitor good_, other_;            // of two tenants
  Visitor reader_, solver_;         // of the good one's tenant, with one scope each
  std::vector<Visitor> strangers_;  // whom TLS refuses
  std::vector<Visitor> unknown_;    // whom the server does not know by their tokens
  std::map<std::string, std::shared_ptr<grpc::Channel>> channels_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_E2E_GUARDED_SERVER_H_
