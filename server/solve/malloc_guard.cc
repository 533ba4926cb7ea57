// Takes the place of the C library's allocation functions in rollgait-solve, so that none fails unnoticed: MUMPS
// answers a failed allocation with a failed factorisation, which Ipopt takes for an infeasible problem, and a client
// would get a wrong answer instead of KIND_MEMORY_LIMIT.
#include <cstddef>

#include "server/solve/worker.h"

// Sanitizers bring allocation functions of their own.
#if !defined(ROLLGAIT_ADDRESS_SANITIZER) && !defined(ROLLGAIT_THREAD_SANITIZER)

extern "C" {

// glibc's own functions.
void* __libc_malloc(size_t size) noexcept;
void* __libc_calloc(size_t count, size_t size) noexcept;
void* __libc_realloc(void* block, size_t size) noexcept;

void* malloc(size_t size) noexcept {
  void* block = __libc_malloc(size);
  if (block == nullptr) rollgait::server::OnFailedAllocation();
  return block;
}

void* calloc(size_t count, size_t size) noexcept {
  void* block = __libc_calloc(count, size);
  if (block == nullptr) rollgait::server::OnFailedAllocation();
  return block;
}

void* realloc(void* old_block, size_t size) noexcept {
  void* block = __libc_realloc(old_block, size);
  if (block == nullptr && size > 0) rollgait::server::OnFailedAllocation();
  return block;
}

}  // extern "C"

#endif
