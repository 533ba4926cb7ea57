#ifndef ROLLGAIT_SERVER_BASE_PROCESS_LIMITS_H_
#define ROLLGAIT_SERVER_BASE_PROCESS_LIMITS_H_

#include <cstdint>
#include <optional>
#include <string>

namespace rollgait::server {

// Variables that hold the numeric libraries to one thread, as "NAME=1"; they read them when they are loaded.
inline constexpr const char* kOneThreadVariables[] = {"OPENBLAS_NUM_THREADS=1", "OMP_NUM_THREADS=1",
                                                      "MKL_NUM_THREADS=1", "BLIS_NUM_THREADS=1"};

// Starts this program again with those variables unless they are set. Returns the reason if that fails.
std::optional<std::string> EnsureOneThread(char** argv);

// No core dumps, no new privileges, death with the parent; and niceness 10 and time slices of 100 ms (where Linux,
// since 6.12, gives them), so that programs that serve clients get a busy processor first and at once. Returns the
// reason if the kernel refuses.
std::optional<std::string> ConfineProcess();

// Bounds the address space (bytes > 0); without effect in builds with address or thread sanitizer. Returns the reason
// if the kernel refuses.
std::optional<std::string> LimitMemory(int64_t bytes);

// Bounds the CPU time of this process, what it has used already included (s > 0): then SIGXCPU, five seconds later
// SIGKILL. Only ever lowers the limit. Returns the reason if the kernel refuses.
std::optional<std::string> LimitCpuTime(int64_t seconds);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_PROCESS_LIMITS_H_
