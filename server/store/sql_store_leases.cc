// The calls of SqlStore that agents make.
#include <deque>
#include <utility>

#include "rollgait/v1/solve.pb.h"
#include "server/store/fair_order.h"
#include "server/store/sql_rows.h"
#include "server/store/sql_store.h"

namespace rollgait::server {
namespace {

int64_t Nanos(std::chrono::milliseconds time) { return std::chrono::nanoseconds(time).count(); }

// Asks for the solve of a lease, if that is still held.
Query AskLeased(SqlConnection& connection, const Lease& lease) {
  return Query(connection, "SELECT " ROLLGAIT_SOLVE_COLUMNS "FROM solves " ROLLGAIT_IS_LEASED "{for_update}",
               lease.solve_id, lease.owner, lease.epoch);
}

// Those that are not held already; see SolveStore::AppendEvents. The row is to be saved afterwards.
void AppendNew(SqlConnection& connection, const std::vector<StoredEvent>& events, SolveRow& row) {
  for (const StoredEvent& event : events) {
    const bool held = event.sequence > 0 && event.sequence <= row.record.last_sequence;
    if (!held) AppendEvent(connection, row, event.kind, event.payload);
  }
}

void InsertResult(SqlConnection& connection, const ResultRow& row, const std::string& key, bool reusable,
                  const std::string& payload) {
  Query::Do(connection,
            "INSERT INTO results (id, solve_key, reusable, payload, termination, verdict) {given_key} VALUES (?, "
            "?, ?, ?, ?, ?)",
            row.id, key, reusable, Blob{payload}, row.termination, row.verdict);
}

// The solution that a solve has so far: its result until the solve ends, which answers nobody else and does not count
// as stored by the tenant. The row is to be saved afterwards.
void KeepSolution(SqlConnection& connection, SolveRow& row, const std::string& solution) {
  if (row.result_id == 0) {
    Query next(connection, "SELECT {next_result}");
    ROLLGAIT_CHECK(next.Step());
    row.result_id = next.Int(0);
    InsertResult(connection, {row.result_id}, "", false, solution);
  } else {
    Query::Do(connection, "UPDATE results SET payload = ? WHERE id = ?", Blob{solution}, row.result_id);
  }
}

// Appends to leased solves: asks for all that are leased, then writes. An outcome for each batch.
class Appender {
 public:
  // Only what events change is read: a spec may be large.
  void Ask(SqlConnection& connection, const Lease& lease) {
    leased_.emplace_back(
        connection,
        "SELECT number, last_sequence, bytes, cancel_requested, result_id FROM solves " ROLLGAIT_IS_LEASED
        "{for_update}",
        lease.solve_id, lease.owner, lease.epoch);
  }
  // Of the first that was asked for and not written. Writes nothing if the lease is lost.
  Outcome<LeaseState> Write(SqlConnection& connection, const Lease& lease, const std::vector<StoredEvent>& events,
                            const std::string& solution = "") {
    Query& query = leased_.front();
    const bool leased = query.Step();
    SolveRow row;
    if (leased) {
      row.number = query.Int(0);
      row.record.last_sequence = query.Int(1);
      row.bytes = query.Int(2);
      row.record.cancel_requested = query.Int(3) != 0;
      row.result_id = query.Int(4);
    }
    leased_.pop_front();
    if (!leased) return LeaseLost(lease);
    AppendNew(connection, events, row);
    if (!solution.empty()) KeepSolution(connection, row, solution);
    Query::Do(connection, "UPDATE solves SET last_sequence = ?, bytes = ?, result_id = NULLIF(?, 0) WHERE number = ?",
              row.record.last_sequence, row.bytes, row.result_id, row.number);
    return LeaseState{row.record.cancel_requested, row.record.last_sequence};
  }

 private:
  std::deque<Query> leased_;
};

std::vector<SolveRow> AllRows(Query& query) {
  std::vector<SolveRow> rows;
  while (query.Step()) rows.push_back(ReadSolve(query));
  return rows;
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

// What a claim may take, and what it needs to know of it.
struct Candidate {
  SolveRow row;
  int64_t reusable = 0;      // a result of its key; 0: none
  int64_t max_running = -1;  // of its tenant; -1: no limit
  std::string warm_start;
  Share share;
};

// The queued solve of the highest priority of one tenant, the oldest of them, whose key does not run. PostgreSQL:
// locked.
#define ROLLGAIT_NEXT_OF(tenant_is)                                                                  \
  "SELECT " ROLLGAIT_SOLVE_COLUMNS                                                                   \
  ", (SELECT MIN(r.id) FROM results AS r WHERE r.solve_key = s.solve_key AND s.solve_key <> '' AND " \
  "r.reusable = 1), "                                                                                \
  "COALESCE((SELECT t.max_running FROM tenants AS t WHERE t.tenant = s.tenant), -1), "               \
  "(SELECT w.payload FROM warm_starts AS w WHERE w.solve = s.number), " ROLLGAIT_SHARE_COLUMNS       \
  "FROM solves AS s {along_queue} WHERE state = 1 AND tenant = " tenant_is                           \
  " AND (solve_key = '' OR NOT EXISTS "                                                              \
  "(SELECT 1 FROM solves AS r WHERE r.solve_key = s.solve_key AND r.state = 2)) "                    \
  "ORDER BY priority DESC, number LIMIT 1 {skip_locked}"

std::optional<Candidate> ReadCandidate(Query& query) {
  if (!query.Step()) return std::nullopt;
  return Candidate{ReadSolve(query), query.Int(kSolveColumns), query.Int(kSolveColumns + 1),
                   query.Bytes(kSolveColumns + 2), ReadShare(query, kSolveColumns + 3)};
}

// Of the tenant whose turn it is; if that has none, all tenants are asked, by their turns. Who they are is asked at the
// same time, so that an empty queue costs one wait.
std::optional<Candidate> NextQueued(SqlConnection& connection) {
  Query first(connection, ROLLGAIT_NEXT_OF("(" ROLLGAIT_TENANTS_BY_TURN "LIMIT 1)"));
  Query turns(connection, ROLLGAIT_TENANTS_BY_TURN);
  std::optional<Candidate> next = ReadCandidate(first);
  if (next.has_value()) return next;
  std::vector<std::string> tenants;
  while (turns.Step()) tenants.push_back(turns.Bytes(0));
  for (const std::string& tenant : tenants) {
    Query query(connection, ROLLGAIT_NEXT_OF("?"), tenant);
    next = ReadCandidate(query);
    if (next.has_value()) break;
  }
  return next;
}

ResultRow FindResult(SqlConnection& connection, int64_t id) {
  Query query(connection, "SELECT termination, verdict FROM results WHERE id = ?", id);
  ROLLGAIT_CHECK(query.Step());
  return {id, static_cast<int>(query.Int(0)), static_cast<int>(query.Int(1))};
}

// Others may have claimed for the same tenant meanwhile: counts again, alone (the count comes after the lock). Throws a
// conflict if there is no room.
void CheckTenantHasRoom(SqlConnection& connection, const std::string& tenant) {
  Query limit(connection, "SELECT max_running FROM tenants WHERE tenant = ? AND max_running >= 0 {for_update}", tenant);
  Query running(connection, "SELECT COUNT(*) FROM solves WHERE tenant = ? AND state = 2", tenant);
  if (limit.Step() && running.Step() && running.Int(0) >= limit.Int(0)) {
    throw SqlFailure(SqlFailure::Kind::kConflict, "tenant " + tenant + " runs as many solves as it may");
  }
}

}  // namespace

Outcome<std::optional<ClaimedSolve>> SqlStore::ClaimNext(const std::string& owner, std::chrono::milliseconds duration) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<std::optional<ClaimedSolve>> {
    const int64_t now_us = clock_.WallMicros();
    std::optional<Candidate> next = NextQueued(connection);
    // One that was queued while an equal one ended has its answer already.
    for (; next.has_value() && next->reusable != 0; next = NextQueued(connection)) {
      next->row.record.from_cache = true;
      EndSolve(connection, next->row, SolveState::kSucceeded, FindResult(connection, next->reusable), "", now_us);
    }
    if (!next.has_value()) return std::optional<ClaimedSolve>();
    SolveRow& row = next->row;
    SolveRecord& record = row.record;
    if (next->max_running >= 0) CheckTenantHasRoom(connection, record.tenant);
    CountClaim(connection, record.tenant, next->share);
    if (record.start_time_us == 0) record.start_time_us = now_us;
    record.attempts += 1;
    row.epoch += 1;
    ChangeState(connection, row, SolveState::kRunning, "", now_us);
    Query::Do(connection,
              "UPDATE solves SET state = 2, start_time_us = ?, attempts = ?, last_sequence = ?, owner = ?, epoch = ?, "
              "bytes = ?, lease_boot_id = {boot_id}, lease_end_ns = {now_ns} + ? WHERE number = ?",
              record.start_time_us, record.attempts, record.last_sequence, owner, row.epoch, row.bytes, Nanos(duration),
              row.number);
    return std::optional(ClaimedSolve{{record.id, owner, row.epoch}, record, next->warm_start});
  });
}

Outcome<LeaseState> SqlStore::RenewLease(const Lease& lease, std::chrono::milliseconds duration) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<LeaseState> {
    Query query(connection,
                "UPDATE solves SET lease_boot_id = {boot_id}, lease_end_ns = {now_ns} + ? " ROLLGAIT_IS_LEASED
                "RETURNING cancel_requested, last_sequence",
                Nanos(duration), lease.solve_id, lease.owner, lease.epoch);
    if (!query.Step()) return LeaseLost(lease);
    const LeaseState state{query.Int(0) != 0, query.Int(1)};
    query.Run();
    return state;
  });
}

Outcome<LeaseState> SqlStore::AppendEvents(const Lease& lease, const std::vector<StoredEvent>& events) {
  return database_->Write([&](SqlConnection& connection) {
    Appender appender;
    appender.Ask(connection, lease);
    return appender.Write(connection, lease, events);
  });
}

Outcome<std::vector<Outcome<LeaseState>>> SqlStore::AppendAll(const std::vector<EventBatch>& batches) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<std::vector<Outcome<LeaseState>>> {
    Appender appender;
    for (const EventBatch& batch : batches) appender.Ask(connection, batch.lease);
    std::vector<Outcome<LeaseState>> outcomes;
    for (const EventBatch& batch : batches)
      outcomes.push_back(appender.Write(connection, batch.lease, batch.events, batch.solution));
    return outcomes;
  });
}

Outcome<Done> SqlStore::Finish(const Lease& lease, const std::vector<StoredEvent>& events, const SolveEnd& end) {
  ROLLGAIT_CHECK(IsTerminal(end.state));
  const bool succeeded = end.state == SolveState::kSucceeded;
  v1::SolveResult said;
  if (!said.ParseFromString(end.result))
    said.Clear();  // stored all the same; whoever reads it says that it cannot be read
  return database_->Write([&](SqlConnection& connection) -> Outcome<Done> {
    Query leased = AskLeased(connection, lease);
    std::optional<Query> next_result, equal;
    if (succeeded) next_result.emplace(connection, "SELECT {next_result}");
    if (succeeded && end.reusable) {
      equal.emplace(connection,
                    "SELECT " ROLLGAIT_SOLVE_COLUMNS
                    "FROM solves WHERE solve_key = (SELECT solve_key FROM solves WHERE id = ?) AND solve_key <> '' "
                    "AND state = 1 ORDER BY number {for_update}",
                    lease.solve_id);
    }
    if (!leased.Step()) return LeaseLost(lease);
    SolveRow row = ReadSolve(leased);
    AppendNew(connection, events, row);
    const int64_t now_us = clock_.WallMicros();
    const std::string& key = row.record.solve_key;
    ResultRow result;
    if (next_result.has_value()) {
      ROLLGAIT_CHECK(next_result->Step());
      result = {next_result->Int(0), static_cast<int>(said.termination()), static_cast<int>(said.accuracy().verdict())};
      InsertResult(connection, result, key, end.reusable && !key.empty(), end.result);
      row.bytes += static_cast<int64_t>(end.result.size());
    }
    const bool optimal = succeeded && result.termination == v1::TERMINATION_OPTIMAL;
    if (optimal) MarkOptimal(connection, row.number);
    if (!succeeded && !end.result.empty()) KeepSolution(connection, row, end.result);
    EndSolve(connection, row, end.state, result, end.error, now_us);
    if (!equal.has_value()) return Done{};
    // Those that wait for the result of an equal one.
    for (SolveRow& waiting : AllRows(*equal)) {
      waiting.record.from_cache = true;
      if (optimal) MarkOptimal(connection, waiting.number);
      EndSolve(connection, waiting, SolveState::kSucceeded, result, "", now_us);
    }
    return Done{};
  });
}

Outcome<SolveState> SqlStore::GiveBack(const Lease& lease, GiveBackReason reason, const std::string& detail) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<SolveState> {
    Query leased = AskLeased(connection, lease);
    if (!leased.Step()) return LeaseLost(lease);
    SolveRow row = ReadSolve(leased);
    const int64_t now_us = clock_.WallMicros();
    if (reason == GiveBackReason::kCrashed) row.record.crashes += 1;
    if (row.record.crashes >= kMaxCrashes && !row.record.cancel_requested) {
      EndSolve(connection, row, SolveState::kFailed, {}, CrashError(row.record.crashes, detail), now_us);
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
    Query query(connection, "SELECT " ROLLGAIT_SOLVE_COLUMNS
                            "FROM solves WHERE state = 2 AND (lease_boot_id <> {boot_id} OR lease_end_ns < {now_ns}) "
                            "ORDER BY number {skip_locked}");
    return RequeueAll(connection, AllRows(query), "its lease expired", clock_.WallMicros());
  });
}

Outcome<std::vector<std::string>> SqlStore::ReclaimOwner(const std::string& owner) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<std::vector<std::string>> {
    Query query(connection,
                "SELECT " ROLLGAIT_SOLVE_COLUMNS
                "FROM solves WHERE state = 2 AND owner = ? ORDER BY number {skip_locked}",
                owner);
    return RequeueAll(connection, AllRows(query), "its agent died", clock_.WallMicros());
  });
}

}  // namespace rollgait::server
