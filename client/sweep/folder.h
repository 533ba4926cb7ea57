// A folder that a command writes several files into.
#ifndef ROLLGAIT_CLIENT_SWEEP_FOLDER_H_
#define ROLLGAIT_CLIENT_SWEEP_FOLDER_H_

#include <string>

namespace rollgait::client {

// Makes the folder and its parents unless they exist. Throws Failure(kUsage), which names the flag, if it cannot be
// made or written in.
void MakeFolder(const std::string& flag, const std::string& path);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SWEEP_FOLDER_H_
