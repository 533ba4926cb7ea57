#include "tests/schedules/fiber.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <utility>

#include "core/base/check.h"

namespace rollgait::server {
namespace {

size_t PageBytes() { return static_cast<size_t>(sysconf(_SC_PAGESIZE)); }

}  // namespace

FiberStack::FiberStack()
    : memory_(
          mmap(nullptr, kBytes + PageBytes(), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0)) {
  ROLLGAIT_CHECK(memory_ != MAP_FAILED);
  ROLLGAIT_CHECK(mprotect(memory_, PageBytes(), PROT_NONE) == 0);
}

FiberStack::~FiberStack() { munmap(memory_, kBytes + PageBytes()); }

void* FiberStack::bottom() const { return static_cast<char*>(memory_) + PageBytes(); }

Fiber::Fiber(FiberStack& stack, std::function<void()> body) : body_(std::move(body)) {
  ROLLGAIT_CHECK(getcontext(&start_) == 0);
  start_.uc_stack.ss_sp = stack.bottom();
  start_.uc_stack.ss_size = FiberStack::kBytes;
  start_.uc_link = nullptr;
  // makecontext hands over integers only.
  const auto address = reinterpret_cast<uintptr_t>(this);
  makecontext(&start_, reinterpret_cast<void (*)()>(&Fiber::Enter), 2, static_cast<unsigned>(address >> 32),
              static_cast<unsigned>(address & 0xffffffffu));
}

void Fiber::Enter(unsigned high, unsigned low) {
  auto* const fiber = reinterpret_cast<Fiber*>(uintptr_t{high} << 32 | uintptr_t{low});
  fiber->body_();
  fiber->ended_ = true;
  fiber->Suspend();
}

void Fiber::Resume() {
  ROLLGAIT_CHECK(!ended_);
  if (_setjmp(outside_) != 0) return;
  if (started_) _longjmp(inside_, 1);
  started_ = true;
  setcontext(&start_);
  std::abort();  // setcontext came back
}

void Fiber::Suspend() {
  // Exceptions that are being handled belong to the thread, not to the stack.
  ROLLGAIT_CHECK(std::current_exception() == nullptr && std::uncaught_exceptions() == 0);
  if (_setjmp(inside_) == 0) _longjmp(outside_, 1);
}

}  // namespace rollgait::server
