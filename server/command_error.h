#ifndef ROLLGAIT_SERVER_COMMAND_ERROR_H_
#define ROLLGAIT_SERVER_COMMAND_ERROR_H_

#include <cstdio>

#include "server/base/outcome.h"

namespace rollgait::server {

// Tells on standard error why a command of rollgaitd failed, and returns its exit code: 2 for an argument that is not
// admissible, 7 for what does not exist, else 1.
inline int ReportError(const Error& error) {
  std::fprintf(stderr, "rollgaitd: %s\n", error.message.c_str());
  return error.code == ErrorCode::kInvalidArgument ? 2 : error.code == ErrorCode::kNotFound ? 7 : 1;
}

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_COMMAND_ERROR_H_
