// Copies of the store, by the commands of the real rollgaitd.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>

#include "tests/e2e/daemon.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

Daemon::Options OptionsFor(const std::string& data_dir) {
  Daemon::Options options;
  options.data_dir = data_dir;
  options.solver = SLOW_SOLVER;
  return options;
}

v1::Solve Get(const Daemon& daemon, const std::string& name) {
  grpc::ClientContext context;
  v1::GetSolveRequest request;
  request.set_name(name);
  v1::Solve solve;
  EXPECT_TRUE(daemon.NewStub()->GetSolve(&context, request, &solve).ok());
  return solve;
}

// Iterations of a solve that runs until it is cancelled, however slow the machine is: 100 s of the test's solver.
constexpr int kLong = 10000;

std::string Create(const Daemon& daemon, int iterations) {
  grpc::ClientContext context;
  v1::CreateSolveRequest request;
  request.mutable_spec()->mutable_model()->set_name("planar");
  request.mutable_spec()->mutable_solver_limits()->set_max_iterations(iterations);
  v1::Solve solve;
  EXPECT_TRUE(daemon.NewStub()->CreateSolve(&context, request, &solve).ok());
  return solve.name();
}

void Cancel(const Daemon& daemon, const std::string& name) {
  grpc::ClientContext context;
  v1::CancelSolveRequest request;
  request.set_name(name);
  v1::Solve solve;
  EXPECT_TRUE(daemon.NewStub()->CancelSolve(&context, request, &solve).ok());
}

bool ReachesState(const Daemon& daemon, const std::string& name, v1::SolveState state) {
  for (int i = 0; i < 600; ++i) {
    if (Get(daemon, name).state() == state) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

// Reads the log of the solve up to an iteration of its second attempt.
bool IsSolvedAgain(const Daemon& daemon, const std::string& name) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::minutes(1));
  v1::WatchSolveRequest request;
  request.set_name(name);
  const auto stream = daemon.NewStub()->WatchSolve(&context, request);
  int attempts = 0;
  for (v1::SolveEvent event; stream->Read(&event);) {
    if (event.has_state_change() && event.state_change().state() == v1::SOLVE_STATE_RUNNING) ++attempts;
    if (!event.has_iteration() || attempts < 2) continue;
    context.TryCancel();
    return true;
  }
  return false;
}

TEST(BackupTest, AServerOnTheCopyHasWhatWasThereAndGoesOnWithWhatRan) {
  const TemporaryDirectory directory;
  const std::string first = directory.path() + "/first", second = directory.path() + "/second";
  const std::string copy = directory.path() + "/copy.db";
  std::string done, running;
  v1::Solve before;
  {
    Daemon daemon(OptionsFor(first));
    ASSERT_NE(daemon.address(), "");
    done = Create(daemon, 3);
    ASSERT_TRUE(ReachesState(daemon, done, v1::SOLVE_STATE_SUCCEEDED));
    before = Get(daemon, done);
    running = Create(daemon, kLong);
    const std::string report = OutputOfRollgaitd("backup --data-dir " + first + " --to " + copy);
    EXPECT_NE(report.find("2 solves, 1 results"), std::string::npos) << report;
    EXPECT_EQ(std::filesystem::status(copy).permissions() & std::filesystem::perms::group_all,
              std::filesystem::perms::none);
    EXPECT_THROW(OutputOfRollgaitd("backup --data-dir " + first + " --to " + copy), std::runtime_error);
    EXPECT_THROW(OutputOfRollgaitd("restore --data-dir " + first + " --from " + copy), std::runtime_error);
    Cancel(daemon, running);
    EXPECT_TRUE(ReachesState(daemon, running, v1::SOLVE_STATE_CANCELLED));
  }
  EXPECT_NE(OutputOfRollgaitd("restore --data-dir " + second + " --from " + copy).find("2 solves"), std::string::npos);
  const Daemon daemon(OptionsFor(second));
  ASSERT_NE(daemon.address(), "");
  EXPECT_EQ(Get(daemon, done).SerializeAsString(), before.SerializeAsString());
  // The copy says that it runs, but here a solver must have it.
  EXPECT_TRUE(IsSolvedAgain(daemon, running));
  Cancel(daemon, running);
  EXPECT_TRUE(ReachesState(daemon, running, v1::SOLVE_STATE_CANCELLED));
}

}  // namespace
}  // namespace rollgait::server
