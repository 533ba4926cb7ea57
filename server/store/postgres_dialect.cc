#include "server/store/sql_dialect.h"

namespace rollgait::server {

const SqlDialect kPostgresDialect = {
    .serial_key = "BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY",
    .blob = "BYTEA",
    .clustered = "",
    .for_update = "FOR UPDATE",
    .skip_locked = "FOR UPDATE SKIP LOCKED",
};

}  // namespace rollgait::server
