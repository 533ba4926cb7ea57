#include "client/tradeoff_flags.h"

#include <CLI/CLI.hpp>
#include <set>
#include <string>

namespace rollgait::client {
namespace {

const std::set<std::string>& SceneFlags() {
  static const std::set<std::string> flags = {"--absolute-tolerance", "--drift", "--repeats", "--output-step",
                                              "--max-wall-time"};
  return flags;
}

const std::set<std::string>& CommonFlags() {
  static const std::set<std::string> flags = {"--tolerance", "--duration", "--output", "--help"};
  return flags;
}

// What the two kinds of request do not share.
void RefuseContradictions(const CLI::App& command) {
  const bool has_scene = command.get_option("--scene")->count() > 0;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || option->get_lnames().empty()) continue;
    const std::string flag = "--" + option->get_lnames().front();
    if (!has_scene && SceneFlags().count(flag) > 0) {
      throw CLI::ValidationError(flag + " takes --scene: it says how a scene is simulated");
    }
    if (has_scene && flag != "--scene" && SceneFlags().count(flag) + CommonFlags().count(flag) == 0) {
      throw CLI::ValidationError(flag +
                                 " does not go with --scene: a scene is simulated, it is no gait to be solved for");
    }
  }
}

}  // namespace

void AddTradeoffFlags(CLI::App& command, TradeoffOptions& options) {
  AddSpecFlags(command, options.spec);
  for (const char* flag : {"--scheme", "--intervals", "--double-intervals", "--tolerance", "--max-refinements",
                           "--errors", "--max-error", "--warm-start"}) {
    command.remove_option(command.get_option(flag));
  }
  command.add_option("--scheme", options.schemes, "Schemes, separated by commas")->capture_default_str()->group("Grid");
  command
      .add_option("--intervals", options.intervals, "Of single support: FROM:TO:STEP, or numbers separated by commas")
      ->capture_default_str()
      ->group("Grid");
  command
      .add_option("--tolerance", options.tolerances,
                  "Scaled KKT errors, separated by commas, default 1e-6; of a scene those of the integrator, default " +
                      std::string(kSceneTolerances))
      ->group("Grid");
  command.add_flag("--errors", options.estimate_errors,
                   "Also solve each point with the estimate of its errors; its time does not count");
  command.add_option("-o,--output", options.output,
                     "Write tradeoff.csv, tradeoff.json and tradeoff.html into this folder");
  const std::string group = "Scene";
  command
      .add_option("--scene", options.scene.file,
                  "In place of a gait: SimulationScene as proto3 JSON, - for standard input")
      ->group(group);
  command
      .add_option("--absolute-tolerance", options.absolutes,
                  "Of the integrator, separated by commas; default: that of the scene, or the number of the tolerance")
      ->group(group);
  command
      .add_option("--drift", options.drifts,
                  "projection, baumgarte and none, separated by commas; default: that of the scene")
      ->group(group);
  command.add_option("--repeats", options.repeats, "Runs of each point; the median of their CPU times counts")
      ->check(CLI::Range(1, 100))
      ->capture_default_str()
      ->group(group);
  command.add_option("--output-step", options.scene.output_step_s, "Overrides the time between samples, s")
      ->group(group);
  command.add_option("--max-wall-time", options.max_wall_time_s, "The server ends a run after so many s, at most 600")
      ->group(group);
  command.footer(
      "Ctrl-C leaves the solves alone; the same command attaches to them. Points of a scene are kept in --output.\n"
      "Example: rollgait tradeoff --model planar --speed 1.3 --accuracy draft --scheme radau2,radau3 --output front\n"
      "Example: rollgait tradeoff --scene scenes/rattleback.json --drift projection,none --output front");
  command.parse_complete_callback([&command] { RefuseContradictions(command); });
}

}  // namespace rollgait::client
