#ifndef ROLLGAIT_SERVER_BASE_CANCEL_SIGNAL_H_
#define ROLLGAIT_SERVER_BASE_CANCEL_SIGNAL_H_

#include <csignal>

namespace rollgait::server {

// By which an agent tells a solver to end its solve with what it has. Not SIGTERM: that reaches every process of a
// terminal, a systemd unit or a Slurm job that is stopped, when nobody has cancelled the solve; a solver is deaf to it
// and the agent, which gives the solve back, ends it.
constexpr int kCancelSignal = SIGUSR1;

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_CANCEL_SIGNAL_H_
