#include "server/store/sqlite_store.h"

#include <cstdint>
#include <utility>

#include "server/store/page_token.h"
#include "server/store/sqlite_rows.h"
#include "server/store/sqlite_schema.h"

namespace rollgait::server {
namespace {

Error NoSuchSolve(const std::string& id) {
  return {ErrorCode::kNotFound, "there is no solve \"solves/" + id + "\"; ListSolves lists those that are"};
}

// The record with its result.
SolveRecord FullRecord(SqliteConnection& connection, SolveRow row) {
  if (row.result_id != 0) {
    Query query(connection, "SELECT payload FROM results WHERE id = ?", row.result_id);
    if (query.Step()) row.record.result = query.Bytes(0);
  }
  return std::move(row.record);
}

int CountState(SqliteConnection& connection, SolveState state) {
  Query query(connection, "SELECT COUNT(*) FROM solves WHERE state = ?", static_cast<int>(state));
  return query.Step() ? static_cast<int>(query.Int(0)) : 0;
}

// The solve made before with this request_id.
std::optional<SolveRow> FindRequest(SqliteConnection& connection, const std::string& request_id) {
  Query query(connection, "SELECT " ROLLGAIT_SOLVE_COLUMNS "FROM solves WHERE request_id = ?", request_id);
  if (!query.Step()) return std::nullopt;
  return ReadSolve(query);
}

// What the first event of a queued solve says: why it waits, if it waits for another (single flight).
std::string QueuedDetail(SqliteConnection& connection, const std::string& solve_key) {
  if (solve_key.empty()) return "";
  Query query(connection, "SELECT id FROM solves WHERE solve_key = ? AND state IN (1, 2) ORDER BY number LIMIT 1",
              solve_key);
  return query.Step() ? "waits for the result of the equal request solves/" + query.Bytes(0) : "";
}

Error QueueFull(int queued, int limit) {
  return {ErrorCode::kResourceExhausted,
          std::to_string(queued) + " solves are queued, the limit is " + std::to_string(limit) + "; try again later",
          {},
          std::chrono::milliseconds(1000)};
}

void InsertSolve(SqliteConnection& connection, const NewSolve& solve, SolveRow& row) {
  Query(connection,
        "INSERT INTO solves (id, request_id, spec, solve_key, state, create_time_us) "
        "VALUES (?, NULLIF(?, ''), ?, ?, ?, ?)",
        solve.id, solve.request_id, Blob{solve.spec}, solve.solve_key, static_cast<int>(SolveState::kQueued),
        row.record.create_time_us)
      .Run();
  row.number = connection.last_row();
  if (!solve.warm_start.empty()) {
    Query(connection, "INSERT INTO warm_starts (solve, payload) VALUES (?, ?)", row.number, Blob{solve.warm_start}).Run();
  }
  row.record.id = solve.id;
  row.record.spec = solve.spec;
  row.record.solve_key = solve.solve_key;
}

}  // namespace

Outcome<std::unique_ptr<SqliteStore>> SqliteStore::Open(const std::string& path, const Clock& clock) {
  try {
    std::unique_ptr<SqliteStore> store(new SqliteStore(path, clock));
    EnsureSchema(store->writer_);
    return store;
  } catch (const SqliteFailure& failure) {
    return Error{ErrorCode::kUnavailable, "cannot use the store " + path + ": " + failure.what()};
  }
}

Error SqliteStore::ToError(const SqliteFailure& failure) {
  switch (failure.code()) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_NOMEM:
      return {ErrorCode::kUnavailable, std::string("the store cannot do this now: ") + failure.what()};
    default:
      return {ErrorCode::kInternal, std::string("the store failed: ") + failure.what()};
  }
}

int64_t SqliteStore::LeaseEnd(std::chrono::milliseconds duration) const {
  return clock_.BootNanos() + std::chrono::nanoseconds(duration).count();
}

Outcome<CreatedSolve> SqliteStore::Create(const NewSolve& solve) {
  return Write([&](SqliteConnection& connection) -> Outcome<CreatedSolve> {
    if (!solve.request_id.empty()) {
      if (std::optional<SolveRow> old = FindRequest(connection, solve.request_id)) {
        if (old->record.spec == solve.spec) return CreatedSolve{FullRecord(connection, std::move(*old)), false};
        return Error{ErrorCode::kAlreadyExists, "request_id \"" + solve.request_id + "\" belongs to solves/" +
                                                    old->record.id + ", which has another spec; use a new request_id"};
      }
    }
    const int64_t reusable = FindReusableResult(connection, solve.solve_key);
    const int queued = CountState(connection, SolveState::kQueued);
    if (reusable == 0 && queued >= solve.max_queued) return QueueFull(queued, solve.max_queued);
    const std::string detail = QueuedDetail(connection, solve.solve_key);
    SolveRow row;
    row.record.create_time_us = clock_.WallMicros();
    InsertSolve(connection, solve, row);
    ChangeState(connection, row, SolveState::kQueued, detail, row.record.create_time_us);
    if (reusable != 0) {
      row.record.from_cache = true;
      EndSolve(connection, row, SolveState::kSucceeded, reusable, "", row.record.create_time_us);
    } else {
      SaveSolve(connection, row);
    }
    return CreatedSolve{FullRecord(connection, std::move(row)), true};
  });
}

Outcome<SolveRecord> SqliteStore::Get(const std::string& id) {
  return Read([&](SqliteConnection& connection) -> Outcome<SolveRecord> {
    std::optional<SolveRow> row = FindSolve(connection, id);
    if (!row.has_value()) return NoSuchSolve(id);
    return FullRecord(connection, std::move(*row));
  });
}

Outcome<SolvePage> SqliteStore::List(const ListQuery& query) {
  int64_t before = INT64_MAX;
  if (!query.page_token.empty()) {
    const std::optional<int64_t> parsed = ParsePageToken(query.page_token, query.state);
    if (!parsed.has_value()) {
      const std::string message =
          "is not a token of this list: give back next_page_token unchanged, with the same state";
      return Error{ErrorCode::kInvalidArgument, "page_token " + message, {{"page_token", message}}};
    }
    before = *parsed;
  }
  return Read([&](SqliteConnection& connection) -> Outcome<SolvePage> {
    const int limit = query.page_size + 1;  // one more tells whether there is a next page
    const bool all = !query.state.has_value();
    Query rows(connection,
               all ? "SELECT " ROLLGAIT_SOLVE_COLUMNS
                     "FROM solves WHERE ? = 0 AND number < ? ORDER BY number DESC LIMIT ?"
                   : "SELECT " ROLLGAIT_SOLVE_COLUMNS
                     "FROM solves WHERE state = ? AND number < ? ORDER BY number DESC LIMIT ?",
               all ? 0 : static_cast<int>(*query.state), before, limit);
    SolvePage page;
    int64_t last_number = 0;
    size_t bytes = 0;
    while (rows.Step()) {
      if (static_cast<int>(page.records.size()) == query.page_size || bytes > kMaxPageBytes) {
        page.next_page_token = MakePageToken(last_number, query.state);
        break;
      }
      SolveRow row = ReadSolve(rows);
      last_number = row.number;
      bytes += row.record.spec.size() + row.record.error.size();
      page.records.push_back(std::move(row.record));
    }
    return page;
  });
}

Outcome<Done> SqliteStore::Delete(const std::string& id) {
  return Write([&](SqliteConnection& connection) -> Outcome<Done> {
    const std::optional<SolveRow> row = FindSolve(connection, id);
    if (!row.has_value()) return NoSuchSolve(id);
    if (!IsTerminal(row->record.state)) {
      return Error{ErrorCode::kFailedPrecondition, "solves/" + id + " has not finished; cancel it first"};
    }
    Query(connection, "DELETE FROM solves WHERE number = ?", row->number).Run();
    Query(connection, "DELETE FROM results WHERE id = ? AND NOT EXISTS (SELECT 1 FROM solves WHERE result_id = ?)",
          row->result_id, row->result_id)
        .Run();
    return Done{};
  });
}

Outcome<SolveRecord> SqliteStore::RequestCancel(const std::string& id) {
  return Write([&](SqliteConnection& connection) -> Outcome<SolveRecord> {
    std::optional<SolveRow> row = FindSolve(connection, id);
    if (!row.has_value()) return NoSuchSolve(id);
    if (row->record.state == SolveState::kQueued) {
      row->record.cancel_requested = true;
      EndSolve(connection, *row, SolveState::kCancelled, 0, CancelledError(), clock_.WallMicros());
    } else if (row->record.state == SolveState::kRunning && !row->record.cancel_requested) {
      row->record.cancel_requested = true;
      SaveSolve(connection, *row);
    }
    return FullRecord(connection, std::move(*row));
  });
}

Outcome<EventPage> SqliteStore::ReadEvents(const std::string& id, int64_t after_sequence, int max_events) {
  return Read([&](SqliteConnection& connection) -> Outcome<EventPage> {
    EventPage page;
    int64_t number = 0;
    {
      Query query(connection, "SELECT number, last_sequence, state FROM solves WHERE id = ?", id);
      if (!query.Step()) return NoSuchSolve(id);
      number = query.Int(0);
      page.last_sequence = query.Int(1);
      page.state = static_cast<SolveState>(query.Int(2));
    }
    if (after_sequence < 0 || after_sequence > page.last_sequence) {
      return Error{ErrorCode::kOutOfRange,
                   "after_sequence is " + std::to_string(after_sequence) + ", the events of solves/" + id +
                       " are 1 to " + std::to_string(page.last_sequence) + "; use a number from 0 to the last"};
    }
    Query query(connection,
                "SELECT sequence, kind, payload FROM events WHERE solve = ? AND sequence > ? ORDER BY sequence LIMIT ?",
                number, after_sequence, max_events);
    while (query.Step()) {
      page.events.push_back({query.Int(0), static_cast<EventKind>(query.Int(1)), query.Bytes(2)});
    }
    return page;
  });
}

Outcome<SolveCounts> SqliteStore::Counts() {
  return Read([&](SqliteConnection& connection) -> Outcome<SolveCounts> {
    return SolveCounts{CountState(connection, SolveState::kQueued), CountState(connection, SolveState::kRunning)};
  });
}

}  // namespace rollgait::server
