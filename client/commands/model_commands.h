// Commands below `rollgait models`, as those of commands.h.
#ifndef ROLLGAIT_CLIENT_COMMANDS_MODEL_COMMANDS_H_
#define ROLLGAIT_CLIENT_COMMANDS_MODEL_COMMANDS_H_

#include <string>
#include <vector>

#include "client/connection.h"
#include "client/failure.h"
#include "client/terminal.h"

namespace rollgait::client {

struct CheckModelOptions {
  std::string file;       // a model as JSON, or a URDF, MJCF or .osim file
  std::string side_file;  // of such a file
};
// What the server says of a model in a file: RunModels of it. Nothing is stored.
ExitCode RunCheckModel(const CheckModelOptions& options, const GlobalOptions& global, const Terminal& terminal);
// The part of a side file with the feet, as it is proposed for a URDF, MJCF or .osim file. Asks no server.
ExitCode RunFitFeet(const std::string& file, const GlobalOptions& global, const Terminal& terminal);

struct CreateModelOptions {
  std::string file;       // rollgait.v1.Model as proto3 JSON, or a URDF, MJCF or .osim file
  std::string side_file;  // of such a file: rollgait.v1.ModelSideFile as proto3 JSON
  std::string id;         // "ID" or "models/ID"; empty: the name in the file
};
// Stores a model and writes its name, or with --json the whole model, to terminal.out; what was read of such a file to
// terminal.err.
ExitCode RunCreateModel(const CreateModelOptions& options, const GlobalOptions& global, const Terminal& terminal);
// As RunDelete.
ExitCode RunDeleteModels(const std::vector<std::string>& names, const GlobalOptions& global, const Terminal& terminal);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMANDS_MODEL_COMMANDS_H_
