#include "client/interrupt.h"

#include <utility>

namespace rollgait::client {

Interrupt::Interrupt(std::function<void(int count)> on_interrupt) : on_interrupt_(std::move(on_interrupt)) {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGUSR1);  // Sent by the destructor to its own thread only.
  pthread_sigmask(SIG_BLOCK, &signals_, &previous_);
  thread_ = std::thread([this] {
    int count = 0;
    int signal = 0;
    while (sigwait(&signals_, &signal) == 0 && signal != SIGUSR1) on_interrupt_(++count);
  });
}

Interrupt::~Interrupt() {
  pthread_kill(thread_.native_handle(), SIGUSR1);
  thread_.join();
  pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

}  // namespace rollgait::client
