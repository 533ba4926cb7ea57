#ifndef ROLLGAIT_SERVER_ACCESS_MAIN_H_
#define ROLLGAIT_SERVER_ACCESS_MAIN_H_

#include <optional>

namespace rollgait::server {

// `rollgaitd token|tenant|audit ...`: works on the store, beside a running server or without one. Returns the exit
// code; nullopt if the arguments are not of these commands.
std::optional<int> RunAccessCommand(int argc, char** argv);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_ACCESS_MAIN_H_
