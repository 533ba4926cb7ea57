#include "client/completion_scripts.h"

#include <functional>
#include <map>

#include "client/completion_words.h"
#include "client/flag_values.h"

namespace rollgait::client {
namespace {

// Shell commands that print names on the server, one a line.
constexpr char kListSolves[] = "rollgait --timeout 1 list --limit 100 2> /dev/null | awk 'NR > 1 { print $1 }'";
constexpr char kListModels[] = "rollgait --timeout 1 models 2> /dev/null | awk 'NR > 1 { print $1 }'";

using FlagValue = FlagDescription::Value;
using ArgumentValue = ArgumentDescription::Value;

// "--output | -o", for a case of bash.
std::string BashPattern(const FlagDescription& flag) {
  return flag.name + (flag.short_name.empty() ? "" : " | " + flag.short_name);
}

// What completes the value of a flag; empty: nothing.
std::string BashValue(const FlagDescription& flag) {
  // A cost may go on with a weight, a bound must go on with a number.
  const std::string suffix = flag.name == "--bound" ? "-S = " : "";
  const std::string nospace =
      flag.name == "--bound" || flag.name == "--cost" ? "; compopt -o nospace 2> /dev/null" : "";
  switch (flag.value) {
    case FlagValue::kWords:
      return "COMPREPLY=($(compgen " + suffix + "-W \"" + JoinWords(flag.words) + "\" -- \"$current\"))" + nospace;
    case FlagValue::kFile:
      return "COMPREPLY=($(compgen -f -- \"$current\"))";
    case FlagValue::kModel:
      return "COMPREPLY=($(compgen -W \"$(" + std::string(kListModels) + ")\" -- \"$current\"))";
    case FlagValue::kOther:
      return "COMPREPLY=()";
    case FlagValue::kNone:
      return "";
  }
  return "";
}

std::string BashArguments(const CommandDescription& command, const ProgramDescription& program) {
  if (command.arguments.empty()) return "";
  switch (command.arguments.front().value) {
    case ArgumentValue::kSolve:
      return "COMPREPLY=($(compgen -W \"$(" + std::string(kListSolves) +
             ")\" -- \"$current\") $(compgen -f -X '!*.json' -- \"$current\"))";
    case ArgumentValue::kModel:
      return "COMPREPLY=($(compgen -W \"" + WordsBelow(command) + "$(" + std::string(kListModels) +
             ")\" -- \"$current\") $(compgen -f -X '!*.json' -- \"$current\"))";
    case ArgumentValue::kFile:
      return "COMPREPLY=($(compgen -f -- \"$current\"))";
    case ArgumentValue::kTopic:
      return "COMPREPLY=($(compgen -W \"" + JoinWords(TopicNames(program)) + "\" -- \"$current\"))";
    case ArgumentValue::kShell:
      return "COMPREPLY=($(compgen -W \"" + JoinWords(CompletionShells()) + "\" -- \"$current\"))";
    case ArgumentValue::kOther:
      return "";
  }
  return "";
}

// One flag name may mean different values in different commands; the lines of a case per command come first.
std::string BashValues(const CommandDescription& command, const std::string& indent) {
  std::string text;
  for (const FlagDescription& flag : AllFlags(command)) {
    const std::string value = BashValue(flag);
    if (!value.empty()) text += indent + BashPattern(flag) + ") " + value + "; return ;;\n";
  }
  return text;
}

std::string BashScript(const ProgramDescription& program) {
  std::string script =
      "# Completion of rollgait for bash: source <(rollgait completion bash), or write it to\n"
      "# ~/.local/share/bash-completion/completions/rollgait. Written by `rollgait completion bash`.\n"
      "_rollgait() {\n"
      "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command= word\n"
      "  local commands=\"" +
      JoinWords(CommandNames(program)) +
      "\"\n"
      "  local options=\"--help " +
      JoinWords(FlagNames(program.program)) +
      "\"\n"
      "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n" +
      NameOfAlias(program) +
      "    if [[ \" $commands \" == *\" $word \"* ]]; then command=$word; break; fi\n"
      "  done\n"
      "  case $previous in\n" +
      BashValues(program.program, "    ") + "  esac\n  case $command in\n";
  for (const CommandDescription& command : program.commands) {
    const std::string values = BashValues(command, "        ");
    script += "    " + command.name + ")\n";
    if (!values.empty()) script += "      case $previous in\n" + values + "      esac\n";
    if (!FlagNames(command).empty()) script += "      options+=\" " + JoinWords(FlagNames(command)) + "\"\n";
    const std::string arguments = BashArguments(command, program);
    if (!arguments.empty()) script += "      if [[ $current != -* ]]; then " + arguments + "; return; fi\n";
    script += "      ;;\n";
  }
  return script +
         "  esac\n"
         "  if [[ $current == -* ]]; then COMPREPLY=($(compgen -W \"$options\" -- \"$current\"))\n"
         "  elif [[ -z $command ]]; then COMPREPLY=($(compgen -W \"$commands\" -- \"$current\"))\n"
         "  fi\n"
         "}\n"
         "complete -F _rollgait rollgait\n";
}

// Text for a description in an _arguments or _describe word of zsh.
std::string ZshText(const std::string& text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == ':' || letter == '[' || letter == ']' || letter == '\\') escaped += '\\';
    escaped += letter;
  }
  return escaped;
}

std::string ZshAction(const FlagDescription& flag) {
  switch (flag.value) {
    case FlagValue::kWords:
      return ":word:(" + JoinWords(flag.words) + ")";
    case FlagValue::kFile:
      return ":file:_files";
    case FlagValue::kModel:
      return ":model:_rollgait_models";
    case FlagValue::kOther:
      return ":value: ";
    case FlagValue::kNone:
      return "";
  }
  return "";
}

std::string ZshFlags(const CommandDescription& command, const std::string& indent) {
  std::string text;
  for (const FlagDescription& flag : AllFlags(command)) {
    for (const std::string& name : {flag.name, flag.short_name}) {
      if (name.empty()) continue;
      text += indent + QuotedForShell("*" + name + "[" + ZshText(flag.help) + "]" + ZshAction(flag)) + " \\\n";
    }
  }
  return text;
}

std::string ZshArguments(const CommandDescription& command, const ProgramDescription& program) {
  if (command.arguments.empty()) return ": ";
  switch (command.arguments.front().value) {
    case ArgumentValue::kSolve:
      return "'*:solve:_rollgait_solves'";
    case ArgumentValue::kModel:
      return command.commands.empty() ? "'*:model:_rollgait_models'"
                                      : "'*:model:{compadd " + WordsBelow(command) + "; _rollgait_models}'";
    case ArgumentValue::kFile:
      return "'*:file:_files'";
    case ArgumentValue::kTopic:
      return "'*:topic:(" + JoinWords(TopicNames(program)) + ")'";
    case ArgumentValue::kShell:
      return "'*:shell:(" + JoinWords(CompletionShells()) + ")'";
    case ArgumentValue::kOther:
      return "'*:: '";
  }
  return "";
}

std::string ZshScript(const ProgramDescription& program) {
  std::string script =
      "#compdef rollgait\n"
      "# Completion of rollgait for zsh: write it to a file _rollgait in a folder of $fpath.\n"
      "# Written by `rollgait completion zsh`.\n"
      "_rollgait_solves() {\n"
      "  local -a names=(${(f)\"$(" +
      std::string(kListSolves) + ")\"})\n  compadd -a names\n  _files -g '*.json'\n}\n" +
      "_rollgait_models() {\n"
      "  local -a names=(${(f)\"$(" +
      std::string(kListModels) +
      ")\"})\n  compadd -a names\n  _files -g '*.json'\n}\n"
      "_rollgait() {\n"
      "  local -a commands=(\n";
  for (const CommandDescription& command : program.commands) {
    script += "    " + QuotedForShell(command.name + ":" + command.summary) + "\n";
  }
  script +=
      "  )\n"
      "  local command= word\n"
      "  for word in \"${(@)words[2,CURRENT-1]}\"; do\n" +
      NameOfAlias(program) +
      "    if (( ${commands[(I)$word:*]} )); then command=$word; break; fi\n"
      "  done\n"
      "  case $command in\n";
  const std::string global = ZshFlags(program.program, "        ");
  for (const CommandDescription& command : program.commands) {
    script += "    " + command.name + ")\n      _arguments \\\n" + ZshFlags(command, "        ") + global +
              "        '--help[help]' '1: ' " + ZshArguments(command, program) + "\n      ;;\n";
  }
  return script + "    *)\n      _arguments \\\n" + global +
         "        '--help[help]' '*:command:{_describe command commands}'\n      ;;\n  esac\n}\n"
         "if [[ $funcstack[1] == _rollgait ]]; then _rollgait \"$@\"; else compdef _rollgait rollgait; fi\n";
}

std::string FishFlag(const FlagDescription& flag, const std::string& condition) {
  std::string line = "complete -c rollgait" + condition + " -l " + flag.name.substr(2);
  if (!flag.short_name.empty()) line += " -s " + flag.short_name.substr(1);
  switch (flag.value) {
    case FlagValue::kWords:
      line += " -x -a " + QuotedForShell(JoinWords(flag.words));
      break;
    case FlagValue::kFile:
      line += " -r -F";
      break;
    case FlagValue::kModel:
      line += " -x -a '(__rollgait_models)'";
      break;
    case FlagValue::kOther:
      line += " -x";
      break;
    case FlagValue::kNone:
      break;
  }
  return line + " -d " + QuotedForShell(flag.help) + "\n";
}

std::string FishArguments(const CommandDescription& command, const ProgramDescription& program,
                          const std::string& condition) {
  if (command.arguments.empty()) return "";
  const std::string start = "complete -c rollgait" + condition + " -a ";
  switch (command.arguments.front().value) {
    case ArgumentValue::kSolve:
      return start + "'(__rollgait_solves)'\n" + start + "'(__fish_complete_suffix .json)'\n";
    case ArgumentValue::kModel:
      return (command.commands.empty() ? "" : start + QuotedForShell(WordsBelow(command)) + "\n") + start +
             "'(__rollgait_models)'\n" + start + "'(__fish_complete_suffix .json)'\n";
    case ArgumentValue::kFile:
      return start + "'(__fish_complete_path)'\n";
    case ArgumentValue::kTopic:
      return start + QuotedForShell(JoinWords(TopicNames(program))) + "\n";
    case ArgumentValue::kShell:
      return start + QuotedForShell(JoinWords(CompletionShells())) + "\n";
    case ArgumentValue::kOther:
      return "";
  }
  return "";
}

// awk's $1 and quotes are fish's, too.
std::string FishScript(const ProgramDescription& program) {
  std::string script =
      "# Completion of rollgait for fish: write it to ~/.config/fish/completions/rollgait.fish.\n"
      "# Written by `rollgait completion fish`.\n"
      "function __rollgait_solves\n  " +
      std::string(kListSolves) + "\nend\nfunction __rollgait_models\n  " + kListModels +
      "\nend\ncomplete -c rollgait -f\n";
  for (const FlagDescription& flag : program.program.flags) script += FishFlag(flag, "");
  for (const CommandDescription& command : program.commands) {
    script += "complete -c rollgait -n __fish_use_subcommand -a " + command.name + " -d " +
              QuotedForShell(command.summary) + "\n";
  }
  for (const CommandDescription& command : program.commands) {
    std::vector<std::string> names = {command.name};
    names.insert(names.end(), command.aliases.begin(), command.aliases.end());
    const std::string condition = " -n '__fish_seen_subcommand_from " + JoinWords(names) + "'";
    for (const FlagDescription& flag : AllFlags(command)) script += FishFlag(flag, condition);
    script += FishArguments(command, program, condition);
  }
  return script;
}

using ScriptWriter = std::function<std::string(const ProgramDescription&)>;

const std::map<std::string, ScriptWriter>& ScriptWriters() {
  static const std::map<std::string, ScriptWriter> writers = {
      {"bash", BashScript}, {"fish", FishScript}, {"zsh", ZshScript}};
  return writers;
}

}  // namespace

std::vector<std::string> CompletionShells() {
  std::vector<std::string> shells;
  for (const auto& [shell, writer] : ScriptWriters()) shells.push_back(shell);
  return shells;
}

std::string CompletionScript(const std::string& shell, const ProgramDescription& program) {
  return Lookup("completion", shell, ScriptWriters())(program);
}

}  // namespace rollgait::client
