#include "server/service/solve_service.h"

#include <google/protobuf/util/time_util.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>

#include "server/service/solve_message.h"
#include "tests/server/service/service_fixture.h"

namespace rollgait::server {
namespace {

v1::CreateSolveRequest CreateRequest(const v1::SolveSpec& spec, const std::string& request_id = "") {
  v1::CreateSolveRequest request;
  *request.mutable_spec() = spec;
  request.set_request_id(request_id);
  return request;
}

TEST(SolveServiceTest, CreateGetListAndDelete) {
  ServiceBench bench;
  const v1::Solve created = bench.service().CreateSolve({}, CreateRequest(PlanarSpec())).value();
  EXPECT_EQ(created.state(), v1::SOLVE_STATE_QUEUED);
  EXPECT_EQ(created.spec().slope_rad(), 0.1);
  const std::string id = created.name().substr(7);
  EXPECT_EQ(bench.service().DeleteSolve({}, Named<v1::DeleteSolveRequest>(SolveName(id))).error().code,
            ErrorCode::kFailedPrecondition);
  bench.Finish(bench.Claim());
  const SolveBytes bytes = bench.service().GetSolve({}, Named<v1::GetSolveRequest>(SolveName(id)), kHoldAll).value();
  v1::Solve done;
  ASSERT_TRUE(done.ParseFromString(bytes.head + bytes.result));
  EXPECT_EQ(done.state(), v1::SOLVE_STATE_SUCCEEDED);
  EXPECT_EQ(done.result().message(), "found");
  const v1::ListSolvesResponse list = bench.service().ListSolves({}, {}).value();
  ASSERT_EQ(list.solves_size(), 1);
  EXPECT_FALSE(list.solves(0).has_result());
  EXPECT_TRUE(bench.service().DeleteSolve({}, Named<v1::DeleteSolveRequest>(SolveName(id))).ok());
  EXPECT_EQ(bench.service().GetSolve({}, Named<v1::GetSolveRequest>(SolveName(id)), kHoldAll).error().code,
            ErrorCode::kNotFound);
}

TEST(SolveServiceTest, AnAnswerIsReadOnlyOnceThereIsRoomForIt) {
  ServiceBench bench;
  const std::string id = bench.Create();
  bench.Finish(bench.Claim());
  const SolveRecord record = bench.store().Get(id).value();
  int64_t asked = 0;
  const auto hold = [&](int64_t bytes) -> Outcome<Done> {
    asked = bytes;
    return Error{ErrorCode::kResourceExhausted, "no room"};
  };
  EXPECT_EQ(bench.service().GetSolve({}, Named<v1::GetSolveRequest>(SolveName(id)), hold).error().message, "no room");
  EXPECT_EQ(asked, static_cast<int64_t>(record.spec.size() + record.result.size()));
}

TEST(SolveServiceTest, BadSpecsAreRefusedWithTheirPathsAndNothingIsStored) {
  ServiceBench bench;
  v1::SolveSpec spec = PlanarSpec(0.7);
  spec.mutable_model()->set_name("snake");
  const Outcome<v1::Solve> refused = bench.service().CreateSolve({}, CreateRequest(spec));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  ASSERT_EQ(refused.error().violations.size(), 2u);
  EXPECT_EQ(refused.error().violations[0].field, "spec.model.name");
  EXPECT_EQ(refused.error().violations[1].field, "spec.slope_rad");
  const Outcome<v1::Solve> nan =
      bench.service().CreateSolve({}, CreateRequest(PlanarSpec(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(nan.error().violations[0].field, "spec.slope_rad");
  EXPECT_EQ(bench.service().CreateSolve({}, {}).error().violations[0].field, "spec");
  const Outcome<v1::Solve> id = bench.service().CreateSolve({}, CreateRequest(PlanarSpec(), std::string(200, 'x')));
  EXPECT_EQ(id.error().violations[0].field, "request_id");
  EXPECT_EQ(bench.service().ListSolves({}, {}).value().solves_size(), 0);
}

TEST(SolveServiceTest, ADryRunChecksAndStoresNothing) {
  ServiceBench bench;
  v1::CreateSolveRequest request = CreateRequest(PlanarSpec());
  request.set_validate_only(true);
  EXPECT_EQ(bench.service().CreateSolve({}, request).value().name(), "");
  request.mutable_spec()->set_slope_rad(3);
  EXPECT_EQ(bench.service().CreateSolve({}, request).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(bench.service().ListSolves({}, {}).value().solves_size(), 0);
}

TEST(SolveServiceTest, ADryRunSpellsThePresetOut) {
  ServiceBench bench;
  v1::CreateSolveRequest request = CreateRequest(PlanarSpec());
  request.mutable_spec()->set_preset(v1::PRESET_TORQUE);
  request.set_validate_only(true);
  EXPECT_EQ(bench.service().CreateSolve({}, request).value().spec().preset(), v1::PRESET_TORQUE);
  request.set_spell_out(true);
  const v1::SolveSpec spelled = bench.service().CreateSolve({}, request).value().spec();
  EXPECT_EQ(spelled.preset(), v1::PRESET_UNSPECIFIED);
  ASSERT_EQ(spelled.costs_size(), 1);
  EXPECT_TRUE(spelled.costs(0).has_squared_torque());
  request.set_validate_only(false);
  EXPECT_EQ(bench.service().CreateSolve({}, request).error().violations[0].field, "spell_out");
  EXPECT_EQ(bench.service().ListSolves({}, {}).value().solves_size(), 0);
}

TEST(SolveServiceTest, ServerInfoTellsClockQueueAndTheDiskToTheAdministrator) {
  ServiceOptions options;
  options.max_queued = 17;
  options.store_disk = DiskRoom("/tmp", 0);
  ServiceBench bench(std::chrono::hours(1), options);
  Caller administrator, reader;
  administrator.scopes = kScopeAdmin | kScopeRead;
  reader.scopes = kScopeRead;
  using google::protobuf::util::TimeUtil;
  const auto now_ns = [] {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
        .count();
  };
  const int64_t before_ns = now_ns();
  const v1::ServerInfo info = bench.service().GetServerInfo(administrator, {}).value();
  EXPECT_GE(TimeUtil::TimestampToNanoseconds(info.server_time()), before_ns);
  EXPECT_LE(TimeUtil::TimestampToNanoseconds(info.server_time()), now_ns());
  EXPECT_EQ(info.max_queued(), 17);
  EXPECT_TRUE(info.has_store_free_bytes());
  EXPECT_GT(info.store_free_bytes(), 0);
  EXPECT_FALSE(bench.service().GetServerInfo(reader, {}).value().has_store_free_bytes());
}

TEST(SolveServiceTest, TheSameRequestIdIsTheSameSolve) {
  ServiceBench bench;
  const std::string name = bench.service().CreateSolve({}, CreateRequest(PlanarSpec(), "r")).value().name();
  EXPECT_EQ(bench.service().CreateSolve({}, CreateRequest(PlanarSpec(), "r")).value().name(), name);
  EXPECT_EQ(bench.service().CreateSolve({}, CreateRequest(PlanarSpec(0.2), "r")).error().code,
            ErrorCode::kAlreadyExists);
}

TEST(SolveServiceTest, AnEqualRequestIsAnsweredFromTheStoreUnlessForbidden) {
  for (const bool reuse : {true, false}) {
    ServiceOptions options;
    options.reuse_results = reuse;
    ServiceBench bench(std::chrono::hours(1), options);
    bench.Create();
    bench.Finish(bench.Claim());
    const v1::Solve again = bench.service().CreateSolve({}, CreateRequest(PlanarSpec())).value();
    EXPECT_EQ(again.from_cache(), reuse);
    EXPECT_EQ(again.state(), reuse ? v1::SOLVE_STATE_SUCCEEDED : v1::SOLVE_STATE_QUEUED);
    EXPECT_EQ(again.result().message(), reuse ? "found" : "");
    const v1::Solve other = bench.service().CreateSolve({}, CreateRequest(PlanarSpec(0.3))).value();
    EXPECT_EQ(other.state(), v1::SOLVE_STATE_QUEUED);
  }
}

TEST(SolveServiceTest, CancelEndsAQueuedSolve) {
  ServiceBench bench;
  const std::string id = bench.Create();
  const v1::Solve solve = bench.service().CancelSolve({}, Named<v1::CancelSolveRequest>(SolveName(id))).value();
  EXPECT_EQ(solve.state(), v1::SOLVE_STATE_CANCELLED);
  EXPECT_EQ(solve.error().kind(), v1::SolveError::KIND_CANCELLED);
  EXPECT_EQ(bench.service().CancelSolve({}, Named<v1::CancelSolveRequest>("solves/none")).error().code,
            ErrorCode::kNotFound);
}

TEST(SolveServiceTest, APriorityIsStoredShownChangedAndBounded) {
  ServiceBench bench;
  v1::CreateSolveRequest create;
  *create.mutable_spec() = PlanarSpec();
  create.set_request_id("once");
  create.set_priority(-10);
  const v1::Solve made = bench.service().CreateSolve({}, create).value();
  EXPECT_EQ(made.priority(), -10);
  create.set_priority(10);
  EXPECT_EQ(bench.service().CreateSolve({}, create).value().priority(), -10) << "attached to, and left as it is";
  create.set_validate_only(true);
  EXPECT_EQ(bench.service().CreateSolve({}, create).value().priority(), 10);
  create.set_priority(11);
  const Error above = bench.service().CreateSolve({}, create).error();
  ASSERT_EQ(above.violations.size(), 1u);
  EXPECT_EQ(above.violations[0].field, "priority");
  EXPECT_EQ(above.violations[0].message, "is 11, must be from -10 to 10");
  v1::BatchCreateSolvesRequest batch;
  *batch.add_requests()->mutable_spec() = PlanarSpec(0.2);
  batch.mutable_requests(0)->set_priority(4);
  EXPECT_EQ(bench.service().BatchCreateSolves({}, batch).value().solves(0).priority(), 4);
  batch.mutable_requests(0)->set_priority(-11);
  EXPECT_EQ(bench.service().BatchCreateSolves({}, batch).error().violations[0].field, "requests[0].priority");

  auto set = Named<v1::SetSolvePriorityRequest>(made.name());
  set.set_priority(-11);
  const Error below = bench.service().SetSolvePriority({}, set).error();
  EXPECT_EQ(below.code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(below.violations[0].message, "is -11, must be from -10 to 10");
  set.set_priority(7);
  EXPECT_EQ(bench.service().SetSolvePriority({}, set).value().priority(), 7);
  EXPECT_EQ(bench.service().ListSolves({}, {}).value().solves(1).priority(), 7);
  bench.Claim();
  EXPECT_TRUE(bench.service().SetSolvePriority({}, set).ok()) << "it has this one";
  set.set_priority(8);
  EXPECT_EQ(bench.service().SetSolvePriority({}, set).error().code, ErrorCode::kFailedPrecondition);
}

TEST(SolveServiceTest, ListRefusesBadPages) {
  ServiceBench bench;
  v1::ListSolvesRequest request;
  request.set_page_size(1001);
  EXPECT_EQ(bench.service().ListSolves({}, request).error().violations[0].field, "page_size");
  request.set_page_size(-1);
  EXPECT_EQ(bench.service().ListSolves({}, request).error().violations[0].field, "page_size");
  request.set_page_size(10);
  request.set_page_token("forged");
  EXPECT_EQ(bench.service().ListSolves({}, request).error().violations[0].field, "page_token");
  request.clear_page_token();
  request.set_state(static_cast<v1::SolveState>(42));
  EXPECT_EQ(bench.service().ListSolves({}, request).error().violations[0].field, "state");
}

TEST(SolveServiceTest, ModelsAndServerInfo) {
  ServiceOptions options;
  options.solver_slots = 7;
  options.solver_build = "a build";
  ServiceBench bench(std::chrono::hours(1), options);
  EXPECT_EQ(bench.service().models().ListModels({}, {}).value().models(0).name(), "planar");
  v1::GetModelRequest request;
  request.mutable_model()->set_name("snake");
  EXPECT_EQ(bench.service().models().GetModel({}, request).error().code, ErrorCode::kNotFound);
  request.mutable_model()->set_name("planar");
  EXPECT_TRUE(bench.service().models().GetModel({}, request).ok());
  request.mutable_model()->set_stature_m(9);
  EXPECT_EQ(bench.service().models().GetModel({}, request).error().violations[0].field, "model.stature_m");
  bench.Create();
  bench.Create(PlanarSpec(0.2));
  bench.Claim();
  const v1::ServerInfo info = bench.service().GetServerInfo({}, {}).value();
  EXPECT_EQ(info.solver_slots(), 7);
  EXPECT_EQ(info.solver_build(), "a build");
  EXPECT_EQ(info.running(), 1);
  EXPECT_EQ(info.queued(), 1);
  EXPECT_EQ(info.max_request_bytes(), 4 << 20);
  EXPECT_EQ(info.store(), "sqlite");
}

TEST(SolveServiceTest, AFullQueueRefusesOnlyWhatNeedsAPlaceInIt) {
  ServiceOptions options;
  options.max_queued = 1;
  ServiceBench bench(std::chrono::hours(1), options);
  v1::CreateSolveRequest solved, waiting, further, wrong;
  *solved.mutable_spec() = PlanarSpec(0.1);
  *waiting.mutable_spec() = PlanarSpec(0.2);
  *further.mutable_spec() = PlanarSpec(0.3);
  *wrong.mutable_spec() = PlanarSpec(0.9);
  bench.Create(solved.spec());
  bench.Finish(bench.Claim());
  waiting.set_request_id("mine");
  const std::string name = bench.service().CreateSolve({}, waiting).value().name();
  for (int i = 0; i < 3; ++i) {  // asked of the store, then remembered
    EXPECT_EQ(bench.service().CreateSolve({}, further).error().code, ErrorCode::kResourceExhausted);
    EXPECT_EQ(bench.service().CreateSolve({}, waiting).value().name(), name);
    EXPECT_TRUE(bench.service().CreateSolve({}, solved).value().from_cache());
    EXPECT_EQ(bench.service().CreateSolve({}, wrong).error().code, ErrorCode::kInvalidArgument);
    v1::CreateSolveRequest question = further;
    question.set_validate_only(true);
    EXPECT_TRUE(bench.service().CreateSolve({}, question).ok());
  }
}

}  // namespace
}  // namespace rollgait::server
