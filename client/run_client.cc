#include "client/run_client.h"

#include <CLI/CLI.hpp>

#include "client/command_line.h"
#include "client/command_tree.h"
#include "client/commands/commands.h"
#include "client/commands/simulation_commands.h"
#include "client/commands/sweep.h"
#include "client/commands/tradeoff.h"
#include "client/completion_scripts.h"
#include "client/help_topics.h"
#include "client/man_page.h"
#include "client/settings.h"
#include "client/usage_error.h"
#include "core/base/nearest_word.h"

namespace rollgait::client {
namespace {

// Of a command or a topic; without a name that of the program. Throws Failure(kUsage) for another name.
std::string HelpText(const CLI::App& app, const std::string& name) {
  if (name.empty()) return app.help();
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->check_name(name)) return command->help(app.get_name());
    names.push_back(command->get_name());
  }
  for (const HelpTopic& topic : HelpTopics()) {
    if (topic.name == name) return topic.text;
    names.push_back(topic.name);
  }
  throw Failure(ExitCode::kUsage, "help " + name + ": no such command or topic" + DidYouMean(name, names));
}

// `models` alone, or the command below it.
ExitCode RunModelCommand(const CLI::App& models, const Arguments& arguments, const Terminal& terminal) {
  if (models.get_subcommands().empty()) return RunModels(arguments.models, arguments.global, terminal);
  const std::string command = models.get_subcommands().front()->get_name();
  if (command == "check") return RunCheckModel(arguments.checked_model, arguments.global, terminal);
  if (command == "fit-feet") return RunFitFeet(arguments.fitted_file, arguments.global, terminal);
  if (command == "delete") return RunDeleteModels(arguments.removed_models, arguments.global, terminal);
  return RunCreateModel(arguments.created_model, arguments.global, terminal);
}

// The command that was named on the command line.
ExitCode Run(const CLI::App& app, const Arguments& arguments, const Terminal& terminal) {
  const std::string command = app.get_subcommands().front()->get_name();
  const GlobalOptions& global = arguments.global;
  if (command == "solve") return RunSolve(arguments.solve, global, terminal);
  if (command == "sweep") return RunSweep(arguments.sweep, global, terminal);
  if (command == "tradeoff") return RunTradeoff(arguments.tradeoff, global, terminal);
  if (command == "watch") return RunWatch(arguments.watch, global, terminal);
  if (command == "get") return RunGet(arguments.get, global, terminal);
  if (command == "list") return RunList(arguments.list, global, terminal);
  if (command == "cancel") return RunCancel(arguments.cancel, global, terminal);
  if (command == "priority") return RunPriority(arguments.priority, global, terminal);
  if (command == "delete") return RunDelete(arguments.remove, global, terminal);
  if (command == "export") return RunExport(arguments.exported, global, terminal);
  if (command == "models") return RunModelCommand(*app.get_subcommands().front(), arguments, terminal);
  if (command == "simulate") return RunSimulate(arguments.simulate, global, terminal);
  if (command == "poincare") return RunPoincare(arguments.poincare, global, terminal);
  if (command == "report") return RunReport(arguments.report, global, terminal);
  if (command == "view") return RunView(arguments.view, global, terminal);
  if (command == "reproduce-paper") return RunReproducePaper(arguments.paper, global, terminal);
  if (command == "health") return RunHealth(global, terminal);
  if (command == "server-info") return RunServerInfo(global, terminal);
  if (command == "spec") return RunSpec(arguments.spec, global, terminal);
  if (command == "explain") return RunExplain(arguments.explain, global, terminal);
  if (command == "doctor") return RunDoctor(global, terminal);
  if (command == "completion") {
    terminal.out << CompletionScript(arguments.shell, DescribeProgram(app)) << std::flush;
  } else if (command == "man") {
    terminal.out << ManPage(DescribeProgram(app)) << std::flush;
  } else {
    terminal.out << HelpText(app, arguments.help_topic) << std::flush;
  }
  return ExitCode::kSuccess;
}

}  // namespace

int RunClient(int argc, const char* const* argv, const Terminal& terminal) {
  CLI::App app{"Optimal walking gaits from a Rollgait server", "rollgait"};
  Arguments arguments;
  AddCommandLine(app, arguments);
  try {
    if (argc <= 1) {
      terminal.out << app.help() << std::flush;
      return 0;
    }
    ApplySettings(app, ProcessEnvironment());
    app.parse(argc, argv);
    return static_cast<int>(Run(app, arguments, terminal));
  } catch (const CLI::Error& error) {
    if (error.get_exit_code() == 0) return app.exit(error, terminal.out, terminal.err);  // --help, --version
    terminal.err << "rollgait: " << UsageMessage(app, error) << std::endl;
    return static_cast<int>(ExitCode::kUsage);
  } catch (const Failure& failure) {
    if (*failure.what() != '\0') terminal.err << "rollgait: " << failure.what() << std::endl;
    return static_cast<int>(failure.code());
  } catch (const std::exception& error) {
    terminal.err << "rollgait: internal error: " << error.what() << std::endl;
    return static_cast<int>(ExitCode::kInternal);
  }
}

}  // namespace rollgait::client
