#include "client/man_page.h"

#include <cctype>

#include "client/help_topics.h"

namespace rollgait::client {
namespace {

// Text as roff shows it: backslashes and hyphens escaped, no line taken for a request.
std::string Roff(const std::string& text) {
  std::string escaped;
  bool line_start = true;
  for (const char letter : text) {
    if (line_start && (letter == '.' || letter == '\'')) escaped += "\\&";
    if (letter == '\\') {
      escaped += "\\e";
    } else if (letter == '-') {
      escaped += "\\-";
    } else {
      escaped += letter;
    }
    line_start = letter == '\n';
  }
  return escaped;
}

std::string Literal(const std::string& text) {
  return ".nf\n" + Roff(text) + (text.back() == '\n' ? "" : "\n") + ".fi\n";
}

std::string RoffFlags(const CommandDescription& command) {
  std::string text;
  for (const FlagDescription& flag : command.flags) {
    text += ".TP\n.B " + Roff((flag.short_name.empty() ? "" : flag.short_name + ", ") + flag.name) + "\n" +
            Roff(flag.help) + "\n";
    if (flag.words.empty()) continue;
    std::string words;
    for (const std::string& word : flag.words) words += (words.empty() ? "" : ", ") + word;
    text += "(" + Roff(words) + ")\n";
  }
  return text;
}

std::string Capitals(std::string text) {
  for (char& letter : text) {
    letter = letter == '-' ? ' ' : static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  }
  return text;
}

// `parent`: what stands before the name, "rollgait".
std::string RoffCommand(const CommandDescription& command, const std::string& parent) {
  const std::string name = parent + " " + command.name;
  std::string usage = name;
  if (!command.flags.empty()) usage += " [flags]";
  std::string text;
  for (const ArgumentDescription& argument : command.arguments) {
    usage += argument.required ? " " + argument.name : " [" + argument.name + "]";
    if (argument.many) usage += "...";
    if (!argument.help.empty()) text += ".TP\n.I " + Roff(argument.name) + "\n" + Roff(argument.help) + "\n";
  }
  text = ".SS " + Roff(usage) + "\n" + Roff(command.summary) + ".\n" + text + RoffFlags(command);
  if (!command.footer.empty()) text += ".PP\n" + Literal(command.footer);
  for (const CommandDescription& below : command.commands) text += RoffCommand(below, name);
  return text;
}

}  // namespace

std::string ManPage(const ProgramDescription& program) {
  std::string page =
      ".TH ROLLGAIT 1 \"\" \"rollgait " ROLLGAIT_VERSION "\" \"User Commands\"\n.SH NAME\nrollgait \\- " +
      Roff(program.program.summary) +
      "\n.SH SYNOPSIS\n.B rollgait\n[flags]\n.I command\n[flags]\n"
      ".SH DESCRIPTION\n"
      "Sends requests for optimal gaits to a server, rollgaitd, follows their solves, and writes what they\n"
      "found. Progress goes to standard error, data to standard output.\n"
      ".SH FLAGS OF EVERY COMMAND\n" +
      RoffFlags(program.program) + ".SH COMMANDS\n";
  for (const CommandDescription& command : program.commands) page += RoffCommand(command, "rollgait");
  for (const HelpTopic& topic : HelpTopics()) page += ".SH " + Capitals(topic.name) + "\n" + Literal(topic.text);
  return page;
}

}  // namespace rollgait::client
