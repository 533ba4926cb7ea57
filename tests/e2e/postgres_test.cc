// Several rollgaitd and agents on one PostgreSQL, with a solver that takes its time.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <memory>

#include "tests/e2e/daemon.h"
#include "tests/server/store/temporary_directory.h"
#include "tests/support/postgres_cluster.h"

extern char** environ;

namespace rollgait::server {
namespace {

using Stub = v1::GaitService::Stub;

// A rollgait-agent as on another machine: the database is all that it has in common with the others.
class FarAgent {
 public:
  FarAgent(const std::string& url, const std::string& work_dir) {
    std::vector<std::string> arguments = {
        ROLLGAIT_AGENT, "--store",   url,         "--work-dir", work_dir,      "--slots", "2",
        "--solver",     SLOW_SOLVER, "--lease-s", "3",          "--log-level", "error"};
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    EXPECT_EQ(posix_spawn(&pid_, pointers[0], &actions, nullptr, pointers.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
  }
  ~FarAgent() {
    if (pid_ != 0) End(SIGKILL);
  }
  FarAgent(const FarAgent&) = delete;
  FarAgent& operator=(const FarAgent&) = delete;

  void Signal(int signal) { kill(pid_, signal); }
  // Sends a signal that ends it; returns its wait status.
  int End(int signal) {
    int status = 0;
    kill(pid_, signal);
    EXPECT_EQ(waitpid(pid_, &status, 0), pid_);
    pid_ = 0;
    return status;
  }

 private:
  pid_t pid_ = 0;
};

// What a watcher has seen, over any number of servers.
struct Seen {
  int64_t last = 0;
  bool dense = true;
  int iterations = 0;
  v1::Solve finished;
};

// Watches on; stops once so many iterations were seen (0: at the end).
grpc::Status WatchOn(Stub& stub, const std::string& name, Seen& seen, int enough = 0) {
  grpc::ClientContext context;
  v1::WatchSolveRequest request;
  request.set_name(name);
  request.set_after_sequence(seen.last);
  const auto stream = stub.WatchSolve(&context, request);
  v1::SolveEvent event;
  const auto is_enough = [&] { return enough > 0 && seen.iterations >= enough; };
  while (!is_enough() && stream->Read(&event)) {
    if (event.has_heartbeat()) continue;
    seen.dense = seen.dense && event.sequence() == seen.last + event.skipped_count() + 1;
    seen.last = event.sequence();
    seen.iterations += event.has_iteration() ? 1 + event.skipped_count() : 0;
    if (event.has_finished()) seen.finished = event.finished();
  }
  if (is_enough()) context.TryCancel();
  return stream->Finish();
}

std::string Create(Stub& stub, int iterations) {
  grpc::ClientContext context;
  v1::CreateSolveRequest request;
  request.mutable_spec()->mutable_model()->set_name("planar");
  request.mutable_spec()->mutable_solver_limits()->set_max_iterations(iterations);
  v1::Solve solve;
  const grpc::Status status = stub.CreateSolve(&context, request, &solve);
  EXPECT_TRUE(status.ok()) << status.error_message();
  return solve.name();
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
  FarAgent agent(cluster_.Url(), Directory("agent"));
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
  WatchOn(*one->NewStub(), endless, cancelled, 3);
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
  auto first = std::make_unique<FarAgent>(cluster_.Url(), Directory("first"));
  const std::string name = Create(*server->NewStub(), 100);
  Seen seen;
  WatchOn(*server->NewStub(), name, seen, 10);
  first->End(SIGKILL);
  FarAgent second(cluster_.Url(), Directory("second"));
  EXPECT_TRUE(WatchOn(*server->NewStub(), name, seen).ok());
  EXPECT_TRUE(seen.dense);
  EXPECT_EQ(seen.finished.state(), v1::SOLVE_STATE_SUCCEEDED);
  EXPECT_EQ(seen.finished.attempts(), 2);
}

TEST_F(PostgresTest, AnAgentThatStoodStillBeyondItsLeaseWritesNothingMore) {
  const auto server = Start("server");
  ASSERT_NE(server->address(), "");
  FarAgent first(cluster_.Url(), Directory("first"));
  const std::string name = Create(*server->NewStub(), 500);
  Seen seen;
  WatchOn(*server->NewStub(), name, seen, 10);
  first.Signal(SIGSTOP);
  FarAgent second(cluster_.Url(), Directory("second"));
  // The second attempt has begun: the watcher sees more than the first one can have sent.
  WatchOn(*server->NewStub(), name, seen, seen.iterations + 30);
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
  FarAgent first(cluster_.Url(), Directory("first"));
  const std::string name = Create(*server->NewStub(), 60);
  Seen seen;
  WatchOn(*server->NewStub(), name, seen, 10);
  EXPECT_EQ(first.End(SIGTERM), 0);
  EXPECT_EQ(cluster_.Execute("SELECT COUNT(*) FROM solves WHERE state = 1"), "1");
  FarAgent second(cluster_.Url(), Directory("second"));
  EXPECT_TRUE(WatchOn(*server->NewStub(), name, seen).ok());
  EXPECT_TRUE(seen.dense);
  EXPECT_EQ(seen.finished.attempts(), 2);
}

}  // namespace
}  // namespace rollgait::server
