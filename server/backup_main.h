#ifndef ROLLGAIT_SERVER_BACKUP_MAIN_H_
#define ROLLGAIT_SERVER_BACKUP_MAIN_H_

#include <optional>

namespace rollgait::server {

// `rollgaitd backup|restore ...`: docs/explanation/stores.md. Returns the exit code; nullopt if the arguments are not
// of these commands.
std::optional<int> RunBackupCommand(int argc, char** argv);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BACKUP_MAIN_H_
