#include "server/rpc/watch_stream.h"

#include <gtest/gtest.h>

#include <map>
#include <thread>

#include "tests/server/rpc/rpc_bench.h"

namespace rollgait::server {
namespace {

using Stream = grpc::ClientReader<v1::SolveEvent>;

std::unique_ptr<Stream> StartRun(RpcBench& bench, grpc::ClientContext* context, bool cancel_on_disconnect = false) {
  v1::RunSolveRequest request;
  *request.mutable_spec() = PlanarSpec();
  request.set_cancel_on_disconnect(cancel_on_disconnect);
  return bench.stub().RunSolve(context, request);
}

std::unique_ptr<Stream> Watch(RpcBench& bench, grpc::ClientContext* context, const std::string& name, int64_t after) {
  v1::WatchSolveRequest request;
  request.set_name(name);
  request.set_after_sequence(after);
  return bench.stub().WatchSolve(context, request);
}

// Waits until the condition holds; the bound only ends a hung test.
template <typename Condition>
bool Eventually(Condition condition) {
  for (int i = 0; i < 3000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(WatchStreamTest, RunSolveStreamsFromQueuedToFinished) {
  RpcBench bench;
  grpc::ClientContext context;
  const auto stream = StartRun(bench, &context);
  v1::SolveEvent event;
  ASSERT_TRUE(stream->Read(&event));
  EXPECT_EQ(event.sequence(), 1);
  EXPECT_EQ(event.state_change().state(), v1::SOLVE_STATE_QUEUED);
  EXPECT_EQ(event.name().rfind("solves/", 0), 0u);
  const Lease lease = bench.bench().Claim();
  bench.bench().AppendIterations(lease, 0, 2);
  for (int64_t sequence = 2; sequence <= 4; ++sequence) {
    ASSERT_TRUE(stream->Read(&event));
    EXPECT_EQ(event.sequence(), sequence);
  }
  bench.bench().Finish(lease);
  ASSERT_TRUE(stream->Read(&event));
  EXPECT_EQ(event.finished().result().termination(), v1::TERMINATION_OPTIMAL);
  EXPECT_FALSE(stream->Read(&event));
  EXPECT_TRUE(stream->Finish().ok());
}

TEST(WatchStreamTest, WatchResumesAfterANumber) {
  RpcBench bench;
  const std::string id = bench.bench().Create();
  const Lease lease = bench.bench().Claim();
  bench.bench().AppendIterations(lease, 0, 5);
  bench.bench().Finish(lease);
  grpc::ClientContext context;
  const auto stream = Watch(bench, &context, "solves/" + id, 4);
  v1::SolveEvent event;
  for (int64_t sequence = 5; sequence <= 8; ++sequence) {
    ASSERT_TRUE(stream->Read(&event));
    EXPECT_EQ(event.sequence(), sequence);
  }
  EXPECT_TRUE(event.has_finished());
  EXPECT_FALSE(stream->Read(&event));
  EXPECT_TRUE(stream->Finish().ok());
}

TEST(WatchStreamTest, OneStreamCarriesManySolvesAndGoesOnWhereItBroke) {
  RpcBench bench;
  v1::BatchCreateSolvesRequest batch;
  constexpr int kSolves = 20;
  for (int i = 0; i < kSolves; ++i) {
    *batch.add_requests()->mutable_spec() = PlanarSpec(0.01 * i);
    (*batch.mutable_requests(i)->mutable_labels())["sweep"] = "s";
  }
  v1::BatchCreateSolvesResponse made;
  {
    grpc::ClientContext context;
    ASSERT_TRUE(bench.stub().BatchCreateSolves(&context, batch, &made).ok());
  }
  ASSERT_EQ(made.solves_size(), kSolves);
  v1::WatchSolvesRequest request;
  (*request.mutable_labels())["sweep"] = "s";
  std::map<std::string, int64_t> read;  // the newest number of each
  v1::SolveEvent event;
  {
    grpc::ClientContext context;
    const auto stream = bench.stub().WatchSolves(&context, request);
    while (read.size() < kSolves && stream->Read(&event)) read[event.name()] = event.sequence();
    context.TryCancel();
    stream->Finish();
  }
  ASSERT_EQ(read.size(), static_cast<size_t>(kSolves));
  request.clear_labels();
  for (const auto& [name, sequence] : read) {
    request.add_solves()->set_name(name);
    request.mutable_solves()->rbegin()->set_after_sequence(sequence);
  }
  grpc::ClientContext context;
  const auto stream = bench.stub().WatchSolves(&context, request);
  for (int i = 0; i < kSolves; ++i) {
    const Lease lease = bench.bench().Claim();
    bench.bench().AppendIterations(lease, 0, 3);
    bench.bench().Finish(lease);
  }
  int finished = 0;
  while (stream->Read(&event)) {
    EXPECT_EQ(event.sequence(), read[event.name()] + 1) << event.name();
    read[event.name()] = event.sequence();
    if (event.has_finished()) ++finished;
  }
  EXPECT_TRUE(stream->Finish().ok());
  EXPECT_EQ(finished, kSolves);
  request.mutable_solves(3)->set_name("solves/none");
  grpc::ClientContext unknown;
  const auto refused = bench.stub().WatchSolves(&unknown, request);
  EXPECT_FALSE(refused->Read(&event));
  const grpc::Status status = refused->Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_NE(status.error_message().find("solves/none"), std::string::npos) << status.error_message();
}

TEST(WatchStreamTest, ABatchCountsAsManyCreations) {
  Gatekeeper::Options gate;
  gate.limits.creates_per_s = 1;
  RpcBench bench({}, {}, std::chrono::hours(1), gate);
  v1::BatchCreateSolvesRequest batch;
  for (int i = 0; i < 10; ++i) *batch.add_requests()->mutable_spec() = PlanarSpec(0.01 * i);
  v1::BatchCreateSolvesResponse made;
  grpc::ClientContext first, second;
  ASSERT_TRUE(bench.stub().BatchCreateSolves(&first, batch, &made).ok());
  EXPECT_EQ(bench.stub().BatchCreateSolves(&second, batch, &made).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED)
      << "the bucket held two";
}

TEST(WatchStreamTest, ABatchThatAttachesCountsAsOneCreation) {
  Gatekeeper::Options gate;
  gate.limits.creates_per_s = 1;
  RpcBench bench({}, {}, std::chrono::hours(1), gate);
  v1::BatchCreateSolvesRequest batch, further;
  for (int i = 0; i < 100; ++i) {
    *batch.add_requests()->mutable_spec() = PlanarSpec(0.001 * i);
    batch.mutable_requests(i)->set_request_id("slope " + std::to_string(i));
  }
  *further.add_requests()->mutable_spec() = PlanarSpec(0.3);
  const v1::BatchCreateSolvesResponse before = bench.bench().service().BatchCreateSolves({}, batch).value();
  v1::BatchCreateSolvesResponse made;
  grpc::ClientContext first, second;
  ASSERT_TRUE(bench.stub().BatchCreateSolves(&first, batch, &made).ok());
  EXPECT_EQ(made.solves(99).name(), before.solves(99).name());
  const grpc::Status status = bench.stub().BatchCreateSolves(&second, further, &made);
  EXPECT_TRUE(status.ok()) << status.error_message();
}

TEST(WatchStreamTest, BadPlacesHaveTheirCodes) {
  RpcBench bench;
  const std::string id = bench.bench().Create();
  v1::SolveEvent event;
  grpc::ClientContext beyond, unknown, malformed;
  auto stream = Watch(bench, &beyond, "solves/" + id, 2);
  EXPECT_FALSE(stream->Read(&event));
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::OUT_OF_RANGE);
  stream = Watch(bench, &unknown, "solves/none", 0);
  EXPECT_FALSE(stream->Read(&event));
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::NOT_FOUND);
  v1::RunSolveRequest request;
  stream = bench.stub().RunSolve(&malformed, request);
  EXPECT_FALSE(stream->Read(&event));
  const grpc::Status status = stream->Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(ViolatedField(status), "spec");
}

TEST(WatchStreamTest, IteratesComeToAClientThatAsksAndNoMoreThanFourASecond) {
  RpcBench bench;
  ASSERT_TRUE(bench.bench().iterates().MakeDirectory().ok());
  const std::string id = bench.bench().Create();
  const Lease lease = bench.bench().Claim();
  v1::Iterate iterate;
  iterate.set_index(3);
  ASSERT_TRUE(bench.bench().iterates().Put(id, iterate.SerializeAsString()).ok());
  v1::WatchSolveRequest request;
  request.set_name("solves/" + id);
  v1::SolveEvent event;
  for (const int refused : {-1, 5}) {
    request.set_iterates_per_second(refused);
    grpc::ClientContext context;
    const auto stream = bench.stub().WatchSolve(&context, request);
    EXPECT_FALSE(stream->Read(&event));
    const grpc::Status status = stream->Finish();
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    EXPECT_EQ(ViolatedField(status), "iterates_per_second");
  }
  request.set_iterates_per_second(4);
  grpc::ClientContext context;
  const auto stream = bench.stub().WatchSolve(&context, request);
  do {
    ASSERT_TRUE(stream->Read(&event));
  } while (!event.has_iterate());
  EXPECT_EQ(event.iterate().index(), 3);
  bench.bench().Finish(lease);
  while (stream->Read(&event)) {
  }
  EXPECT_TRUE(event.has_finished());
  EXPECT_TRUE(stream->Finish().ok());
}

TEST(WatchStreamTest, AClientThatGoesAwayCancelsOnlyIfItSaidSo) {
  RpcBench bench;
  for (const bool cancel : {false, true}) {
    v1::SolveEvent event;
    {
      grpc::ClientContext context;
      const auto stream = StartRun(bench, &context, cancel);
      ASSERT_TRUE(stream->Read(&event));
      context.TryCancel();
      stream->Finish();
    }
    const std::string id = event.name().substr(7);
    if (cancel) {
      EXPECT_TRUE(Eventually([&] { return bench.bench().store().Get(id).value().state == SolveState::kCancelled; }));
    } else {
      EXPECT_EQ(bench.bench().store().Get(id).value().state, SolveState::kQueued);
    }
  }
}

TEST(WatchStreamTest, SlowReadersGetIterationsMergedAndAllElse) {
  RpcOptions options;
  options.slow_write = std::chrono::milliseconds(1);
  RpcBench bench(options);
  const std::string id = bench.bench().Create();
  grpc::ClientContext context;
  const auto stream = Watch(bench, &context, "solves/" + id, 0);
  v1::SolveEvent event;
  ASSERT_TRUE(stream->Read(&event));
  const Lease lease = bench.bench().Claim();
  constexpr int kIterations = 30'000;  // about 2 MB: more than the flow-control windows take
  for (int i = 0; i < kIterations; i += 1000) bench.bench().AppendIterations(lease, i, 1000);
  // Nobody reads; the server fills the windows and then waits in one write.
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  bench.bench().Finish(lease);
  int64_t previous = 1;
  int64_t iterations = 0, skipped = 0;
  bool running = false, finished = false;
  while (stream->Read(&event)) {
    EXPECT_EQ(event.sequence(), previous + event.skipped_count() + 1);
    previous = event.sequence();
    running = running || event.state_change().state() == v1::SOLVE_STATE_RUNNING;
    finished = finished || event.has_finished();
    if (event.has_iteration()) iterations += 1 + event.skipped_count();
    skipped += event.skipped_count();
  }
  EXPECT_TRUE(stream->Finish().ok());
  EXPECT_TRUE(running);
  EXPECT_TRUE(finished);
  EXPECT_EQ(iterations, kIterations);
  EXPECT_GT(skipped, 0);
}

TEST(WatchStreamTest, HeartbeatsComeInSilence) {
  RpcBench bench({}, {}, std::chrono::milliseconds(10));
  grpc::ClientContext context;
  const auto stream = StartRun(bench, &context);
  v1::SolveEvent event;
  ASSERT_TRUE(stream->Read(&event));
  ASSERT_TRUE(stream->Read(&event));
  EXPECT_TRUE(event.has_heartbeat());
  EXPECT_EQ(event.sequence(), 1);
  context.TryCancel();
}

TEST(WatchStreamTest, ManyReadersOfManySolvesMissNothing) {
  RpcBench bench;
  constexpr int kSolves = 4, kReaders = 25, kIterations = 40;
  std::vector<std::string> ids;
  for (int i = 0; i < kSolves; ++i) ids.push_back(bench.bench().Create(PlanarSpec(0.01 * i)));
  std::vector<std::thread> threads;
  std::atomic<int> complete{0};
  for (int i = 0; i < kSolves * kReaders; ++i) {
    threads.emplace_back([&, i] {
      grpc::ClientContext context;
      const auto stream = Watch(bench, &context, "solves/" + ids[static_cast<size_t>(i % kSolves)], 0);
      v1::SolveEvent event;
      int64_t previous = 0;
      bool dense = true;
      while (stream->Read(&event)) {
        dense = dense && event.sequence() == previous + event.skipped_count() + 1;
        previous = event.sequence();
      }
      if (dense && event.has_finished() && stream->Finish().ok()) ++complete;
    });
  }
  std::vector<Lease> leases;
  for (int i = 0; i < kSolves; ++i) leases.push_back(bench.bench().Claim());
  for (int k = 0; k < kIterations; ++k) {
    for (const Lease& lease : leases) bench.bench().AppendIterations(lease, k, 1);
  }
  for (const Lease& lease : leases) bench.bench().Finish(lease);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(complete, kSolves * kReaders);
}

TEST(WatchStreamTest, StoppingEndsStreamsWithUnavailableAndCancelsNothing) {
  RpcBench bench;
  grpc::ClientContext context;
  const auto stream = StartRun(bench, &context, true);
  v1::SolveEvent event;
  ASSERT_TRUE(stream->Read(&event));
  bench.server().Stop(std::chrono::seconds(5));
  EXPECT_FALSE(stream->Read(&event));
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(bench.bench().store().Get(event.name().substr(7)).value().state, SolveState::kQueued);
}

}  // namespace
}  // namespace rollgait::server
