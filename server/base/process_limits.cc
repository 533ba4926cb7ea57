#include "server/base/process_limits.h"

#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "server/base/sanitized.h"

namespace rollgait::server {
namespace {

constexpr int kNiceness = 10;
constexpr uint64_t kSliceNanos = 100'000'000;  // the longest that the kernel takes

std::string Reason(const char* call) { return std::string(call) + ": " + std::strerror(errno); }

// The first version of the kernel's sched_attr, whose header does not go with glibc's <sched.h>.
struct SchedulingAttributes {
  uint32_t size, policy;
  uint64_t flags;
  int32_t nice;
  uint32_t priority;
  uint64_t runtime, deadline, period;
};

// Asks for long turns on the processor. Since Linux 6.12 a thread that wakes up displaces one with a longer slice at
// once; beside one of the same slice it may wait for the next tick, whatever their niceness. Older kernels take it and
// do nothing; where a container's rules refuse it, calls wait longer beside work and nothing else changes.
void TakeLongSlices() {
  SchedulingAttributes attributes{};
  if (syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0) != 0) return;
  if (attributes.policy != SCHED_OTHER) return;  // somebody has chosen another one
  attributes.runtime = kSliceNanos;
  syscall(SYS_sched_setattr, 0, &attributes, 0);
}

}  // namespace

std::optional<std::string> EnsureOneThread(char** argv) {
  bool complete = true;
  for (const std::string_view variable : kOneThreadVariables) {
    const size_t equals = variable.find('=');
    const std::string name(variable.substr(0, equals));
    const char* value = std::getenv(name.c_str());
    if (value != nullptr && variable.substr(equals + 1) == value) continue;
    complete = false;
    if (setenv(name.c_str(), "1", 1) != 0) return Reason("setenv");
  }
  if (complete) return std::nullopt;
  execv("/proc/self/exe", argv);
  return Reason("execv /proc/self/exe");
}

std::optional<std::string> ConfineProcess() {
  const rlimit none{0, 0};
  if (setrlimit(RLIMIT_CORE, &none) != 0) return Reason("setrlimit RLIMIT_CORE");
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return Reason("prctl PR_SET_NO_NEW_PRIVS");
  if (prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0) != 0) return Reason("prctl PR_SET_PDEATHSIG");
  if (getpriority(PRIO_PROCESS, 0) < kNiceness && setpriority(PRIO_PROCESS, 0, kNiceness) != 0)
    return Reason("setpriority");
  TakeLongSlices();
  return std::nullopt;
}

std::optional<std::string> LimitMemory(int64_t bytes) {
  if (kSanitized) return std::nullopt;
  const rlimit limit{static_cast<rlim_t>(bytes), static_cast<rlim_t>(bytes)};
  if (setrlimit(RLIMIT_AS, &limit) != 0) return Reason("setrlimit RLIMIT_AS");
  return std::nullopt;
}

std::optional<std::string> LimitCpuTime(int64_t seconds) {
  rlimit limit{};
  if (getrlimit(RLIMIT_CPU, &limit) != 0) return Reason("getrlimit RLIMIT_CPU");
  limit.rlim_cur = std::min(limit.rlim_cur, static_cast<rlim_t>(seconds));
  limit.rlim_max = std::min(limit.rlim_max, static_cast<rlim_t>(seconds + 5));
  if (setrlimit(RLIMIT_CPU, &limit) != 0) return Reason("setrlimit RLIMIT_CPU");
  return std::nullopt;
}

}  // namespace rollgait::server
