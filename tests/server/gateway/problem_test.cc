#include "server/gateway/problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace rollgait::server {
namespace {

using nlohmann::json;

TEST(Problem, EveryCodeOfGrpcHasItsStatus) {
  const int expected[] = {200, 499, 500, 400, 504, 404, 409, 403, 429, 412, 409, 400, 501, 500, 503, 500, 401};
  for (int code = 0; code <= 16; ++code) {
    EXPECT_EQ(HttpStatusOf(static_cast<grpc::StatusCode>(code)), expected[code]) << "code " << code;
  }
}

TEST(Problem, DetailsOfTheServiceComeAlong) {
  google::rpc::Status details;
  google::rpc::BadRequest bad;
  bad.add_field_violations()->set_field("spec.slope_rad");
  details.add_details()->PackFrom(bad);
  google::rpc::RetryInfo retry;
  retry.mutable_retry_delay()->set_nanos(1);
  details.add_details()->PackFrom(retry);
  details.add_details()->set_type_url("type.googleapis.com/what.nobody.Knows");
  const Problem problem =
      ProblemOf({grpc::StatusCode::RESOURCE_EXHAUSTED, "the queue \"a\" is full", details.SerializeAsString()});
  EXPECT_EQ(problem.http_status, 429);
  EXPECT_EQ(problem.retry_after_s, 1);
  const json error = json::parse(problem.json)["error"];
  EXPECT_EQ(error["code"], 429);
  EXPECT_EQ(error["status"], "RESOURCE_EXHAUSTED");
  EXPECT_EQ(error["message"], "the queue \"a\" is full");
  ASSERT_EQ(error["details"].size(), 3u);
  EXPECT_EQ(error["details"][0]["fieldViolations"][0]["field"], "spec.slope_rad");
  EXPECT_EQ(error["details"][2]["@type"], "type.googleapis.com/what.nobody.Knows");
}

TEST(Problem, WhateverAMessageHoldsIsJson) {
  const Problem problem = ProblemOf({grpc::StatusCode::INTERNAL, "\xff\n\"\\", "no status"});
  EXPECT_EQ(json::parse(problem.json)["error"]["message"], "? \"\\");
  EXPECT_EQ(json::parse(MakeProblem(404, grpc::StatusCode::NOT_FOUND, "gone").json)["error"]["status"], "NOT_FOUND");
}

}  // namespace
}  // namespace rollgait::server
