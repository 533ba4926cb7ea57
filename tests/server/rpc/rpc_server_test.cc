#include "server/rpc/rpc_server.h"

#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/server/rpc/rpc_bench.h"

namespace rollgait::server {
namespace {

grpc::Status Create(RpcBench& bench, const v1::SolveSpec& spec, v1::Solve* solve) {
  grpc::ClientContext context;
  v1::CreateSolveRequest request;
  *request.mutable_spec() = spec;
  return bench.stub().CreateSolve(&context, request, solve);
}

// A unary call with hand-made bytes.
grpc::Status CallRaw(RpcBench& bench, const std::string& method, const std::string& bytes, std::string* answer) {
  grpc::GenericStub stub(bench.channel());
  grpc::ClientContext context;
  grpc::CompletionQueue queue;
  grpc::Slice slice(bytes);
  auto call = stub.PrepareUnaryCall(&context, method, grpc::ByteBuffer(&slice, 1), &queue);
  call->StartCall();
  grpc::ByteBuffer response;
  grpc::Status status;
  call->Finish(&response, &status, nullptr);
  void* tag = nullptr;
  bool ok = false;
  queue.Next(&tag, &ok);
  grpc::Slice flat;
  if (status.ok() && response.DumpToSingleSlice(&flat).ok()) {
    answer->assign(reinterpret_cast<const char*>(flat.begin()), flat.size());
  }
  return status;
}

TEST(RpcServerTest, EveryUnaryMethodAnswers) {
  RpcBench bench;
  v1::Solve solve;
  ASSERT_TRUE(Create(bench, PlanarSpec(), &solve).ok());
  {
    grpc::ClientContext context;
    v1::GetSolveRequest request;
    request.set_name(solve.name());
    v1::Solve got;
    ASSERT_TRUE(bench.stub().GetSolve(&context, request, &got).ok());
    EXPECT_EQ(got.name(), solve.name());
  }
  {
    grpc::ClientContext context;
    v1::ListSolvesResponse list;
    ASSERT_TRUE(bench.stub().ListSolves(&context, {}, &list).ok());
    EXPECT_EQ(list.solves_size(), 1);
  }
  {
    grpc::ClientContext context;
    v1::CancelSolveRequest request;
    request.set_name(solve.name());
    ASSERT_TRUE(bench.stub().CancelSolve(&context, request, &solve).ok());
    EXPECT_EQ(solve.state(), v1::SOLVE_STATE_CANCELLED);
  }
  {
    grpc::ClientContext context;
    v1::DeleteSolveRequest request;
    request.set_name(solve.name());
    google::protobuf::Empty empty;
    ASSERT_TRUE(bench.stub().DeleteSolve(&context, request, &empty).ok());
    grpc::ClientContext again;
    EXPECT_EQ(bench.stub().DeleteSolve(&again, request, &empty).error_code(), grpc::StatusCode::NOT_FOUND);
  }
  {
    grpc::ClientContext context;
    v1::ListModelsResponse models;
    ASSERT_TRUE(bench.stub().ListModels(&context, {}, &models).ok());
    EXPECT_EQ(models.models(0).name(), "planar");
  }
  {
    grpc::ClientContext context;
    v1::GetModelRequest request;
    request.mutable_model()->set_name("planar");
    v1::Model model;
    EXPECT_TRUE(bench.stub().GetModel(&context, request, &model).ok());
  }
  {
    grpc::ClientContext context, second, third;
    v1::CreateModelRequest request;
    request.mutable_model()->mutable_summary()->set_name("walker");
    request.mutable_model()->add_joints()->set_mass_kg(-1);
    v1::Model model;
    const grpc::Status refused = bench.stub().CreateModel(&context, request, &model);
    EXPECT_EQ(refused.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    EXPECT_EQ(ViolatedField(refused), "model.joints[0].mass_kg");
    request.mutable_model()->mutable_joints(0)->set_mass_kg(70);
    ASSERT_TRUE(bench.stub().CreateModel(&second, request, &model).ok());
    EXPECT_EQ(model.summary().stored().name(), "models/walker@1");
    v1::DeleteModelRequest removal;
    removal.set_name("models/walker");
    google::protobuf::Empty empty;
    EXPECT_TRUE(bench.stub().DeleteModel(&third, removal, &empty).ok());
  }
  {
    grpc::ClientContext context;
    v1::ServerInfo info;
    ASSERT_TRUE(bench.stub().GetServerInfo(&context, {}, &info).ok());
    EXPECT_EQ(info.store(), "sqlite");
  }
}

TEST(RpcServerTest, RefusalsCarryTheFieldPath) {
  RpcBench bench;
  v1::Solve solve;
  const grpc::Status steep = Create(bench, PlanarSpec(3), &solve);
  EXPECT_EQ(steep.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(ViolatedField(steep), "spec.slope_rad");
  const grpc::Status infinite = Create(bench, PlanarSpec(std::numeric_limits<double>::infinity()), &solve);
  EXPECT_EQ(infinite.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(ViolatedField(infinite), "spec.slope_rad");
  v1::SolveSpec strange = PlanarSpec();
  strange.set_cycle(static_cast<v1::Cycle>(99));
  EXPECT_EQ(ViolatedField(Create(bench, strange, &solve)), "spec.cycle");
}

TEST(RpcServerTest, OversizeRequestsAreRefusedByName) {
  RpcBench bench;
  v1::SolveSpec large = PlanarSpec();
  auto* channel = large.add_costs()->mutable_tracking()->add_channels();
  channel->mutable_positions()->Resize(5 * (1 << 20) / 8, 0.5);
  v1::Solve solve;
  const grpc::Status status = Create(bench, large, &solve);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(ViolatedField(status), "spec");
  EXPECT_NE(status.error_message().find("4194304"), std::string::npos) << status.error_message();
}

TEST(RpcServerTest, AFullQueueSaysWhenToTryAgain) {
  ServiceOptions options;
  options.max_queued = 1;
  RpcBench bench({}, options);
  v1::Solve solve;
  ASSERT_TRUE(Create(bench, PlanarSpec(0.1), &solve).ok());
  const grpc::Status status = Create(bench, PlanarSpec(0.2), &solve);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  google::rpc::Status details;
  google::rpc::RetryInfo retry;
  ASSERT_TRUE(details.ParseFromString(status.error_details()));
  ASSERT_EQ(details.details_size(), 1);
  ASSERT_TRUE(details.details(0).UnpackTo(&retry));
  EXPECT_GT(retry.retry_delay().seconds(), 0);
}

TEST(RpcServerTest, TooManyWaitingCallsAreRefusedAndTheServerGoesOn) {
  RpcOptions options;
  options.max_waiting_calls = 0;
  RpcBench bench(options);
  v1::Solve solve;
  EXPECT_EQ(Create(bench, PlanarSpec(), &solve).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  grpc::ClientContext context;
  v1::RunSolveRequest request;
  auto stream = bench.stub().RunSolve(&context, request);
  v1::SolveEvent event;
  EXPECT_FALSE(stream->Read(&event));
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
}

TEST(RpcServerTest, HealthIsServing) {
  RpcBench bench;
  // grpc.health.v1.HealthCheckRequest{service} and HealthCheckResponse{status}, field 1 each; SERVING is 1.
  for (const std::string& service : {std::string(), std::string("rollgait.v1.GaitService")}) {
    std::string request;
    if (!service.empty()) request = std::string("\x0a") + static_cast<char>(service.size()) + service;
    std::string answer;
    ASSERT_TRUE(CallRaw(bench, "/grpc.health.v1.Health/Check", request, &answer).ok());
    EXPECT_EQ(answer, "\x08\x01");
  }
}

// A stream opened with one message of hand-made bytes; answers are read one by one.
class RawStream {
 public:
  RawStream(RpcBench& bench, const std::string& method, const std::string& bytes) : stub_(bench.channel()) {
    stream_ = stub_.PrepareCall(&context_, method, &queue_);
    stream_->StartCall(nullptr);
    Wait();
    grpc::Slice slice(bytes);
    stream_->WriteLast(grpc::ByteBuffer(&slice, 1), grpc::WriteOptions(), nullptr);
    Wait();
  }
  ~RawStream() {
    context_.TryCancel();
    grpc::Status status;
    stream_->Finish(&status, nullptr);
    Wait();
  }
  // Empty at the end of the stream.
  std::string Read() {
    grpc::ByteBuffer buffer;
    stream_->Read(&buffer, nullptr);
    grpc::Slice flat;
    if (!Wait() || !buffer.DumpToSingleSlice(&flat).ok()) return "";
    return {reinterpret_cast<const char*>(flat.begin()), flat.size()};
  }

 private:
  bool Wait() {
    void* tag = nullptr;
    bool ok = false;
    return queue_.Next(&tag, &ok) && ok;
  }

  grpc::GenericStub stub_;
  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
  std::unique_ptr<grpc::GenericClientAsyncReaderWriter> stream_;
};

TEST(RpcServerTest, HealthSaysNotServingWhenTheServerStops) {
  RpcBench bench;
  RawStream health(bench, "/grpc.health.v1.Health/Watch", "");
  EXPECT_EQ(health.Read(), "\x08\x01");
  bench.server().Stop(std::chrono::seconds(5));
  EXPECT_EQ(health.Read(), "\x08\x02");
}

TEST(RpcServerTest, ReflectionListsTheService) {
  RpcBench bench;
  // ServerReflectionRequest{list_services: "*"}: field 7.
  RawStream reflection(bench, "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", "\x3a\x01*");
  EXPECT_NE(reflection.Read().find("rollgait.v1.GaitService"), std::string::npos);
}

TEST(RpcServerTest, GarbageIsRefusedAndTheServerGoesOn) {
  RpcBench bench;
  std::string answer;
  EXPECT_FALSE(CallRaw(bench, "/rollgait.v1.GaitService/CreateSolve", "\xff\xff\xff\xff", &answer).ok());
  EXPECT_EQ(CallRaw(bench, "/rollgait.v1.GaitService/NoSuchMethod", "", &answer).error_code(),
            grpc::StatusCode::UNIMPLEMENTED);
  v1::Solve solve;
  EXPECT_TRUE(Create(bench, PlanarSpec(), &solve).ok());
}

TEST(RpcServerTest, AnAddressInUseIsReported) {
  RpcBench bench;
  ServiceBench other;
  RpcOptions options;
  options.listen = bench.server().address();
  Gatekeeper gatekeeper({});
  const auto second = RpcServer::Start(options, other.service(), other.hub(), gatekeeper);
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.error().code, ErrorCode::kUnavailable);
  EXPECT_NE(second.error().message.find(options.listen), std::string::npos);
}

}  // namespace
}  // namespace rollgait::server
