#ifndef ROLLGAIT_CORE_BASE_CHECK_H_
#define ROLLGAIT_CORE_BASE_CHECK_H_

#include <cstdio>
#include <cstdlib>

// Contract between parts of this program, alive in every build type. Never for what a user can cause: see result.h.
#define ROLLGAIT_CHECK(condition)                                                             \
  do {                                                                                        \
    if (!(condition)) {                                                                       \
      std::fprintf(stderr, "%s:%d: contract violated: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                           \
    }                                                                                         \
  } while (false)

#endif  // ROLLGAIT_CORE_BASE_CHECK_H_
