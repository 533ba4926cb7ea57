#include "client/commands/scene_input.h"

#include "client/json.h"

namespace rollgait::client {

v1::SimulationScene ReadScene(const SceneInput& input) {
  v1::SimulationScene scene;
  ReadJsonFile(input.file, scene);
  if (input.duration_s) scene.set_duration_s(*input.duration_s);
  if (input.tolerance) scene.set_tolerance(*input.tolerance);
  if (input.output_step_s) scene.set_output_step_s(*input.output_step_s);
  return scene;
}

}  // namespace rollgait::client
