// Every method of every service of a server that asks for certificates and tokens, called by everyone who may not, and
// by one who may. Prints the matrix that docs/explanation/security.md shows.
#include <google/protobuf/descriptor.h>
#include <google/protobuf/dynamic_message.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "server/access/methods.h"
#include "tests/e2e/guarded_server.h"
#include "tests/server/shipped_scene.h"

namespace rollgait::server {
namespace {

using google::protobuf::MethodDescriptor;
using grpc::StatusCode;

class MatrixTest : public GuardedServer {
 protected:
  // A request of the method's type that the server would serve; its field `name`, if it has one, names a solve or a
  // model.
  std::string Request(const MethodDescriptor& method, const std::string& name) {
    v1::SolveSpec spec;
    spec.mutable_model()->set_name("planar");
    spec.mutable_solver_limits()->set_max_iterations(3);
    const bool walks = method.name() == "FindPeriodicGait";
    const std::map<std::string, std::string> parts = {
        {"spec", spec.SerializeAsString()},
        {"model", spec.model().SerializeAsString()},
        {"scene", ReadShipped(walks ? "simplest_walker.json" : "ball_flat.json").SerializeAsString()}};
    std::unique_ptr<google::protobuf::Message> message(factory_.GetPrototype(method.input_type())->New());
    const google::protobuf::Reflection& reflection = *message->GetReflection();
    for (int i = 0; i < method.input_type()->field_count(); ++i) {
      const auto* field = method.input_type()->field(i);
      const auto part = parts.find(std::string(field->name()));
      if (field->message_type() == v1::CreateSolveRequest::descriptor()) {  // of a batch
        v1::CreateSolveRequest create;
        *create.mutable_spec() = spec;
        EXPECT_TRUE(
            reflection.AddMessage(message.get(), field, &factory_)->ParseFromString(create.SerializeAsString()));
        continue;
      }
      if (field->message_type() == v1::WatchSolveRequest::descriptor()) {  // of several
        v1::WatchSolveRequest watch;
        watch.set_name(name);
        EXPECT_TRUE(reflection.AddMessage(message.get(), field, &factory_)->ParseFromString(watch.SerializeAsString()));
        continue;
      }
      if (field->name() == "name") reflection.SetString(message.get(), field, name);
      if (field->message_type() == v1::Model::descriptor()) {
        EXPECT_TRUE(reflection.MutableMessage(message.get(), field, &factory_)->ParseFromString(planar_));
        continue;
      }
      if (part == parts.end()) continue;
      EXPECT_TRUE(reflection.MutableMessage(message.get(), field, &factory_)->ParseFromString(part->second));
    }
    return message->SerializeAsString();
  }

  // Stores the model "planar" as the good caller's own "models/{id}".
  void StoreModel(const std::string& id) {
    v1::GetModelRequest get;
    get.mutable_model()->set_name("planar");
    v1::CreateModelRequest create;
    const grpc::Status known = GoodStub()->GetModel(GoodContext().get(), get, create.mutable_model());
    ASSERT_TRUE(known.ok()) << known.error_message();
    planar_ = create.model().SerializeAsString();
    create.set_model_id(id);
    v1::Model model;
    const grpc::Status stored = GoodStub()->CreateModel(GoodContext().get(), create, &model);
    ASSERT_TRUE(stored.ok()) << stored.error_message();
  }

  std::set<std::string> GoodModels() {
    v1::ListModelsResponse response;
    const grpc::Status status = GoodStub()->ListModels(GoodContext().get(), {}, &response);
    EXPECT_TRUE(status.ok()) << status.error_message();
    std::set<std::string> names;
    for (const v1::ModelSummary& model : response.models()) names.insert(model.stored().name());
    return names;
  }

  std::set<std::string> GoodSolves() {
    v1::ListSolvesResponse response;
    const grpc::Status status = GoodStub()->ListSolves(GoodContext().get(), {}, &response);
    EXPECT_TRUE(status.ok()) << status.error_message();
    std::set<std::string> names;
    for (const v1::Solve& solve : response.solves()) names.insert(solve.name());
    return names;
  }

  google::protobuf::DynamicMessageFactory factory_;
  std::string planar_;  // v1::Model
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
  const std::string kept = EndedSolve(), to_delete = EndedSolve();
  ASSERT_NE(kept, to_delete);
  StoreModel("to_delete");
  const std::map<std::string, std::string> deleted = {{"DeleteSolve", to_delete}, {"DeleteModel", "models/to_delete"}};
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
      const auto name = deleted.find(std::string(method.name()));
      const std::string bytes = Request(method, name == deleted.end() ? kept : name->second);
      const std::set<std::string> before = GoodSolves(), models_before = GoodModels();
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
      const bool names_one = method.input_type()->FindFieldByName("name") != nullptr || method.name() == "WatchSolves";
      EXPECT_EQ(row.back() == StatusCode::NOT_FOUND, names_one);
      EXPECT_TRUE(row.back() == StatusCode::OK || names_one) << row.back();
      EXPECT_EQ(GoodSolves(), before) << "a call that was refused has done something";
      EXPECT_EQ(GoodModels(), models_before) << "a call that was refused has done something";
      // A simulation of the call before may still be leaving its place.
      StatusCode good = Call(good_, path, bytes);
      for (int again = 0; again < 100 && good == StatusCode::RESOURCE_EXHAUSTED; ++again) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        good = Call(good_, path, bytes);
      }
      row.push_back(good);
      EXPECT_EQ(row.back(), StatusCode::OK);
      Print(std::string(method.name()), row);
    }
  }
  EXPECT_GE(methods, 16);
  EXPECT_EQ(GoodModels().count("models/to_delete@1"), 0u);
  EXPECT_EQ(GoodModels().count("models/planar@1"), 1u);
  EXPECT_EQ(GoodSolves().count(to_delete), 0u);
  EXPECT_EQ(GoodSolves().count(kept), 1u);
}

}  // namespace
}  // namespace rollgait::server
