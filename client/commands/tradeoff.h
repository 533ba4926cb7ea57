// `rollgait tradeoff`; as the commands of commands.h.
#ifndef ROLLGAIT_CLIENT_COMMANDS_TRADEOFF_H_
#define ROLLGAIT_CLIENT_COMMANDS_TRADEOFF_H_

#include <string>

#include "client/connection.h"
#include "client/failure.h"
#include "client/spec_flags.h"
#include "client/terminal.h"

namespace rollgait::client {

struct TradeoffOptions {
  SpecFlags spec;  // without what follows
  std::string schemes = "radau2,radau3,hermite-simpson", intervals = "4,8,16,32", tolerances = "1e-6";
  bool estimate_errors = false;  // Each point is solved once more, with the estimate.
  std::string output;            // a folder for tradeoff.csv, .json and .html; empty: none
  double reconnect_s = 60;
};
// Solves one request on a grid of schemes, meshes and tolerances, then a reference from the finest solution, and writes
// CPU time and true errors. The exit code of the first solve that is not a success; kNoSolution without a reference.
// Ctrl-C leaves the solves alone; the same command attaches to them.
ExitCode RunTradeoff(const TradeoffOptions& options, const GlobalOptions& global, const Terminal& terminal);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMANDS_TRADEOFF_H_
