#include "server/base/process_limits.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
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

// Whether the kernel's sched_attr of this process tells this slice: 0 before Linux 6.12.
bool HasSlice(uint64_t nanos) {
  struct {
    uint32_t size, policy;
    uint64_t flags;
    int32_t nice;
    uint32_t priority;
    uint64_t runtime, deadline, period;
  } attributes{};
  return syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0) == 0 && attributes.runtime == nanos;
}

TEST(ProcessLimits, ConfinedProcessesAreDisplacedByWhoeverWakesUp) {
  const int status = InChild([] {
    if (HasSlice(0)) _exit(77);
    return !ConfineProcess() && HasSlice(100'000'000);
  });
  if (WIFEXITED(status) && WEXITSTATUS(status) == 77) GTEST_SKIP() << "slices cannot be asked for before Linux 6.12";
  EXPECT_TRUE(ExitedWith0(status));
}

TEST(ProcessLimits, ConfinedProcessesKeepAPolicyThatSomebodyChose) {
  EXPECT_TRUE(ExitedWith0(InChild([] {
    const sched_param none{};
    return sched_setscheduler(0, SCHED_IDLE, &none) == 0 && !ConfineProcess() && sched_getscheduler(0) == SCHED_IDLE;
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
