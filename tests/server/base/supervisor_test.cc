#include "server/base/supervisor.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;

// Waits until the condition holds; the bound only ends a hung test.
bool Eventually(const std::function<bool()>& condition) {
  for (int i = 0; i < 3000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(milliseconds(10));
  }
  return false;
}

Supervisor::Options Shell(const std::string& script) {
  Supervisor::Options options;
  options.name = "child";
  options.arguments = {"/bin/sh", "-c", script};
  options.first_pause = milliseconds(1);
  return options;
}

TEST(SupervisorTest, AChildThatDiesIsStartedAgain) {
  const TemporaryDirectory directory;
  // cat ends with the pipe: the child lives as long as it is left alone.
  auto supervisor = Supervisor::Start(Shell("echo x >> " + directory.path() + "/starts; exec cat")).value();
  const pid_t first = supervisor->pid();
  ASSERT_GT(first, 0);
  ASSERT_EQ(kill(first, SIGKILL), 0);
  EXPECT_TRUE(Eventually([&] { return supervisor->pid() != 0 && supervisor->pid() != first; }));
  supervisor->Stop(milliseconds(10'000));
  EXPECT_EQ(supervisor->pid(), 0);
}

TEST(SupervisorTest, StopAsksThenKills) {
  const TemporaryDirectory directory;
  const std::string asked = directory.path() + "/asked", ready = directory.path() + "/ready";
  auto supervisor = Supervisor::Start(Shell("trap 'echo x > " + asked + "' TERM; echo x > " + ready +
                                            "; while true; do sleep 0.05; done"))
                        .value();
  ASSERT_TRUE(Eventually([&] { return std::filesystem::exists(ready); }));
  const pid_t pid = supervisor->pid();
  supervisor->Stop(milliseconds(300));
  EXPECT_TRUE(std::filesystem::exists(asked));
  EXPECT_EQ(kill(pid, 0), -1) << "the process is gone and reaped";
}

TEST(SupervisorTest, TheLifelineEndsOnlyWithTheParent) {
  const TemporaryDirectory directory;
  const std::string end = directory.path() + "/end";
  // A process between this one and the child, so that it can die: a test program that starts a supervisor in a fork.
  const pid_t middle = fork();
  if (middle == 0) {
    auto supervisor = Supervisor::Start(Shell("cat; echo x > " + end));
    pause();  // until it is killed
    _exit(supervisor.ok() ? 0 : 1);
  }
  std::this_thread::sleep_for(milliseconds(300));
  EXPECT_FALSE(std::filesystem::exists(end));
  ASSERT_EQ(kill(middle, SIGKILL), 0);
  EXPECT_TRUE(Eventually([&] { return std::filesystem::exists(end); }));
  waitpid(middle, nullptr, 0);
}

TEST(SupervisorTest, AMissingProgramIsReportedAtOnce) {
  Supervisor::Options options;
  options.name = "child";
  options.arguments = {"/no/such/program"};
  const auto supervisor = Supervisor::Start(options);
  ASSERT_FALSE(supervisor.ok());
  EXPECT_NE(supervisor.error().message.find("/no/such/program"), std::string::npos);
}

TEST(SupervisorTest, WaitStatusesAreDescribed) {
  EXPECT_EQ(DescribeWaitStatus(3 << 8), "exit code 3");
  EXPECT_EQ(DescribeWaitStatus(9), "signal 9 (Killed)");
}

}  // namespace
}  // namespace rollgait::server
