#include "server/store/sql_dialect.h"

namespace rollgait::server {

// One writer at a time has the whole file: there are no rows to lock.
const SqlDialect kSqliteDialect = {
    .serial_key = "INTEGER PRIMARY KEY AUTOINCREMENT",
    .blob = "BLOB",
    .clustered = "WITHOUT ROWID",
    .for_update = "",
    .skip_locked = "",
};

}  // namespace rollgait::server
