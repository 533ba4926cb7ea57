// Ctrl-C as a call instead of a sudden death.
#ifndef ROLLGAIT_CLIENT_INTERRUPT_H_
#define ROLLGAIT_CLIENT_INTERRUPT_H_

#include <csignal>
#include <functional>
#include <thread>

namespace rollgait::client {

// While an object lives, SIGINT is delivered to its own thread, which calls `on_interrupt` with 1, 2, … for each
// Ctrl-C. Must be made before any other thread of the process, which inherit the blocked signal. At most one at a time.
class Interrupt {
 public:
  explicit Interrupt(std::function<void(int count)> on_interrupt);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

 private:
  std::function<void(int)> on_interrupt_;
  sigset_t signals_;
  sigset_t previous_;
  std::thread thread_;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_INTERRUPT_H_
