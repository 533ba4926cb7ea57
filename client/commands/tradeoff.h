// `rollgait tradeoff`; as the commands of commands.h.
#ifndef ROLLGAIT_CLIENT_COMMANDS_TRADEOFF_H_
#define ROLLGAIT_CLIENT_COMMANDS_TRADEOFF_H_

#include <optional>
#include <string>

#include "client/commands/scene_input.h"
#include "client/connection.h"
#include "client/failure.h"
#include "client/spec_flags.h"
#include "client/terminal.h"

namespace rollgait::client {

struct TradeoffOptions {
  SpecFlags spec;  // without what follows
  std::string schemes = "radau2,radau3,hermite-simpson", intervals = "4,8,16,32";
  std::optional<std::string> tolerances;  // none: 1e-6, of a scene kSceneTolerances
  bool estimate_errors = false;           // Each point is solved once more, with the estimate.
  std::string output;                     // a folder for tradeoff.csv, .json and .html; empty: none
  double reconnect_s = 60;

  // With a scene's file there is no request; `duration_s` of `spec` overrides that of the scene.
  SceneInput scene;
  std::string absolutes, drifts;  // empty: that of the scene
  int repeats = 3;                // of each point; the median of their CPU times counts
  std::optional<double> max_wall_time_s;
};
inline constexpr char kSceneTolerances[] = "1e-4,1e-6,1e-8,1e-10";

// Solves one request on a grid of schemes, meshes and tolerances, then a reference from the finest solution, and writes
// CPU time and true errors. The exit code of the first solve that is not a success; kNoSolution without a reference.
// Ctrl-C leaves the solves alone; the same command attaches to them.
ExitCode RunTradeoff(const TradeoffOptions& options, const GlobalOptions& global, const Terminal& terminal);

// The same of a scene: a reference that is ten times finer than the finest point, then the points one after the other.
// With --output each point is kept in tradeoff.json as it ends, and the same command goes on behind it. kNoSolution if
// a point or the reference ended early; without a reference nothing is printed.
ExitCode RunSceneTradeoff(const TradeoffOptions& options, const GlobalOptions& global, const Terminal& terminal);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMANDS_TRADEOFF_H_
