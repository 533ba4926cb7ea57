// Tenants' own models, in every kind of store.
#include <set>
#include <thread>
#include <vector>

#include "tests/server/store/store_bench.h"

namespace rollgait::server {
namespace {

// Content stands for itself: its digest is the content.
NewModel ModelOf(const std::string& tenant, const std::string& id, const std::string& content) {
  NewModel model;
  model.id = id;
  model.digest = content;
  model.summary = "summary of " + content;
  model.payload = "model of " + content;
  model.actor = {tenant, "token-" + tenant, "ipv4:127.0.0.1"};
  return model;
}

std::vector<std::string> Names(const ModelPage& page) {
  std::vector<std::string> names;
  for (const ModelRecord& model : page.models) names.push_back(model.id + "@" + std::to_string(model.version));
  return names;
}

TEST_P(SolveStoreConformance, AModelIsKeptVersionByVersion) {
  StoreBench bench(GetParam());
  const CreatedModel first = bench.models().CreateModel(ModelOf("red", "walker", "a")).value();
  EXPECT_TRUE(first.created);
  EXPECT_EQ(first.model.version, 1);
  EXPECT_EQ(first.model.create_time_us, bench.clock().WallMicros());
  const CreatedModel second = bench.models().CreateModel(ModelOf("red", "walker", "b")).value();
  EXPECT_TRUE(second.created);
  EXPECT_EQ(second.model.version, 2);
  bench.Restart();
  const ModelRecord newest = bench.models().GetModel({"red", "walker"}).value();
  EXPECT_EQ(newest.version, 2);
  EXPECT_EQ(newest.payload, "model of b");
  EXPECT_EQ(newest.summary, "summary of b");
  EXPECT_EQ(newest.bytes, static_cast<int64_t>(newest.payload.size() + newest.summary.size()));
  EXPECT_EQ(bench.models().GetModel({"red", "walker", 1}).value().payload, "model of a");
  EXPECT_EQ(bench.models().GetModel({"red", "walker", 3}).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(bench.models().GetModel({"red", "runner"}).error().code, ErrorCode::kNotFound);
}

TEST_P(SolveStoreConformance, EqualContentOfAnIdIsOneVersion) {
  StoreBench bench(GetParam());
  ASSERT_TRUE(bench.models().CreateModel(ModelOf("red", "walker", "a")).ok());
  ASSERT_TRUE(bench.models().CreateModel(ModelOf("red", "walker", "b")).ok());
  const CreatedModel again = bench.models().CreateModel(ModelOf("red", "walker", "a")).value();
  EXPECT_FALSE(again.created);
  EXPECT_EQ(again.model.version, 1);
  EXPECT_EQ(again.model.payload, "model of a");
  NewModel rounded = ModelOf("red", "walker", "b, rounded");
  rounded.given_digest = "b";
  EXPECT_EQ(bench.models().CreateModel(rounded).value().model.version, 2);
  EXPECT_TRUE(bench.models().CreateModel(ModelOf("red", "runner", "a")).value().created) << "another id";
}

TEST_P(SolveStoreConformance, CreationsAtTheSameTimeMakeEachVersionOnce) {
  StoreBench bench(GetParam());
  constexpr int kThreads = 4, kContents = 5;
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&bench] {
      for (int k = 0; k < kContents; ++k) {
        const std::string content = Numbered("content", static_cast<size_t>(k));
        EXPECT_TRUE(bench.models().CreateModel(ModelOf("red", "walker", content)).ok());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::set<std::string> contents;
  for (int version = 1; version <= kContents; ++version) {
    contents.insert(bench.models().GetModel({"red", "walker", version}).value().digest);
  }
  EXPECT_EQ(contents.size(), static_cast<size_t>(kContents));
  EXPECT_FALSE(bench.models().GetModel({"red", "walker", kContents + 1}).ok());
}

TEST_P(SolveStoreConformance, AModelOfAnotherTenantDoesNotExist) {
  StoreBench bench(GetParam());
  ASSERT_TRUE(bench.models().CreateModel(ModelOf("red", "walker", "a")).ok());
  EXPECT_EQ(bench.models().GetModel({"blue", "walker"}).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(bench.models().DeleteModel("walker", {"blue", "", ""}).error().code, ErrorCode::kNotFound);
  EXPECT_TRUE(bench.models().ListModels({"blue", 50, ""}).value().models.empty());
  EXPECT_EQ(bench.models().CreateModel(ModelOf("blue", "walker", "b")).value().model.version, 1);
  EXPECT_EQ(bench.models().GetModel({"red", "walker"}).value().payload, "model of a");
}

TEST_P(SolveStoreConformance, ModelsAreListedInPages) {
  StoreBench bench(GetParam());
  for (const char* id : {"a", "b", "c"}) ASSERT_TRUE(bench.models().CreateModel(ModelOf("red", id, "old")).ok());
  ASSERT_TRUE(bench.models().CreateModel(ModelOf("red", "a", "new")).ok());
  ModelQuery query{"red", 2, ""};
  const ModelPage first = bench.models().ListModels(query).value();
  EXPECT_EQ(Names(first), (std::vector<std::string>{"a@2", "c@1"}));
  EXPECT_EQ(first.models[0].summary, "summary of new");
  EXPECT_EQ(first.models[0].payload, "");
  query.page_token = first.next_page_token;
  const ModelPage second = bench.models().ListModels(query).value();
  EXPECT_EQ(Names(second), std::vector<std::string>{"b@1"});
  EXPECT_EQ(second.next_page_token, "");
  query.tenant = "blue";
  EXPECT_EQ(bench.models().ListModels(query).error().code, ErrorCode::kInvalidArgument) << "the token is red's";
  ListQuery solves{10, first.next_page_token, std::nullopt, "red"};
  EXPECT_EQ(bench.store().List(solves).error().code, ErrorCode::kInvalidArgument) << "the token is one of models";
}

TEST_P(SolveStoreConformance, ADeletedModelIsGoneWithAllVersionsAndItsRoomIsFree) {
  StoreBench bench(GetParam());
  NewModel large = ModelOf("red", "walker", "a");
  large.payload = std::string(600, 'x');
  large.max_bytes_tenant = 1000;
  ASSERT_TRUE(bench.models().CreateModel(large).ok());
  NewModel larger = large;
  larger.digest = "b";
  const Error full = bench.models().CreateModel(larger).error();
  EXPECT_EQ(full.code, ErrorCode::kResourceExhausted);
  EXPECT_EQ(full.quota.value().subject, "tenant:red");
  EXPECT_NE(full.message.find("1000"), std::string::npos) << full.message;
  NewSolve solve{"s", "", std::string(500, 'y'), ""};
  solve.actor = large.actor;
  solve.max_bytes_tenant = 1000;
  EXPECT_EQ(bench.store().Create(solve).error().code, ErrorCode::kResourceExhausted) << "models count";
  ASSERT_TRUE(bench.models().DeleteModel("walker", large.actor).ok());
  EXPECT_EQ(bench.models().GetModel({"red", "walker"}).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(bench.models().DeleteModel("walker", large.actor).error().code, ErrorCode::kNotFound);
  EXPECT_TRUE(bench.store().Create(solve).ok());
}

TEST_P(SolveStoreConformance, VersionsOfATenantAreBounded) {
  StoreBench bench(GetParam());
  for (const char* content : {"a", "b", "c"}) {
    NewModel model = ModelOf("red", "walker", content);
    model.max_versions_tenant = 2;
    const Outcome<CreatedModel> created = bench.models().CreateModel(model);
    EXPECT_EQ(created.ok(), std::string(content) != "c");
    EXPECT_TRUE(created.ok() || created.error().code == ErrorCode::kResourceExhausted);
  }
  NewModel known = ModelOf("red", "walker", "a");
  known.max_versions_tenant = 2;
  EXPECT_TRUE(bench.models().CreateModel(known).ok()) << "it takes nothing";
}

TEST_P(SolveStoreConformance, WhatIsDoneToModelsIsAudited) {
  StoreBench bench(GetParam());
  const NewModel model = ModelOf("red", "walker", "a");
  ASSERT_TRUE(bench.models().CreateModel(model).ok());
  ASSERT_TRUE(bench.models().CreateModel(model).ok());
  ASSERT_TRUE(bench.models().DeleteModel("walker", model.actor).ok());
  const std::vector<AuditRow> rows = bench.store().ReadAudit(0, 10).value();
  ASSERT_EQ(rows.size(), 2u) << "a repeat changes nothing";
  EXPECT_EQ(rows[0].action, "create model");
  EXPECT_EQ(rows[0].detail, "models/walker@1");
  EXPECT_EQ(rows[0].actor.token_id, "token-red");
  EXPECT_EQ(rows[1].action, "delete model");
}

}  // namespace
}  // namespace rollgait::server
