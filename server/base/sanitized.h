#ifndef ROLLGAIT_SERVER_BASE_SANITIZED_H_
#define ROLLGAIT_SERVER_BASE_SANITIZED_H_

namespace rollgait::server {

// Whether this build has the address or the thread sanitizer, which reserve terabytes of address space and ask the
// kernel for more than the program does.
#if defined(ROLLGAIT_ADDRESS_SANITIZER) || defined(ROLLGAIT_THREAD_SANITIZER)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_SANITIZED_H_
