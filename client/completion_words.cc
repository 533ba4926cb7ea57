#include "client/completion_words.h"

#include "client/help_topics.h"

namespace rollgait::client {

std::string JoinWords(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::vector<std::string> CommandNames(const ProgramDescription& program) {
  std::vector<std::string> names;
  for (const CommandDescription& command : program.commands) names.push_back(command.name);
  return names;
}

std::string NameOfAlias(const ProgramDescription& program) {
  std::string cases;
  for (const CommandDescription& command : program.commands) {
    for (const std::string& alias : command.aliases) cases += alias + ") word=" + command.name + " ;; ";
  }
  return "    case $word in " + cases + "esac\n";
}

std::vector<FlagDescription> AllFlags(const CommandDescription& command) {
  std::vector<FlagDescription> flags = command.flags;
  for (const CommandDescription& below : command.commands) {
    const std::vector<FlagDescription> more = AllFlags(below);
    flags.insert(flags.end(), more.begin(), more.end());
  }
  return flags;
}

std::vector<std::string> FlagNames(const CommandDescription& command) {
  std::vector<std::string> names;
  for (const FlagDescription& flag : AllFlags(command)) names.push_back(flag.name);
  return names;
}

std::string WordsBelow(const CommandDescription& command) {
  std::string words;
  for (const CommandDescription& below : command.commands) words += below.name + " ";
  return words;
}

std::vector<std::string> TopicNames(const ProgramDescription& program) {
  std::vector<std::string> names = CommandNames(program);
  for (const HelpTopic& topic : HelpTopics()) names.push_back(topic.name);
  return names;
}

std::string QuotedForShell(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text) {
    if (letter == '\'') {
      quoted += "’";
    } else {
      quoted += letter == '\n' ? ' ' : letter;
    }
  }
  return quoted + "'";
}

}  // namespace rollgait::client
