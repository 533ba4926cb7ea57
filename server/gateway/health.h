#ifndef ROLLGAIT_SERVER_GATEWAY_HEALTH_H_
#define ROLLGAIT_SERVER_GATEWAY_HEALTH_H_

#include <string>

#include "server/base/outcome.h"

namespace rollgait::server {

// Asks the gateway that listens at "HOST:PORT" or "unix:PATH" for its document, which needs no rollgaitd and no token.
// kUnavailable with the reason: it does not answer with 200 within a few seconds.
Outcome<Done> AskForHealth(const std::string& listen);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_HEALTH_H_
