#ifndef ROLLGAIT_SERVER_STORE_SQL_ROWS_H_
#define ROLLGAIT_SERVER_STORE_SQL_ROWS_H_

#include <cstdint>
#include <optional>
#include <string>

#include "server/store/solve_record.h"
#include "server/store/sql_connection.h"

namespace rollgait::server {

// A row of `solves`. Read, changed and written back (SaveSolve) within one transaction. The record's `result` is not
// part of it.
struct SolveRow {
  int64_t number = 0;
  int64_t result_id = 0;  // 0: none
  std::string owner;      // empty: none
  int64_t epoch = 0;
  std::string lease_boot_id;
  int64_t lease_end_ns = 0;
  int64_t bytes = 0;  // spec, events, error, and a result of its own
  SolveRecord record;
};

// Columns of `solves` in the order that ReadSolve takes them.
#define ROLLGAIT_SOLVE_COLUMNS                                                                          \
  "number, id, spec, solve_key, state, create_time_us, start_time_us, end_time_us, attempts, crashes, " \
  "cancel_requested, from_cache, last_sequence, result_id, error, owner, epoch, lease_boot_id, lease_end_ns, " \
  "tenant, solver_fingerprint, traceparent, trimmed_sequence, bytes "
inline constexpr int kSolveColumns = 24;

// False: no solve has such an id, and no database needs to be asked.
bool CouldBeId(const std::string& text);

// The row that a query over ROLLGAIT_SOLVE_COLUMNS stands on.
SolveRow ReadSolve(const Query& query);

// Nobody else changes the row until the end of the transaction.
std::optional<SolveRow> FindSolve(SqlConnection& connection, const std::string& id);

// Writes everything that can change.
void SaveSolve(SqlConnection& connection, const SolveRow& row);

// Appends an event and counts row.record.last_sequence up; the row is to be saved afterwards.
void AppendEvent(SqlConnection& connection, SolveRow& row, EventKind kind, const std::string& payload);

// Sets the state and appends its event.
void ChangeState(SqlConnection& connection, SolveRow& row, SolveState state, const std::string& detail,
                 int64_t now_us);

// Ends the solve: state, end time, terminal event, no lease; saves the row. `result_id` 0 and `error` empty: none.
void EndSolve(SqlConnection& connection, SolveRow& row, SolveState state, int64_t result_id,
              const std::string& error, int64_t now_us);

// Puts a running solve back into the queue, or ends it if it was to be cancelled; saves the row.
void RequeueSolve(SqlConnection& connection, SolveRow& row, const std::string& detail, int64_t now_us);

// Removes the solve, its events, and its result unless another solve shares it.
void RemoveSolve(SqlConnection& connection, const SolveRow& row);

// A reusable result of this key; 0: none. An empty key has none.
int64_t FindReusableResult(SqlConnection& connection, const std::string& solve_key);

// The v1::SolveError of a cancelled solve.
std::string CancelledError();

// What somebody did, for the audit.
struct AuditEntry {
  const Actor& actor;
  std::string action;   // create, cancel, delete, end, expire
  std::string solve;    // id
  std::string outcome;  // the solve's state
  std::string detail = {};
};
void AddAudit(SqlConnection& connection, const AuditEntry& entry, int64_t now_us);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SQL_ROWS_H_
