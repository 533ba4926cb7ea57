#include "server/base/time_slice.h"

#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace rollgait::server {
namespace {

// The first version of the kernel's sched_attr, whose header does not go with glibc's <sched.h>.
struct SchedulingAttributes {
  uint32_t size, policy;
  uint64_t flags;
  int32_t nice;
  uint32_t priority;
  uint64_t runtime, deadline, period;
};

}  // namespace

void TakeSlices(std::chrono::nanoseconds slice) {
  SchedulingAttributes attributes{};
  if (syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0) != 0) return;
  if (attributes.policy != SCHED_OTHER) return;  // somebody has chosen another one
  attributes.runtime = static_cast<uint64_t>(slice.count());
  syscall(SYS_sched_setattr, 0, &attributes, 0);
}

}  // namespace rollgait::server
