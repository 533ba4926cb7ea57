#include "server/store/schema.h"

#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "rollgait/v1/solve.pb.h"
#include "server/base/digest.h"
#include "server/store/spec_model.h"

namespace rollgait::server {
namespace {

constexpr char kVersionTable[] = "CREATE TABLE schema_version (version BIGINT NOT NULL);";

// Results are apart from solves, because several solves may share one (from_cache).
constexpr char kResults[] = R"(
CREATE TABLE results (
  id {serial_key},
  solve_key TEXT NOT NULL,
  reusable BIGINT NOT NULL,
  payload {blob} NOT NULL);
CREATE INDEX results_by_key ON results (solve_key) WHERE reusable = 1;
)";

// `number` is the order of creation.
constexpr char kSolves[] = R"(
CREATE TABLE solves (
  number {serial_key},
  id TEXT NOT NULL UNIQUE,
  tenant TEXT NOT NULL DEFAULT '',
  request_id TEXT,
  spec {blob} NOT NULL,
  solve_key TEXT NOT NULL,
  solver_fingerprint TEXT NOT NULL DEFAULT '',
  traceparent TEXT NOT NULL DEFAULT '',
  state BIGINT NOT NULL,
  create_time_us BIGINT NOT NULL,
  start_time_us BIGINT NOT NULL DEFAULT 0,
  end_time_us BIGINT NOT NULL DEFAULT 0,
  attempts BIGINT NOT NULL DEFAULT 0,
  crashes BIGINT NOT NULL DEFAULT 0,
  cancel_requested BIGINT NOT NULL DEFAULT 0,
  from_cache BIGINT NOT NULL DEFAULT 0,
  last_sequence BIGINT NOT NULL DEFAULT 0,
  trimmed_sequence BIGINT NOT NULL DEFAULT 0,
  result_id BIGINT REFERENCES results (id),
  error {blob},
  owner TEXT,
  epoch BIGINT NOT NULL DEFAULT 0,
  lease_boot_id TEXT,
  lease_end_ns BIGINT);
)";

// The last one is single flight, whoever claims.
constexpr char kSolveIndexes[] = R"(
CREATE UNIQUE INDEX solves_by_request ON solves (tenant, request_id);
CREATE INDEX solves_by_state ON solves (state, number);
CREATE INDEX solves_by_tenant ON solves (tenant, number);
CREATE INDEX solves_by_tenant_state ON solves (tenant, state, number);
CREATE INDEX solves_by_key ON solves (solve_key, state);
CREATE INDEX solves_by_result ON solves (result_id);
CREATE INDEX solves_by_end ON solves (end_time_us) WHERE end_time_us > 0;
CREATE UNIQUE INDEX solves_running_once ON solves (solve_key) WHERE state = 2 AND solve_key <> '';
)";

// A warm start is a copy of what a solve that has not ended starts from, so that the solve it came from may be deleted.
constexpr char kPartsOfSolves[] = R"(
CREATE TABLE events (
  solve BIGINT NOT NULL REFERENCES solves (number) ON DELETE CASCADE,
  sequence BIGINT NOT NULL,
  kind BIGINT NOT NULL,
  payload {blob} NOT NULL,
  PRIMARY KEY (solve, sequence)) {clustered};
CREATE TABLE warm_starts (
  solve BIGINT PRIMARY KEY REFERENCES solves (number) ON DELETE CASCADE,
  payload {blob} NOT NULL);
)";

// Times are wall clock, microseconds since 1970. A token's expire_time_us and revoke_time_us: 0 is never; limits of a
// tenant: -1 is the server's default.
constexpr char kAccess[] = R"(
CREATE TABLE tokens (
  id TEXT PRIMARY KEY,
  hash TEXT NOT NULL UNIQUE,
  tenant TEXT NOT NULL,
  scopes TEXT NOT NULL,
  create_time_us BIGINT NOT NULL,
  expire_time_us BIGINT NOT NULL DEFAULT 0,
  revoke_time_us BIGINT NOT NULL DEFAULT 0,
  note TEXT NOT NULL DEFAULT '');
CREATE TABLE tenants (
  tenant TEXT PRIMARY KEY,
  max_queued BIGINT NOT NULL DEFAULT -1,
  max_running BIGINT NOT NULL DEFAULT -1,
  max_watches BIGINT NOT NULL DEFAULT -1,
  creates_per_s DOUBLE PRECISION NOT NULL DEFAULT -1);
CREATE TABLE audit (
  number {serial_key},
  time_us BIGINT NOT NULL,
  tenant TEXT NOT NULL DEFAULT '',
  token_id TEXT NOT NULL DEFAULT '',
  peer TEXT NOT NULL DEFAULT '',
  action TEXT NOT NULL,
  solve TEXT NOT NULL DEFAULT '',
  outcome TEXT NOT NULL DEFAULT '',
  detail TEXT NOT NULL DEFAULT '');
CREATE INDEX audit_by_time ON audit (time_us);
CREATE INDEX audit_by_tenant ON audit (tenant, number);
)";

// Version 1 existed on SQLite only. request_id was unique by itself, which takes a new table to undo; the rows of other
// tables go on referring to it by its name.
constexpr char kMoveSolves[] = R"(
DROP INDEX solves_by_state;
DROP INDEX solves_by_key;
DROP INDEX solves_by_result;
ALTER TABLE solves RENAME TO solves_1;
)";
constexpr char kCopySolves[] = R"(
INSERT INTO solves (number, id, request_id, spec, solve_key, state, create_time_us, start_time_us, end_time_us, attempts,
  crashes, cancel_requested, from_cache, last_sequence, result_id, error, owner, epoch, lease_boot_id, lease_end_ns)
SELECT number, id, request_id, spec, solve_key, state, create_time_us, start_time_us, end_time_us, attempts,
  crashes, cancel_requested, from_cache, last_sequence, result_id, error, owner, epoch, lease_boot_id, lease_end_ns
FROM solves_1;
DROP TABLE solves_1;
)";
constexpr char kWarmStartsOf1[] = R"(
CREATE TABLE IF NOT EXISTS warm_starts (
  solve INTEGER PRIMARY KEY REFERENCES solves (number) ON DELETE CASCADE,
  payload BLOB NOT NULL);
)";

// What a solve takes, for retention by size; a shared result counts once.
constexpr char kBytes[] = R"(
ALTER TABLE solves ADD COLUMN bytes BIGINT NOT NULL DEFAULT 0;
UPDATE solves SET bytes = LENGTH(spec) + COALESCE(LENGTH(error), 0)
  + COALESCE((SELECT SUM(LENGTH(payload)) FROM events WHERE solve = number), 0)
  + CASE WHEN from_cache = 1 THEN 0
    ELSE COALESCE((SELECT LENGTH(payload) FROM results WHERE results.id = result_id), 0) END;
DROP INDEX solves_by_end;
CREATE INDEX solves_by_end ON solves (end_time_us, bytes) WHERE end_time_us > 0;
)";

void From1To2(SqlConnection& connection) {
  for (const char* part : {kWarmStartsOf1, kMoveSolves, kSolves, kCopySolves, kSolveIndexes, kAccess}) {
    connection.Execute(part);
  }
}

void From2To3(SqlConnection& connection) { connection.Execute(kBytes); }

// What lists show of a result without reading it: the numbers of v1::Termination and v1::Verdict; 0: not known.
constexpr char kOutcomes[] = R"(
ALTER TABLE results ADD COLUMN termination BIGINT NOT NULL DEFAULT 0;
ALTER TABLE results ADD COLUMN verdict BIGINT NOT NULL DEFAULT 0;
)";

// The termination is the first field of a v1::SolveResult: the byte of its tag, then its number. Older results have no
// verdict.
void From3To4(SqlConnection& connection) {
  connection.Execute(kOutcomes);
  std::vector<std::pair<int64_t, int64_t>> terminations;
  {
    Query query(connection, "SELECT id, SUBSTR(payload, 1, 2) FROM results ORDER BY id");
    while (query.Step()) {
      const std::string start = query.Bytes(1);
      constexpr char kTag = v1::SolveResult::kTerminationFieldNumber << 3;
      const bool known = start.size() == 2 && start[0] == kTag && v1::Termination_IsValid(start[1]);
      if (known) terminations.emplace_back(query.Int(0), start[1]);
    }
  }
  for (const auto& [id, termination] : terminations) {
    Query::Do(connection, "UPDATE results SET termination = ? WHERE id = ?", termination, id);
  }
}

// Where `nearest` looks (solve_place.h): apart from solves, whose rows are as long as their specs. Solves of older
// stores get theirs from the server, which knows what specs mean.
constexpr char kPlaces[] = R"(
CREATE TABLE places (
  solve BIGINT PRIMARY KEY REFERENCES solves (number) ON DELETE CASCADE,
  tenant TEXT NOT NULL,
  question TEXT NOT NULL,
  slope_rad DOUBLE PRECISION NOT NULL,
  speed_m_s DOUBLE PRECISION NOT NULL,
  optimal BIGINT NOT NULL);
CREATE INDEX places_by_question ON places (question, tenant, optimal, slope_rad, speed_m_s);
)";

// What tenants may store and how much they simulate; -1: the server's default. The index sums what a tenant stores.
constexpr char kTenantLimits[] = R"(
ALTER TABLE tenants ADD COLUMN max_storage_bytes BIGINT NOT NULL DEFAULT -1;
ALTER TABLE tenants ADD COLUMN max_simulations BIGINT NOT NULL DEFAULT -1;
CREATE INDEX solves_by_tenant_end ON solves (tenant, end_time_us, bytes);
)";

// Random texts that never leave the store.
constexpr char kSecrets[] = "CREATE TABLE secrets (name TEXT PRIMARY KEY, value TEXT NOT NULL);";

void From4To5(SqlConnection& connection) {
  for (const char* part : {kPlaces, kTenantLimits, kSecrets}) connection.Execute(part);
  Query::Do(connection, "INSERT INTO secrets (name, value) VALUES ('page_tokens', ?)", RandomHex(32));
}

// Models of tenants, a row a version. `number` is the order of creation; the summary is apart, for lists.
constexpr char kModels[] = R"(
CREATE TABLE models (
  number {serial_key},
  tenant TEXT NOT NULL,
  id TEXT NOT NULL,
  version BIGINT NOT NULL,
  digest TEXT NOT NULL,
  create_time_us BIGINT NOT NULL,
  bytes BIGINT NOT NULL,
  summary {blob} NOT NULL,
  payload {blob} NOT NULL);
CREATE UNIQUE INDEX models_by_version ON models (tenant, id, version);
CREATE UNIQUE INDEX models_by_digest ON models (tenant, id, digest);
CREATE INDEX models_by_tenant ON models (tenant, number, bytes);
)";

void From5To6(SqlConnection& connection) { connection.Execute(kModels); }

// What lists filter by, beside the state. The outcome is copied from the results, which are long to read past. `tenant`
// in labels is that of the solve, for the index.
constexpr char kFilters[] = R"(
ALTER TABLE solves ADD COLUMN termination BIGINT NOT NULL DEFAULT 0;
ALTER TABLE solves ADD COLUMN verdict BIGINT NOT NULL DEFAULT 0;
ALTER TABLE solves ADD COLUMN model TEXT NOT NULL DEFAULT '';
UPDATE solves SET termination = (SELECT r.termination FROM results AS r WHERE r.id = result_id),
  verdict = (SELECT r.verdict FROM results AS r WHERE r.id = result_id) WHERE result_id IS NOT NULL;
DROP INDEX solves_by_tenant;
CREATE INDEX solves_by_tenant ON solves (tenant, number, create_time_us, model);
CREATE TABLE labels (
  solve BIGINT NOT NULL REFERENCES solves (number) ON DELETE CASCADE,
  tenant TEXT NOT NULL,
  name TEXT NOT NULL,
  value TEXT NOT NULL,
  PRIMARY KEY (solve, name)) {clustered};
CREATE INDEX labels_by_value ON labels (name, value, tenant, solve);
)";

// The models stand in the specs, of which a few are in memory at a time.
void From6To7(SqlConnection& connection) {
  connection.Execute(kFilters);
  constexpr int kSpecsAtOnce = 16;  // of 4 MiB at most
  int64_t last = 0;
  for (bool more = true; more;) {
    std::vector<std::pair<int64_t, std::string>> models;
    {
      Query query(connection, "SELECT number, spec FROM solves WHERE number > ? ORDER BY number LIMIT ?", last,
                  kSpecsAtOnce);
      v1::SolveSpec spec;
      // A spec that cannot be read has no model.
      while (query.Step()) models.emplace_back(query.Int(0), spec.ParseFromString(query.Bytes(1)) ? ModelOf(spec) : "");
    }
    for (const auto& [number, model] : models) {
      Query::Do(connection, "UPDATE solves SET model = ? WHERE number = ?", model, number);
    }
    more = models.size() == kSpecsAtOnce;
    if (more) last = models.back().first;
  }
}

// The order of the queue: fair_order.h. Weight -1: 1.
constexpr char kFairOrder[] = R"(
ALTER TABLE solves ADD COLUMN priority BIGINT NOT NULL DEFAULT 0;
ALTER TABLE tenants ADD COLUMN weight BIGINT NOT NULL DEFAULT -1;
CREATE INDEX solves_queued ON solves (tenant, state, priority DESC, number) WHERE state = 1;
CREATE TABLE shares (
  tenant TEXT PRIMARY KEY,
  start_tag BIGINT NOT NULL,
  finish_tag BIGINT NOT NULL);
CREATE INDEX shares_by_start ON shares (start_tag);
)";

void From7To8(SqlConnection& connection) { connection.Execute(kFairOrder); }

// What an attempt has come to, for agents that do not share its spool; goes with the end of the solve. `epoch` is that
// of the attempt's lease.
constexpr char kJournals[] = R"(
CREATE TABLE journals (
  solve BIGINT PRIMARY KEY REFERENCES solves (number) ON DELETE CASCADE,
  epoch BIGINT NOT NULL,
  payload {blob} NOT NULL);
)";

void From8To9(SqlConnection& connection) { connection.Execute(kJournals); }

using Step = void (*)(SqlConnection&);
// kSteps[i] leads from version i + 1 to i + 2.
constexpr Step kSteps[] = {From1To2, From2To3, From3To4, From4To5, From5To6, From6To7, From7To8, From8To9};
static_assert(std::size(kSteps) == kSchemaVersion - 1);

// An empty database gets version 2, where the steps of both engines begin.
void MakeVersion2(SqlConnection& connection) {
  for (const char* part : {kVersionTable, kResults, kSolves, kSolveIndexes, kPartsOfSolves, kAccess}) {
    connection.Execute(part);
  }
  Query(connection, "INSERT INTO schema_version (version) VALUES (2)").Run();
}

void BringUp(SqlConnection& connection) {
  int64_t version = 0;
  {
    Query query(connection, "SELECT version FROM schema_version");
    if (query.Step()) version = query.Int(0);
  }
  if (version < 1 || version > kSchemaVersion) {
    throw SqlFailure(SqlFailure::Kind::kInternal,
                     "it has schema version " + std::to_string(version) + ", this program reads versions 1 to " +
                         std::to_string(kSchemaVersion) + "; run a program at least as new as the one that wrote it");
  }
  if (version == kSchemaVersion) return;
  for (int64_t from = version; from < kSchemaVersion; ++from) kSteps[from - 1](connection);
  Query(connection, "UPDATE schema_version SET version = ?", kSchemaVersion).Run();
}

}  // namespace

void EnsureSchema(SqlConnection& connection) {
  connection.BeginSchemaChange();
  try {
    if (!connection.HasSchema()) MakeVersion2(connection);
    BringUp(connection);
    connection.Commit();
  } catch (...) {
    connection.Rollback();
    connection.EndSchemaChange();
    throw;
  }
  connection.EndSchemaChange();
}

}  // namespace rollgait::server
