#include "server/base/sandbox.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <functional>
#include <vector>

#include "server/base/process_limits.h"
#include "server/base/sanitized.h"

namespace rollgait::server {
namespace {

// The wait status of a child that does `probe` in the sandbox: exit code 0 if it holds, 1 if not, 2 without a sandbox.
int InSandbox(const std::function<bool()>& probe) {
  const pid_t pid = fork();
  if (pid == 0) {
    if (ConfineProcess() || EnterSandbox()) _exit(2);
    _exit(probe() ? 0 : 1);
  }
  int status = -1;
  EXPECT_EQ(waitpid(pid, &status, 0), pid);
  return status;
}

bool Holds(const std::function<bool()>& probe) {
  const int status = InSandbox(probe);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool Refused(long result) { return result == -1 && errno == EPERM; }

TEST(Sandbox, TheMachineOffersIt) { EXPECT_EQ(SandboxObstacle(), std::nullopt); }

TEST(Sandbox, ComputingGoesOn) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  EXPECT_TRUE(Holds([&] {
    std::vector<char> memory(64 << 20, 1);
    char byte = 7, back = 0;
    timespec now{};
    rusage usage{};
    struct sigaction action {};
    action.sa_handler = SIG_IGN;
    return memory[12345] == 1 && write(ends[1], &byte, 1) == 1 && read(ends[0], &back, 1) == 1 && back == 7 &&
           syscall(SYS_clock_gettime, CLOCK_MONOTONIC, &now) == 0 && getrusage(RUSAGE_SELF, &usage) == 0 &&
           sigaction(SIGTERM, &action, nullptr) == 0;
  }));
  close(ends[0]);
  close(ends[1]);
}

TEST(Sandbox, AbortStillEndsTheProcessWithItsSignal) {
  const int status = InSandbox([]() -> bool { std::abort(); });
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGABRT);
}

TEST(Sandbox, NothingCanBeOpenedOrReached) {
  EXPECT_TRUE(Holds([] { return kSanitized || Refused(open("/etc/passwd", O_RDONLY)); }));
  EXPECT_TRUE(Holds([] { return kSanitized || Refused(openat(AT_FDCWD, "/tmp", O_TMPFILE | O_WRONLY, 0600)); }));
  EXPECT_TRUE(Holds([] { return Refused(socket(AF_INET, SOCK_STREAM, 0)); }));
  EXPECT_TRUE(Holds([] { return Refused(socket(AF_UNIX, SOCK_STREAM, 0)); }));
  EXPECT_TRUE(Holds([] { return Refused(unlink("/tmp/rollgait-nothing")); }));
  EXPECT_TRUE(Holds([] { return Refused(syscall(SYS_memfd_create, "code", 0)); }));
  EXPECT_TRUE(Holds([] { return Refused(syscall(SYS_io_uring_setup, 1, nullptr)); }));
  EXPECT_TRUE(Holds([] { return kSanitized || Refused(kill(getppid(), 0)); }));
  EXPECT_TRUE(Holds([] { return kSanitized || Refused(fork()); }));
}

TEST(Sandbox, NoMemoryBecomesExecutable) {
  EXPECT_TRUE(Holds([] {
    return mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED &&
           errno == EPERM;
  }));
  EXPECT_TRUE(Holds([] {
    void* page = mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return page != MAP_FAILED && Refused(mprotect(page, 4096, PROT_READ | PROT_EXEC));
  }));
}

TEST(Sandbox, LimitsAreOnlyLowered) {
  EXPECT_TRUE(Holds([] { return !LimitCpuTime(1000).has_value(); }));
  if (kSanitized) return;  // their runtime sets limits
  EXPECT_TRUE(Holds([] {
    const rlimit more{RLIM_INFINITY, RLIM_INFINITY};
    return Refused(setrlimit(RLIMIT_AS, &more));
  }));
}

TEST(Sandbox, StartingAProgramIsDeadly) {
  const auto killed = [](int status) { return WIFSIGNALED(status) && WTERMSIG(status) == SIGSYS; };
  EXPECT_TRUE(killed(InSandbox([] {
    char name[] = "/bin/true";
    char* arguments[] = {name, nullptr};
    return execv(name, arguments) == 0;
  })));
  EXPECT_TRUE(killed(InSandbox([] { return syscall(SYS_process_vm_readv, 1, nullptr, 0, nullptr, 0, 0) == 0; })));
  EXPECT_TRUE(killed(InSandbox([] { return syscall(SYS_unshare, 0) == 0; })));
  EXPECT_TRUE(kSanitized || killed(InSandbox([] { return syscall(SYS_ptrace, 0, 0, 0, 0) == 0; })));
}

}  // namespace
}  // namespace rollgait::server
