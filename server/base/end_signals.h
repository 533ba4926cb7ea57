#ifndef ROLLGAIT_SERVER_BASE_END_SIGNALS_H_
#define ROLLGAIT_SERVER_BASE_END_SIGNALS_H_

#include <signal.h>

namespace rollgait::server {

// SIGTERM and SIGINT, which end a server, are waited for (sigwait), not handled. Blocked here, before there are other
// threads, which inherit it; SIGPIPE is ignored, so that a write to a peer that has gone is an error of that write.
inline sigset_t BlockEndSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);
  return signals;
}

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_END_SIGNALS_H_
