// The commands of `rollgait` that simulate scenes; contract as in commands.h.
#ifndef ROLLGAIT_CLIENT_COMMANDS_SIMULATION_COMMANDS_H_
#define ROLLGAIT_CLIENT_COMMANDS_SIMULATION_COMMANDS_H_

#include <optional>
#include <string>

#include "client/commands/scene_input.h"
#include "client/connection.h"
#include "client/failure.h"
#include "client/terminal.h"

namespace rollgait::client {

struct SimulateOptions {
  SceneInput scene;
  std::string output;  // a .json file for the whole run as rollgait.v1.Simulation; empty: none
  bool validate_only = false;
  std::optional<double> max_wall_time_s;
};
// On terminal.out samples as comma separated values, or messages as JSON lines; events and the report on terminal.err.
// kNoSolution if the simulation ended early. Ctrl-C ends it.
ExitCode RunSimulate(const SimulateOptions& options, const GlobalOptions& global, const Terminal& terminal);

struct PoincareOptions {
  SceneInput scene;
  std::optional<double> residual, max_wall_time_s;
  std::optional<int> max_iterations;
};
// The periodic gait of a passive walker. kNoSolution if the search did not converge.
ExitCode RunPoincare(const PoincareOptions& options, const GlobalOptions& global, const Terminal& terminal);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMANDS_SIMULATION_COMMANDS_H_
