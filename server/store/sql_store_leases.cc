// The calls of SqlStore that agents make.
#include <utility>

#include "rollgait/v1/solve.pb.h"
#include "server/store/sql_rows.h"
#include "server/store/sql_store.h"

namespace rollgait::server {
namespace {

// The solve of a lease that is still held.
Outcome<SolveRow> FindLeased(SqlConnection& connection, const Lease& lease) {
  std::optional<SolveRow> row = FindSolve(connection, lease.solve_id);
  if (row.has_value() && row->record.state == SolveState::kRunning && row->owner == lease.owner &&
      row->epoch == lease.epoch) {
    return std::move(*row);
  }
  return Error{ErrorCode::kLeaseLost, "the lease of " + lease.owner + " on solves/" + lease.solve_id + ", epoch " +
                                          std::to_string(lease.epoch) + ", is lost; stop working on it"};
}

void SetLease(SqlConnection& connection, std::chrono::milliseconds duration, SolveRow& row) {
  const LeaseTime now = connection.Now();
  row.lease_boot_id = now.boot_id;
  row.lease_end_ns = now.ns + std::chrono::nanoseconds(duration).count();
}

// Those that are not held already; see SolveStore::AppendEvents.
void AppendNew(SqlConnection& connection, const std::vector<StoredEvent>& events, SolveRow& row) {
  for (const StoredEvent& event : events) {
    const bool held = event.sequence > 0 && event.sequence <= row.record.last_sequence;
    if (!held) AppendEvent(connection, row, event.kind, event.payload);
  }
}

LeaseState StateOf(const SolveRow& row) { return {row.record.cancel_requested, row.record.last_sequence}; }

// Writes nothing if the lease is lost.
Outcome<LeaseState> AppendLeased(SqlConnection& connection, const Lease& lease, const std::vector<StoredEvent>& events) {
  Outcome<SolveRow> row = FindLeased(connection, lease);
  if (!row.ok()) return row.error();
  AppendNew(connection, events, row.value());
  SaveSolve(connection, row.value());
  return StateOf(row.value());
}

// Every queued solve of this key ends with the result.
void AnswerQueued(SqlConnection& connection, const std::string& solve_key, int64_t result_id, int64_t now_us) {
  if (solve_key.empty()) return;
  std::vector<SolveRow> waiting;
  {
    Query query(connection, "SELECT " ROLLGAIT_SOLVE_COLUMNS "FROM solves WHERE solve_key = ? AND state = ? ORDER BY number {for_update}", solve_key,
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
std::vector<std::string> RequeueAll(SqlConnection& connection, std::vector<SolveRow> rows, const std::string& detail,
                                    int64_t now_us) {
  std::vector<std::string> ids;
  for (SolveRow& row : rows) {
    ids.push_back(row.record.id);
    RequeueSolve(connection, row, detail, now_us);
  }
  return ids;
}

std::vector<SolveRow> RunningSolves(SqlConnection& connection) {
  std::vector<SolveRow> rows;
  Query query(connection, "SELECT " ROLLGAIT_SOLVE_COLUMNS "FROM solves WHERE state = ? ORDER BY number {skip_locked}",
              static_cast<int>(SolveState::kRunning));
  while (query.Step()) rows.push_back(ReadSolve(query));
  return rows;
}

// The oldest queued solve whose key does not run and whose tenant has room. PostgreSQL: locked.
std::optional<SolveRow> NextQueued(SqlConnection& connection) {
  Query query(connection, "SELECT " ROLLGAIT_SOLVE_COLUMNS
                          "FROM solves AS s WHERE state = 1 AND (solve_key = '' OR NOT EXISTS "
                          "(SELECT 1 FROM solves AS r WHERE r.solve_key = s.solve_key AND r.state = 2)) "
                          "AND NOT EXISTS (SELECT 1 FROM tenants AS t WHERE t.tenant = s.tenant AND t.max_running >= 0 "
                          "AND t.max_running <= "
                          "(SELECT COUNT(*) FROM solves AS b WHERE b.tenant = s.tenant AND b.state = 2)) "
                          "ORDER BY number LIMIT 1 {skip_locked}");
  if (!query.Step()) return std::nullopt;
  return ReadSolve(query);
}

// Others may have claimed for the same tenant meanwhile: counts again, alone. Throws a conflict if there is no room.
void CheckTenantHasRoom(SqlConnection& connection, const std::string& tenant) {
  int64_t limit = 0;
  {
    Query query(connection, "SELECT max_running FROM tenants WHERE tenant = ? AND max_running >= 0 {for_update}", tenant);
    if (!query.Step()) return;
    limit = query.Int(0);
  }
  Query query(connection, "SELECT COUNT(*) FROM solves WHERE tenant = ? AND state = 2", tenant);
  if (query.Step() && query.Int(0) >= limit) {
    throw SqlFailure(SqlFailure::Kind::kConflict, "tenant " + tenant + " runs as many solves as it may");
  }
}

}  // namespace

Outcome<std::optional<ClaimedSolve>> SqlStore::ClaimNext(const std::string& owner,
                                                            std::chrono::milliseconds duration) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<std::optional<ClaimedSolve>> {
    const int64_t now_us = clock_.WallMicros();
    std::optional<SolveRow> next = NextQueued(connection);
    // One that was queued while an equal one ended has its answer already.
    while (next.has_value()) {
      const int64_t reusable = FindReusableResult(connection, next->record.solve_key);
      if (reusable == 0) break;
      next->record.from_cache = true;
      EndSolve(connection, *next, SolveState::kSucceeded, reusable, "", now_us);
      next = NextQueued(connection);
    }
    if (!next.has_value()) return std::optional<ClaimedSolve>();
    SolveRow row = std::move(*next);
    CheckTenantHasRoom(connection, row.record.tenant);
    if (row.record.start_time_us == 0) row.record.start_time_us = now_us;
    row.record.attempts += 1;
    row.owner = owner;
    row.epoch += 1;
    SetLease(connection, duration, row);
    ChangeState(connection, row, SolveState::kRunning, "", now_us);
    SaveSolve(connection, row);
    Query start(connection, "SELECT payload FROM warm_starts WHERE solve = ?", row.number);
    const std::string warm_start = start.Step() ? start.Bytes(0) : "";
    return std::optional<ClaimedSolve>(ClaimedSolve{{row.record.id, owner, row.epoch}, row.record, warm_start});
  });
}

Outcome<LeaseState> SqlStore::RenewLease(const Lease& lease, std::chrono::milliseconds duration) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<LeaseState> {
    Outcome<SolveRow> row = FindLeased(connection, lease);
    if (!row.ok()) return row.error();
    SetLease(connection, duration, row.value());
    SaveSolve(connection, row.value());
    return StateOf(row.value());
  });
}

Outcome<LeaseState> SqlStore::AppendEvents(const Lease& lease, const std::vector<StoredEvent>& events) {
  return database_->Write([&](SqlConnection& connection) { return AppendLeased(connection, lease, events); });
}

Outcome<std::vector<Outcome<LeaseState>>> SqlStore::AppendAll(const std::vector<EventBatch>& batches) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<std::vector<Outcome<LeaseState>>> {
    std::vector<Outcome<LeaseState>> outcomes;
    for (const EventBatch& batch : batches) outcomes.push_back(AppendLeased(connection, batch.lease, batch.events));
    return outcomes;
  });
}

Outcome<Done> SqlStore::Finish(const Lease& lease, const std::vector<StoredEvent>& events, const SolveEnd& end) {
  ROLLGAIT_CHECK(IsTerminal(end.state));
  return database_->Write([&](SqlConnection& connection) -> Outcome<Done> {
    Outcome<SolveRow> row = FindLeased(connection, lease);
    if (!row.ok()) return row.error();
    AppendNew(connection, events, row.value());
    const int64_t now_us = clock_.WallMicros();
    const std::string& key = row.value().record.solve_key;
    int64_t result_id = 0;
    if (end.state == SolveState::kSucceeded) {
      Query query(connection, "INSERT INTO results (solve_key, reusable, payload) VALUES (?, ?, ?) RETURNING id", key,
                  end.reusable && !key.empty(), Blob{end.result});
      ROLLGAIT_CHECK(query.Step());
      result_id = query.Int(0);
      query.Run();
      row.value().bytes += static_cast<int64_t>(end.result.size());
    }
    EndSolve(connection, row.value(), end.state, result_id, end.error, now_us);
    if (result_id != 0 && end.reusable) AnswerQueued(connection, key, result_id, now_us);
    return Done{};
  });
}

Outcome<SolveState> SqlStore::GiveBack(const Lease& lease, GiveBackReason reason, const std::string& detail) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<SolveState> {
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

Outcome<std::vector<std::string>> SqlStore::CancelRequests(const std::string& owner) {
  return database_->ReadOne([&](SqlConnection& connection) -> Outcome<std::vector<std::string>> {
    std::vector<std::string> ids;
    Query query(connection, "SELECT id FROM solves WHERE state = 2 AND owner = ? AND cancel_requested = 1", owner);
    while (query.Step()) ids.push_back(query.Bytes(0));
    return ids;
  });
}

Outcome<std::vector<LeaseOwner>> SqlStore::LeaseOwners() {
  return database_->ReadOne([&](SqlConnection& connection) -> Outcome<std::vector<LeaseOwner>> {
    std::vector<LeaseOwner> owners;
    Query query(connection, "SELECT owner, COUNT(*) FROM solves WHERE state = 2 GROUP BY owner");
    while (query.Step()) owners.push_back({query.Bytes(0), static_cast<int>(query.Int(1))});
    return owners;
  });
}

Outcome<std::vector<std::string>> SqlStore::ReclaimExpired() {
  return database_->Write([&](SqlConnection& connection) -> Outcome<std::vector<std::string>> {
    const LeaseTime now = connection.Now();
    std::vector<SolveRow> expired;
    for (SolveRow& row : RunningSolves(connection)) {
      if (row.lease_boot_id != now.boot_id || row.lease_end_ns < now.ns) expired.push_back(std::move(row));
    }
    return RequeueAll(connection, std::move(expired), "its lease expired", clock_.WallMicros());
  });
}

Outcome<std::vector<std::string>> SqlStore::ReclaimOwner(const std::string& owner) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<std::vector<std::string>> {
    std::vector<SolveRow> orphaned;
    for (SolveRow& row : RunningSolves(connection)) {
      if (row.owner == owner) orphaned.push_back(std::move(row));
    }
    return RequeueAll(connection, std::move(orphaned), "its agent died", clock_.WallMicros());
  });
}

}  // namespace rollgait::server
