// Labels, filters and batches of the service.
#include <gtest/gtest.h>

#include "server/service/request_check.h"
#include "server/service/solve_message.h"
#include "tests/server/service/service_fixture.h"

namespace rollgait::server {
namespace {

v1::CreateSolveRequest LabelledRequest(double slope, const std::string& sweep, const std::string& request_id = "") {
  v1::CreateSolveRequest request;
  *request.mutable_spec() = PlanarSpec(slope);
  if (!sweep.empty()) (*request.mutable_labels())["sweep"] = sweep;
  request.set_request_id(request_id);
  return request;
}

std::vector<double> ListedSlopes(ServiceBench& bench, const v1::ListSolvesRequest& request, const Caller& caller = {}) {
  std::vector<double> slopes;
  const Outcome<v1::ListSolvesResponse> list = bench.service().ListSolves(caller, request);
  EXPECT_TRUE(list.ok());
  if (!list.ok()) return slopes;
  for (const v1::Solve& solve : list.value().solves()) slopes.push_back(solve.spec().slope_rad());
  return slopes;
}

std::string FieldRefused(const Error& error) {
  EXPECT_EQ(error.code, ErrorCode::kInvalidArgument) << error.message;
  return error.violations.empty() ? "" : error.violations[0].field;
}

TEST(SolveLabelsTest, AreStoredReturnedAndNoPartOfTheQuestion) {
  ServiceBench bench;
  const v1::Solve solve = bench.service().CreateSolve({}, LabelledRequest(0.1, "hills")).value();
  EXPECT_EQ(solve.labels().at("sweep"), "hills");
  bench.Finish(bench.Claim());
  const SolveBytes bytes = bench.service().GetSolve({}, Named<v1::GetSolveRequest>(solve.name()), kHoldAll).value();
  v1::Solve read;
  ASSERT_TRUE(read.ParseFromString(bytes.head + bytes.result));
  EXPECT_EQ(read.labels().at("sweep"), "hills");
  const v1::Solve equal = bench.service().CreateSolve({}, LabelledRequest(0.1, "dales")).value();
  EXPECT_TRUE(equal.from_cache()) << "the solver does not see labels";
  EXPECT_EQ(equal.labels().at("sweep"), "dales");
}

TEST(SolveLabelsTest, BadOnesAreRefused) {
  ServiceBench bench;
  v1::CreateSolveRequest request = LabelledRequest(0.1, "");
  (*request.mutable_labels())["Sweep"] = "x";
  EXPECT_EQ(FieldRefused(bench.service().CreateSolve({}, request).error()), "labels[\"Sweep\"]");
  EXPECT_EQ(FieldRefused(bench.service().CreateSolve({}, LabelledRequest(0.1, std::string(65, 'x'))).error()),
            "labels[\"sweep\"]");
  EXPECT_TRUE(ListedSlopes(bench, {}).empty());
}

TEST(ListFilterTest, TheServerFilters) {
  ServiceBench bench;
  for (const double slope : {0.1, 0.2, 0.3}) {
    ASSERT_TRUE(bench.service().CreateSolve({}, LabelledRequest(slope, slope < 0.25 ? "hills" : "")).ok());
  }
  bench.Finish(bench.Claim());
  v1::ListSolvesRequest request;
  v1::SolveFilter& filter = *request.mutable_filter();
  (*filter.mutable_labels())["sweep"] = "hills";
  EXPECT_EQ(ListedSlopes(bench, request), (std::vector<double>{0.2, 0.1}));
  filter.add_states(v1::SOLVE_STATE_QUEUED);
  EXPECT_EQ(ListedSlopes(bench, request), std::vector<double>{0.2});
  filter.add_states(v1::SOLVE_STATE_SUCCEEDED);
  EXPECT_EQ(ListedSlopes(bench, request), (std::vector<double>{0.2, 0.1}));
  filter.set_termination(v1::TERMINATION_OPTIMAL);
  EXPECT_EQ(ListedSlopes(bench, request), std::vector<double>{0.1});
  filter.set_termination(v1::TERMINATION_UNSPECIFIED);
  EXPECT_EQ(ListedSlopes(bench, request), std::vector<double>{0.2}) << "set, not absent";
  filter.Clear();
  filter.set_model("planar");
  EXPECT_EQ(ListedSlopes(bench, request).size(), 3u);
  filter.set_model("human29");
  EXPECT_TRUE(ListedSlopes(bench, request).empty());
  const google::protobuf::Timestamp created = bench.service().ListSolves({}, {}).value().solves(1).create_time();
  filter.Clear();
  *filter.mutable_create_time_from() = created;
  EXPECT_EQ(ListedSlopes(bench, request), (std::vector<double>{0.3, 0.2}));
  *filter.mutable_create_time_before() = created;
  filter.mutable_create_time_before()->set_nanos(created.nanos() + 1);
  EXPECT_EQ(ListedSlopes(bench, request), std::vector<double>{0.2});
}

TEST(ListFilterTest, ATokenOfAnotherFilterIsRefused) {
  ServiceBench bench;
  for (const double slope : {0.1, 0.2, 0.3}) bench.Create(PlanarSpec(slope));
  v1::ListSolvesRequest request;
  request.set_page_size(1);
  request.mutable_filter()->set_model("planar");
  request.set_page_token(bench.service().ListSolves({}, request).value().next_page_token());
  EXPECT_EQ(ListedSlopes(bench, request), std::vector<double>{0.2});
  request.mutable_filter()->add_states(v1::SOLVE_STATE_QUEUED);
  EXPECT_EQ(FieldRefused(bench.service().ListSolves({}, request).error()), "page_token");
  request.clear_filter();
  EXPECT_EQ(FieldRefused(bench.service().ListSolves({}, request).error()), "page_token");
}

TEST(ListFilterTest, WhatMeansNothingIsRefused) {
  ServiceBench bench;
  const auto refused = [&](const auto& change) {
    v1::ListSolvesRequest request;
    change(&request, request.mutable_filter());
    const Outcome<v1::ListSolvesResponse> list = bench.service().ListSolves({}, request);
    return list.ok() ? std::string("nothing") : FieldRefused(list.error());
  };
  using Request = v1::ListSolvesRequest;
  using Filter = v1::SolveFilter;
  EXPECT_EQ(refused([](Request*, Filter* filter) { filter->add_states(v1::SOLVE_STATE_UNSPECIFIED); }),
            "filter.states[0]");
  EXPECT_EQ(refused([](Request*, Filter* filter) {
              filter->add_states(v1::SOLVE_STATE_QUEUED);
              filter->add_states(v1::SOLVE_STATE_QUEUED);
            }),
            "filter.states[1]");
  EXPECT_EQ(refused([](Request* request, Filter* filter) {
              request->set_state(v1::SOLVE_STATE_QUEUED);
              filter->add_states(v1::SOLVE_STATE_QUEUED);
            }),
            "state");
  EXPECT_EQ(refused([](Request*, Filter* filter) { filter->set_model(std::string(129, 'm')); }), "filter.model");
  EXPECT_EQ(refused([](Request*, Filter* filter) { filter->set_model(std::string("planar\0", 7)); }), "filter.model");
  EXPECT_EQ(refused([](Request* request, Filter*) { request->set_tenant(std::string("a\0", 2)); }), "tenant");
  EXPECT_EQ(refused([](Request*, Filter* filter) {
              for (const char* key : {"a", "b", "c", "d", "e"}) (*filter->mutable_labels())[key] = "v";
            }),
            "filter.labels");
  EXPECT_EQ(refused([](Request*, Filter* filter) { filter->mutable_create_time_from()->set_seconds(INT64_MAX); }),
            "filter.create_time_from");
  EXPECT_EQ(refused([](Request*, Filter* filter) { filter->mutable_create_time_before()->set_nanos(-1); }),
            "filter.create_time_before");
  EXPECT_EQ(refused([](Request*, Filter* filter) {
              filter->mutable_create_time_from()->set_seconds(5);
              filter->mutable_create_time_before()->set_seconds(5);
            }),
            "filter.create_time_before");
}

v1::BatchCreateSolvesRequest BatchOf(const std::vector<double>& slopes) {
  v1::BatchCreateSolvesRequest batch;
  for (const double slope : slopes) {
    *batch.add_requests() = LabelledRequest(slope, "hills", "slope " + std::to_string(slope));
  }
  return batch;
}

TEST(BatchCreateTest, AllAreStoredInOrderAndARepetitionAttaches) {
  ServiceBench bench;
  const v1::BatchCreateSolvesResponse made = bench.service().BatchCreateSolves({}, BatchOf({0.1, 0.2, 0.3})).value();
  ASSERT_EQ(made.solves_size(), 3);
  EXPECT_EQ(made.solves(1).spec().slope_rad(), 0.2);
  EXPECT_EQ(made.solves(1).labels().at("sweep"), "hills");
  bench.Finish(bench.Claim());
  const v1::BatchCreateSolvesResponse again = bench.service().BatchCreateSolves({}, BatchOf({0.4, 0.3, 0.1})).value();
  EXPECT_EQ(again.solves(1).name(), made.solves(2).name());
  EXPECT_EQ(again.solves(2).name(), made.solves(0).name());
  EXPECT_EQ(again.solves(2).outcome().termination(), v1::TERMINATION_OPTIMAL);
  EXPECT_FALSE(again.solves(2).has_result());
  EXPECT_EQ(ListedSlopes(bench, {}).size(), 4u);
}

TEST(BatchCreateTest, TheWrongOneIsNamedAndNothingIsStored) {
  ServiceBench bench;
  EXPECT_EQ(FieldRefused(bench.service().BatchCreateSolves({}, BatchOf({0.1, 0.2, 0.9})).error()),
            "requests[2].spec.slope_rad");
  EXPECT_EQ(FieldRefused(bench.service().BatchCreateSolves({}, BatchOf({0.1, 0.1})).error()), "requests[1].request_id");
  v1::BatchCreateSolvesRequest batch = BatchOf({0.1, 0.2});
  (*batch.mutable_requests(1)->mutable_labels())["X"] = "x";
  EXPECT_EQ(FieldRefused(bench.service().BatchCreateSolves({}, batch).error()), "requests[1].labels[\"X\"]");
  batch = BatchOf({0.1});
  batch.mutable_requests(0)->set_validate_only(true);
  EXPECT_EQ(FieldRefused(bench.service().BatchCreateSolves({}, batch).error()), "requests[0].validate_only");
  batch.mutable_requests(0)->set_validate_only(false);
  batch.mutable_requests(0)->set_spell_out(true);
  EXPECT_EQ(FieldRefused(bench.service().BatchCreateSolves({}, batch).error()), "requests[0].spell_out");
  EXPECT_EQ(FieldRefused(bench.service().BatchCreateSolves({}, {}).error()), "requests");
  EXPECT_EQ(FieldRefused(bench.service().BatchCreateSolves({}, BatchOf(std::vector<double>(257, 0.1))).error()),
            "requests");
  EXPECT_TRUE(ListedSlopes(bench, {}).empty());
}

TEST(BatchCreateTest, StoredModelsAreReadAndCountTowardsTheBatch) {
  ServiceBench bench;
  v1::CreateModelRequest create;
  create.mutable_model()->mutable_summary()->set_name("walker");
  create.mutable_model()->mutable_summary()->set_description(std::string(100'000, 'd'));
  create.mutable_model()->add_joints()->set_mass_kg(70);
  ASSERT_TRUE(bench.service().models().CreateModel({}, create).ok());
  v1::BatchCreateSolvesRequest batch = BatchOf({0.1, 0.2});
  batch.mutable_requests(1)->mutable_spec()->mutable_model()->set_name("models/walker");
  const v1::BatchCreateSolvesResponse made = bench.service().BatchCreateSolves({}, batch).value();
  EXPECT_FALSE(made.solves(0).spec().model().has_own());
  EXPECT_EQ(made.solves(1).spec().model().own().joints(0).mass_kg(), 70);
  v1::BatchCreateSolvesRequest large;
  for (int i = 0; i < 200; ++i) {
    *large.add_requests() = LabelledRequest(0.001 * i, "large");
    large.mutable_requests(i)->mutable_spec()->mutable_model()->set_name("models/walker");
  }
  const Error refused = bench.service().BatchCreateSolves({}, large).error();
  EXPECT_EQ(FieldRefused(refused), "requests[167].spec") << "16 MiB of 100 kB each";
  EXPECT_NE(refused.message.find("16777216"), std::string::npos) << refused.message;
  EXPECT_EQ(ListedSlopes(bench, {}).size(), 2u);
}

TEST(BatchCreateTest, ARequestIsNoLongerWithItsStoredModelThanOneAloneMayBe) {
  ServiceBench bench;
  v1::CreateModelRequest create;
  create.mutable_model()->mutable_summary()->set_name("walker");
  create.mutable_model()->mutable_summary()->set_description(std::string(kMaxRequestBytes - 1000, 'd'));
  create.mutable_model()->add_joints()->set_mass_kg(70);
  ASSERT_TRUE(bench.service().models().CreateModel({}, create).ok());
  v1::BatchCreateSolvesRequest batch = BatchOf({0.1, 0.2});
  v1::SolveSpec& spec = *batch.mutable_requests(1)->mutable_spec();
  spec.mutable_model()->set_name("models/walker");
  spec.set_warm_start(std::string(2000, 's'));
  const Outcome<v1::BatchCreateSolvesResponse> made = bench.service().BatchCreateSolves({}, batch);
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(FieldRefused(made.error()).substr(0, 12), "requests[1].") << made.error().message;
  EXPECT_NE(made.error().message.find(std::to_string(kMaxRequestBytes)), std::string::npos) << made.error().message;
}

TEST(BatchCreateTest, AQueueWithoutRoomForAllTakesNone) {
  ServiceOptions options;
  options.max_queued = 2;
  ServiceBench bench(std::chrono::hours(1), options);
  EXPECT_EQ(bench.service().BatchCreateSolves({}, BatchOf({0.1, 0.2, 0.3})).error().code,
            ErrorCode::kResourceExhausted);
  EXPECT_TRUE(ListedSlopes(bench, {}).empty());
  EXPECT_TRUE(bench.service().BatchCreateSolves({}, BatchOf({0.1, 0.2})).ok());
}

TEST(BatchCreateTest, AQueueThatWasFullAMomentAgoRefusesOnlyWhatNeedsAPlaceInIt) {
  ServiceOptions options;
  options.max_queued = 1;
  ServiceBench bench(std::chrono::hours(1), options);
  const v1::BatchCreateSolvesResponse made = bench.service().BatchCreateSolves({}, BatchOf({0.1})).value();
  std::string at_the_door, of_batch;
  for (int attempt = 0; attempt < 20 && (attempt == 0 || of_batch != at_the_door); ++attempt) {  // it is a short moment
    at_the_door = bench.service().CreateSolve({}, LabelledRequest(0.2, "")).error().message;
    of_batch = bench.service().BatchCreateSolves({}, BatchOf({0.1, 0.3})).error().message;
  }
  EXPECT_EQ(of_batch, at_the_door) << "the store was not asked: it names the request";
  const Outcome<v1::BatchCreateSolvesResponse> again = bench.service().BatchCreateSolves({}, BatchOf({0.1}));
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ(again.value().solves(0).name(), made.solves(0).name());
}

TEST(BatchCreateTest, TheFirstIsTakenHoweverLongItsWarmStartIs) {
  ServiceBench bench;
  const std::string start = SolveName(bench.Create());
  v1::SolveResult result;
  result.set_termination(v1::TERMINATION_OPTIMAL);
  result.mutable_trajectory()->add_phases()->mutable_node_positions()->mutable_values()->Resize(17 << 17, 0.5);
  ASSERT_TRUE(
      bench.store().Finish(bench.Claim(), {}, {SolveState::kSucceeded, result.SerializeAsString(), "", true}).ok());
  v1::BatchCreateSolvesRequest batch = BatchOf({-0.1, -0.2});
  batch.mutable_requests(0)->mutable_spec()->set_warm_start(start);
  const Error refused = bench.service().BatchCreateSolves({}, batch).error();
  EXPECT_EQ(FieldRefused(refused), "requests[1].spec");
  EXPECT_NE(refused.message.find("send it in several batches"), std::string::npos)
      << "the words that clients know: " << refused.message;
  batch.mutable_requests()->RemoveLast();
  const Outcome<v1::BatchCreateSolvesResponse> made = bench.service().BatchCreateSolves({}, batch);
  ASSERT_TRUE(made.ok()) << made.error().message;
  EXPECT_EQ(made.value().solves_size(), 1);
}

TEST(BatchCreateTest, ADryRunStoresNothing) {
  ServiceBench bench;
  v1::BatchCreateSolvesRequest batch = BatchOf({0.1, 0.2});
  batch.set_validate_only(true);
  const v1::BatchCreateSolvesResponse checked = bench.service().BatchCreateSolves({}, batch).value();
  ASSERT_EQ(checked.solves_size(), 2);
  EXPECT_EQ(checked.solves(1).name(), "");
  EXPECT_EQ(checked.solves(1).spec().slope_rad(), 0.2);
  EXPECT_TRUE(ListedSlopes(bench, {}).empty());
}

TEST(FindWatchedTest, ByNamesOrByLabelsOfTheCaller) {
  ServiceBench bench;
  const Caller red = CallerOf("red"), blue = CallerOf("blue");
  const v1::BatchCreateSolvesResponse made = bench.service().BatchCreateSolves(red, BatchOf({0.1, 0.2})).value();
  ASSERT_TRUE(bench.service().BatchCreateSolves(blue, BatchOf({0.1})).ok());
  v1::WatchSolvesRequest request;
  EXPECT_EQ(FieldRefused(bench.service().FindWatched(red, request).error()), "solves");
  (*request.mutable_labels())["sweep"] = "hills";
  const std::vector<WatchPosition> found = bench.service().FindWatched(red, request).value().positions;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(SolveName(found[0].id), made.solves(1).name());
  EXPECT_EQ(found[0].after_sequence, 0);
  (*request.mutable_labels())["sweep"] = "dales";
  EXPECT_EQ(FieldRefused(bench.service().FindWatched(red, request).error()), "labels");
  *request.add_solves() = Named<v1::WatchSolveRequest>(made.solves(0).name());
  EXPECT_EQ(FieldRefused(bench.service().FindWatched(red, request).error()), "solves") << "both";
  request.clear_labels();
  EXPECT_EQ(bench.service().FindWatched(red, request).value().positions.size(), 1u);
  EXPECT_EQ(bench.service().FindWatched(blue, request).error().code, ErrorCode::kNotFound);
  *request.add_solves() = Named<v1::WatchSolveRequest>(made.solves(0).name());
  EXPECT_EQ(FieldRefused(bench.service().FindWatched(red, request).error()), "solves[1].name");
  request.mutable_solves(1)->set_name(made.solves(1).name());
  request.mutable_solves(1)->set_iterates_per_second(kMostIteratesPerSecond + 1);
  EXPECT_EQ(FieldRefused(bench.service().FindWatched(red, request).error()), "solves[1].iterates_per_second");
  request.mutable_solves(1)->set_iterates_per_second(2);
  EXPECT_EQ(bench.service().FindWatched(red, request).value().positions[1].iterates_per_second, 2);
  for (int i = 0; i < 255; ++i) request.add_solves()->set_name("solves/x" + std::to_string(i));
  EXPECT_EQ(FieldRefused(bench.service().FindWatched(red, request).error()), "solves");
}

TEST(FindWatchedTest, MoreThanOneStreamTakesAreRefused) {
  ServiceBench bench;
  v1::BatchCreateSolvesRequest batch;
  for (int i = 0; i < 256; ++i) *batch.add_requests() = LabelledRequest(0.001 * i, "many");
  ASSERT_TRUE(bench.service().BatchCreateSolves({}, batch).ok());
  v1::WatchSolvesRequest request;
  (*request.mutable_labels())["sweep"] = "many";
  EXPECT_EQ(bench.service().FindWatched({}, request).value().positions.size(), 256u);
  ASSERT_TRUE(bench.service().CreateSolve({}, LabelledRequest(0.3, "many")).ok());
  EXPECT_EQ(FieldRefused(bench.service().FindWatched({}, request).error()), "labels");
}

}  // namespace
}  // namespace rollgait::server
