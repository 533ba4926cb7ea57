// `rollgait sweep`; as the commands of commands.h.
#ifndef ROLLGAIT_CLIENT_COMMANDS_SWEEP_H_
#define ROLLGAIT_CLIENT_COMMANDS_SWEEP_H_

#include <string>
#include <vector>

#include "client/connection.h"
#include "client/failure.h"
#include "client/spec_flags.h"
#include "client/terminal.h"

namespace rollgait::client {

struct SweepOptions {
  SpecFlags spec;                   // without those of the axes
  std::vector<std::string> values;  // of SweepAxes() (client/sweep/grid.h), empty: no axis
  std::string name;                 // of the sweep, the value of its label; empty: a digest of what it asks
  std::string output;               // a folder for the solves, "slope_5.json"; empty: none
  std::string csv;                  // a file for the table, "-": terminal.out in place of that for people
  int priority = 0;                 // of the solves
  bool again = false;               // solve again what ended without an answer
  double reconnect_s = 60;
};
// Makes the solves of a grid, or attaches to those that the same sweep has made, follows them to their ends and writes
// a table. The exit code of the first point, in the order of the grid, that is not a success; Ctrl-C leaves the solves
// alone.
ExitCode RunSweep(const SweepOptions& options, const GlobalOptions& global, const Terminal& terminal);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMANDS_SWEEP_H_
