#include "server/store/sql_dialect.h"

namespace rollgait::server {

const SqlDialect kPostgresDialect = {
    .serial_key = "BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY",
    .blob = "BYTEA",
    .clustered = "",
    .for_update = "FOR UPDATE",
    .skip_locked = "FOR UPDATE SKIP LOCKED",
    .boot_id = "'database'",
    .now_ns = "CAST(EXTRACT(EPOCH FROM clock_timestamp()) * 1000000000 AS BIGINT)",
    .next_solve = "nextval(pg_get_serial_sequence('solves', 'number'))",
    .next_result = "nextval(pg_get_serial_sequence('results', 'id'))",
    .given_key = "OVERRIDING SYSTEM VALUE",
    .label_lines = "STRING_AGG(name || '=' || value, CHR(10))",
    .along_queue = "",
};

}  // namespace rollgait::server
