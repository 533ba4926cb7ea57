// Answers that clients do not read: what they may occupy.
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/server/rpc/rpc_bench.h"

namespace rollgait::server {
namespace {

constexpr int64_t kMiB = 1 << 20;

Gatekeeper::Options SmallBudget() {
  Gatekeeper::Options options;
  options.answers.connection = 5 * kMiB;
  return options;
}

// A call whose request is sent and whose answer is not read: flow control stops the server after so many bytes.
constexpr int kWindow = 64;
class UnreadCall {
 public:
  UnreadCall(RpcBench& bench, const std::string& method, const std::string& request) : stub_(Channel(bench)) {
    stream_ = stub_.PrepareCall(&context_, method, &queue_);
    stream_->StartCall(nullptr);
    Wait();
    grpc::Slice slice(request);
    stream_->WriteLast(grpc::ByteBuffer(&slice, 1), grpc::WriteOptions(), nullptr);
    Wait();
  }
  ~UnreadCall() {
    context_.TryCancel();
    if (!finished_) Finish();
  }
  // Reads to the end: how many messages there were.
  int Read() {
    int messages = 0;
    while (true) {
      grpc::ByteBuffer buffer;
      stream_->Read(&buffer, nullptr);
      if (!Wait()) return messages;
      ++messages;
    }
  }
  grpc::Status Finish() {
    finished_ = true;
    grpc::Status status;
    stream_->Finish(&status, nullptr);
    Wait();
    return status;
  }

 private:
  // All calls share one connection. A window of less than the first event of a watch.
  static std::shared_ptr<grpc::Channel> Channel(RpcBench& bench) {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
    arguments.SetInt(GRPC_ARG_HTTP2_STREAM_LOOKAHEAD_BYTES, kWindow);
    return grpc::CreateCustomChannel(bench.server().address(), grpc::InsecureChannelCredentials(), arguments);
  }
  bool Wait() {
    void* tag = nullptr;
    bool ok = false;
    return queue_.Next(&tag, &ok) && ok;
  }

  grpc::GenericStub stub_;
  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
  std::unique_ptr<grpc::GenericClientAsyncReaderWriter> stream_;
  bool finished_ = false;
};

// A finished solve with a result of one MiB; returns its name.
std::string LongSolve(RpcBench& bench) {
  const std::string id = bench.bench().Create();
  v1::SolveResult result;
  result.set_termination(v1::TERMINATION_OPTIMAL);
  result.set_message(std::string(kMiB, 'm'));
  const Lease lease = bench.bench().Claim();
  EXPECT_TRUE(
      bench.bench().store().Finish(lease, {}, {SolveState::kSucceeded, result.SerializeAsString(), "", true}).ok());
  return "solves/" + id;
}

template <typename Request>
std::string Naming(const std::string& name) {
  Request request;
  request.set_name(name);
  return request.SerializeAsString();
}

bool Eventually(const std::function<bool()>& condition) {
  for (int i = 0; i < 3000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return condition();
}

// Opens calls that are not read until one is refused, and returns them; the last one is the refused one.
std::vector<std::unique_ptr<UnreadCall>> OpenUntilRefused(RpcBench& bench, const std::string& method,
                                                          const std::string& request) {
  const auto budget = bench.gatekeeper().answers();
  std::vector<std::unique_ptr<UnreadCall>> calls;
  for (int i = 0; i < 20 && budget->refused()[AnswerBudget::kConnection] == 0; ++i) {
    const int64_t before = budget->held();
    calls.push_back(std::make_unique<UnreadCall>(bench, method, request));
    Eventually([&] { return budget->held() > before + kMiB / 2 || budget->refused()[AnswerBudget::kConnection] > 0; });
  }
  return calls;
}

TEST(AnswersTest, UnreadResultsAreBoundedAndRefusalsArePlain) {
  RpcBench bench({}, {}, std::chrono::hours(1), SmallBudget());
  const std::string name = LongSolve(bench);
  const auto budget = bench.gatekeeper().answers();
  {
    auto calls = OpenUntilRefused(bench, "/rollgait.v1.GaitService/GetSolve", Naming<v1::GetSolveRequest>(name));
    EXPECT_EQ(calls.size(), 5u) << "four results of 1 MiB and a little";
    EXPECT_LE(budget->held(), 5 * kMiB);
    EXPECT_EQ(calls.back()->Read(), 0);
    const grpc::Status refused = calls.back()->Finish();
    EXPECT_EQ(refused.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
    EXPECT_NE(refused.error_message().find("of this connection that were not read yet"), std::string::npos)
        << refused.error_message();
    grpc::ClientContext context;
    v1::ServerInfo info;
    EXPECT_TRUE(bench.stub().GetServerInfo(&context, {}, &info).ok()) << "small answers are still given";
    EXPECT_EQ(calls.front()->Read(), 1) << "an answer that is read after all is whole";
    EXPECT_TRUE(calls.front()->Finish().ok());
    EXPECT_TRUE(Eventually([&] { return budget->held() < 4 * kMiB; })) << "and gives its room back";
  }
  EXPECT_TRUE(Eventually([&] { return budget->held() == 0; })) << budget->held();
}

TEST(AnswersTest, UnreadWatchesAreBounded) {
  RpcBench bench({}, {}, std::chrono::hours(1), SmallBudget());
  const std::string name = LongSolve(bench);
  const auto budget = bench.gatekeeper().answers();
  {
    auto calls = OpenUntilRefused(bench, "/rollgait.v1.GaitService/WatchSolve", Naming<v1::WatchSolveRequest>(name));
    EXPECT_LE(calls.size(), 3u) << "each holds the event and what is written of it";
    EXPECT_LE(budget->held(), 5 * kMiB);
    calls.back()->Read();
    EXPECT_EQ(calls.back()->Finish().error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  }
  EXPECT_TRUE(Eventually([&] { return budget->held() == 0; })) << budget->held();
}

}  // namespace
}  // namespace rollgait::server
