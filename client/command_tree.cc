#include "client/command_tree.h"

#include <CLI/CLI.hpp>
#include <set>

#include "client/spec_words.h"

namespace rollgait::client {
namespace {

// `name`: one of the option's long names, without its dashes. The short name goes with the first.
FlagDescription DescribeFlag(const CLI::Option& option, const std::string& name) {
  static const std::set<std::string> kFileFlags = {"--output",   "--spec",    "--scene",     "--tls-ca",
                                                   "--tls-cert", "--tls-key", "--token-file"};
  FlagDescription flag;
  flag.name = "--" + name;
  if (!option.get_snames().empty() && name == option.get_lnames().front())
    flag.short_name = "-" + option.get_snames().front();
  flag.group = option.get_group();
  flag.help = option.get_description();
  flag.words = FlagWords(flag.name);
  if (option.get_items_expected_max() == 0) {
    flag.value = FlagDescription::Value::kNone;
  } else if (!flag.words.empty()) {
    flag.value = FlagDescription::Value::kWords;
  } else if (kFileFlags.count(flag.name) > 0) {
    flag.value = FlagDescription::Value::kFile;
  } else if (flag.name == "--model") {
    flag.value = FlagDescription::Value::kModel;
  }
  return flag;
}

ArgumentDescription DescribeArgument(const CLI::Option& option) {
  ArgumentDescription argument;
  argument.name = option.get_name(true);
  argument.help = option.get_description();
  argument.required = option.get_required();
  argument.many = option.get_items_expected_max() > 1;
  if (argument.name == "SOLVE") argument.value = ArgumentDescription::Value::kSolve;
  if (argument.name == "FILE") argument.value = ArgumentDescription::Value::kFile;
  if (argument.name == "MODEL") argument.value = ArgumentDescription::Value::kModel;
  if (argument.name == "NAME") argument.value = ArgumentDescription::Value::kModel;
  if (argument.name == "TOPIC") argument.value = ArgumentDescription::Value::kTopic;
  if (argument.name == "SHELL") argument.value = ArgumentDescription::Value::kShell;
  return argument;
}

CommandDescription DescribeCommand(const CLI::App& app) {
  CommandDescription command;
  command.name = app.get_name();
  command.aliases = app.get_aliases();
  command.summary = app.get_description();
  command.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) {
    if (option == app.get_help_ptr()) continue;
    if (option->get_lnames().empty()) command.arguments.push_back(DescribeArgument(*option));
    for (const std::string& name : option->get_lnames()) command.flags.push_back(DescribeFlag(*option, name));
  }
  return command;
}

std::vector<CommandDescription> CommandsBelow(const CLI::App& app) {
  std::vector<CommandDescription> commands;
  for (const CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(DescribeCommand(*below));
    commands.back().commands = CommandsBelow(*below);
  }
  return commands;
}

}  // namespace

ProgramDescription DescribeProgram(const CLI::App& app) { return {DescribeCommand(app), CommandsBelow(app)}; }

}  // namespace rollgait::client
