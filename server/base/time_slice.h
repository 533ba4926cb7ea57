#ifndef ROLLGAIT_SERVER_BASE_TIME_SLICE_H_
#define ROLLGAIT_SERVER_BASE_TIME_SLICE_H_

#include <chrono>

namespace rollgait::server {

// Asks for turns of this length on the processor for the calling thread and what it starts. Since Linux 6.12 a thread
// that wakes up displaces one with a longer slice at once; beside one of the same slice it may wait for the next tick
// (4 ms at 250 Hz), whatever their niceness. So this is for what computes beside others that answer. Older kernels take
// it and do nothing; where a container's rules refuse it, or somebody has chosen another scheduling policy, nothing
// changes.
void TakeSlices(std::chrono::nanoseconds slice);

// Of processes that do nothing but compute: the longest that the kernel takes.
inline constexpr std::chrono::milliseconds kLongestSlice{100};
// Of threads that compute in a process that answers: longer than the kernel's own (at most 2.8 ms), and no more than
// twice, since a thread that is displaced comes back after about that time, and may hold a lock.
inline constexpr std::chrono::milliseconds kLongerSlice{5};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_TIME_SLICE_H_
