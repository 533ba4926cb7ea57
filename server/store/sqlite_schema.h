#ifndef ROLLGAIT_SERVER_STORE_SQLITE_SCHEMA_H_
#define ROLLGAIT_SERVER_STORE_SQLITE_SCHEMA_H_

#include "server/store/sqlite_connection.h"

namespace rollgait::server {

inline constexpr int kSchemaVersion = 1;

// Creates the tables in an empty file; leaves a file of this version alone. Throws SqliteFailure, also for a file of a
// newer version. Processes may call it at the same time.
void EnsureSchema(SqliteConnection& connection);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SQLITE_SCHEMA_H_
