// The commands and flags of `rollgait`, as CLI11 reads them.
#ifndef ROLLGAIT_CLIENT_COMMAND_LINE_H_
#define ROLLGAIT_CLIENT_COMMAND_LINE_H_

#include <string>
#include <vector>

#include "client/commands/commands.h"
#include "client/commands/model_commands.h"
#include "client/commands/simulation_commands.h"
#include "client/commands/sweep.h"
#include "client/commands/tradeoff.h"

namespace CLI {
class App;
}

namespace rollgait::client {

// Everything that the command line can set.
struct Arguments {
  GlobalOptions global;
  SolveOptions solve;
  WatchOptions watch;
  GetOptions get;
  ExplainOptions explain;
  ListOptions list;
  ReportOptions report;
  ViewOptions view;
  ReproducePaperOptions paper;
  SweepOptions sweep;
  TradeoffOptions tradeoff;
  ModelsOptions models;
  CheckModelOptions checked_model;
  CreateModelOptions created_model;
  ExportOptions exported;
  SpecOptions spec;
  SimulateOptions simulate;
  PoincareOptions poincare;
  ChosenSolves cancel, remove;
  PriorityOptions priority;
  std::vector<std::string> removed_models;
  std::string fitted_file, help_topic, shell;
};

// Adds all commands and flags; parsing fills `arguments`, which outlives `app`.
void AddCommandLine(CLI::App& app, Arguments& arguments);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMAND_LINE_H_
