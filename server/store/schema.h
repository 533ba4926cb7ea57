#ifndef ROLLGAIT_SERVER_STORE_SCHEMA_H_
#define ROLLGAIT_SERVER_STORE_SCHEMA_H_

#include "server/store/sql_connection.h"

namespace rollgait::server {

inline constexpr int kSchemaVersion = 9;

// Makes the tables in an empty database and brings those of an older version up to this one, in one transaction; leaves
// tables of this version alone. Throws SqlFailure, also for tables of a newer version. Processes may call it at the
// same time.
void EnsureSchema(SqlConnection& connection);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SCHEMA_H_
