#include "client/run_client.h"

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "client/commands/commands.h"
#include "client/formats/format_table.h"

namespace rollgait::client {
namespace {

constexpr char kExitCodes[] = R"(Exit codes:
  0  done; a solve that was waited for is optimal or acceptable, within its accuracy bounds or not judged (draft)
  1  internal error, here or in the server, or a file that could not be written
  2  wrong command line, or a request that the server refuses (INVALID_ARGUMENT, a token that is missing or not enough)
  3  no server, no answer in time, or a server too busy to answer
  4  the solve ended without a solution: infeasible or not converged; a simulation ended early; no periodic gait found
  5  the run failed: crash, CPU limit or memory limit
  6  cancelled
  7  no such solve or model
  8  the solve is optimal or acceptable, but the trajectory misses an accuracy bound

Environment:
  ROLLGAIT_SERVER  HOST:PORT of the server, as --server
  ROLLGAIT_TOKEN   token for the server, unless --token-file is given
  NO_COLOR         any non-empty value: no colours

Progress goes to standard error, data to standard output.)";

constexpr char kSolveHelp[] = R"(Ctrl-C cancels the solve and waits for its end; a second Ctrl-C leaves at once.
Example: rollgait solve --model planar --slope 10 --speed 1.3 --output uphill.json)";

constexpr char kOutputHelp[] =
    "Write FILE: .json the finished Solve, .csv the trajectory, .sto the gait cycle as OpenSim storage, or another "
    "ending of `rollgait export`";

// Everything that the command line can set.
struct Arguments {
  GlobalOptions global;
  SolveOptions solve;
  WatchOptions watch;
  GetOptions get;
  ListOptions list;
  ReportOptions report;
  ReproducePaperOptions paper;
  ModelsOptions models;
  ExportOptions exported;
  SimulateOptions simulate;
  PoincareOptions poincare;
  std::vector<std::string> cancel, remove;
  std::string help_command;
};

void AddGlobal(CLI::App& app, GlobalOptions& global) {
  app.add_option("--server", global.server, "HOST:PORT of the server")
      ->envname("ROLLGAIT_SERVER")
      ->capture_default_str();
  app.add_option("--tls-ca", global.tls_ca,
                 "Speak TLS; CA bundle (PEM) that signs the server; default beyond loopback: the system's");
  app.add_option("--tls-cert", global.tls_cert, "Certificate of this client, PEM");
  app.add_option("--tls-key", global.tls_key, "Private key of --tls-cert, PEM");
  app.add_option("--token-file", global.token_file, "File with the token for the server; default: ROLLGAIT_TOKEN");
  app.add_flag("--insecure", global.insecure, "Speak plain text beyond loopback");
  if (const char* token = std::getenv("ROLLGAIT_TOKEN")) global.token = token;
  app.add_flag("--json", global.json,
               "Proto3 JSON on standard output; solve and watch: one object a line, the Solve last");
  app.add_flag("-q,--quiet", global.quiet, "No progress, no summary: data and errors only");
  app.add_option("--timeout", global.timeout_s, "RPC deadline, s; streams have none")
      ->check(CLI::Range(0.001, 86400.0))
      ->capture_default_str();
  app.set_version_flag("--version", "rollgait " ROLLGAIT_VERSION);
  app.require_subcommand(1);
  app.footer(kExitCodes);
  // --server and its like may stand before or behind the command.
  app.fallthrough();
}

void AddSolveCommands(CLI::App& app, Arguments& arguments) {
  CLI::App* const solve = app.add_subcommand("solve", "Ask for a gait, watch the solver, print what it found");
  AddSpecFlags(*solve, arguments.solve.spec);
  solve->add_option("-o,--output", arguments.solve.output, kOutputHelp);
  solve->add_option("--request-id", arguments.solve.request_id,
                    "The same id and request attach to the solve made before");
  CLI::Option* const validate = solve->add_flag("--validate-only", arguments.solve.validate_only,
                                                "Let the server check the request; solve nothing");
  solve->add_flag("--detach", arguments.solve.detach, "Print the name of the new solve and leave it running")
      ->excludes(validate);
  solve->footer(kSolveHelp);

  CLI::App* const watch = app.add_subcommand("watch", "Follow a solve to its end; Ctrl-C leaves it alone");
  watch->add_option("SOLVE", arguments.watch.name, "solves/ID or ID")->required();
  watch->add_option("--after-sequence", arguments.watch.after_sequence, "Only events with a larger number")
      ->check(CLI::NonNegativeNumber);
  watch->add_option("-o,--output", arguments.watch.output, kOutputHelp);
  for (auto [command, seconds] :
       {std::pair(solve, &arguments.solve.reconnect_s), {watch, &arguments.watch.reconnect_s}}) {
    command->add_option("--reconnect", *seconds, "How long to re-attach when the connection breaks, s")
        ->check(CLI::Range(0.0, 86400.0))
        ->capture_default_str();
  }
}

void AddExport(CLI::App& app, ExportOptions& options) {
  CLI::App* const command = app.add_subcommand("export", "Write a finished solve for other programs");
  command->add_option("SOLVE", options.solve, "solves/ID or ID, or a .json file of --output")->required();
  command->add_option("--format", options.format, "One of the formats below; default: by the ending of --output");
  command->add_option("-o,--output", options.output,
                      "A file, a folder for formats of several files, - for standard output");
  std::string footer = "Formats (docs/reference/formats.md has their axes, units and names):\n";
  for (const Format& format : Formats()) {
    footer += "  " + format.name + std::string(format.name.size() < 10 ? 10 - format.name.size() : 1, ' ') +
              (format.ending.empty() ? "folder" : format.ending) +
              std::string(8 - (format.ending.empty() ? 6 : format.ending.size()), ' ') + format.what + "\n";
  }
  command->footer(footer + "Example: rollgait export solves/ID --format opensim -o walk");
}

void AddOtherCommands(CLI::App& app, Arguments& arguments) {
  CLI::App* const get = app.add_subcommand("get", "Print a solve as it stands");
  get->add_option("SOLVE", arguments.get.name, "solves/ID or ID")->required();
  get->add_option("-o,--output", arguments.get.output, kOutputHelp);

  CLI::App* const list = app.add_subcommand("list", "Solves, newest first");
  list->add_option("--state", arguments.list.state, "Only queued, running, succeeded, failed or cancelled");
  list->add_option("--limit", arguments.list.limit, "At most so many")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();

  app.add_subcommand("cancel", "Stop queued or running solves")
      ->add_option("SOLVE", arguments.cancel, "solves/ID or ID")
      ->required();
  app.add_subcommand("delete", "Delete finished solves")
      ->add_option("SOLVE", arguments.remove, "solves/ID or ID")
      ->required();

  CLI::App* const models = app.add_subcommand("models", "Models of the server, or one of them whole");
  models->add_option("NAME", arguments.models.flags.model, "Print this model: joints, links, limits, contact surfaces");
  AddBodyFlags(*models, arguments.models.flags);
  models->add_option("--format", arguments.models.format, "Write the model as " + ModelFormatNames());
  models->add_option("-o,--output", arguments.models.output, "With --format: the file; default: standard output");
  models->add_option("--slope", arguments.models.slope_deg, "With --format: of the ground, degrees; uphill is positive")
      ->check(CLI::Range(-45.0, 45.0));

  AddExport(app, arguments.exported);

  CLI::App* const report = app.add_subcommand("report", "Write an HTML page about one or several solves");
  report->add_option("SOLVE", arguments.report.solves, "Names on the server, or .json files of --output")->required();
  report->add_option("-o,--output", arguments.report.output, "The page, one file that needs no network")->required();
  report->add_option("--title", arguments.report.title, "Title of the page");
  report->add_flag("--no-normative", arguments.report.without_people,
                   "Leave out people's curves, which human models get");

  CLI::App* const paper =
      app.add_subcommand("reproduce-paper", "The paper's three walks and its statements beside ours");
  AddSpecFlags(*paper, arguments.paper.spec);
  paper->remove_option(paper->get_option("--slope"));
  paper->add_option("-o,--output", arguments.paper.output, "The page, one file that needs no network");
  paper->footer(
      "Slopes +10, 0 and -10 degrees; model human29, speed 1.3 and least squared torque if no flag says otherwise.\n"
      "Example: rollgait reproduce-paper -o paper.html");

  app.add_subcommand("server-info", "Version, load and store of the server");
  app.add_subcommand("health", "Whether the server serves: exit code 0, else 3; also by unix:DATA_DIR/admin.sock");
  app.add_subcommand("help", "Print this, or the help of a command")->add_option("COMMAND", arguments.help_command);
}

void AddSceneFlags(CLI::App& command, SceneInput& scene, std::optional<double>& max_wall_time_s) {
  command.add_option("--scene", scene.file, "SimulationScene as proto3 JSON, - for standard input")->required();
  command.add_option("--duration", scene.duration_s, "Overrides duration_s of the scene, s");
  command.add_option("--tolerance", scene.tolerance, "Overrides the integrator's tolerance");
  command.add_option("--max-wall-time", max_wall_time_s, "The server ends the run after so many s, at most 600");
}

void AddSceneCommands(CLI::App& app, Arguments& arguments) {
  CLI::App* const simulate =
      app.add_subcommand("simulate", "Forward contact dynamics of a scene: samples, events, report");
  AddSceneFlags(*simulate, arguments.simulate.scene, arguments.simulate.max_wall_time_s);
  simulate->add_option("--output-step", arguments.simulate.scene.output_step_s,
                       "Overrides the time between samples, s");
  simulate->add_option("-o,--output", arguments.simulate.output,
                       "Also write the whole run to FILE.json: scene, samples, events, report");
  simulate->add_flag("--validate-only", arguments.simulate.validate_only,
                     "Let the server check the scene; simulate nothing");
  simulate->footer(
      "Samples are comma separated values (with --json: one message a line); events and the report go to\n"
      "standard error. Example: rollgait simulate --scene scenes/rattleback.json > rattleback.csv");

  CLI::App* const poincare = app.add_subcommand("poincare", "Periodic gait of a passive walker and its eigenvalues");
  AddSceneFlags(*poincare, arguments.poincare.scene, arguments.poincare.max_wall_time_s);
  poincare->add_option("--residual", arguments.poincare.residual,
                       "Largest change of the state over a step, default 1e-12");
  poincare->add_option("--max-iterations", arguments.poincare.max_iterations, "Of Newton's method, default 40");
}

// The command that was named on the command line.
ExitCode Run(const CLI::App& app, const Arguments& arguments, const Terminal& terminal) {
  const std::string command = app.get_subcommands().front()->get_name();
  const GlobalOptions& global = arguments.global;
  if (command == "solve") return RunSolve(arguments.solve, global, terminal);
  if (command == "watch") return RunWatch(arguments.watch, global, terminal);
  if (command == "get") return RunGet(arguments.get, global, terminal);
  if (command == "list") return RunList(arguments.list, global, terminal);
  if (command == "cancel") return RunCancel(arguments.cancel, global, terminal);
  if (command == "delete") return RunDelete(arguments.remove, global, terminal);
  if (command == "export") return RunExport(arguments.exported, global, terminal);
  if (command == "models") return RunModels(arguments.models, global, terminal);
  if (command == "simulate") return RunSimulate(arguments.simulate, global, terminal);
  if (command == "poincare") return RunPoincare(arguments.poincare, global, terminal);
  if (command == "report") return RunReport(arguments.report, global, terminal);
  if (command == "reproduce-paper") return RunReproducePaper(arguments.paper, global, terminal);
  if (command == "health") return RunHealth(global, terminal);
  if (command == "server-info") return RunServerInfo(global, terminal);
  const CLI::App* const topic = arguments.help_command.empty() ? &app : app.get_subcommand(arguments.help_command);
  terminal.out << topic->help() << std::flush;
  return ExitCode::kSuccess;
}

}  // namespace

int RunClient(int argc, const char* const* argv, const Terminal& terminal) {
  CLI::App app{"Optimal walking gaits from a Rollgait server", "rollgait"};
  Arguments arguments;
  AddGlobal(app, arguments.global);
  AddSolveCommands(app, arguments);
  AddSceneCommands(app, arguments);
  AddOtherCommands(app, arguments);
  try {
    app.parse(argc, argv);
    return static_cast<int>(Run(app, arguments, terminal));
  } catch (const CLI::Error& error) {
    const int code = app.exit(error, terminal.out, terminal.err);
    return code == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  } catch (const Failure& failure) {
    if (*failure.what() != '\0') terminal.err << "rollgait: " << failure.what() << std::endl;
    return static_cast<int>(failure.code());
  } catch (const std::exception& error) {
    terminal.err << "rollgait: internal error: " << error.what() << std::endl;
    return static_cast<int>(ExitCode::kInternal);
  }
}

}  // namespace rollgait::client
