// Several rollgaitd and agents on one PostgreSQL, with a solver that takes its time.
#include <gtest/gtest.h>
#include <signal.h>

#include <memory>

#include "tests/e2e/daemon.h"
#include "tests/e2e/far_agent.h"
#include "tests/e2e/watching.h"
#include "tests/server/store/temporary_directory.h"
#include "tests/support/postgres_cluster.h"

namespace rollgait::server {
namespace {

using Stub = v1::GaitService::Stub;

std::string Create(Stub& stub, int iterations) {
  v1::SolveSpec spec;
  spec.mutable_model()->set_name("planar");
  spec.mutable_solver_limits()->set_max_iterations(iterations);
  return CreateSolve(stub, spec).name();
}

class PostgresTest : public testing::Test {
 protected:
  std::unique_ptr<Daemon> Start(const std::string& name) {
    Daemon::Options options;
    options.data_dir = Directory(name);
    options.solver = SLOW_SOLVER;
    options.flags = {"--store", cluster_.Url(), "--log-level", "error"};
    return std::make_unique<Daemon>(options);
  }
  std::string Directory(const std::string& name) const { return directory_.path() + "/" + name; }

  PostgresCluster cluster_;
  TemporaryDirectory directory_;
};

TEST_F(PostgresTest, SeveralServersServeTheSameSolves) {
  const auto one = Start("one"), two = Start("two");
  ASSERT_NE(one->address(), "");
  ASSERT_NE(two->address(), "");
  EXPECT_TRUE(AgentsOf(Directory("one")).empty()) << "with PostgreSQL a server brings no agent by itself";
  FarAgent agent(cluster_.Url(), Directory("agent"), SLOW_SOLVER);
  const std::string name = Create(*one->NewStub(), 40);
  Seen here, there;
  for (const auto& [server, seen] : {std::pair(&*two, &there), std::pair(&*one, &here)}) {
    const grpc::Status status = WatchOn(*server->NewStub(), name, *seen);
    EXPECT_TRUE(status.ok()) << status.error_message();
  }
  for (const Seen& seen : {here, there}) {
    EXPECT_TRUE(seen.dense);
    EXPECT_EQ(seen.iterations, 40);
    EXPECT_EQ(seen.finished.result().termination(), v1::TERMINATION_OPTIMAL);
  }
  // A cancellation by the other server reaches the solver.
  const std::string endless = Create(*one->NewStub(), 100'000);
  Seen cancelled;
  WatchOn(*one->NewStub(), endless, cancelled, Iterations(3));
  grpc::ClientContext context;
  v1::CancelSolveRequest request;
  request.set_name(endless);
  v1::Solve solve;
  ASSERT_TRUE(two->NewStub()->CancelSolve(&context, request, &solve).ok());
  EXPECT_TRUE(WatchOn(*one->NewStub(), endless, cancelled).ok());
  EXPECT_EQ(cancelled.finished.state(), v1::SOLVE_STATE_CANCELLED);
}

TEST_F(PostgresTest, TheSolvesOfADeadAgentRunElsewhereWhenTheirLeaseIsOver) {
  const auto server = Start("server");
  ASSERT_NE(server->address(), "");
  auto first = std::make_unique<FarAgent>(cluster_.Url(), Directory("first"), SLOW_SOLVER);
  const std::string name = Create(*server->NewStub(), 100);
  Seen seen;
  WatchOn(*server->NewStub(), name, seen, Iterations(10));
  first->End(SIGKILL);
  FarAgent second(cluster_.Url(), Directory("second"), SLOW_SOLVER);
  EXPECT_TRUE(WatchOn(*server->NewStub(), name, seen).ok());
  EXPECT_TRUE(seen.dense);
  EXPECT_EQ(seen.finished.state(), v1::SOLVE_STATE_SUCCEEDED);
  EXPECT_EQ(seen.finished.attempts(), 2);
}

TEST_F(PostgresTest, AnAgentThatStoodStillBeyondItsLeaseWritesNothingMore) {
  const auto server = Start("server");
  ASSERT_NE(server->address(), "");
  FarAgent first(cluster_.Url(), Directory("first"), SLOW_SOLVER);
  const std::string name = Create(*server->NewStub(), 500);
  Seen seen;
  WatchOn(*server->NewStub(), name, seen, Iterations(10));
  first.Signal(SIGSTOP);
  FarAgent second(cluster_.Url(), Directory("second"), SLOW_SOLVER);
  // The second attempt has begun: the watcher sees more than the first one can have sent.
  WatchOn(*server->NewStub(), name, seen, Iterations(seen.iterations + 30));
  first.Signal(SIGCONT);
  EXPECT_TRUE(WatchOn(*server->NewStub(), name, seen).ok());
  EXPECT_TRUE(seen.dense);
  EXPECT_EQ(seen.finished.state(), v1::SOLVE_STATE_SUCCEEDED);
  EXPECT_EQ(seen.finished.attempts(), 2);
  EXPECT_EQ(first.End(SIGTERM), 0) << "it goes on living, without that solve";
}

TEST_F(PostgresTest, SigtermGivesTheSolvesOfAnAgentBackAtOnce) {
  const auto server = Start("server");
  ASSERT_NE(server->address(), "");
  FarAgent first(cluster_.Url(), Directory("first"), SLOW_SOLVER);
  const std::string name = Create(*server->NewStub(), 60);
  Seen seen;
  WatchOn(*server->NewStub(), name, seen, Iterations(10));
  EXPECT_EQ(first.End(SIGTERM), 0);
  EXPECT_EQ(cluster_.Execute("SELECT COUNT(*) FROM solves WHERE state = 1"), "1");
  FarAgent second(cluster_.Url(), Directory("second"), SLOW_SOLVER);
  EXPECT_TRUE(WatchOn(*server->NewStub(), name, seen).ok());
  EXPECT_TRUE(seen.dense);
  EXPECT_EQ(seen.finished.attempts(), 2);
}

}  // namespace
}  // namespace rollgait::server
