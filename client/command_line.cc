#include "client/command_line.h"

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "client/completion_scripts.h"
#include "client/formats/format_table.h"
#include "client/repeated_flags.h"
#include "client/sweep/grid.h"
#include "client/tradeoff_flags.h"

namespace rollgait::client {
namespace {

constexpr char kOutputHelp[] =
    "Write FILE: .json the finished Solve, .csv the trajectory, .sto the gait cycle as OpenSim storage, or another "
    "ending of `rollgait export`; - writes the Solve as JSON to standard output";
constexpr char kPageHelp[] = "The page, one file that needs no network; - for standard output";
constexpr char kModelFile[] = "The model: rollgait.v1.Model as JSON, or a URDF, MJCF or .osim file";
constexpr char kSideFile[] = "Of a URDF, MJCF or .osim file: rollgait.v1.ModelSideFile as JSON";
constexpr char kSolveArgument[] = "solves/ID or ID, or a .json file of --output";

void AddGlobal(CLI::App& app, GlobalOptions& global) {
  app.add_option("--server", global.server, "HOST:PORT of the server")->capture_default_str();
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
  app.footer(
      "`rollgait help TOPIC` has more: a command, exit-codes, settings (environment, configuration file), formats, "
      "repeated-flags.");
  // --server and its like may stand before or behind the command.
  app.fallthrough();
}

void AddReconnect(CLI::App& command, double& seconds) {
  command.add_option("--reconnect", seconds, "How long to re-attach when the connection breaks, s")
      ->check(CLI::Range(0.0, 86400.0))
      ->capture_default_str();
}

constexpr int kLeastPriority = -10, kMostPriority = 10;  // of the service
constexpr char kPriorityHelp[] = "Among your queued solves: the highest runs first, of equal ones the oldest";

void AddSolveCommands(CLI::App& app, Arguments& arguments) {
  CLI::App* const solve = app.add_subcommand("solve", "Ask for a gait, watch the solver, print what it found");
  AddSpecFlags(*solve, arguments.solve.spec);
  solve->add_option("-o,--output", arguments.solve.output, kOutputHelp);
  solve->add_option("--request-id", arguments.solve.request_id,
                    "The same id and request attach to the solve made before");
  AddRepeatedFlag(*solve, "--label", arguments.solve.labels,
                  "KEY=VALUE: what `list --label` finds the solve by, up to 16", "key");
  solve->add_option("--priority", arguments.solve.priority, kPriorityHelp)
      ->check(CLI::Range(kLeastPriority, kMostPriority))
      ->capture_default_str();
  CLI::Option* const validate = solve->add_flag("--validate-only", arguments.solve.validate_only,
                                                "Let the server check the request; solve nothing");
  solve->add_flag("--detach", arguments.solve.detach, "Print the name of the new solve and leave it running")
      ->excludes(validate);
  solve
      ->add_flag("--predict", arguments.solve.predict,
                 "Say what CPU time the solve will take, from measured ones; ask no server and solve nothing")
      ->excludes(validate);
  solve->footer(
      "Ctrl-C cancels the solve; a second Ctrl-C leaves at once.\n"
      "Example: rollgait solve --model planar --slope 10 --speed 1.3 --output uphill.json");

  CLI::App* const watch = app.add_subcommand("watch", "Follow a solve to its end; Ctrl-C leaves it alone");
  watch->add_option("SOLVE", arguments.watch.name, "solves/ID or ID")->required();
  watch->add_option("--after-sequence", arguments.watch.after_sequence, "Only events with a larger number")
      ->check(CLI::NonNegativeNumber);
  watch->add_option("-o,--output", arguments.watch.output, kOutputHelp);
  AddReconnect(*solve, arguments.solve.reconnect_s);
  AddReconnect(*watch, arguments.watch.reconnect_s);
}

void AddSweep(CLI::App& app, SweepOptions& options) {
  CLI::App* const sweep =
      app.add_subcommand("sweep", "Ask for the gaits of a grid, watch them together, print a table");
  AddSpecFlags(*sweep, options.spec);
  options.values.resize(SweepAxes().size());
  for (size_t i = 0; i < SweepAxes().size(); ++i) {
    const SweepAxis& axis = SweepAxes()[i];
    sweep->remove_option(sweep->get_option(axis.flag));
    sweep->add_option(axis.flag, options.values[i], axis.help + ": FROM:TO:STEP, or numbers separated by commas")
        ->group("Grid");
  }
  sweep->add_option("-o,--output", options.output, "Also write every finished solve as JSON into this folder");
  sweep->add_option("--csv", options.csv, "Also write the table as comma separated values; - for standard output");
  sweep->add_option(
      "--name", options.name,
      "Value of the label \"sweep\" of its solves, up to 64 characters; default: a digest of the requests. "
      "The same name and request attach to the solve made before");
  sweep->add_option("--priority", options.priority, kPriorityHelp)
      ->check(CLI::Range(kLeastPriority, kMostPriority))
      ->capture_default_str();
  sweep->add_flag("--again", options.again, "Solve again what failed or was cancelled before");
  AddReconnect(*sweep, options.reconnect_s);
  sweep->footer(
      "Ctrl-C leaves the solves alone; the same command attaches to them. Exit code: that of the first point that is\n"
      "not a success. Example: rollgait sweep --model planar --slope -10:10:5 --speed 1,1.3 --output hills");
}

void AddTradeoff(CLI::App& app, TradeoffOptions& options) {
  CLI::App* const tradeoff = app.add_subcommand(
      "tradeoff", "CPU time against true error of one gait or scene over schemes, meshes and tolerances");
  AddTradeoffFlags(*tradeoff, options);
  AddReconnect(*tradeoff, options.reconnect_s);
}

void AddListFilters(CLI::App& command, ListFilter& filter) {
  AddRepeatedFlag(command, "--state", filter.states, "Only queued, running, succeeded, failed or cancelled", "state");
  CLI::Option* const tenant =
      command.add_option("--tenant", filter.tenant, "Only of this tenant; another than your own takes the scope admin");
  command
      .add_flag_callback(
          "--all-tenants", [&filter] { filter.tenant = "-"; }, "Of all tenants; takes the scope admin")
      ->excludes(tenant);
  command.add_option("--verdict", filter.verdict, "Only this accuracy verdict: within, exceeded, not-judged or none");
  command.add_option("--termination", filter.termination,
                     "Only solves that ended so, for example optimal; none: not yet");
  command.add_option("--model", filter.model, "Only of this model; own: of one that the request carries");
  AddRepeatedFlag(command, "--label", filter.labels, "KEY=VALUE: only solves that carry this label, up to 4", "key");
  command.add_option("--name", filter.name_prefix, "Only solves whose ID begins with this");
  command.add_option(
      "--since", filter.since,
      "Only solves created since: an age (90s, 30m, 12h, 7d) or a UTC date (2026-11-24, or with T12:30)");
  command.add_option("--before", filter.before, "Only solves created before: an age or a UTC date, as --since");
}

void AddSpec(CLI::App& app, SpecOptions& options) {
  CLI::App* const spec = app.add_subcommand("spec", "Write a request as the file that --spec reads; solve nothing");
  AddSpecFlags(*spec, options.spec);
  spec->add_option("-o,--output", options.output, "The file; default and -: standard output");
  spec->add_flag("--keep-preset", options.keep_preset,
                 "Do not ask the server for what the preset stands for: costs, feet, duty factor, clearance");
  spec->footer(
      "Example: rollgait spec --model human29 --preset human -o human.json, edit, rollgait solve --spec human.json");
}

void AddExport(CLI::App& app, ExportOptions& options) {
  CLI::App* const command = app.add_subcommand("export", "Write a finished solve for other programs");
  command->add_option("SOLVE", options.solve, kSolveArgument)->required();
  command->add_option("--format", options.format, "The format; default: by the ending of --output");
  command->add_option("-o,--output", options.output,
                      "A file, a folder for formats of several files, - for standard output");
  command->footer("Formats: `rollgait help formats`. Example: rollgait export solves/ID --format opensim -o walk");
}

void AddModels(CLI::App& app, Arguments& arguments) {
  CLI::App* const models = app.add_subcommand(
      "models", "Models of the server and your own, or one of them whole; check, store and delete your own");
  models->alias("model");
  models->add_option(
      "NAME", arguments.models.flags.model,
      "Print this model: joints, links, limits, contact surfaces; models/ID is one of your own, models/ID@2 "
      "its second version; or check the one in FILE.json, .urdf, .xml (MJCF) or .osim");
  AddBodyFlags(*models, arguments.models.flags);
  models->add_flag(
      "--propose-side", arguments.models.propose_side,
      "Of a URDF, MJCF or .osim file: print a side file to begin with, and say why on standard error; asks no server");
  models->add_option("--format", arguments.models.format, "Write the model as " + ModelFormatNames());
  models->add_option("-o,--output", arguments.models.output, "With --format: the file; default: standard output");
  models->add_option("--slope", arguments.models.slope_deg, "With --format: of the ground, degrees; uphill is positive")
      ->check(CLI::Range(-45.0, 45.0));
  models->footer("Example: rollgait models create robot.json, then rollgait solve --model models/robot");

  CLI::App* const check = models->add_subcommand(
      "check", "Say what the server makes of a model in a file, or why it refuses it; store nothing");
  check->add_option("FILE", arguments.checked_model.file, kModelFile)->required();
  check->add_option("--side", arguments.checked_model.side_file, kSideFile);
  models
      ->add_subcommand(
          "fit-feet",
          "Fit ellipsoids to the feet of a URDF, MJCF or .osim file; print that part of a side file, ask no server")
      ->add_option("FILE", arguments.fitted_file, "The file, whose shapes of contact are fitted")
      ->required();
  CLI::App* const create = models->add_subcommand("create", "Store a model of your own on the server; print its name");
  create->add_option("FILE", arguments.created_model.file, kModelFile)->required();
  create->add_option("--side", arguments.created_model.side_file, kSideFile);
  create->add_option(
      "--id", arguments.created_model.id,
      "The ID in models/ID; default: the name in the file. Other content under an ID is its next version");
  models->add_subcommand("delete", "Delete models of your own, all versions; solves keep theirs")
      ->add_option("MODEL", arguments.removed_models, "models/ID or ID")
      ->required();
}

void AddView(CLI::App& app, ViewOptions& options) {
  CLI::App* const view = app.add_subcommand("view", "Show a solve in the browser, live while it runs; Ctrl-C ends it");
  view->add_option("SOLVE", options.solve,
                   "solves/ID or ID, or a .json file of --output; default: your newest that runs, else your newest");
  view->add_option("--port", options.port, "Port on 127.0.0.1; default: any free one")->check(CLI::Range(1, 65535));
  view->add_flag("--open", options.opens, "Open the page with xdg-open");
  view->add_option("--reconnect", options.reconnect_s, "How long to re-attach when the connection breaks, s")
      ->check(CLI::Range(0.0, 86400.0))
      ->capture_default_str();
  view->footer(
      "Prints the address of the page, which only this machine reaches.\n"
      "Example: rollgait view $(rollgait solve --model human29 --detach)");
}

void AddOtherCommands(CLI::App& app, Arguments& arguments) {
  CLI::App* const get = app.add_subcommand("get", "Print a solve as it stands");
  get->add_option("SOLVE", arguments.get.name, "solves/ID or ID")->required();
  get->add_option("-o,--output", arguments.get.output, kOutputHelp);

  app.add_subcommand("explain", "Say in sentences how a solve ended, what limits it, and what to change")
      ->add_option("SOLVE", arguments.explain.solve, kSolveArgument)
      ->required();

  CLI::App* const list = app.add_subcommand("list", "Solves, newest first");
  AddListFilters(*list, arguments.list.filter);
  list->add_option("--limit", arguments.list.limit, "At most so many")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();

  CLI::App* const cancel = app.add_subcommand("cancel", "Stop queued or running solves");
  cancel->footer("Example: rollgait cancel --label sweep=hills");
  CLI::App* const remove = app.add_subcommand("delete", "Delete finished solves");
  for (auto [command, chosen] : {std::pair(cancel, &arguments.cancel), {remove, &arguments.remove}}) {
    command->add_option("SOLVE", chosen->names, "solves/ID or ID");
    AddRepeatedFlag(*command, "--label", chosen->labels, "KEY=VALUE: also those of yours that carry this label", "key");
  }

  CLI::App* const priority = app.add_subcommand("priority", "Change the priority of queued solves");
  priority->add_option("SOLVE", arguments.priority.chosen.names, "solves/ID or ID");
  priority->add_option("--to", arguments.priority.priority, kPriorityHelp)
      ->check(CLI::Range(kLeastPriority, kMostPriority))
      ->required();
  AddRepeatedFlag(*priority, "--label", arguments.priority.chosen.labels,
                  "KEY=VALUE: also those of yours that carry this label", "key");
  priority->footer("Example: rollgait priority --label sweep=hills --to -5");

  AddModels(app, arguments);
  AddExport(app, arguments.exported);
  AddSpec(app, arguments.spec);

  CLI::App* const report = app.add_subcommand("report", "Write an HTML page about one or several solves");
  report->add_option("SOLVE", arguments.report.solves, "Names on the server, or .json files of --output")->required();
  report->add_option("-o,--output", arguments.report.output, kPageHelp)->required();
  report->add_option("--title", arguments.report.title, "Title of the page");
  report->add_flag("--no-normative", arguments.report.without_people,
                   "Leave out people's curves, which human models get");

  AddView(app, arguments.view);

  CLI::App* const paper =
      app.add_subcommand("reproduce-paper", "The paper's three walks and its statements beside ours");
  AddSpecFlags(*paper, arguments.paper.spec);
  paper->remove_option(paper->get_option("--slope"));
  paper->add_option("-o,--output", arguments.paper.output, kPageHelp);
  paper->footer(
      "Slopes +10, 0 and -10 degrees; model human29, speed 1.3 and least squared torque if no flag says otherwise.\n"
      "Example: rollgait reproduce-paper -o paper.html");

  app.add_subcommand("server-info", "Version, load and store of the server");
  app.add_subcommand("health", "Whether the server serves: exit code 0, else 3; also by unix:DATA_DIR/admin.sock");
  app.add_subcommand("doctor", "Check the way to the server, its certificate, clock, version and disk")
      ->footer("Each line says ok, warn or FAIL and what to do. Exit code: 0, or 3 if a line says FAIL.");
  app.add_subcommand("help", "Print this, or the help of a command or topic")
      ->add_option("TOPIC", arguments.help_topic, "A command, or exit-codes, settings, formats, repeated-flags");
  app.add_subcommand("completion", "Print a script that completes command lines")
      ->add_option("SHELL", arguments.shell, "bash, fish or zsh")
      ->required();
  app.add_subcommand("man", "Print the manual page: rollgait man | man -l -");
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
  simulate->add_option(
      "-o,--output", arguments.simulate.output,
      "Also write the whole run to FILE.json: scene, samples, events, report; - writes it in place of the samples");
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

}  // namespace

void AddCommandLine(CLI::App& app, Arguments& arguments) {
  AddGlobal(app, arguments.global);
  AddSolveCommands(app, arguments);
  AddSweep(app, arguments.sweep);
  AddTradeoff(app, arguments.tradeoff);
  AddSceneCommands(app, arguments);
  AddOtherCommands(app, arguments);
}

}  // namespace rollgait::client
