#include "server/gateway/request_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rollgait/v1/gait_service.pb.h"
#include "server/gateway/event_text.h"
#include "server/gateway/json.h"

namespace rollgait::server {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const RouteTable& Table() {
  static const RouteTable table;
  return table;
}

Outcome<std::string> Make(const char* verb, const char* path, std::string_view query, std::string_view body = "",
                          const std::string& last_event_id = "") {
  const RouteMatch match = Table().Match(verb, path);
  return MakeRequestMessage(*match.route, match.id, query, body, last_event_id);
}

// The message that the request makes; a failure says why it makes none.
template <typename Message>
Message Read(const Outcome<std::string>& wire) {
  Message message;
  EXPECT_TRUE(wire.ok()) << (wire.ok() ? "" : wire.error().message);
  EXPECT_TRUE(wire.ok() && message.ParseFromString(wire.value()));
  return message;
}

std::string Refusal(const Outcome<std::string>& wire) { return wire.ok() ? "it is taken" : wire.error().message; }

TEST(RequestMessage, QuerySetsFieldsByTheirPaths) {
  const auto request = Read<v1::ListSolvesRequest>(
      Make("GET", "/v1/solves",
           "pageSize=7&page_token=a%2Bb&filter.states=SOLVE_STATE_QUEUED&filter.states=2&filter.labels%5Blab%5D=x+y&"
           "filter.labels.run-1=z.a&filter.verdict=VERDICT_NOT_JUDGED&filter.createTimeFrom=2026-01-02T03:04:05Z&&"));
  EXPECT_EQ(request.page_size(), 7);
  EXPECT_EQ(request.page_token(), "a+b");
  ASSERT_EQ(request.filter().states_size(), 2);
  EXPECT_EQ(request.filter().states(0), v1::SOLVE_STATE_QUEUED);
  EXPECT_EQ(request.filter().states(1), v1::SOLVE_STATE_RUNNING);
  EXPECT_EQ(request.filter().labels_size(), 2);
  EXPECT_EQ(request.filter().labels().at("lab"), "x y");
  EXPECT_EQ(request.filter().labels().at("run-1"), "z.a");
  EXPECT_EQ(request.filter().verdict(), v1::VERDICT_NOT_JUDGED);
  EXPECT_EQ(request.filter().create_time_from().seconds(), 1767323045);
}

TEST(RequestMessage, PathBodyAndQueryComeTogether) {
  EXPECT_EQ(Read<v1::GetSolveRequest>(Make("GET", "/v1/solves/abc", "")).name(), "solves/abc");
  const auto model =
      Read<v1::CreateModelRequest>(Make("POST", "/v1/models", "modelId=me", R"({"summary":{"name":"a"}})"));
  EXPECT_EQ(model.model_id(), "me");
  EXPECT_EQ(model.model().summary().name(), "a");
  const auto solve = Read<v1::CreateSolveRequest>(
      Make("POST", "/v1/solves", "", R"({"spec":{"model":{"name":"planar"},"slope_rad":0.5},"labels":{"a":"b"}})"));
  EXPECT_EQ(solve.spec().slope_rad(), 0.5);
  EXPECT_EQ(solve.labels().at("a"), "b");
  EXPECT_EQ(Read<v1::GetModelRequest>(Make("GET", "/v1/models/own%401", "")).model().name(), "models/own@1");
  const auto scaled = Read<v1::GetModelRequest>(Make("GET", "/v1/models:get", "model.name=planar&model.statureM=1.5"));
  EXPECT_EQ(scaled.model().stature_m(), 1.5);
}

TEST(RequestMessage, LastEventIdWinsOverTheQuery) {
  const auto request = Read<v1::WatchSolveRequest>(Make("GET", "/v1/solves/a:watch", "afterSequence=3", "", "8"));
  EXPECT_EQ(request.after_sequence(), 8);
  EXPECT_THAT(Refusal(Make("GET", "/v1/solves/a:watch", "", "", "eight")), HasSubstr("Last-Event-ID: eight"));
}

TEST(RequestMessage, WhatIsWrongIsNamed) {
  const auto list = [](std::string_view query) { return Refusal(Make("GET", "/v1/solves", query)); };
  EXPECT_THAT(list("pagesize=1"), HasSubstr("pagesize: ListSolvesRequest has no field pagesize"));
  EXPECT_THAT(list("filter=1"), HasSubstr("cannot be set in a query"));
  EXPECT_THAT(list("filter.labels=1"), HasSubstr("filter.labels[KEY]=VALUE"));
  EXPECT_THAT(list("filter.nothing=1"), HasSubstr("SolveFilter has no field nothing"));
  EXPECT_THAT(list("filter.states.a=1"), HasSubstr("states has no fields that a query can set"));
  EXPECT_THAT(list("filter.createTimeFrom.seconds=1"), HasSubstr("createTimeFrom has no fields"));
  // What exists is not said to be missing.
  const auto model = [](std::string_view query) { return Refusal(Make("GET", "/v1/models:get", query)); };
  EXPECT_THAT(model("model.own=1"), HasSubstr("model.own: cannot be set in a query; it is no single value"));
  EXPECT_THAT(model("model.own.summary=1"), HasSubstr("go through one message at most"));
  EXPECT_THAT(model("model.own.nothing=1"), HasSubstr("Model has no field nothing"));
  EXPECT_THAT(list("filter.labels.a=1&filter.labels%5Ba%5D=2"), HasSubstr("filter.labels[a]: is given twice"));
  EXPECT_THAT(list("pageSize=1&page_size=2"), HasSubstr("given twice"));
  EXPECT_THAT(list("pageSize=1.5"), HasSubstr("pageSize=1.5"));
  EXPECT_THAT(list("state=NO_STATE"), HasSubstr("state=NO_STATE"));
  EXPECT_THAT(list("filter.createTimeFrom=yesterday"), HasSubstr("filter.createTimeFrom=yesterday"));
  EXPECT_THAT(list("pageToken=%ff"), HasSubstr("UTF-8"));
  EXPECT_THAT(list("pageToken=\"%22}"), testing::Eq("it is taken"));  // quotes do not end the text
  std::string many = "a=b";
  for (size_t i = 0; i < kMostQueryFields; ++i) many += "&filter.states=1";
  EXPECT_THAT(list(many), HasSubstr("no field a"));
  EXPECT_THAT(list(many.substr(4) + "&filter.states=1"), HasSubstr("more than 256 fields"));
  EXPECT_THAT(Refusal(Make("GET", "/v1/solves/a", "name=solves/b")), HasSubstr("stands in the path"));
  EXPECT_THAT(Refusal(Make("POST", "/v1/solves", "validateOnly=true")), HasSubstr("not in the query"));
  EXPECT_THAT(Refusal(Make("POST", "/v1/models", "model.summary=1", "{}")), HasSubstr("not in the query"));
  EXPECT_THAT(Refusal(Make("POST", "/v1/solves/a:cancel", "", "{\"a\":1}")), HasSubstr("has no body"));
}

TEST(RequestMessage, BodiesThatAreNoSuchMessageAreRefused) {
  const auto create = [](std::string_view body) { return Refusal(Make("POST", "/v1/solves", "", body)); };
  EXPECT_THAT(create(R"({"spec":{"modle":{}}})"), AllOf(HasSubstr("modle"), HasSubstr("CreateSolveRequest")));
  EXPECT_THAT(create("{\"requestId\":\"\xff\"}"), HasSubstr("UTF-8"));
  EXPECT_THAT(create(R"({"requestId":"\ud800"})"), StartsWith("the body is not"));
  EXPECT_THAT(create(R"({"spec":{"slopeRad":"steep"}})"), HasSubstr("steep"));
  EXPECT_THAT(create("[]"), StartsWith("the body is not"));
  EXPECT_THAT(create("{"), StartsWith("the body is not"));
  EXPECT_THAT(create("{} {}"), StartsWith("the body is not"));
  std::string deep = "{\"spec\":";
  for (int i = 0; i < 100'000; ++i) deep += "[";
  EXPECT_THAT(create(deep), StartsWith("the body is not"));
}

// docs/how-to/http.md says what is taken besides JSON.
TEST(RequestMessage, TheParserIsAsLenientAsIsSaid) {
  for (const char* body : {"{'requestId':'b'}", R"({requestId:"b"})", R"({"requestId":"b",})", R"({"request_id":"b"})",
                           R"({"requestId":"a","requestId":"b"})", R"({"requestId":"b","spec":null})",
                           R"({"requestId":"b","spec":{"slopeRad":"0.5"}})"}) {
    EXPECT_EQ(Read<v1::CreateSolveRequest>(Make("POST", "/v1/solves", "", body)).request_id(), "b") << body;
  }
  for (const char* body :
       {R"({"labels":{"a":"1","a":"2"}})", R"({"requestId":"a" /* b */})", "{}x", R"({"nothing":1})"}) {
    EXPECT_THAT(Refusal(Make("POST", "/v1/solves", "", body)), StartsWith("the body is not")) << body;
  }
}

TEST(RequestMessage, EventsAreThoseOfTheStandard) {
  const RouteMatch watch = Table().Match("GET", "/v1/solves/a:watch"), run = Table().Match("POST", "/v1/solves:run");
  v1::SolveEvent event;
  event.set_sequence(7);
  event.mutable_state_change()->set_detail("a\n\nevent: end\ndata: {}");
  EXPECT_EQ(EventText(*watch.route, event.SerializeAsString()),
            "id: 7\nevent: stateChange\ndata: {\"sequence\":\"7\",\"stateChange\":{\"detail\":\"a\\n\\nevent: "
            "end\\ndata: {}\"}}\n\n");
  EXPECT_THAT(*EventText(*run.route, event.SerializeAsString()), StartsWith("event: stateChange\n"));
  event.mutable_heartbeat();
  EXPECT_EQ(EventText(*watch.route, event.SerializeAsString()), ": heartbeat\n\n");
  EXPECT_EQ(EventText(*watch.route, "\xff"), std::nullopt);
  EXPECT_EQ(EndText(""), "event: end\ndata: {}\n\n");
}

TEST(Json, TextsAreCutAndPlain) {
  EXPECT_EQ(PlainText("a\nb\x01\xff\n^"), "a b??");
  EXPECT_THAT(PlainText(std::string(5000, 'x')), AllOf(EndsWith("x…"), testing::SizeIs(testing::Lt(1010u))));
  EXPECT_EQ(JsonString("a\"\\\n"), "\"a\\\"\\\\\\u000a\"");
}

}  // namespace
}  // namespace rollgait::server
