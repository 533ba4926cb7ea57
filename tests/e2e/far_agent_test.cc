// A solve whose agent stops goes on at an agent elsewhere, which has nothing of the first one's disk: PostgreSQL and
// the real solver.
#include "tests/e2e/far_agent.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <functional>

#include "tests/e2e/daemon.h"
#include "tests/e2e/watching.h"
#include "tests/server/store/temporary_directory.h"
#include "tests/support/postgres_cluster.h"

namespace rollgait::server {
namespace {

TEST(FarAgentTest, ASolveThatIsGivenBackGoesOnElsewhere) {
  PostgresCluster cluster;
  TemporaryDirectory directory;
  Daemon::Options options;
  options.data_dir = directory.path() + "/server";
  options.flags = {"--store", cluster.Url(), "--log-level", "error"};
  Daemon server(options);
  ASSERT_NE(server.address(), "");
  FarAgent first(cluster.Url(), directory.path() + "/first", REAL_SOLVER);
  v1::SolveSpec spec;
  spec.mutable_model()->set_name("human29");
  const std::string name = CreateSolve(*server.NewStub(), spec).name();
  Seen seen;
  WatchOn(*server.NewStub(), name, seen, Iterations(30));
  EXPECT_EQ(first.End(SIGTERM), 0);
  ASSERT_EQ(cluster.Execute("SELECT COUNT(*) FROM journals"), "1") << "the solve was over before its agent";
  FarAgent second(cluster.Url(), directory.path() + "/second", REAL_SOLVER);
  EXPECT_TRUE(WatchOn(*server.NewStub(), name, seen).ok());
  EXPECT_TRUE(seen.dense);
  EXPECT_EQ(seen.finished.attempts(), 2);
  EXPECT_EQ(seen.finished.result().termination(), v1::TERMINATION_OPTIMAL);
  ASSERT_GT(seen.places.size(), 30u);
  const auto repeated = std::adjacent_find(seen.places.begin(), seen.places.end(), std::greater_equal<>());
  EXPECT_EQ(repeated, seen.places.end()) << "mesh " << repeated->first << ", iteration " << repeated->second
                                         << ": every iteration is to be reported once, in its order";
  EXPECT_EQ(cluster.Execute("SELECT COUNT(*) FROM journals"), "0");
}

}  // namespace
}  // namespace rollgait::server
