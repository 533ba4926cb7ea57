#include "server/gateway/openapi.h"

#include <gmock/gmock.h>
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "server/gateway/gateway.h"
#include "server/gateway/routes.h"

namespace rollgait::server {
namespace {

using nlohmann::json;

// All that references in `node` name.
void Collect(const json& node, std::set<std::string>& names) {
  if (node.is_object() && node.contains("$ref")) names.insert(node["$ref"].get<std::string>());
  for (const json& child : node) {
    if (child.is_structured()) Collect(child, names);
  }
}

TEST(OpenApi, HasEveryRowAndEverythingItNames) {
  const json document = json::parse(OpenApiDocument());
  size_t operations = 0;
  for (const auto& path : document["paths"]) operations += path.size();
  EXPECT_EQ(operations, std::size(kRoutes));
  std::set<std::string> names;
  Collect(document, names);
  EXPECT_GT(names.size(), 50u);
  for (const std::string& name : names) {
    EXPECT_TRUE(document.contains(json::json_pointer(name.substr(1)))) << name;
  }
}

TEST(OpenApi, TextsAreTheComments) {
  const json document = json::parse(OpenApiDocument());
  const json& schemas = document["components"]["schemas"];
  EXPECT_EQ(schemas["CreateSolveRequest"]["properties"]["validateOnly"]["description"],
            "Check the spec and answer with a Solve without a name; store nothing.");
  EXPECT_THAT(schemas["Termination"]["description"].get<std::string>(), testing::HasSubstr("KKT conditions hold"));
  EXPECT_THAT(schemas["SolveEvent"]["properties"]["iteration"]["description"].get<std::string>(),
              testing::HasSubstr("One of `event`"));
  // Every call is described, but GetServerInfo, which has no comment.
  for (const auto& [path, operations] : document["paths"].items()) {
    for (const auto& [verb, operation] : operations.items()) {
      if (path != "/v1/serverInfo") {
        EXPECT_NE(operation["description"], "") << path;
      }
    }
  }
}

TEST(OpenApi, ANewFieldAndItsCommentAppear) {
  std::ifstream input(DESCRIPTORS, std::ios::binary);
  google::protobuf::FileDescriptorSet files;
  ASSERT_TRUE(files.ParseFromIstream(&input));
  google::protobuf::DescriptorPool pool;
  for (auto file : files.file()) {
    if (file.name() == "rollgait/v1/gait_service.proto") {
      auto* field = file.mutable_message_type(0)->add_field();
      field->set_name("new_field");
      field->set_json_name("newField");
      field->set_number(99);
      field->set_type(google::protobuf::FieldDescriptorProto::TYPE_INT64);
      field->set_label(google::protobuf::FieldDescriptorProto::LABEL_OPTIONAL);
    }
    ASSERT_NE(pool.BuildFile(file), nullptr);
  }
  const json document = json::parse(MakeOpenApi(pool, "1.2.3"));
  EXPECT_EQ(document["info"]["version"], "1.2.3");
  const json& property = document["components"]["schemas"]["RunSolveRequest"]["properties"]["newField"];
  EXPECT_EQ(property, (json{{"type", "string"}, {"format", "int64"}}));
}

}  // namespace
}  // namespace rollgait::server
