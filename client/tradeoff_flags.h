// The flags of `rollgait tradeoff`.
#ifndef ROLLGAIT_CLIENT_TRADEOFF_FLAGS_H_
#define ROLLGAIT_CLIENT_TRADEOFF_FLAGS_H_

#include "client/commands/tradeoff.h"

namespace CLI {
class App;
}

namespace rollgait::client {

// Parsing refuses flags of requests beside --scene, and flags of scenes without it.
void AddTradeoffFlags(CLI::App& command, TradeoffOptions& options);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_TRADEOFF_FLAGS_H_
