#include "server/gateway/routes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "rollgait/v1/gait_service.pb.h"

namespace rollgait::server {
namespace {

using ::testing::HasSubstr;

const google::protobuf::ServiceDescriptor& Service() {
  return *v1::CreateSolveRequest::descriptor()->file()->FindServiceByName("GaitService");
}

TEST(Routes, EveryMethodHasARowAndEveryRowIsRight) {
  std::set<std::string> rows, places;
  for (const Route& route : kRoutes) {
    EXPECT_EQ(RouteProblem(route, Service()), "");
    rows.insert(route.method);
  }
  ASSERT_GT(Service().method_count(), 10);
  for (int i = 0; i < Service().method_count(); ++i) {
    const std::string name = Service().method(i)->name();
    EXPECT_EQ(rows.count(name), 1) << name << " has no row in kRoutes";
  }
  const RouteTable table;
  for (const ResolvedRoute& route : table.routes()) {
    EXPECT_TRUE(places.insert(route.route->verb + (" " + route.before) + "*" + route.after).second)
        << "two rows for " << route.DocumentPath();
    EXPECT_THAT(route.DocumentPath(), testing::StartsWith("/v1/"));
  }
}

TEST(Routes, WhatIsWrongWithARowIsSaid) {
  const auto problem = [](const Route& route) { return RouteProblem(route, Service()); };
  EXPECT_THAT(problem({"Fly", "GET", "/v1/x", ""}), HasSubstr("no method Fly"));
  EXPECT_THAT(problem({"GetSolve", "GET", "/v1/{nome=solves/*}", ""}), HasSubstr("no string nome"));
  EXPECT_THAT(problem({"ListSolves", "GET", "/v1/{page_size=solves/*}", ""}), HasSubstr("no string page_size"));
  EXPECT_THAT(problem({"GetSolve", "GET", "/v1/{name=solves}", ""}), HasSubstr("COLLECTION"));
  EXPECT_THAT(problem({"CreateModel", "POST", "/v1/models", "model_id"}), HasSubstr("no message model_id"));
  EXPECT_THAT(problem({"GetSolve", "GET", "/v1/{name=solves/*}", "", "name"}), HasSubstr("cannot go on after name"));
  EXPECT_THAT(problem({"GetSolve", "PATCH", "/v1/{name=solves/*}", ""}), HasSubstr("PATCH"));
  EXPECT_THAT(problem({"GetSolve", "GET", "/v1/{name=solves/*}", "*"}), HasSubstr("no body"));
}

struct Sent {
  const char *verb, *path, *method, *id;
};

TEST(Routes, PathsLeadToTheirCalls) {
  const RouteTable table;
  for (const Sent& sent : std::initializer_list<Sent>{{"GET", "/v1/solves", "ListSolves", ""},
                                                      {"POST", "/v1/solves", "CreateSolve", ""},
                                                      {"POST", "/v1/solves:batchCreate", "BatchCreateSolves", ""},
                                                      {"GET", "/v1/solves/abc", "GetSolve", "abc"},
                                                      {"GET", "/v1/solves/abc:watch", "WatchSolve", "abc"},
                                                      {"POST", "/v1/solves/abc:cancel", "CancelSolve", "abc"},
                                                      {"DELETE", "/v1/solves/abc", "DeleteSolve", "abc"},
                                                      {"GET", "/v1/models/a%40b", "GetModel", "a@b"},
                                                      {"GET", "/v1/solves/a%3Ab", "GetSolve", "a:b"},
                                                      {"GET", "/v1/serverInfo", "GetServerInfo", ""}}) {
    const RouteMatch match = table.Match(sent.verb, sent.path);
    ASSERT_NE(match.route, nullptr) << sent.path;
    EXPECT_STREQ(match.route->route->method, sent.method);
    EXPECT_EQ(match.id, sent.id);
  }
  EXPECT_EQ(table.Match("GET", "/v1/solves/abc").route->MethodPath(), "/rollgait.v1.GaitService/GetSolve");
  EXPECT_EQ(table.Match("POST", "/v1/solves/abc:cancel").route->DocumentPath(), "/v1/solves/{solve}:cancel");
}

TEST(Routes, OtherPathsAreNoCalls) {
  const RouteTable table;
  for (const char* path : {"",
                           "/",
                           "/v1",
                           "/v1/",
                           "/v1/solves/",
                           "/v1/solves/a/b",
                           "/v1/solves/a:fly",
                           "/v1/solves/:watch",
                           "/v1/solves/..",
                           "/v1/solves/%2e%2e",
                           "/v1/solves/a%2Fb",
                           "/v1/solves/%2E",
                           "/v1/solves/%",
                           "/v1/solves/%4",
                           "/v1/solves/%zz",
                           "/v1/solves/%00",
                           "/v1/solves/%0a",
                           "/v1/solves/%ff",
                           "/v1/solves/%c0%ae",
                           "/v2/solves",
                           "//v1/solves",
                           "/v1/Solves"}) {
    const RouteMatch match = table.Match("GET", path);
    EXPECT_EQ(match.route, nullptr) << path;
    EXPECT_EQ(match.allowed, "") << path;
  }
}

TEST(Routes, AnotherVerbIsToldWhichThereAre) {
  const RouteTable table;
  const RouteMatch match = table.Match("PUT", "/v1/solves/abc");
  EXPECT_EQ(match.route, nullptr);
  EXPECT_EQ(match.allowed, "GET, HEAD, DELETE");
  EXPECT_EQ(table.Match("PUT", "/v1/solves/abc:watch").allowed, "GET");
}

TEST(Routes, HeadIsAnsweredWhereGetIsButByNoStream) {
  const RouteTable table;
  EXPECT_STREQ(table.Match("HEAD", "/v1/solves/abc").route->route->method, "GetSolve");
  EXPECT_EQ(table.Match("HEAD", "/v1/solves/abc:watch").route, nullptr);
  EXPECT_EQ(table.Match("HEAD", "/v1/solves:run").route, nullptr);
}

TEST(Routes, PercentSignsAreDecodedOnce) {
  std::string text;
  EXPECT_TRUE(DecodePercent("a%2541+b", false, &text));
  EXPECT_EQ(text, "a%41+b");
  EXPECT_TRUE(DecodePercent("a+%C3%A9", true, &text));
  EXPECT_EQ(text, "a é");
  for (const char* wrong : {"%", "%1", "a%", "%g1", "%1g", "%+1", "%7f", "%ED%A0%80"}) {
    EXPECT_FALSE(DecodePercent(wrong, false, &text)) << wrong;
  }
}

}  // namespace
}  // namespace rollgait::server
