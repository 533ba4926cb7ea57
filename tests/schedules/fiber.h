#ifndef ROLLGAIT_TESTS_SCHEDULES_FIBER_H_
#define ROLLGAIT_TESTS_SCHEDULES_FIBER_H_

#include <setjmp.h>
#include <ucontext.h>

#include <cstddef>
#include <functional>
#include <memory>

namespace rollgait::server {

// Memory for the stack of a fiber, with a page below it that nothing may touch. Costly to make, so used again.
class FiberStack {
 public:
  FiberStack();
  ~FiberStack();
  FiberStack(const FiberStack&) = delete;
  FiberStack& operator=(const FiberStack&) = delete;

  void* bottom() const;
  static constexpr size_t kBytes = size_t{256} << 10;

 private:
  void* memory_;
};

// A function with a stack of its own that can stop in the middle and go on later, in one thread with all others.
class Fiber {
 public:
  // The stack outlives the fiber. An exception must not leave `body`.
  Fiber(FiberStack& stack, std::function<void()> body);
  Fiber(const Fiber&) = delete;
  Fiber& operator=(const Fiber&) = delete;

  // Called from outside: runs until the next Suspend or the end.
  void Resume();
  // Called from inside, outside of any catch block.
  void Suspend();
  bool ended() const { return ended_; }

 private:
  static void Enter(unsigned high, unsigned low);

  const std::function<void()> body_;
  // Where it goes on: makecontext starts a stack, and _longjmp changes stacks without asking the kernel for signals'
  // masks.
  ucontext_t start_{};
  jmp_buf inside_, outside_;
  bool started_ = false, ended_ = false;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_FIBER_H_
