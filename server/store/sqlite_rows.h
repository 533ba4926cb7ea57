#ifndef ROLLGAIT_SERVER_STORE_SQLITE_ROWS_H_
#define ROLLGAIT_SERVER_STORE_SQLITE_ROWS_H_

#include <cstdint>
#include <optional>
#include <string>

#include "server/store/solve_record.h"
#include "server/store/sqlite_connection.h"

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
  SolveRecord record;
};

// Columns of `solves` in the order that ReadSolve takes them.
#define ROLLGAIT_SOLVE_COLUMNS                                                                          \
  "number, id, spec, solve_key, state, create_time_us, start_time_us, end_time_us, attempts, crashes, " \
  "cancel_requested, from_cache, last_sequence, result_id, error, owner, epoch, lease_boot_id, lease_end_ns "

// The row that a query over ROLLGAIT_SOLVE_COLUMNS stands on.
SolveRow ReadSolve(const Query& query);

std::optional<SolveRow> FindSolve(SqliteConnection& connection, const std::string& id);

// Writes everything that can change.
void SaveSolve(SqliteConnection& connection, const SolveRow& row);

// Appends an event and counts row.record.last_sequence up; the row is to be saved afterwards.
void AppendEvent(SqliteConnection& connection, SolveRow& row, EventKind kind, const std::string& payload);

// Sets the state and appends its event.
void ChangeState(SqliteConnection& connection, SolveRow& row, SolveState state, const std::string& detail,
                 int64_t now_us);

// Ends the solve: state, end time, terminal event, no lease; saves the row. `result_id` 0 and `error` empty: none.
void EndSolve(SqliteConnection& connection, SolveRow& row, SolveState state, int64_t result_id,
              const std::string& error, int64_t now_us);

// Puts a running solve back into the queue, or ends it if it was to be cancelled; saves the row.
void RequeueSolve(SqliteConnection& connection, SolveRow& row, const std::string& detail, int64_t now_us);

// A reusable result of this key; 0: none. An empty key has none.
int64_t FindReusableResult(SqliteConnection& connection, const std::string& solve_key);

// The v1::SolveError of a cancelled solve.
std::string CancelledError();

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SQLITE_ROWS_H_
