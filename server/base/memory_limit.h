#ifndef ROLLGAIT_SERVER_BASE_MEMORY_LIMIT_H_
#define ROLLGAIT_SERVER_BASE_MEMORY_LIMIT_H_

#include <cstdint>
#include <string>

namespace rollgait::server {

// Bytes of memory that this process and its children may take: the limit of its control group (version 2) or of one
// above it, the machine's memory if none is smaller. `groups` and `own` stand for /sys/fs/cgroup and /proc/self/cgroup.
int64_t MemoryLimit(const std::string& groups = "/sys/fs/cgroup", const std::string& own = "/proc/self/cgroup");

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_MEMORY_LIMIT_H_
