// Matrices of Eigen come from malloc, which the linker wraps (see tests/CMakeLists.txt); everything else comes from
// operator new, which is replaced here. In a file of its own, so that no compiler sees through to the wrong partner of
// operator new.
#include "tests/support/allocation_counter.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> allocations = 0;
}

extern "C" {
void* __real_malloc(size_t size);
void* __real_realloc(void* block, size_t size);
void* __wrap_malloc(size_t size) {
  ++allocations;
  return __real_malloc(size);
}
void* __wrap_realloc(void* block, size_t size) {
  ++allocations;
  return __real_realloc(block, size);
}
}

void* operator new(size_t size) {
  ++allocations;
  void* block = __real_malloc(size == 0 ? 1 : size);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
// A sanitizer brings a version of this one of its own, which the operator delete below would not match.
void* operator new(size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return __real_malloc(size == 0 ? 1 : size);
}
void* operator new(size_t size, std::align_val_t alignment) {
  ++allocations;
  const size_t step = static_cast<size_t>(alignment);
  void* block = std::aligned_alloc(step, (size + step - 1) / step * step);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, size_t, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, size_t) noexcept { std::free(block); }

namespace rollgait {

long Allocations() { return allocations; }

}  // namespace rollgait
