#include "server/store/sql_dialect.h"

namespace rollgait::server {

// One writer at a time has the whole file: there are no rows to lock.
const SqlDialect kSqliteDialect = {
    .serial_key = "INTEGER PRIMARY KEY AUTOINCREMENT",
    .blob = "BLOB",
    .clustered = "WITHOUT ROWID",
    .for_update = "",
    .skip_locked = "",
    .boot_id = "boot_id()",  // functions of SqliteConnection
    .now_ns = "boot_ns()",
    .next_solve = "COALESCE((SELECT seq FROM sqlite_sequence WHERE name = 'solves'), 0) + 1",
    .next_result = "COALESCE((SELECT seq FROM sqlite_sequence WHERE name = 'results'), 0) + 1",
    .given_key = "",
    .label_lines = "GROUP_CONCAT(name || '=' || value, CHAR(10))",
    .along_queue = "INDEXED BY solves_queued",
};

}  // namespace rollgait::server
