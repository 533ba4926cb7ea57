// The calls of SqliteStore that agents make.
#include <utility>

#include "rollgait/v1/solve.pb.h"
#include "server/store/sqlite_rows.h"
#include "server/store/sqlite_store.h"

namespace rollgait::server {
namespace {

// The solve of a lease that is still held.
Outcome<SolveRow> FindLeased(SqliteConnection& connection, const Lease& lease) {
  std::optional<SolveRow> row = FindSolve(connection, lease.solve_id);
  if (row.has_value() && row->record.state == SolveState::kRunning && row->owner == lease.owner &&
      row->epoch == lease.epoch) {
    return std::move(*row);
  }
  return Error{ErrorCode::kLeaseLost, "the lease of " + lease.owner + " on solves/" + lease.solve_id + ", epoch " +
                                          std::to_string(lease.epoch) + ", is lost; stop working on it"};
}

LeaseState StateOf(const SolveRow& row) { return {row.record.cancel_requested, row.record.last_sequence}; }

// Every queued solve of this key ends with the result.
void AnswerQueued(SqliteConnection& connection, const std::string& solve_key, int64_t result_id, int64_t now_us) {
  if (solve_key.empty()) return;
  std::vector<SolveRow> waiting;
  {
    Query query(connection, "SELECT " ROLLGAIT_SOLVE_COLUMNS "FROM solves WHERE solve_key = ? AND state = ?", solve_key,
                static_cast<int>(SolveState::kQueued));
    while (query.Step()) waiting.push_back(ReadSolve(query));
  }
  for (SolveRow& row : waiting) {
    row.record.from_cache = true;
    EndSolve(connection, row, SolveState::kSucceeded, result_id, "", now_us);
  }
}

std::string CrashError(int crashes, const std::string& detail) {
  v1::SolveError error;
  error.set_kind(v1::SolveError::KIND_CRASH);
  error.set_message("the solver process died " + std::to_string(crashes) + " times, the last time: " + detail);
  return error.SerializeAsString();
}

// Requeues the rows and returns their ids.
std::vector<std::string> RequeueAll(SqliteConnection& connection, std::vector<SolveRow> rows, const std::string& detail,
                                    int64_t now_us) {
  std::vector<std::string> ids;
  for (SolveRow& row : rows) {
    ids.push_back(row.record.id);
    RequeueSolve(connection, row, detail, now_us);
  }
  return ids;
}

std::vector<SolveRow> RunningSolves(SqliteConnection& connection) {
  std::vector<SolveRow> rows;
  Query query(connection, "SELECT " ROLLGAIT_SOLVE_COLUMNS "FROM solves WHERE state = ?",
              static_cast<int>(SolveState::kRunning));
  while (query.Step()) rows.push_back(ReadSolve(query));
  return rows;
}

}  // namespace

Outcome<std::optional<ClaimedSolve>> SqliteStore::ClaimNext(const std::string& owner,
                                                            std::chrono::milliseconds duration) {
  return Write([&](SqliteConnection& connection) -> Outcome<std::optional<ClaimedSolve>> {
    SolveRow row;
    {
      Query query(connection, "SELECT " ROLLGAIT_SOLVE_COLUMNS
                              "FROM solves AS s WHERE state = 1 AND (solve_key = '' OR NOT EXISTS "
                              "(SELECT 1 FROM solves AS r WHERE r.solve_key = s.solve_key AND r.state = 2)) "
                              "ORDER BY number LIMIT 1");
      if (!query.Step()) return std::optional<ClaimedSolve>();
      row = ReadSolve(query);
    }
    const int64_t now_us = clock_.WallMicros();
    if (row.record.start_time_us == 0) row.record.start_time_us = now_us;
    row.record.attempts += 1;
    row.owner = owner;
    row.epoch += 1;
    row.lease_boot_id = clock_.BootId();
    row.lease_end_ns = LeaseEnd(duration);
    ChangeState(connection, row, SolveState::kRunning, "", now_us);
    SaveSolve(connection, row);
    Query start(connection, "SELECT payload FROM warm_starts WHERE solve = ?", row.number);
    const std::string warm_start = start.Step() ? start.Bytes(0) : "";
    return std::optional<ClaimedSolve>(ClaimedSolve{{row.record.id, owner, row.epoch}, row.record, warm_start});
  });
}

Outcome<LeaseState> SqliteStore::RenewLease(const Lease& lease, std::chrono::milliseconds duration) {
  return Write([&](SqliteConnection& connection) -> Outcome<LeaseState> {
    Outcome<SolveRow> row = FindLeased(connection, lease);
    if (!row.ok()) return row.error();
    row.value().lease_boot_id = clock_.BootId();
    row.value().lease_end_ns = LeaseEnd(duration);
    SaveSolve(connection, row.value());
    return StateOf(row.value());
  });
}

Outcome<LeaseState> SqliteStore::AppendEvents(const Lease& lease, const std::vector<StoredEvent>& events) {
  return Write([&](SqliteConnection& connection) -> Outcome<LeaseState> {
    Outcome<SolveRow> row = FindLeased(connection, lease);
    if (!row.ok()) return row.error();
    for (const StoredEvent& event : events) AppendEvent(connection, row.value(), event.kind, event.payload);
    SaveSolve(connection, row.value());
    return StateOf(row.value());
  });
}

Outcome<Done> SqliteStore::Finish(const Lease& lease, const std::vector<StoredEvent>& events, const SolveEnd& end) {
  ROLLGAIT_CHECK(IsTerminal(end.state));
  return Write([&](SqliteConnection& connection) -> Outcome<Done> {
    Outcome<SolveRow> row = FindLeased(connection, lease);
    if (!row.ok()) return row.error();
    for (const StoredEvent& event : events) AppendEvent(connection, row.value(), event.kind, event.payload);
    const int64_t now_us = clock_.WallMicros();
    const std::string& key = row.value().record.solve_key;
    int64_t result_id = 0;
    if (end.state == SolveState::kSucceeded) {
      Query(connection, "INSERT INTO results (solve_key, reusable, payload) VALUES (?, ?, ?)", key,
            end.reusable && !key.empty(), Blob{end.result})
          .Run();
      result_id = connection.last_row();
    }
    EndSolve(connection, row.value(), end.state, result_id, end.error, now_us);
    if (result_id != 0 && end.reusable) AnswerQueued(connection, key, result_id, now_us);
    return Done{};
  });
}

Outcome<SolveState> SqliteStore::GiveBack(const Lease& lease, GiveBackReason reason, const std::string& detail) {
  return Write([&](SqliteConnection& connection) -> Outcome<SolveState> {
    Outcome<SolveRow> found = FindLeased(connection, lease);
    if (!found.ok()) return found.error();
    SolveRow row = std::move(found).value();
    const int64_t now_us = clock_.WallMicros();
    if (reason == GiveBackReason::kCrashed) row.record.crashes += 1;
    if (row.record.crashes >= kMaxCrashes && !row.record.cancel_requested) {
      EndSolve(connection, row, SolveState::kFailed, 0, CrashError(row.record.crashes, detail), now_us);
    } else {
      RequeueSolve(connection, row, detail, now_us);
    }
    return row.record.state;
  });
}

Outcome<std::vector<std::string>> SqliteStore::CancelRequests(const std::string& owner) {
  return Read([&](SqliteConnection& connection) -> Outcome<std::vector<std::string>> {
    std::vector<std::string> ids;
    Query query(connection, "SELECT id FROM solves WHERE state = 2 AND owner = ? AND cancel_requested = 1", owner);
    while (query.Step()) ids.push_back(query.Bytes(0));
    return ids;
  });
}

Outcome<std::vector<std::string>> SqliteStore::LeaseOwners() {
  return Read([&](SqliteConnection& connection) -> Outcome<std::vector<std::string>> {
    std::vector<std::string> owners;
    Query query(connection, "SELECT DISTINCT owner FROM solves WHERE state = 2");
    while (query.Step()) owners.push_back(query.Bytes(0));
    return owners;
  });
}

Outcome<std::vector<std::string>> SqliteStore::ReclaimExpired() {
  return Write([&](SqliteConnection& connection) -> Outcome<std::vector<std::string>> {
    const std::string boot_id = clock_.BootId();
    const int64_t now_ns = clock_.BootNanos();
    std::vector<SolveRow> expired;
    for (SolveRow& row : RunningSolves(connection)) {
      if (row.lease_boot_id != boot_id || row.lease_end_ns < now_ns) expired.push_back(std::move(row));
    }
    return RequeueAll(connection, std::move(expired), "its lease expired", clock_.WallMicros());
  });
}

Outcome<std::vector<std::string>> SqliteStore::ReclaimOwner(const std::string& owner) {
  return Write([&](SqliteConnection& connection) -> Outcome<std::vector<std::string>> {
    std::vector<SolveRow> orphaned;
    for (SolveRow& row : RunningSolves(connection)) {
      if (row.owner == owner) orphaned.push_back(std::move(row));
    }
    return RequeueAll(connection, std::move(orphaned), "its agent died", clock_.WallMicros());
  });
}

}  // namespace rollgait::server
