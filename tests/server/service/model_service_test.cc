#include "server/service/model_service.h"

#include <gtest/gtest.h>

#include "tests/server/service/service_fixture.h"

namespace rollgait::server {
namespace {

v1::CreateModelRequest Walker(double mass = 70) {
  v1::CreateModelRequest request;
  request.mutable_model()->mutable_summary()->set_name("walker");
  request.mutable_model()->add_joints()->set_mass_kg(mass);
  return request;
}

v1::GetModelRequest Get(const std::string& name) {
  v1::GetModelRequest request;
  request.mutable_model()->set_name(name);
  return request;
}

v1::CreateSolveRequest SolveWith(const std::string& model) {
  v1::CreateSolveRequest request;
  *request.mutable_spec() = PlanarSpec();
  request.mutable_spec()->mutable_model()->set_name(model);
  return request;
}

TEST(ModelServiceTest, AStoredModelIsCompletedAndHasAName) {
  ServiceBench bench;
  ModelService& models = bench.service().models();
  const v1::Model created = models.CreateModel(CallerOf("acme"), Walker()).value();
  EXPECT_EQ(created.total_mass_kg(), 70);
  EXPECT_EQ(created.summary().stored().name(), "models/walker@1");
  EXPECT_EQ(created.summary().stored().version(), 1);
  EXPECT_EQ(created.summary().stored().digest().size(), 64u);
  EXPECT_GT(created.summary().stored().create_time().seconds(), 0);
  EXPECT_GT(created.summary().stored().size_bytes(), 0);
  for (const char* name : {"models/walker", "models/walker@1"}) {
    EXPECT_EQ(models.GetModel(CallerOf("acme"), Get(name)).value().SerializeAsString(), created.SerializeAsString());
  }
  // What GetModel answers and what was sent are the same content.
  v1::CreateModelRequest again;
  *again.mutable_model() = created;
  EXPECT_EQ(models.CreateModel(CallerOf("acme"), again).value().summary().stored().version(), 1);
  EXPECT_EQ(models.CreateModel(CallerOf("acme"), Walker()).value().summary().stored().version(), 1);
  EXPECT_EQ(models.CreateModel(CallerOf("acme"), Walker(71)).value().summary().stored().version(), 2);
  EXPECT_EQ(models.GetModel(CallerOf("acme"), Get("models/walker")).value().total_mass_kg(), 71);
  v1::CreateModelRequest named = Walker();
  named.set_model_id("other");
  EXPECT_EQ(models.CreateModel(CallerOf("acme"), named).value().summary().stored().name(), "models/other@1");
}

TEST(ModelServiceTest, ModelsOfTheListAndStoredOnesAreListed) {
  ServiceBench bench;
  ModelService& models = bench.service().models();
  for (const char* id : {"a", "b"}) {
    v1::CreateModelRequest request = Walker();
    request.set_model_id(id);
    ASSERT_TRUE(models.CreateModel(CallerOf("acme"), request).ok());
  }
  v1::ListModelsRequest request;
  request.set_page_size(1);
  const v1::ListModelsResponse first = models.ListModels(CallerOf("acme"), request).value();
  ASSERT_EQ(first.models_size(), 2);
  EXPECT_EQ(first.models(0).name(), "planar");
  EXPECT_FALSE(first.models(0).has_stored());
  EXPECT_EQ(first.models(1).stored().name(), "models/b@1");
  request.set_page_token(first.next_page_token());
  const v1::ListModelsResponse second = models.ListModels(CallerOf("acme"), request).value();
  ASSERT_EQ(second.models_size(), 1);
  EXPECT_EQ(second.models(0).stored().name(), "models/a@1");
  EXPECT_EQ(second.next_page_token(), "");
  request.set_page_size(1001);
  EXPECT_EQ(models.ListModels(CallerOf("acme"), request).error().violations[0].field, "page_size");
}

TEST(ModelServiceTest, AnotherTenantNeitherSeesNorUsesNorDeletesIt) {
  ServiceBench bench;
  ModelService& models = bench.service().models();
  ASSERT_TRUE(models.CreateModel(CallerOf("acme"), Walker()).ok());
  const Caller rival = CallerOf("rival");
  EXPECT_EQ(models.GetModel(rival, Get("models/walker")).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(models.ListModels(rival, {}).value().models_size(), 1) << "the one of the list";
  EXPECT_EQ(models.DeleteModel(rival, Named<v1::DeleteModelRequest>("models/walker")).error().code,
            ErrorCode::kNotFound);
  const Error refused = bench.service().CreateSolve(rival, SolveWith("models/walker")).error();
  EXPECT_EQ(refused.code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused.violations[0].field, "spec.model.name");
  EXPECT_TRUE(models.GetModel(CallerOf("acme"), Get("models/walker")).ok());
}

TEST(ModelServiceTest, ASolveKeepsTheModelItUsed) {
  ServiceBench bench;
  const Caller caller = CallerOf("acme");
  ModelService& models = bench.service().models();
  v1::Model content = models.CreateModel(caller, Walker()).value();
  content.mutable_summary()->clear_stored();
  const v1::Solve solve = bench.service().CreateSolve(caller, SolveWith("models/walker")).value();
  EXPECT_EQ(solve.spec().model().name(), "");
  EXPECT_EQ(solve.spec().model().own().SerializeAsString(), content.SerializeAsString());
  ASSERT_TRUE(models.DeleteModel(caller, Named<v1::DeleteModelRequest>("models/walker")).ok());
  const Lease lease = bench.Claim();
  v1::SolveSpec claimed;
  ASSERT_TRUE(claimed.ParseFromString(bench.store().Get(lease.solve_id).value().spec));
  EXPECT_EQ(claimed.model().own().total_mass_kg(), 70);
  bench.Finish(lease);
  // The answer belongs to the content: the model by another name, or carried by the request, is the same question.
  v1::CreateModelRequest renamed = Walker();
  renamed.set_model_id("renamed");
  ASSERT_TRUE(models.CreateModel(caller, renamed).ok());
  EXPECT_TRUE(bench.service().CreateSolve(caller, SolveWith("models/renamed@1")).value().from_cache());
  v1::CreateSolveRequest carried = SolveWith("");
  *carried.mutable_spec()->mutable_model()->mutable_own() = content;
  EXPECT_TRUE(bench.service().CreateSolve(caller, carried).value().from_cache());
  EXPECT_FALSE(bench.service().CreateSolve(caller, SolveWith("models/walker")).ok()) << "deleted";
}

TEST(ModelServiceTest, BrokenModelsAndNamesAreRefused) {
  ServiceBench bench;
  const Caller caller = CallerOf("acme");
  ModelService& models = bench.service().models();
  EXPECT_EQ(models.CreateModel(caller, Walker(-1)).error().violations[0].field, "model.joints[0].mass_kg");
  EXPECT_EQ(models.CreateModel(caller, {}).error().violations[0].field, "model");
  for (const char* id : {"a b", "a@1", "../a", "ä"}) {
    v1::CreateModelRequest request = Walker();
    request.set_model_id(id);
    EXPECT_EQ(models.CreateModel(caller, request).error().violations[0].field, "model_id") << id;
  }
  EXPECT_EQ(models.ListModels(caller, {}).value().models_size(), 1) << "nothing was stored";
  ASSERT_TRUE(models.CreateModel(caller, Walker()).ok());
  for (const char* name : {"models/", "models/walker@", "models/walker@0", "models/walker@01", "models/walker@x",
                           "models/walker@99999999999", "models/walker@2", "walker"}) {
    EXPECT_EQ(models.GetModel(caller, Get(name)).error().code, ErrorCode::kNotFound) << name;
  }
  v1::GetModelRequest scaled = Get("models/walker");
  scaled.mutable_model()->set_stature_m(1.8);
  EXPECT_EQ(models.GetModel(caller, scaled).error().violations[0].field, "model.stature_m");
  EXPECT_EQ(models.DeleteModel(caller, Named<v1::DeleteModelRequest>("models/walker@1")).error().violations[0].field,
            "name");
  EXPECT_EQ(models.DeleteModel(caller, Named<v1::DeleteModelRequest>("planar")).error().code, ErrorCode::kNotFound);
}

TEST(ModelServiceTest, WhatATenantStoresIsBounded) {
  ServiceBench bench;
  Caller caller = CallerOf("acme");
  caller.limits.max_storage_bytes = 10;
  const Error full = bench.service().models().CreateModel(caller, Walker()).error();
  EXPECT_EQ(full.code, ErrorCode::kResourceExhausted);
  EXPECT_EQ(full.quota.value().subject, "tenant:acme");
}

}  // namespace
}  // namespace rollgait::server
