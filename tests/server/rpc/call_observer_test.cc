#include "server/rpc/call_observer.h"

#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <thread>

#include "server/base/logging.h"
#include "server/base/trace_context.h"
#include "server/rpc/call_record.h"
#include "tests/server/rpc/rpc_bench.h"
#include "tests/support/scrape.h"

namespace rollgait::server {
namespace {

RpcOptions With(Metrics& metrics) {
  RpcOptions options;
  options.metrics = &metrics;
  return options;
}

// A server that is observed, and what its metrics say.
class CallObserverTest : public testing::Test {
 protected:
  CallObserverTest() : address_(metrics_.Listen("127.0.0.1:0").value()), bench_(With(metrics_)) {}

  double Sample(const std::string& name, const std::string& method, const std::string& type,
                const std::string& code = "") {
    const std::string first = code.empty() ? "" : "grpc_code=\"" + code + "\",";
    const std::string service = method == "unknown" ? "unknown" : "rollgait.v1.GaitService";
    const std::string key = name + "{" + first + "grpc_method=\"" + method + "\",grpc_service=\"" + service +
                            "\",grpc_type=\"" + type + "\"}";
    const auto samples = ParseExposition(Scrape(address_));
    return samples.contains(key) ? samples.at(key) : -1;
  }
  // A call is counted once its status is on its way, which may be after the client has it.
  void ExpectSoon(double expected, const std::string& name, const std::string& method, const std::string& type,
                  const std::string& code = "") {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    double seen = -2;
    while ((seen = Sample(name, method, type, code)) != expected && std::chrono::steady_clock::now() < limit) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(seen, expected) << name << " " << method << " " << code;
  }

  Metrics metrics_{"tester", "", ""};
  const std::string address_;
  RpcBench bench_;
};

TEST_F(CallObserverTest, CountsCallsByMethodAndCode) {
  EXPECT_EQ(Sample("grpc_server_started_total", "GetSolve", "unary"), 0);
  for (int i = 0; i < 3; ++i) {
    grpc::ClientContext context;
    v1::GetSolveRequest request;
    request.set_name("solves/none");
    v1::Solve solve;
    EXPECT_EQ(bench_.stub().GetSolve(&context, request, &solve).error_code(), grpc::StatusCode::NOT_FOUND);
  }
  ExpectSoon(3, "grpc_server_handled_total", "GetSolve", "unary", "NotFound");
  ExpectSoon(0, "grpc_server_handled_total", "GetSolve", "unary", "OK");
  ExpectSoon(3, "grpc_server_started_total", "GetSolve", "unary");
  ExpectSoon(3, "grpc_server_msg_received_total", "GetSolve", "unary");
  ExpectSoon(0, "grpc_server_msg_sent_total", "GetSolve", "unary");
  ExpectSoon(3, "grpc_server_handling_seconds_count", "GetSolve", "unary");
}

TEST_F(CallObserverTest, CountsTheMessagesOfAStream) {
  const std::string id = bench_.bench().Create();
  bench_.bench().AppendIterations(bench_.bench().Claim(), 0, 5);
  grpc::ClientContext context;
  v1::WatchSolveRequest request;
  request.set_name("solves/" + id);
  auto reader = bench_.stub().WatchSolve(&context, request);
  v1::SolveEvent event;
  while (reader->Read(&event) && event.sequence() < 7) {  // queued, running, five iterations
  }
  context.TryCancel();
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::CANCELLED);
  ExpectSoon(7, "grpc_server_msg_sent_total", "WatchSolve", "server_stream");
  ExpectSoon(1, "grpc_server_handled_total", "WatchSolve", "server_stream", "Canceled");
}

TEST_F(CallObserverTest, InventedMethodsMakeNoSeries) {
  const size_t before = ParseExposition(Scrape(address_)).size();
  for (int i = 0; i < 20; ++i) {
    grpc::GenericStub stub(bench_.channel());
    grpc::ClientContext context;
    grpc::CompletionQueue queue;
    auto call =
        stub.PrepareUnaryCall(&context, "/invented.Service/Method" + std::to_string(i), grpc::ByteBuffer(), &queue);
    call->StartCall();
    grpc::ByteBuffer response;
    grpc::Status status;
    call->Finish(&response, &status, nullptr);
    void* tag = nullptr;
    bool ok = false;
    queue.Next(&tag, &ok);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::UNIMPLEMENTED);
  }
  EXPECT_LE(ParseExposition(Scrape(address_)).size(), before + 1);  // at most unknown/Unimplemented is new
}

TEST_F(CallObserverTest, BytesThatAreNoRequestAreRefusedWithAWord) {
  for (const std::string method : {"CreateSolve", "WatchSolve", "ListModels", "Simulate"}) {
    grpc::GenericStub stub(bench_.channel());
    grpc::ClientContext context;
    grpc::CompletionQueue queue;
    grpc::Slice slice("\xff\xff\xff\xff");
    auto call =
        stub.PrepareUnaryCall(&context, "/rollgait.v1.GaitService/" + method, grpc::ByteBuffer(&slice, 1), &queue);
    call->StartCall();
    grpc::ByteBuffer response;
    grpc::Status status;
    call->Finish(&response, &status, nullptr);
    void* tag = nullptr;
    bool ok = false;
    queue.Next(&tag, &ok);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << method;
    EXPECT_NE(status.error_message().find("not a request message of " + method), std::string::npos)
        << status.error_message();
  }
  ExpectSoon(1, "grpc_server_handled_total", "CreateSolve", "unary", "InvalidArgument");
}

TEST_F(CallObserverTest, TheRequestIdComesBack) {
  for (const std::string wish : {"mine-17", "", "with space"}) {
    grpc::ClientContext context;
    if (!wish.empty()) context.AddMetadata("x-request-id", wish);
    v1::ServerInfo info;
    ASSERT_TRUE(bench_.stub().GetServerInfo(&context, {}, &info).ok());
    const auto& metadata = context.GetServerInitialMetadata();
    const auto found = metadata.find("x-request-id");
    ASSERT_NE(found, metadata.end());
    const std::string id(found->second.data(), found->second.size());
    if (wish == "mine-17") {
      EXPECT_EQ(id, wish);
    } else {
      EXPECT_EQ(id.size(), 16u) << id;  // one of ours
    }
  }
}

TEST(CallRecordTest, IsFoundWhileTheCallLives) {
  grpc::CallbackServerContext context;  // only its address counts
  EXPECT_EQ(RecordOf(context), nullptr);
  EXPECT_TRUE(FieldsOf(context).empty());
  KeepRecord(context, std::make_shared<CallRecord>(CallRecord::Origin{"/a/B", "r", "t", "peer"}));
  RecordOf(context)->SetCaller("tenant", "token");
  RecordOf(context)->SetSolve("id");
  const LogFields expected = {{"method", "/a/B"},   {"solve", "id"},      {"request_id", "r"},
                              {"traceparent", "t"}, {"tenant", "tenant"}, {"token", "token"}};
  EXPECT_EQ(FieldsOf(context), expected);
  ForgetRecord(context);
  EXPECT_EQ(RecordOf(context), nullptr);
}

TEST(CodeNameTest, SpeaksAsGoDoes) {
  EXPECT_EQ(CodeName(grpc::StatusCode::OK), "OK");
  EXPECT_EQ(CodeName(grpc::StatusCode::CANCELLED), "Canceled");
  EXPECT_EQ(CodeName(grpc::StatusCode::RESOURCE_EXHAUSTED), "ResourceExhausted");
  EXPECT_EQ(CodeName(grpc::StatusCode::UNAUTHENTICATED), "Unauthenticated");
  EXPECT_EQ(CodeName(static_cast<grpc::StatusCode>(30)), "Unknown");
}

}  // namespace
}  // namespace rollgait::server
