#include "server/base/process_limits.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "server/base/sanitized.h"

namespace rollgait::server {
namespace {

// The wait status of a child that does `body`; limits cannot be taken back in this process.
int InChild(const std::function<bool()>& body) {
  const pid_t pid = fork();
  if (pid == 0) _exit(body() ? 0 : 1);
  int status = -1;
  EXPECT_EQ(waitpid(pid, &status, 0), pid);
  return status;
}

bool ExitedWith0(int status) { return WIFEXITED(status) && WEXITSTATUS(status) == 0; }

TEST(ProcessLimits, ConfinedProcessesLeaveNoCoreAndDieWithTheirParent) {
  EXPECT_TRUE(ExitedWith0(InChild([] {
    if (ConfineProcess()) return false;
    rlimit core{1, 1};
    int signal = 0;
    return getrlimit(RLIMIT_CORE, &core) == 0 && core.rlim_cur == 0 && core.rlim_max == 0 &&
           prctl(PR_GET_NO_NEW_PRIVS, 0, 0, 0, 0) == 1 && prctl(PR_GET_PDEATHSIG, &signal, 0, 0, 0) == 0 &&
           signal == SIGKILL;
  })));
}

TEST(ProcessLimits, ConfinedProcessesYieldTheProcessorAndNeverTakeNicenessBack) {
  EXPECT_TRUE(ExitedWith0(InChild([] { return !ConfineProcess() && getpriority(PRIO_PROCESS, 0) >= 10; })));
  EXPECT_TRUE(ExitedWith0(InChild([] {
    return setpriority(PRIO_PROCESS, 0, 15) == 0 && !ConfineProcess() && getpriority(PRIO_PROCESS, 0) == 15;
  })));
}

TEST(ProcessLimits, MemoryIsBounded) {
  if (kSanitized) GTEST_SKIP() << "sanitizers need the address space";
  EXPECT_TRUE(ExitedWith0(InChild([] {
    if (LimitMemory(int64_t{1} << 40)) return false;
    rlimit limit{};
    return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur == rlim_t{1} << 40;
  })));
}

TEST(ProcessLimits, CpuTimeIsOnlyEverLowered) {
  EXPECT_TRUE(ExitedWith0(InChild([] {
    if (LimitCpuTime(50) || LimitCpuTime(20) || LimitCpuTime(40)) return false;
    rlimit limit{};
    return getrlimit(RLIMIT_CPU, &limit) == 0 && limit.rlim_cur == 20 && limit.rlim_max == 25;
  })));
}

TEST(ProcessLimits, AtTheCpuLimitTheProcessGetsItsSignal) {
  const int status = InChild([] {
    if (LimitCpuTime(1)) return false;
    volatile double x = 1;
    while (x > 0) x = x + 1;
    return true;
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGXCPU);
}

}  // namespace
}  // namespace rollgait::server
