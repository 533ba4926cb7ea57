#include "client/failure.h"

#include <gmock/gmock.h>
#include <google/rpc/error_details.pb.h>
#include <google/rpc/status.pb.h>
#include <gtest/gtest.h>

namespace rollgait::client {
namespace {

TEST(ExitCodeTest, OfFinishedSolves) {
  v1::Solve solve;
  EXPECT_EQ(ExitCodeOf(solve), ExitCode::kInternal);
  solve.set_state(v1::SOLVE_STATE_SUCCEEDED);
  const auto code = [&solve](v1::Termination termination) {
    solve.mutable_result()->set_termination(termination);
    return ExitCodeOf(solve);
  };
  EXPECT_EQ(code(v1::TERMINATION_OPTIMAL), ExitCode::kSuccess);
  EXPECT_EQ(code(v1::TERMINATION_ACCEPTABLE), ExitCode::kSuccess);
  const auto judged = [&](v1::Termination termination, v1::Verdict verdict) {
    solve.mutable_result()->mutable_accuracy()->set_verdict(verdict);
    const ExitCode ended = code(termination);
    solve.mutable_result()->clear_accuracy();
    return ended;
  };
  for (const v1::Termination termination : {v1::TERMINATION_OPTIMAL, v1::TERMINATION_ACCEPTABLE}) {
    EXPECT_EQ(judged(termination, v1::VERDICT_WITHIN), ExitCode::kSuccess);
    EXPECT_EQ(judged(termination, v1::VERDICT_NOT_JUDGED), ExitCode::kSuccess);
    EXPECT_EQ(judged(termination, v1::VERDICT_EXCEEDED), ExitCode::kMissesBound);
  }
  EXPECT_EQ(static_cast<int>(ExitCode::kMissesBound), 8) << "a contract with scripts";
  EXPECT_EQ(judged(v1::TERMINATION_INFEASIBLE, v1::VERDICT_EXCEEDED), ExitCode::kNoSolution);
  EXPECT_EQ(code(v1::TERMINATION_INFEASIBLE), ExitCode::kNoSolution);
  EXPECT_EQ(code(v1::TERMINATION_ITERATION_LIMIT), ExitCode::kNoSolution);
  EXPECT_EQ(code(v1::TERMINATION_TIME_LIMIT), ExitCode::kNoSolution);
  EXPECT_EQ(judged(v1::TERMINATION_TIME_LIMIT, v1::VERDICT_WITHIN), ExitCode::kSuccess);
  EXPECT_EQ(judged(v1::TERMINATION_TIME_LIMIT, v1::VERDICT_EXCEEDED), ExitCode::kMissesBound);
  EXPECT_EQ(judged(v1::TERMINATION_TIME_LIMIT, v1::VERDICT_NOT_JUDGED), ExitCode::kNoSolution);
  solve.mutable_result()->add_unmet_constraints()->set_name("power smoothing");
  EXPECT_EQ(judged(v1::TERMINATION_TIME_LIMIT, v1::VERDICT_WITHIN), ExitCode::kNoSolution) << "of another problem";
  solve.mutable_result()->clear_unmet_constraints();
  solve.mutable_spec()->mutable_accuracy()->mutable_max_error()->set_objective(1e-3);
  EXPECT_EQ(judged(v1::TERMINATION_TIME_LIMIT, v1::VERDICT_WITHIN), ExitCode::kMissesBound) << "no estimate";
  solve.clear_spec();
  EXPECT_EQ(code(v1::TERMINATION_NUMERICAL_DIFFICULTY), ExitCode::kNoSolution);
  EXPECT_EQ(code(v1::TERMINATION_CANCELLED), ExitCode::kCancelled);
  solve.set_state(v1::SOLVE_STATE_FAILED);
  EXPECT_EQ(ExitCodeOf(solve), ExitCode::kRunFailed);
  solve.set_state(v1::SOLVE_STATE_CANCELLED);
  EXPECT_EQ(ExitCodeOf(solve), ExitCode::kCancelled);
}

TEST(ExitCodeTest, AnErrorThatIsNotReachedIsAMissedBound) {
  v1::Solve solve;
  solve.set_state(v1::SOLVE_STATE_SUCCEEDED);
  solve.mutable_result()->set_termination(v1::TERMINATION_OPTIMAL);
  solve.mutable_result()->mutable_accuracy()->set_verdict(v1::VERDICT_WITHIN);
  solve.mutable_result()->mutable_errors()->set_objective(0.5);
  EXPECT_EQ(ExitCodeOf(solve), ExitCode::kSuccess) << "none was asked for";
  solve.mutable_spec()->mutable_accuracy()->mutable_max_error()->set_objective(0.1);
  solve.mutable_result()->mutable_errors()->set_within_max_error(false);
  EXPECT_EQ(ExitCodeOf(solve), ExitCode::kMissesBound);
  EXPECT_TRUE(HasSolution(solve));
  solve.mutable_result()->mutable_errors()->set_within_max_error(true);
  EXPECT_EQ(ExitCodeOf(solve), ExitCode::kSuccess);
  solve.mutable_result()->clear_errors();
  EXPECT_EQ(ExitCodeOf(solve), ExitCode::kMissesBound) << "no estimate";
}

TEST(ExitCodeTest, OfCalls) {
  const auto code = [](grpc::StatusCode status) { return ExitCodeOf(grpc::Status(status, "")); };
  EXPECT_EQ(code(grpc::StatusCode::OK), ExitCode::kSuccess);
  EXPECT_EQ(code(grpc::StatusCode::INVALID_ARGUMENT), ExitCode::kUsage);
  EXPECT_EQ(code(grpc::StatusCode::UNAVAILABLE), ExitCode::kUnreachable);
  EXPECT_EQ(code(grpc::StatusCode::DEADLINE_EXCEEDED), ExitCode::kUnreachable);
  EXPECT_EQ(code(grpc::StatusCode::RESOURCE_EXHAUSTED), ExitCode::kUnreachable);
  EXPECT_EQ(code(grpc::StatusCode::NOT_FOUND), ExitCode::kNotFound);
  EXPECT_EQ(code(grpc::StatusCode::CANCELLED), ExitCode::kCancelled);
  EXPECT_EQ(code(grpc::StatusCode::INTERNAL), ExitCode::kInternal);
}

// The server's message is its first violation, and how many more there are.
TEST(DescribeTest, ARefusalIsSaidOnce) {
  google::rpc::BadRequest refused;
  refused.add_field_violations()->set_field("spec.starts");
  refused.mutable_field_violations(0)->set_description("2 is outside its range");
  refused.add_field_violations()->set_field("spec.slope");
  refused.mutable_field_violations(1)->set_description("is not a number");
  google::rpc::Status rich;
  rich.add_details()->PackFrom(refused);
  const auto text = [&rich](const std::string& message) {
    return Describe(grpc::Status(grpc::StatusCode::INVALID_ARGUMENT, message, rich.SerializeAsString()),
                    "create the solve", "host:1");
  };
  EXPECT_THAT(text("spec.starts 2 is outside its range (and 1 more)"),
              testing::StartsWith("cannot create the solve: INVALID_ARGUMENT\n  spec.starts: 2 is outside its range\n"
                                  "  spec.slope: is not a number\n"));
  EXPECT_THAT(text("the batch has another tenant's solve"),
              testing::StartsWith("cannot create the solve: INVALID_ARGUMENT: the batch has another tenant's solve\n"));
}

TEST(DescribeTest, ShowsEveryDetail) {
  google::rpc::RetryInfo retry;
  retry.mutable_retry_delay()->set_seconds(2);
  retry.mutable_retry_delay()->set_nanos(500000000);
  google::rpc::QuotaFailure quota;
  quota.add_violations()->set_subject("queue");
  quota.mutable_violations(0)->set_description("holds 1000 solves, the limit is 1000");
  google::rpc::Status rich;
  rich.add_details()->PackFrom(retry);
  rich.add_details()->PackFrom(quota);
  const grpc::Status status(grpc::StatusCode::RESOURCE_EXHAUSTED, "the queue is full", rich.SerializeAsString());
  const std::string text = Describe(status, "create the solve", "host:1");
  EXPECT_THAT(text, testing::StartsWith("cannot create the solve: RESOURCE_EXHAUSTED: the queue is full\n"));
  EXPECT_THAT(text, testing::HasSubstr("try again in 2.5 s"));
  EXPECT_EQ(RetryDelay(status), 2.5);
  EXPECT_THAT(text, testing::HasSubstr("\n  queue: holds 1000 solves, the limit is 1000"));
}

TEST(DescribeTest, DetailsThatAreNotAStatusAreIgnored) {
  const grpc::Status status(grpc::StatusCode::INVALID_ARGUMENT, "no", "\xff\xff garbage");
  EXPECT_THAT(Describe(status, "x", "host:1"), testing::StartsWith("cannot x: INVALID_ARGUMENT: no\n"));
  EXPECT_EQ(RetryDelay(status), std::nullopt);
}

TEST(FailureTest, WhatTlsRefusesIsSaidInWords) {
  const auto text = [](const std::string& message) {
    return Describe({grpc::StatusCode::UNAVAILABLE, message}, "ask the server", "gait.example:50051");
  };
  EXPECT_NE(text("Ssl handshake failed: error:0A000086:SSL routines::certificate verify failed").find("--tls-ca"),
            std::string::npos);
  EXPECT_NE(text("error:0A00010B:SSL routines::wrong version number").find("does not speak TLS"), std::string::npos);
  EXPECT_NE(text("Peer name gait.example is not in peer certificate").find("another name"), std::string::npos);
  EXPECT_NE(text("Socket closed").find("If it speaks TLS"), std::string::npos);
  EXPECT_NE(text("Connection refused").find("Is a server running"), std::string::npos);
}

}  // namespace
}  // namespace rollgait::client
