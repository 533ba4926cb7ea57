// The command line of `rollgait`.
#ifndef ROLLGAIT_CLIENT_RUN_CLIENT_H_
#define ROLLGAIT_CLIENT_RUN_CLIENT_H_

#include "client/terminal.h"

namespace rollgait::client {

// Parses the arguments, runs the command, turns failures into messages on terminal.err. Returns the exit code.
int RunClient(int argc, const char* const* argv, const Terminal& terminal);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_RUN_CLIENT_H_
