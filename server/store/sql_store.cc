#include "server/store/sql_store.h"

#include <cstdint>
#include <utility>

#include "server/store/page_token.h"
#include "server/store/sql_rows.h"
#include "server/store/schema.h"

namespace rollgait::server {
namespace {

Error NoSuchSolve(const std::string& id) {
  return {ErrorCode::kNotFound, "there is no solve \"solves/" + id + "\"; ListSolves lists those that are"};
}

// The record with its result.
SolveRecord FullRecord(SqlConnection& connection, SolveRow row) {
  if (row.result_id != 0) {
    Query query(connection, "SELECT payload FROM results WHERE id = ?", row.result_id);
    if (query.Step()) row.record.result = query.Bytes(0);
  }
  return std::move(row.record);
}

// Solves in a state, of one tenant if one is given.
int CountState(SqlConnection& connection, SolveState state, const std::string* tenant) {
  if (tenant == nullptr) {
    Query query(connection, "SELECT COUNT(*) FROM solves WHERE state = ?", static_cast<int>(state));
    return query.Step() ? static_cast<int>(query.Int(0)) : 0;
  }
  Query query(connection, "SELECT COUNT(*) FROM solves WHERE tenant = ? AND state = ?", *tenant, static_cast<int>(state));
  return query.Step() ? static_cast<int>(query.Int(0)) : 0;
}

// The solve that its tenant made before with this request_id.
std::optional<SolveRow> FindRequest(SqlConnection& connection, const NewSolve& solve) {
  Query query(connection, "SELECT " ROLLGAIT_SOLVE_COLUMNS "FROM solves WHERE tenant = ? AND request_id = ?",
              solve.actor.tenant, solve.request_id);
  if (!query.Step()) return std::nullopt;
  return ReadSolve(query);
}

// What the first event of a queued solve says: why it waits, if it waits for another (single flight).
std::string QueuedDetail(SqlConnection& connection, const std::string& solve_key) {
  if (solve_key.empty()) return "";
  Query query(connection, "SELECT id FROM solves WHERE solve_key = ? AND state IN (1, 2) ORDER BY number LIMIT 1",
              solve_key);
  return query.Step() ? "waits for the result of the equal request solves/" + query.Bytes(0) : "";
}

// Why no more may be queued; nullopt: they may.
std::optional<Error> QueueFull(SqlConnection& connection, const NewSolve& solve) {
  const int queued = CountState(connection, SolveState::kQueued, nullptr);
  if (queued >= solve.max_queued) {
    return Error{ErrorCode::kResourceExhausted,
                 std::to_string(queued) + " solves are queued, the limit is " + std::to_string(solve.max_queued) +
                     "; try again later",
                 {},
                 std::chrono::milliseconds(1000)};
  }
  if (solve.max_queued_tenant <= 0) return std::nullopt;
  const std::string& tenant = solve.actor.tenant;
  const int own = CountState(connection, SolveState::kQueued, &tenant);
  if (own < solve.max_queued_tenant) return std::nullopt;
  const std::string text = std::to_string(own) + " solves of tenant \"" + tenant + "\" are queued, its limit is " +
                           std::to_string(solve.max_queued_tenant);
  Error error{ErrorCode::kResourceExhausted, text + "; try again later", {}, std::chrono::milliseconds(1000)};
  error.quota = {"tenant:" + tenant, text};
  return error;
}

void InsertSolve(SqlConnection& connection, const NewSolve& solve, SolveRow& row) {
  SolveRecord& record = row.record;
  record.id = solve.id;
  record.spec = solve.spec;
  row.bytes = static_cast<int64_t>(solve.spec.size());
  record.solve_key = solve.solve_key;
  record.tenant = solve.actor.tenant;
  record.solver_fingerprint = solve.solver_fingerprint;
  record.traceparent = solve.traceparent;
  {
    Query query(connection,
                "INSERT INTO solves (id, tenant, request_id, spec, solve_key, solver_fingerprint, traceparent, state, "
                "create_time_us) VALUES (?, ?, NULLIF(?, ''), ?, ?, ?, ?, ?, ?) RETURNING number",
                record.id, record.tenant, solve.request_id, Blob{record.spec}, record.solve_key,
                record.solver_fingerprint, record.traceparent, static_cast<int>(SolveState::kQueued),
                record.create_time_us);
    ROLLGAIT_CHECK(query.Step());
    row.number = query.Int(0);
    query.Run();
  }
  if (!solve.warm_start.empty()) {
    Query(connection, "INSERT INTO warm_starts (solve, payload) VALUES (?, ?)", row.number, Blob{solve.warm_start}).Run();
  }
}

Query PageOf(SqlConnection& connection, const ListQuery& query, int64_t before) {
  const int limit = query.page_size + 1;  // one more tells whether there is a next page
  const int state = static_cast<int>(query.state.value_or(SolveState::kQueued));
  if (query.tenant.has_value() && query.state.has_value()) {
    return Query(connection,
                 "SELECT " ROLLGAIT_SOLVE_COLUMNS
                 "FROM solves WHERE tenant = ? AND state = ? AND number < ? ORDER BY number DESC LIMIT ?",
                 *query.tenant, state, before, limit);
  }
  if (query.tenant.has_value()) {
    return Query(connection,
                 "SELECT " ROLLGAIT_SOLVE_COLUMNS
                 "FROM solves WHERE tenant = ? AND number < ? ORDER BY number DESC LIMIT ?",
                 *query.tenant, before, limit);
  }
  if (query.state.has_value()) {
    return Query(connection,
                 "SELECT " ROLLGAIT_SOLVE_COLUMNS
                 "FROM solves WHERE state = ? AND number < ? ORDER BY number DESC LIMIT ?",
                 state, before, limit);
  }
  return Query(connection, "SELECT " ROLLGAIT_SOLVE_COLUMNS "FROM solves WHERE number < ? ORDER BY number DESC LIMIT ?",
               before, limit);
}

}  // namespace

Outcome<std::unique_ptr<SqlStore>> SqlStore::Open(std::unique_ptr<Database> database, const Clock& clock,
                                                           DiskRoom room) {
  const Outcome<Done> ready = database->PrepareSchema();
  if (!ready.ok()) {
    return Error{ErrorCode::kUnavailable, "cannot use the store " + database->name() + ": " + ready.error().message};
  }
  return std::unique_ptr<SqlStore>(new SqlStore(std::move(database), clock, std::move(room)));
}

Outcome<CreatedSolve> SqlStore::Create(const NewSolve& solve) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<CreatedSolve> {
    if (!solve.request_id.empty()) {
      if (std::optional<SolveRow> old = FindRequest(connection, solve)) {
        if (old->record.spec == solve.spec) return CreatedSolve{FullRecord(connection, std::move(*old)), false};
        return Error{ErrorCode::kAlreadyExists, "request_id \"" + solve.request_id + "\" belongs to solves/" +
                                                    old->record.id + ", which has another spec; use a new request_id"};
      }
    }
    if (std::optional<Error> full = room_.Refusal()) return *full;
    const int64_t reusable = FindReusableResult(connection, solve.solve_key);
    if (reusable == 0) {
      if (std::optional<Error> full = QueueFull(connection, solve)) return *full;
    }
    const std::string detail = QueuedDetail(connection, solve.solve_key);
    SolveRow row;
    row.record.create_time_us = clock_.WallMicros();
    InsertSolve(connection, solve, row);
    AddAudit(connection, {solve.actor, "create", solve.id, reusable != 0 ? "succeeded" : "queued"}, row.record.create_time_us);
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

Outcome<SolveRecord> SqlStore::Get(const std::string& id) {
  if (!CouldBeId(id)) return NoSuchSolve(id);
  return database_->ReadOne([&](SqlConnection& connection) -> Outcome<SolveRecord> {
    Query query(connection,
                "SELECT " ROLLGAIT_SOLVE_COLUMNS
                ", (SELECT payload FROM results WHERE results.id = solves.result_id) FROM solves WHERE id = ?",
                id);
    if (!query.Step()) return NoSuchSolve(id);
    SolveRecord record = ReadSolve(query).record;
    record.result = query.Bytes(kSolveColumns);
    return record;
  });
}

Outcome<std::string> SqlStore::TenantOf(const std::string& id) {
  return database_->Read([&](SqlConnection& connection) -> Outcome<std::string> {
    if (!CouldBeId(id)) return NoSuchSolve(id);
    Query query(connection, "SELECT tenant FROM solves WHERE id = ?", id);
    if (!query.Step()) return NoSuchSolve(id);
    return query.Bytes(0);
  });
}

Outcome<SolvePage> SqlStore::List(const ListQuery& query) {
  int64_t before = INT64_MAX;
  if (!query.page_token.empty()) {
    const std::optional<int64_t> parsed = ParsePageToken(query);
    if (!parsed.has_value()) {
      const std::string message =
          "is not a token of this list: give back next_page_token unchanged, with the same filter";
      return Error{ErrorCode::kInvalidArgument, "page_token " + message, {{"page_token", message}}};
    }
    before = *parsed;
  }
  return database_->ReadOne([&](SqlConnection& connection) -> Outcome<SolvePage> {
    Query rows = PageOf(connection, query, before);
    SolvePage page;
    int64_t last_number = 0;
    size_t bytes = 0;
    while (rows.Step()) {
      if (static_cast<int>(page.records.size()) == query.page_size || bytes > kMaxPageBytes) {
        page.next_page_token = MakePageToken(last_number, query);
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

Outcome<Done> SqlStore::Delete(const std::string& id, const Actor& actor) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<Done> {
    const std::optional<SolveRow> row = FindSolve(connection, id);
    if (!row.has_value()) return NoSuchSolve(id);
    if (!IsTerminal(row->record.state)) {
      return Error{ErrorCode::kFailedPrecondition, "solves/" + id + " has not finished; cancel it first"};
    }
    RemoveSolve(connection, *row);
    AddAudit(connection, {actor, "delete", id, "deleted"}, clock_.WallMicros());
    return Done{};
  });
}

Outcome<SolveRecord> SqlStore::RequestCancel(const std::string& id, const Actor& actor) {
  return database_->Write([&](SqlConnection& connection) -> Outcome<SolveRecord> {
    std::optional<SolveRow> row = FindSolve(connection, id);
    if (!row.has_value()) return NoSuchSolve(id);
    const int64_t now_us = clock_.WallMicros();
    if (!IsTerminal(row->record.state) && !row->record.cancel_requested) {
      row->record.cancel_requested = true;
      const bool at_once = row->record.state == SolveState::kQueued;
      AddAudit(connection, {actor, "cancel", id, at_once ? "queued" : "running"}, now_us);
      if (at_once) EndSolve(connection, *row, SolveState::kCancelled, 0, CancelledError(), now_us);
      if (!at_once) SaveSolve(connection, *row);
    }
    return FullRecord(connection, std::move(*row));
  });
}

Outcome<EventPage> SqlStore::ReadEvents(const std::string& id, int64_t after_sequence, int max_events) {
  return database_->Read([&](SqlConnection& connection) -> Outcome<EventPage> {
    EventPage page;
    int64_t number = 0, trimmed = 0;
    {
      if (!CouldBeId(id)) return NoSuchSolve(id);
      Query query(connection, "SELECT number, last_sequence, state, trimmed_sequence FROM solves WHERE id = ?", id);
      if (!query.Step()) return NoSuchSolve(id);
      number = query.Int(0);
      page.last_sequence = query.Int(1);
      page.state = static_cast<SolveState>(query.Int(2));
      trimmed = query.Int(3);
    }
    if (after_sequence >= 0 && after_sequence < trimmed) {
      return Error{ErrorCode::kOutOfRange,
                   "after_sequence is " + std::to_string(after_sequence) + ", the oldest event held of solves/" + id +
                       " is " + std::to_string(trimmed + 1) + "; watch after " + std::to_string(trimmed) +
                       " or a later one"};
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

Outcome<SolveCounts> SqlStore::Counts(const std::optional<std::string>& tenant) {
  return database_->Read([&](SqlConnection& connection) -> Outcome<SolveCounts> {
    const std::string* of = tenant.has_value() ? &*tenant : nullptr;
    SolveCounts counts;
    counts.queued = CountState(connection, SolveState::kQueued, of);
    counts.running = CountState(connection, SolveState::kRunning, of);
    Query oldest(connection,
                 of == nullptr ? "SELECT create_time_us FROM solves WHERE ? = '' AND state = 1 ORDER BY number LIMIT 1"
                               : "SELECT create_time_us FROM solves WHERE tenant = ? AND state = 1 ORDER BY number LIMIT 1",
                 of == nullptr ? std::string() : *of);
    if (counts.queued > 0 && oldest.Step()) counts.oldest_queued_us = oldest.Int(0);
    return counts;
  });
}

Outcome<std::vector<AuditRow>> SqlStore::ReadAudit(int64_t after_number, int max_rows) {
  return database_->Read([&](SqlConnection& connection) -> Outcome<std::vector<AuditRow>> {
    std::vector<AuditRow> rows;
    Query query(connection,
                "SELECT number, time_us, tenant, token_id, peer, action, solve, outcome, detail FROM audit "
                "WHERE number > ? ORDER BY number LIMIT ?",
                after_number, max_rows);
    while (query.Step()) {
      rows.push_back({query.Int(0), query.Int(1), Actor{query.Bytes(2), query.Bytes(3), query.Bytes(4)}, query.Bytes(5),
                      query.Bytes(6), query.Bytes(7), query.Bytes(8)});
    }
    return rows;
  });
}

}  // namespace rollgait::server
