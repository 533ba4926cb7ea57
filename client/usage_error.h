// What a command line that cannot be understood is told.
#ifndef ROLLGAIT_CLIENT_USAGE_ERROR_H_
#define ROLLGAIT_CLIENT_USAGE_ERROR_H_

#include <string>

namespace CLI {
class App;
class Error;
}  // namespace CLI

namespace rollgait::client {

// The message, with the command or flag that may have been meant, and where the help is; no line feed at its end.
//   app  after the parse that threw `error`
std::string UsageMessage(const CLI::App& app, const CLI::Error& error);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_USAGE_ERROR_H_
