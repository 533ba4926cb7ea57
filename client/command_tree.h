// What the command line is, read from CLI11's tree of commands: for completion, the man page and suggestions.
#ifndef ROLLGAIT_CLIENT_COMMAND_TREE_H_
#define ROLLGAIT_CLIENT_COMMAND_TREE_H_

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rollgait::client {

// A flag of two long names is described once for each.
struct FlagDescription {
  // What its value is: nothing (a switch), one of `words`, a file, a model, a number or text.
  enum class Value { kNone, kWords, kFile, kModel, kOther };
  std::string name;        // "--output"
  std::string short_name;  // "-o", or empty
  std::string group;       // heading in the help, "Options" by default
  std::string help;
  Value value = Value::kOther;
  std::vector<std::string> words;  // the value, or what it begins with ("torque" of torque:2)
};

struct ArgumentDescription {
  enum class Value { kSolve, kModel, kFile, kTopic, kShell, kOther };
  std::string name;  // "SOLVE"
  std::string help;
  bool required = false, many = false;
  Value value = Value::kOther;
};

struct CommandDescription {
  std::string name;                  // "solve"; of the program "rollgait"
  std::vector<std::string> aliases;  // other names of the same command: "model" of "models"
  std::string summary, footer;
  std::vector<FlagDescription> flags;  // without --help
  std::vector<ArgumentDescription> arguments;
  std::vector<CommandDescription> commands;  // below it: "create" of "models create"
};

struct ProgramDescription {
  CommandDescription program;  // its flags stand before or behind every command
  std::vector<CommandDescription> commands;
};

ProgramDescription DescribeProgram(const CLI::App& app);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMAND_TREE_H_
