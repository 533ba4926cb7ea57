#include "server/store/sqlite_schema.h"

#include <string>

namespace rollgait::server {
namespace {

constexpr char kTables[] = R"(
CREATE TABLE schema_version (version INTEGER NOT NULL);

-- Results are apart from solves, because several solves may share one (from_cache).
CREATE TABLE results (
  id INTEGER PRIMARY KEY,
  solve_key TEXT NOT NULL,
  reusable INTEGER NOT NULL,
  payload BLOB NOT NULL);
CREATE INDEX results_by_key ON results (solve_key) WHERE reusable = 1;

CREATE TABLE solves (
  number INTEGER PRIMARY KEY AUTOINCREMENT,  -- order of creation
  id TEXT NOT NULL UNIQUE,
  request_id TEXT UNIQUE,
  spec BLOB NOT NULL,
  solve_key TEXT NOT NULL,
  state INTEGER NOT NULL,
  create_time_us INTEGER NOT NULL,
  start_time_us INTEGER NOT NULL DEFAULT 0,
  end_time_us INTEGER NOT NULL DEFAULT 0,
  attempts INTEGER NOT NULL DEFAULT 0,
  crashes INTEGER NOT NULL DEFAULT 0,
  cancel_requested INTEGER NOT NULL DEFAULT 0,
  from_cache INTEGER NOT NULL DEFAULT 0,
  last_sequence INTEGER NOT NULL DEFAULT 0,
  result_id INTEGER REFERENCES results (id),
  error BLOB,
  owner TEXT,
  epoch INTEGER NOT NULL DEFAULT 0,
  lease_boot_id TEXT,
  lease_end_ns INTEGER);
CREATE INDEX solves_by_state ON solves (state, number);
CREATE INDEX solves_by_key ON solves (solve_key, state);
CREATE INDEX solves_by_result ON solves (result_id);

CREATE TABLE events (
  solve INTEGER NOT NULL REFERENCES solves (number) ON DELETE CASCADE,
  sequence INTEGER NOT NULL,
  kind INTEGER NOT NULL,
  payload BLOB NOT NULL,
  PRIMARY KEY (solve, sequence)) WITHOUT ROWID;
)";

// Younger than the rest of the schema, and made where it is missing. What a solve that has not ended starts from: a copy,
// so that the solve it came from may be deleted.
constexpr char kWarmStarts[] = R"(
CREATE TABLE IF NOT EXISTS warm_starts (
  solve INTEGER PRIMARY KEY REFERENCES solves (number) ON DELETE CASCADE,
  payload BLOB NOT NULL);
)";

}  // namespace

void EnsureSchema(SqliteConnection& connection) {
  Transaction transaction(connection, Transaction::Kind::kWrite);
  if (!Query(connection, "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'schema_version'").Step()) {
    connection.Execute(kTables);
    Query(connection, "INSERT INTO schema_version (version) VALUES (?)", kSchemaVersion).Run();
  } else {
    Query query(connection, "SELECT version FROM schema_version");
    const int64_t version = query.Step() ? query.Int(0) : 0;
    if (version != kSchemaVersion) {
      throw SqliteFailure(SQLITE_ERROR, "the database has schema version " + std::to_string(version) +
                                            ", this program reads version " + std::to_string(kSchemaVersion));
    }
  }
  connection.Execute(kWarmStarts);
  transaction.Commit();
}

}  // namespace rollgait::server
