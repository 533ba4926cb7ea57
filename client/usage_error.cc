#include "client/usage_error.h"

#include <CLI/CLI.hpp>
#include <vector>

#include "core/base/nearest_word.h"

namespace rollgait::client {
namespace {

void AddFlagNames(const CLI::App& app, std::vector<std::string>* names) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names->push_back("--" + name);
  }
}

// The first word that nothing took, a flag before any other; empty: there is none.
std::string UnknownWord(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word.size() > 1 && word[0] == '-') return word.substr(0, word.find('='));
  }
  return words.empty() ? "" : words.front();
}

}  // namespace

std::string UsageMessage(const CLI::App& app, const CLI::Error& error) {
  const std::vector<CLI::App*> named = app.get_subcommands();
  const std::string& program = app.get_name();
  const std::string help =
      "\nRun `" + program + (named.empty() ? "" : " " + named.front()->get_name()) + " --help` for what there is.";
  const std::string unknown = UnknownWord(app.remaining(true));
  if (unknown.empty()) return error.what() + help;
  if (unknown[0] == '-') {
    std::vector<std::string> flags;
    if (!named.empty()) AddFlagNames(*named.front(), &flags);
    AddFlagNames(app, &flags);
    const std::string hint = unknown == "--format" ? "; --json writes JSON" : DidYouMean(unknown, flags);
    return unknown + ": no such flag" + (named.empty() ? "" : " of " + named.front()->get_name()) + hint + help;
  }
  if (!named.empty()) return unknown + ": " + named.front()->get_name() + " does not take this word" + help;
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(command->get_name());
  }
  return unknown + ": no such command" + DidYouMean(unknown, commands) + help;
}

}  // namespace rollgait::client
