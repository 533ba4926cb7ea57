#include "server/rpc/status.h"

#include <gtest/gtest.h>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace rollgait::server {
namespace {

google::rpc::Status Details(const grpc::Status& status) {
  google::rpc::Status details;
  EXPECT_TRUE(details.ParseFromString(status.error_details()));
  return details;
}

TEST(ToStatusTest, ViolationsAreBadRequestDetails) {
  const grpc::Status status = ToStatus({ErrorCode::kInvalidArgument, "two things", {{"a.b", "is 7"}, {"c", "is 8"}}});
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(status.error_message(), "two things");
  const google::rpc::Status details = Details(status);
  EXPECT_EQ(details.code(), 3);
  ASSERT_EQ(details.details_size(), 1);
  google::rpc::BadRequest bad_request;
  ASSERT_TRUE(details.details(0).UnpackTo(&bad_request));
  ASSERT_EQ(bad_request.field_violations_size(), 2);
  EXPECT_EQ(bad_request.field_violations(0).field(), "a.b");
  EXPECT_EQ(bad_request.field_violations(1).description(), "is 8");
}

TEST(ToStatusTest, ATimeToTryAgainIsRetryInfo) {
  const grpc::Status status = ToStatus({ErrorCode::kResourceExhausted, "full", {}, std::chrono::milliseconds(1500)});
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  google::rpc::RetryInfo retry;
  ASSERT_TRUE(Details(status).details(0).UnpackTo(&retry));
  EXPECT_EQ(retry.retry_delay().seconds(), 1);
  EXPECT_EQ(retry.retry_delay().nanos(), 500'000'000);
}

TEST(ToStatusTest, AQuotaIsNamedBesideTheTimeToTryAgain) {
  Error error{ErrorCode::kResourceExhausted, "full", {}, std::chrono::milliseconds(1500)};
  error.quota = {"tenant:acme", "2 solves are queued, the limit is 2"};
  const google::rpc::Status details = Details(ToStatus(error));
  ASSERT_EQ(details.details_size(), 2);
  google::rpc::QuotaFailure quota;
  ASSERT_TRUE(details.details(0).UnpackTo(&quota));
  EXPECT_EQ(quota.violations(0).subject(), "tenant:acme");
  EXPECT_EQ(quota.violations(0).description(), "2 solves are queued, the limit is 2");
  EXPECT_TRUE(details.details(1).Is<google::rpc::RetryInfo>());
}

TEST(ToStatusTest, WhatClientsCannotTakeIsCut) {
  Error error{ErrorCode::kInvalidArgument, std::string(100'000, 'x')};
  for (int i = 0; i < 10'000; ++i) error.violations.push_back({std::string(1000, 'f'), std::string(1000, 'm')});
  const grpc::Status status = ToStatus(error);
  EXPECT_LT(status.error_message().size(), kMaxText + 8);
  // gRPC clients take 8 KiB of headers by default; base64 makes four bytes of three.
  EXPECT_LT(status.error_message().size() + status.error_details().size() * 4 / 3, 8192u);
  EXPECT_EQ(status.error_details().find(std::string(kMaxText + 1, 'f')), std::string::npos);
}

TEST(ToStatusTest, TextsBecomeValidUtf8WithoutControlCharacters) {
  const grpc::Status status = ToStatus({ErrorCode::kNotFound, "ok \xc3\xa9 bad \xff\xc3 esc \x1b[31m"});
  EXPECT_EQ(status.error_message(), "ok \xc3\xa9 bad ?? esc ?[31m");
  EXPECT_EQ(status.error_details(), "");
  std::string long_text(kMaxText - 1, 'a');
  long_text += "\xc3\xa9";  // would be cut in its middle
  const std::string cut = ToStatus({ErrorCode::kNotFound, long_text}).error_message();
  EXPECT_EQ(cut, std::string(kMaxText - 1, 'a') + "…");
}

TEST(ToStatusTest, EveryCodeHasAStatus) {
  EXPECT_EQ(ToStatus({ErrorCode::kNotFound, ""}).error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(ToStatus({ErrorCode::kAlreadyExists, ""}).error_code(), grpc::StatusCode::ALREADY_EXISTS);
  EXPECT_EQ(ToStatus({ErrorCode::kFailedPrecondition, ""}).error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(ToStatus({ErrorCode::kOutOfRange, ""}).error_code(), grpc::StatusCode::OUT_OF_RANGE);
  EXPECT_EQ(ToStatus({ErrorCode::kUnauthenticated, ""}).error_code(), grpc::StatusCode::UNAUTHENTICATED);
  EXPECT_EQ(ToStatus({ErrorCode::kPermissionDenied, ""}).error_code(), grpc::StatusCode::PERMISSION_DENIED);
  EXPECT_EQ(ToStatus({ErrorCode::kUnavailable, ""}).error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(ToStatus({ErrorCode::kInternal, ""}).error_code(), grpc::StatusCode::INTERNAL);
  EXPECT_EQ(ToStatus({ErrorCode::kLeaseLost, ""}).error_code(), grpc::StatusCode::INTERNAL);
}

}  // namespace
}  // namespace rollgait::server
