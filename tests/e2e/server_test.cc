// The real rollgaitd and rollgait-agent as processes, with a solver that takes its time.
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <functional>
#include <thread>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "tests/e2e/daemon.h"
#include "tests/e2e/watching.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

using Stub = v1::GaitService::Stub;
using Stream = grpc::ClientReader<v1::SolveEvent>;

v1::SolveSpec Spec(int iterations, double slope = 0) {
  v1::SolveSpec spec;
  spec.mutable_model()->set_name("planar");
  spec.set_slope_rad(slope);
  spec.mutable_solver_limits()->set_max_iterations(iterations);
  return spec;
}

v1::Solve Get(Stub& stub, const std::string& name) {
  grpc::ClientContext context;
  v1::GetSolveRequest request;
  request.set_name(name);
  v1::Solve solve;
  EXPECT_TRUE(stub.GetSolve(&context, request, &solve).ok());
  return solve;
}

// Waits until the condition holds; the bound only ends a hung test.
bool Eventually(const std::function<bool()>& condition) {
  for (int i = 0; i < 6000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

class ServerTest : public testing::Test {
 protected:
  Daemon::Options Options(const std::string& listen = "127.0.0.1:0") const {
    Daemon::Options options;
    options.data_dir = directory_.path() + "/data";
    options.listen = listen;
    options.solver = SLOW_SOLVER;
    return options;
  }
  std::string data_dir() const { return directory_.path() + "/data"; }

  TemporaryDirectory directory_;
};

TEST_F(ServerTest, ASolveRunsAndAnEqualOneIsAnsweredFromTheStoreAlsoAfterARestart) {
  std::string address;
  {
    Daemon daemon(Options());
    ASSERT_NE(daemon.address(), "");
    address = daemon.address();
    const auto stub = daemon.NewStub();
    Seen seen;
    const v1::Solve solve = CreateSolve(*stub, Spec(5));
    ASSERT_TRUE(WatchOn(*stub, solve.name(), seen).ok());
    EXPECT_TRUE(seen.dense);
    EXPECT_EQ(seen.iterations, 5);
    EXPECT_EQ(seen.finished.state(), v1::SOLVE_STATE_SUCCEEDED);
    EXPECT_EQ(seen.finished.result().termination(), v1::TERMINATION_OPTIMAL);
    EXPECT_FALSE(seen.finished.from_cache());
    EXPECT_EQ(daemon.Terminate(), 0);
    EXPECT_TRUE(AgentsOf(data_dir()).empty());
  }
  Daemon daemon(Options(address));
  ASSERT_EQ(daemon.address(), address);
  const auto stub = daemon.NewStub();
  const v1::Solve again = CreateSolve(*stub, Spec(5));
  EXPECT_TRUE(again.from_cache());
  EXPECT_EQ(again.result().message(), "from the test's solver");
  EXPECT_FALSE(CreateSolve(*stub, Spec(6)).from_cache());
}

TEST_F(ServerTest, KillOfTheServerInAStreamLosesNothing) {
  auto daemon = std::make_unique<Daemon>(Options());
  ASSERT_NE(daemon->address(), "");
  const std::string address = daemon->address();
  const std::string name = CreateSolve(*daemon->NewStub(), Spec(200)).name();
  Seen seen;
  std::thread killer;
  const grpc::Status broken = WatchOn(*daemon->NewStub(), name, seen, [&](const Seen& all) {
    if (all.iterations >= 20 && !killer.joinable()) killer = std::thread([&] { daemon->Kill(); });
    return false;
  });
  killer.join();
  EXPECT_EQ(broken.error_code(), grpc::StatusCode::UNAVAILABLE);
  ASSERT_FALSE(seen.has_finished);
  const Daemon next(Options(address));
  ASSERT_EQ(next.address(), address);
  EXPECT_TRUE(WatchOn(*next.NewStub(), name, seen).ok());
  EXPECT_TRUE(seen.dense);
  EXPECT_TRUE(seen.has_finished);
  EXPECT_EQ(seen.finished.result().termination(), v1::TERMINATION_OPTIMAL);
  // The old agent went on with it: nothing was computed twice.
  EXPECT_EQ(seen.finished.attempts(), 1);
  EXPECT_EQ(seen.iterations, 200);
}

TEST_F(ServerTest, DeathOfEverythingRunsTheSolveAgainAndNumbersGoOn) {
  auto daemon = std::make_unique<Daemon>(Options());
  ASSERT_NE(daemon->address(), "");
  const std::string name = CreateSolve(*daemon->NewStub(), Spec(50)).name();
  Seen seen;
  WatchOn(*daemon->NewStub(), name, seen, [](const Seen& all) { return all.iterations >= 10; });
  daemon->Kill();
  KillAgents(data_dir());
  const Daemon next(Options());
  EXPECT_TRUE(WatchOn(*next.NewStub(), name, seen).ok());
  EXPECT_TRUE(seen.dense);
  ASSERT_TRUE(seen.has_finished);
  EXPECT_EQ(seen.finished.result().termination(), v1::TERMINATION_OPTIMAL);
  EXPECT_EQ(seen.finished.attempts(), 2);
  EXPECT_EQ(seen.states.back(), (std::pair{v1::SOLVE_STATE_RUNNING, 2}));
}

TEST_F(ServerTest, ADeadAgentIsReplacedAndItsSolveRunsAgain) {
  const Daemon daemon(Options());
  ASSERT_NE(daemon.address(), "");
  const auto stub = daemon.NewStub();
  const std::string name = CreateSolve(*stub, Spec(50)).name();
  Seen seen;
  WatchOn(*stub, name, seen, [](const Seen& all) { return all.iterations >= 10; });
  KillAgents(data_dir());
  EXPECT_TRUE(WatchOn(*stub, name, seen).ok());
  EXPECT_TRUE(seen.dense);
  EXPECT_EQ(seen.finished.state(), v1::SOLVE_STATE_SUCCEEDED);
  EXPECT_EQ(seen.finished.attempts(), 2);
}

TEST_F(ServerTest, AnAgentWithoutAServerFinishesItsSolveAndGoes) {
  auto daemon = std::make_unique<Daemon>(Options());
  ASSERT_NE(daemon->address(), "");
  const auto stub = daemon->NewStub();
  const std::string running = CreateSolve(*stub, Spec(60)).name();
  Seen seen;
  WatchOn(*stub, running, seen, [](const Seen& all) { return all.iterations >= 5; });
  ASSERT_EQ(AgentsOf(data_dir()).size(), 1u);
  daemon->Kill();
  EXPECT_TRUE(Eventually([&] { return AgentsOf(data_dir()).empty(); }));
  const Daemon next(Options());
  const v1::Solve solve = Get(*next.NewStub(), running);
  EXPECT_EQ(solve.state(), v1::SOLVE_STATE_SUCCEEDED);
  EXPECT_EQ(solve.attempts(), 1);
}

TEST_F(ServerTest, ARunningSolveIsCancelled) {
  const Daemon daemon(Options());
  ASSERT_NE(daemon.address(), "");
  const auto stub = daemon.NewStub();
  const std::string name = CreateSolve(*stub, Spec(100'000)).name();
  Seen seen;
  WatchOn(*stub, name, seen, [](const Seen& all) { return all.iterations >= 3; });
  grpc::ClientContext context;
  v1::CancelSolveRequest request;
  request.set_name(name);
  v1::Solve solve;
  ASSERT_TRUE(stub->CancelSolve(&context, request, &solve).ok());
  EXPECT_TRUE(WatchOn(*stub, name, seen).ok());
  EXPECT_TRUE(seen.dense);
  EXPECT_EQ(seen.finished.state(), v1::SOLVE_STATE_CANCELLED);
  EXPECT_EQ(seen.finished.error().kind(), v1::SolveError::KIND_CANCELLED);
}

TEST_F(ServerTest, SigtermGivesRunningSolvesBack) {
  auto daemon = std::make_unique<Daemon>(Options());
  ASSERT_NE(daemon->address(), "");
  const std::string name = CreateSolve(*daemon->NewStub(), Spec(100)).name();
  Seen seen;
  WatchOn(*daemon->NewStub(), name, seen, [](const Seen& all) { return all.iterations >= 5; });
  std::thread stopper;
  const grpc::Status ended = WatchOn(*daemon->NewStub(), name, seen, [&](const Seen& all) {
    if (all.iterations >= 10 && !stopper.joinable()) stopper = std::thread([&] { EXPECT_EQ(daemon->Terminate(), 0); });
    return false;
  });
  stopper.join();
  EXPECT_EQ(ended.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_TRUE(AgentsOf(data_dir()).empty());
  const Daemon next(Options());
  EXPECT_TRUE(WatchOn(*next.NewStub(), name, seen).ok());
  EXPECT_TRUE(seen.dense);
  EXPECT_EQ(seen.finished.state(), v1::SOLVE_STATE_SUCCEEDED);
  EXPECT_EQ(seen.finished.attempts(), 2);
}

TEST_F(ServerTest, MisuseIsRefusedBeforeAnythingStarts) {
  const Daemon daemon(Options());
  ASSERT_NE(daemon.address(), "");
  Daemon second(Options());
  EXPECT_EQ(second.address(), "");
  EXPECT_EQ(second.ExitCode(), 1);
  TemporaryDirectory other;
  Daemon::Options open = Options("0.0.0.0:0");
  open.data_dir = other.path();
  Daemon exposed(open);
  EXPECT_EQ(exposed.address(), "");
  EXPECT_EQ(exposed.ExitCode(), 1);
  Daemon::Options no_solver = Options();
  no_solver.data_dir = other.path();
  no_solver.solver = other.path() + "/none";
  Daemon lacking(no_solver);
  EXPECT_EQ(lacking.address(), "");
  EXPECT_EQ(lacking.ExitCode(), 1);
}

TEST_F(ServerTest, BadRequestsNeverReachASolver) {
  const Daemon daemon(Options());
  ASSERT_NE(daemon.address(), "");
  const auto stub = daemon.NewStub();
  const auto field_refused = [&](const std::function<void(v1::SolveSpec&)>& spoil) {
    v1::CreateSolveRequest request;
    *request.mutable_spec() = Spec(5);
    spoil(*request.mutable_spec());
    grpc::ClientContext context;
    v1::Solve solve;
    const grpc::Status status = stub->CreateSolve(&context, request, &solve);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << status.error_message();
    google::rpc::Status details;
    google::rpc::BadRequest bad;
    EXPECT_TRUE(details.ParseFromString(status.error_details()) && details.details_size() == 1 &&
                details.details(0).UnpackTo(&bad));
    return bad.field_violations_size() > 0 ? bad.field_violations(0).field() : std::string();
  };
  EXPECT_EQ(field_refused([](v1::SolveSpec& spec) { spec.mutable_model()->set_name("snake"); }), "spec.model.name");
  EXPECT_EQ(field_refused([](v1::SolveSpec& spec) { spec.set_slope_rad(1); }), "spec.slope_rad");
  EXPECT_EQ(field_refused([](v1::SolveSpec& spec) { spec.set_slope_rad(NAN); }), "spec.slope_rad");
  EXPECT_EQ(field_refused([](v1::SolveSpec& spec) { spec.mutable_phases(); }), "spec.phases.phases");
  EXPECT_EQ(field_refused([](v1::SolveSpec& spec) { spec.add_costs()->set_weight(-1); }).rfind("spec.costs[0]", 0), 0u);
  EXPECT_EQ(field_refused([](v1::SolveSpec& spec) { spec.mutable_motion()->set_speed_m_s(40); }),
            "spec.motion.speed_m_s");
  for (const int intervals : {0, 1'000'000}) {
    EXPECT_EQ(field_refused(
                  [&](v1::SolveSpec& spec) { spec.mutable_discretization()->set_single_support_intervals(intervals); }),
              "spec.discretization.single_support_intervals");
  }
  grpc::ClientContext context;
  v1::ListSolvesResponse list;
  ASSERT_TRUE(stub->ListSolves(&context, {}, &list).ok());
  EXPECT_EQ(list.solves_size(), 0);
}

}  // namespace
}  // namespace rollgait::server
