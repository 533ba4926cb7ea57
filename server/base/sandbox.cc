#include "server/base/sandbox.h"

#include <linux/seccomp.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>

#include "server/base/sanitized.h"

namespace rollgait::server {
namespace {

constexpr int kAllowed[] = {
    // Held descriptors.
    SCMP_SYS(read), SCMP_SYS(write), SCMP_SYS(readv), SCMP_SYS(writev), SCMP_SYS(recvfrom), SCMP_SYS(sendto),
    SCMP_SYS(recvmsg), SCMP_SYS(sendmsg), SCMP_SYS(poll), SCMP_SYS(ppoll), SCMP_SYS(lseek), SCMP_SYS(fstat),
    SCMP_SYS(close),
    // Memory; mmap and mprotect see below.
    SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise),
    // Clocks and waiting.
    SCMP_SYS(clock_gettime), SCMP_SYS(clock_getres), SCMP_SYS(clock_nanosleep), SCMP_SYS(nanosleep),
    SCMP_SYS(gettimeofday), SCMP_SYS(time), SCMP_SYS(times), SCMP_SYS(futex), SCMP_SYS(sched_yield),
    SCMP_SYS(restart_syscall),
    // Questions about itself.
    SCMP_SYS(getpid), SCMP_SYS(gettid), SCMP_SYS(getrusage), SCMP_SYS(sched_getaffinity), SCMP_SYS(getcpu),
    SCMP_SYS(sysinfo), SCMP_SYS(uname), SCMP_SYS(getrandom),
    // Signals and the end.
    SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(sigaltstack), SCMP_SYS(exit),
    SCMP_SYS(exit_group), SCMP_SYS(set_robust_list), SCMP_SYS(rseq)};

// What no accident of a library calls: the process has been taken over.
constexpr int kDeadly[] = {SCMP_SYS(execve),
                           SCMP_SYS(execveat),
                           SCMP_SYS(process_vm_readv),
                           SCMP_SYS(process_vm_writev),
                           SCMP_SYS(mount),
                           SCMP_SYS(umount2),
                           SCMP_SYS(pivot_root),
                           SCMP_SYS(setns),
                           SCMP_SYS(unshare),
                           SCMP_SYS(bpf),
                           SCMP_SYS(init_module),
                           SCMP_SYS(finit_module),
                           SCMP_SYS(kexec_load),
                           SCMP_SYS(kexec_file_load),
                           SCMP_SYS(keyctl),
                           SCMP_SYS(userfaultfd)};

// The leak checker's: it clones itself, stops its creator with ptrace and reads /proc/self.
constexpr int kForSanitizers[] = {SCMP_SYS(open),       SCMP_SYS(openat),    SCMP_SYS(readlink),   SCMP_SYS(readlinkat),
                                  SCMP_SYS(clone),      SCMP_SYS(ptrace),    SCMP_SYS(wait4),      SCMP_SYS(prctl),
                                  SCMP_SYS(getppid),    SCMP_SYS(kill),      SCMP_SYS(tkill),      SCMP_SYS(getdents),
                                  SCMP_SYS(getdents64), SCMP_SYS(stat),      SCMP_SYS(newfstatat), SCMP_SYS(access),
                                  SCMP_SYS(pread64),    SCMP_SYS(prlimit64), SCMP_SYS(ioctl),      SCMP_SYS(pipe),
                                  SCMP_SYS(pipe2),      SCMP_SYS(dup),       SCMP_SYS(dup2)};

// Collects rules; the first one that the library refuses is remembered.
class Filter {
 public:
  Filter() : context_(seccomp_init(SCMP_ACT_ERRNO(EPERM)), seccomp_release) {
    if (context_ == nullptr) failure_ = -ENOMEM;
  }
  void Set(scmp_filter_attr attribute, uint32_t value) {
    if (failure_ == 0) failure_ = seccomp_attr_set(context_.get(), attribute, value);
  }
  template <typename... Conditions>
  void Add(uint32_t action, int call, Conditions... conditions) {
    if (failure_ == 0) {
      const scmp_arg_cmp list[sizeof...(conditions) + 1] = {conditions...};
      failure_ = seccomp_rule_add_array(context_.get(), action, call, sizeof...(conditions), list);
    }
  }
  int Load() { return failure_ == 0 ? seccomp_load(context_.get()) : failure_; }

 private:
  std::unique_ptr<void, void (*)(scmp_filter_ctx)> context_;
  int failure_ = 0;
};

scmp_arg_cmp Masked(unsigned argument, uint64_t mask, uint64_t value) {
  return {argument, SCMP_CMP_MASKED_EQ, mask, value};
}
scmp_arg_cmp Equal(unsigned argument, uint64_t value) { return {argument, SCMP_CMP_EQ, value, 0}; }

}  // namespace

std::optional<std::string> SandboxObstacle() {
  for (const uint32_t action : {SECCOMP_RET_ERRNO, SECCOMP_RET_KILL_PROCESS}) {
    if (syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &action) != 0) {
      return std::string("the kernel offers no system call filter: seccomp: ") + std::strerror(errno);
    }
  }
  return std::nullopt;
}

std::optional<std::string> EnterSandbox() {
  Filter filter;
  // All threads at once. No code of others runs in this process, so nothing is gained by the mitigation of speculative
  // stores that older kernels switch on with a filter, and time would be lost.
  filter.Set(SCMP_FLTATR_CTL_TSYNC, 1);
  filter.Set(SCMP_FLTATR_CTL_SSB, 1);
  filter.Set(SCMP_FLTATR_ACT_BADARCH, SCMP_ACT_KILL_PROCESS);
  for (const int call : kAllowed) filter.Add(SCMP_ACT_ALLOW, call);
  for (const int call : kDeadly) filter.Add(SCMP_ACT_KILL_PROCESS, call);
  if (!kSanitized) filter.Add(SCMP_ACT_KILL_PROCESS, SCMP_SYS(ptrace));
  for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mprotect)}) {
    filter.Add(SCMP_ACT_ALLOW, call, Masked(2, PROT_EXEC, 0));
  }
  // Signals to itself: abort.
  filter.Add(SCMP_ACT_ALLOW, SCMP_SYS(tgkill), Equal(0, static_cast<uint64_t>(getpid())));
  // Limits of its own may be read, and that of CPU time lowered when the request is known.
  if (!kSanitized) {
    filter.Add(SCMP_ACT_ALLOW, SCMP_SYS(prlimit64), Equal(0, 0), Equal(2, 0));
    filter.Add(SCMP_ACT_ALLOW, SCMP_SYS(prlimit64), Equal(0, 0), Equal(1, RLIMIT_CPU));
  } else {
    for (const int call : kForSanitizers) filter.Add(SCMP_ACT_ALLOW, call);
  }
  const int failure = filter.Load();
  if (failure == 0) return std::nullopt;
  return std::string("the system call filter cannot be installed: ") + std::strerror(-failure);
}

}  // namespace rollgait::server
