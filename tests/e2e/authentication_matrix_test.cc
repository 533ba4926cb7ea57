// Every method of every service of a server that asks for certificates and tokens, called by everyone who may not, and
// by one who may. Prints the matrix that docs/security.md shows.
#include <google/protobuf/descriptor.h>
#include <google/protobuf/dynamic_message.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/access/methods.h"
#include "tests/e2e/daemon.h"
#include "tests/server/store/temporary_directory.h"
#include "tests/support/certificates.h"

namespace rollgait::server {
namespace {

using google::protobuf::MethodDescriptor;
using grpc::StatusCode;

// The standard output of a command of rollgaitd, without its last line feed.
std::string Output(const std::string& arguments) {
  FILE* const pipe = popen((std::string(ROLLGAITD) + " " + arguments + " 2>/dev/null").c_str(), "r");
  std::string text;
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe)) text += static_cast<char>(letter);
  EXPECT_EQ(pclose(pipe), 0) << arguments;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

// A caller: how he connects and what he shows.
struct Visitor {
  std::string name;
  grpc::SslCredentialsOptions tls;
  std::string token;
};

class MatrixTest : public testing::Test {
 protected:
  void SetUp() override {
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
    options.flags = {"--tls-cert",      path("server.pem"), "--tls-key",      path("server.key"),
                     "--tls-client-ca", path("ca.pem"),     "--require-token"};
    daemon_ = std::make_unique<Daemon>(options);
    ASSERT_NE(daemon_->address(), "");
    const std::string good = Token("acme", "read,solve,admin"), revoked = Token("acme", "read,solve");
    Output("token revoke --data-dir " + path("data") + " " + revoked.substr(4, 16));
    const auto shows = [&](const Identity& identity) {
      return grpc::SslCredentialsOptions{authority.cert, identity.key, identity.cert};
    };
    good_ = {"good token", shows(client), good};
    other_ = {"other tenant", shows(client), Token("rival", "read,solve,admin")};
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

  std::string path(const std::string& name) const { return directory_.path() + "/" + name; }
  std::string Token(const std::string& tenant, const std::string& scopes, const std::string& expires = "1d") {
    return Output("token create --data-dir " + path("data") + " --tenant " + tenant + " --scopes " + scopes +
                  " --expires " + expires);
  }

  // Sends one message and returns how the call ended; one that lasts is left after two seconds, which counts as served.
  StatusCode Call(const Visitor& visitor, const std::string& method, const std::string& bytes) {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    auto& channel = channels_[visitor.name + visitor.token];
    if (channel == nullptr)
      channel = grpc::CreateCustomChannel(daemon_->address(), grpc::SslCredentials(visitor.tls), arguments);
    grpc::GenericStub stub(channel);
    grpc::ClientContext context;
    if (!visitor.token.empty()) context.AddMetadata("authorization", "Bearer " + visitor.token);
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
        return StatusCode::OK;
      }
    }
    call->Finish(&status, nullptr);
    wait();
    return status.error_code();
  }

  // A request of the method's type; its field `name`, if it has one, names a solve.
  std::string Request(const MethodDescriptor& method, const std::string& name) {
    const auto* field = method.input_type()->FindFieldByName("name");
    std::unique_ptr<google::protobuf::Message> message(factory_.GetPrototype(method.input_type())->New());
    if (field != nullptr) message->GetReflection()->SetString(message.get(), field, name);
    const auto* model = method.input_type()->FindFieldByName("model");
    if (model != nullptr) {
      google::protobuf::Message* selection = message->GetReflection()->MutableMessage(message.get(), model, &factory_);
      selection->GetReflection()->SetString(selection, model->message_type()->FindFieldByName("name"), "planar");
    }
    return message->SerializeAsString();
  }

  TemporaryDirectory directory_;
  std::unique_ptr<Daemon> daemon_;
  Visitor good_, other_, reader_, solver_;
  std::vector<Visitor> strangers_, unknown_;
  std::map<std::string, std::shared_ptr<grpc::Channel>> channels_;
  google::protobuf::DynamicMessageFactory factory_;
};

void Print(const std::string& method, const std::vector<StatusCode>& codes) {
  static const std::map<StatusCode, const char*> names = {{StatusCode::OK, "ok"},
                                                          {StatusCode::INVALID_ARGUMENT, "bad request"},
                                                          {StatusCode::NOT_FOUND, "NOT_FOUND"},
                                                          {StatusCode::FAILED_PRECONDITION, "precondition"},
                                                          {StatusCode::PERMISSION_DENIED, "DENIED"},
                                                          {StatusCode::UNAUTHENTICATED, "UNAUTHENT."},
                                                          {StatusCode::UNIMPLEMENTED, "not offered"},
                                                          {StatusCode::UNAVAILABLE, "no connection"}};
  std::printf("| %-20s |", method.c_str());
  for (const StatusCode code : codes) {
    const auto name = names.find(code);
    std::printf(" %-13s |", name == names.end() ? std::to_string(code).c_str() : name->second);
  }
  std::printf("\n");
}

TEST_F(MatrixTest, EveryMethodRefusesWhoMayNotCall) {
  const auto* file =
      google::protobuf::DescriptorPool::generated_pool()->FindFileByName("rollgait/v1/gait_service.proto");
  ASSERT_NE(file, nullptr);
  const auto* create = file->FindServiceByName("GaitService")->FindMethodByName("CreateSolve");
  v1::CreateSolveRequest request;
  request.mutable_spec()->mutable_model()->set_name("planar");
  request.mutable_spec()->mutable_solver_limits()->set_max_iterations(3);
  const auto stub_channel = [&](const Visitor& visitor) {
    return v1::GaitService::NewStub(grpc::CreateChannel(daemon_->address(), grpc::SslCredentials(visitor.tls)));
  };
  grpc::ClientContext context;
  context.AddMetadata("authorization", "Bearer " + good_.token);
  v1::Solve solve;
  const grpc::Status made = stub_channel(good_)->CreateSolve(&context, request, &solve);
  ASSERT_TRUE(made.ok()) << made.error_message();
  ASSERT_NE(create, nullptr);
  // The token that expires has done so: it was valid for a second.
  const std::string ask = "/rollgait.v1.GaitService/GetServerInfo";
  for (int i = 0; i < 600 && Call(unknown_.back(), ask, "") == StatusCode::OK; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }

  std::printf("| %-20s |", "method");
  for (const auto* group : {&strangers_, &unknown_}) {
    for (const Visitor& visitor : *group) std::printf(" %-13.13s |", visitor.name.c_str());
  }
  std::printf(" %-13s | %-13s | %-13s |\n", "other scope", "other tenant", "good");
  int methods = 0;
  for (int i = 0; i < file->service_count(); ++i) {
    for (int j = 0; j < file->service(i)->method_count(); ++j, ++methods) {
      const MethodDescriptor& method = *file->service(i)->method(j);
      SCOPED_TRACE(std::string(method.full_name()));
      const std::string path = "/" + std::string(method.service()->full_name()) + "/" + std::string(method.name());
      const std::string bytes = Request(method, solve.name());
      std::vector<StatusCode> row;
      for (const Visitor& visitor : strangers_) {
        row.push_back(Call(visitor, path, bytes));
        EXPECT_EQ(row.back(), StatusCode::UNAVAILABLE) << visitor.name;
      }
      for (const Visitor& visitor : unknown_) {
        row.push_back(Call(visitor, path, bytes));
        EXPECT_EQ(row.back(), StatusCode::UNAUTHENTICATED) << visitor.name;
      }
      const MethodRule* rule = nullptr;
      for (const MethodRule& known : kMethodRules) {
        if (std::string(method.name()) == known.name) rule = &known;
      }
      ASSERT_NE(rule, nullptr) << "the method has no row in kMethodRules";
      row.push_back(Call(rule->scope == kScopeRead ? solver_ : reader_, path, bytes));
      EXPECT_EQ(row.back(), StatusCode::PERMISSION_DENIED);
      row.push_back(Call(other_, path, bytes));
      const bool names_a_solve = method.input_type()->FindFieldByName("name") != nullptr;
      EXPECT_EQ(row.back() == StatusCode::NOT_FOUND, names_a_solve);
      // What is right is answered, or refused for what it asks; DeleteSolve is last of all in meaning: the solve may
      // still run.
      row.push_back(method.name() == "DeleteSolve" ? StatusCode::OK : Call(good_, path, bytes));
      for (const StatusCode refused : {StatusCode::UNAUTHENTICATED, StatusCode::PERMISSION_DENIED,
                                       StatusCode::UNAVAILABLE, StatusCode::UNIMPLEMENTED, StatusCode::INTERNAL}) {
        EXPECT_NE(row.back(), refused);
      }
      EXPECT_NE(row.back(), names_a_solve ? StatusCode::NOT_FOUND : StatusCode::UNKNOWN);
      Print(std::string(method.name()), row);
    }
  }
  EXPECT_GE(methods, 12);
}

TEST_F(MatrixTest, ServicesThatAskForNoTokenAreNotOnThePublicPort) {
  for (const char* method : {"/grpc.health.v1.Health/Check", "/grpc.health.v1.Health/Watch",
                             "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo",
                             "/grpc.channelz.v1.Channelz/GetServers", "/grpc.channelz.v1.Channelz/GetTopChannels"}) {
    EXPECT_EQ(Call(good_, method, ""), StatusCode::UNIMPLEMENTED) << method;
  }
  // They are on the administration socket, which only its owner opens.
  grpc::GenericStub admin(
      grpc::CreateChannel("unix:" + path("data") + "/admin.sock", grpc::InsecureChannelCredentials()));
  grpc::ClientContext context;
  grpc::CompletionQueue queue;
  grpc::Slice nothing;
  const grpc::ByteBuffer request(&nothing, 1);
  auto call = admin.PrepareUnaryCall(&context, "/grpc.health.v1.Health/Check", request, &queue);
  call->StartCall();
  grpc::ByteBuffer answer;
  grpc::Status status;
  call->Finish(&answer, &status, nullptr);
  void* tag = nullptr;
  bool ok = false;
  ASSERT_TRUE(queue.Next(&tag, &ok));
  EXPECT_TRUE(status.ok()) << status.error_message();
}

}  // namespace
}  // namespace rollgait::server
