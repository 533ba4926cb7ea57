// The scene of `rollgait simulate` and `rollgait poincare`.
#ifndef ROLLGAIT_CLIENT_COMMANDS_SCENE_INPUT_H_
#define ROLLGAIT_CLIENT_COMMANDS_SCENE_INPUT_H_

#include <optional>
#include <string>

#include "rollgait/v1/simulation.pb.h"

namespace rollgait::client {

// A file, and what the command line overrides in it.
struct SceneInput {
  std::string file;  // proto3 JSON of rollgait.v1.SimulationScene; "-": standard input
  std::optional<double> duration_s, tolerance, output_step_s;
};

// Throws Failure(kUsage) if the file is not a SimulationScene. The server checks the values.
v1::SimulationScene ReadScene(const SceneInput& input);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMANDS_SCENE_INPUT_H_
