// Completion scripts for shells, written from the tree of commands.
#ifndef ROLLGAIT_CLIENT_COMPLETION_SCRIPTS_H_
#define ROLLGAIT_CLIENT_COMPLETION_SCRIPTS_H_

#include <string>
#include <vector>

#include "client/command_tree.h"

namespace rollgait::client {

// The shells that there is a script for: "bash", "fish", "zsh".
std::vector<std::string> CompletionShells();

// The script: commands, flags, the words of flags that take one of a few, files, and, by asking the server with a
// timeout of 1 s, the names of solves and models. Throws Failure(kUsage) for another shell.
std::string CompletionScript(const std::string& shell, const ProgramDescription& program);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMPLETION_SCRIPTS_H_
