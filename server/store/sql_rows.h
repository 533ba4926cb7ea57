#ifndef ROLLGAIT_SERVER_STORE_SQL_ROWS_H_
#define ROLLGAIT_SERVER_STORE_SQL_ROWS_H_

#include <cstdint>
#include <optional>
#include <string>

#include "server/base/outcome.h"
#include "server/store/solve_record.h"
#include "server/store/sql_connection.h"

namespace rollgait::server {

// A row of `solves` but for when its lease ends, which means something while it runs only. Read, changed and written
// back (SaveSolve) within one transaction. The record's `result` is not part of it.
struct SolveRow {
  int64_t number = 0;
  int64_t result_id = 0;  // 0: none
  std::string owner;      // empty: none
  int64_t epoch = 0;
  int64_t bytes = 0;  // spec, labels, events, error, and a result of its own
  SolveRecord record;
};

// Columns of `solves` in the order that ReadSolve takes them.
#define ROLLGAIT_SOLVE_COLUMNS                                                                          \
  "number, id, spec, solve_key, state, create_time_us, start_time_us, end_time_us, attempts, crashes, " \
  "cancel_requested, from_cache, last_sequence, result_id, error, owner, epoch, "                       \
  "tenant, solver_fingerprint, traceparent, trimmed_sequence, bytes, termination, verdict, "            \
  "(SELECT {label_lines} FROM labels AS own WHERE own.solve = number), priority "
inline constexpr int kSolveColumns = 26;

// False: no solve has such an id, and no database needs to be asked.
bool CouldBeId(const std::string& text);

// The row that a query over ROLLGAIT_SOLVE_COLUMNS stands on.
SolveRow ReadSolve(const Query& query);

// Nobody else changes the row until the end of the transaction.
std::optional<SolveRow> FindSolve(SqlConnection& connection, const std::string& id);

// The solve of a lease that is still held: id, owner and epoch are the lease's.
#define ROLLGAIT_IS_LEASED "WHERE id = ? AND state = 2 AND owner = ? AND epoch = ? "
Error LeaseLost(const Lease& lease);

// Writes everything that can change. Nothing here that writes waits for the answer (Query::Do).
void SaveSolve(SqlConnection& connection, const SolveRow& row);

// Counts an event with this payload, which has row.record.last_sequence from then on; the row is to be saved
// afterwards.
void CountEvent(SolveRow& row, const std::string& payload);
void InsertEvent(SqlConnection& connection, int64_t solve, const StoredEvent& event);
// Both.
void AppendEvent(SqlConnection& connection, SolveRow& row, EventKind kind, const std::string& payload);

// The payload of the event that tells of the row's state.
std::string StateChangeEvent(const SolveRow& row, const std::string& detail, int64_t now_us);

// Sets the state and appends its event.
void ChangeState(SqlConnection& connection, SolveRow& row, SolveState state, const std::string& detail, int64_t now_us);

// A row of `results`.
struct ResultRow {
  int64_t id = 0;  // 0: none
  int termination = 0, verdict = 0;
};

// Ends the solve: state, end time, result, terminal event, no lease; saves the row. `error` empty: none. A result
// takes the place of the solution that the solve has so far, which stays without one.
void EndSolve(SqlConnection& connection, SolveRow& row, SolveState state, const ResultRow& result,
              const std::string& error, int64_t now_us);

// Puts a running solve back into the queue, or ends it if it was to be cancelled; saves the row.
void RequeueSolve(SqlConnection& connection, SolveRow& row, const std::string& detail, int64_t now_us);

// Its result may be the nearest of `nearest`.
void MarkOptimal(SqlConnection& connection, int64_t solve);

// Removes the solve, its events, and its result unless another solve shares it.
void RemoveSolve(SqlConnection& connection, const SolveRow& row);

// The v1::SolveError of a cancelled solve.
std::string CancelledError();

// What somebody did, for the audit.
struct AuditEntry {
  const Actor& actor;
  std::string action;   // create, cancel, delete, set priority, end, expire, create model, delete model
  std::string solve;    // id; empty: of none
  std::string outcome;  // the solve's state
  std::string detail = {};
};
void AddAudit(SqlConnection& connection, const AuditEntry& entry, int64_t now_us);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SQL_ROWS_H_
