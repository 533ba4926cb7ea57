// What `rollgait tradeoff` prints and writes, of solves and of simulations.
#ifndef ROLLGAIT_CLIENT_COMMANDS_TRADEOFF_RESULT_H_
#define ROLLGAIT_CLIENT_COMMANDS_TRADEOFF_RESULT_H_

#include <string>

#include "client/connection.h"
#include "client/terminal.h"
#include "client/tradeoff/tradeoff_table.h"

namespace rollgait::client {

// Into `folder` tradeoff.csv, .json and .html, unless it is empty; on terminal.out the table, or with --json the
// document, with --quiet neither. Throws Failure(kInternal) if writing fails.
void WriteTradeoff(const TradeoffTable& table, const std::string& folder, const GlobalOptions& global,
                   const Terminal& terminal);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMANDS_TRADEOFF_RESULT_H_
