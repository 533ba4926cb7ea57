#include "server/store/sql_store.h"

#include <cstdint>
#include <deque>
#include <utility>

#include "server/store/schema.h"
#include "server/store/sql_rows.h"

namespace rollgait::server {
namespace {

Error NoSuchSolve(const std::string& id) {
  return {ErrorCode::kNotFound, "there is no solve \"solves/" + id + "\"; ListSolves lists those that are"};
}

// For the audit of what an administrator does: whose solve it is, unless it is the actor's own.
std::string OwnerUnless(const Actor& actor, const SolveRecord& record) {
  return actor.tenant == record.tenant ? "" : "of tenant " + record.tenant;
}

// The record with its result.
SolveRecord FullRecord(SqlConnection& connection, SolveRow row) {
  if (row.result_id != 0) {
    Query query(connection, "SELECT payload FROM results WHERE id = ?", row.result_id);
    if (query.Step()) row.record.result = query.Bytes(0);
  }
  return std::move(row.record);
}

// How many are queued and run, and when the oldest that is queued was created.
Query CountsOf(SqlConnection& connection, const std::optional<std::string>& tenant) {
  if (!tenant.has_value()) {
    return Query(connection,
                 "SELECT (SELECT COUNT(*) FROM solves WHERE state = 1), (SELECT COUNT(*) FROM solves WHERE state = 2), "
                 "(SELECT create_time_us FROM solves WHERE state = 1 ORDER BY number LIMIT 1)");
  }
  return Query(connection,
               "SELECT (SELECT COUNT(*) FROM solves WHERE tenant = ? AND state = 1), "
               "(SELECT COUNT(*) FROM solves WHERE tenant = ? AND state = 2), "
               "(SELECT create_time_us FROM solves WHERE tenant = ? AND state = 1 ORDER BY number LIMIT 1)",
               *tenant, *tenant, *tenant);
}

Outcome<std::string> PageSecret(Database& database) {
  return database.ReadOne([](SqlConnection& connection) -> Outcome<std::string> {
    Query query(connection, "SELECT value FROM secrets WHERE name = 'page_tokens'");
    if (!query.Step()) return Error{ErrorCode::kInternal, "the store has lost its secret of page tokens"};
    return query.Bytes(0);
  });
}

// Of up to so many solves from ids[first] on.
constexpr size_t kIdsAtOnce = 16;
void AskLastSequences(SqlConnection& connection, const std::vector<std::string>& ids, size_t first,
                      std::deque<Query>* queries) {
  const auto id = [&](size_t i) { return first + i < ids.size() ? ids[first + i] : std::string(); };
  queries->emplace_back(connection,
                        "SELECT id, last_sequence FROM solves WHERE id IN "
                        "(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                        id(0), id(1), id(2), id(3), id(4), id(5), id(6), id(7), id(8), id(9), id(10), id(11), id(12),
                        id(13), id(14), id(15));
}

}  // namespace

Outcome<std::unique_ptr<SqlStore>> SqlStore::Open(std::unique_ptr<Database> database, const Clock& clock, DiskRoom room,
                                                  std::unique_ptr<DiskReserve> reserve) {
  const Outcome<Done> ready = database->PrepareSchema();
  if (!ready.ok()) {
    return Error{ready.error().code, "cannot use the store " + database->name() + ": " + ready.error().message};
  }
  const Outcome<std::string> secret = PageSecret(*database);
  if (!secret.ok()) return secret.error();
  return std::unique_ptr<SqlStore>(
      new SqlStore(std::move(database), clock, std::move(room), std::move(reserve), secret.value()));
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

Outcome<SolveExtent> SqlStore::Extent(const std::string& id) {
  if (!CouldBeId(id)) return NoSuchSolve(id);
  return database_->ReadOne([&](SqlConnection& connection) -> Outcome<SolveExtent> {
    // Neither engine reads a blob for its length.
    Query query(connection,
                "SELECT tenant, LENGTH(spec), COALESCE(LENGTH(error), 0), COALESCE((SELECT LENGTH(payload) FROM "
                "results WHERE results.id = solves.result_id), 0) FROM solves WHERE id = ?",
                id);
    if (!query.Step()) return NoSuchSolve(id);
    return SolveExtent{query.Bytes(0), query.Int(1) + query.Int(2) + query.Int(3)};
  });
}

Outcome<Done> SqlStore::Delete(const std::string& id, const Actor& actor) {
  return WriteForRoom([&](SqlConnection& connection) -> Outcome<Done> {
    const std::optional<SolveRow> row = FindSolve(connection, id);
    if (!row.has_value()) return NoSuchSolve(id);
    if (!IsTerminal(row->record.state)) {
      return Error{ErrorCode::kFailedPrecondition, "solves/" + id + " has not finished; cancel it first"};
    }
    RemoveSolve(connection, *row);
    storage_use_.Forget();
    AddAudit(connection, {actor, "delete", id, "deleted", OwnerUnless(actor, row->record)}, clock_.WallMicros());
    return Done{};
  });
}

Outcome<SolveRecord> SqlStore::RequestCancel(const std::string& id, const Actor& actor) {
  return WriteForRoom([&](SqlConnection& connection) -> Outcome<SolveRecord> {
    std::optional<SolveRow> row = FindSolve(connection, id);
    if (!row.has_value()) return NoSuchSolve(id);
    const int64_t now_us = clock_.WallMicros();
    if (!IsTerminal(row->record.state) && !row->record.cancel_requested) {
      row->record.cancel_requested = true;
      const bool at_once = row->record.state == SolveState::kQueued;
      AddAudit(connection, {actor, "cancel", id, at_once ? "queued" : "running", OwnerUnless(actor, row->record)},
               now_us);
      if (at_once) EndSolve(connection, *row, SolveState::kCancelled, {}, CancelledError(), now_us);
      if (!at_once) SaveSolve(connection, *row);
    }
    return FullRecord(connection, std::move(*row));
  });
}

Outcome<SolveRecord> SqlStore::SetPriority(const std::string& id, int priority, const Actor& actor) {
  ROLLGAIT_CHECK(priority >= kLeastPriority && priority <= kMostPriority);
  return database_->Write([&](SqlConnection& connection) -> Outcome<SolveRecord> {
    std::optional<SolveRow> row = FindSolve(connection, id);
    if (!row.has_value()) return NoSuchSolve(id);
    SolveRecord& record = row->record;
    if (record.priority == priority) return FullRecord(connection, std::move(*row));
    if (record.state != SolveState::kQueued) {
      return Error{ErrorCode::kFailedPrecondition, "solves/" + id + " is not queued, it has " +
                                                       (IsTerminal(record.state) ? "ended" : "begun to run") +
                                                       "; only the priority of a queued solve can be changed"};
    }
    const int earlier = std::exchange(record.priority, priority);
    const std::string owner = OwnerUnless(actor, record);
    const std::string detail =
        owner + (owner.empty() ? "" : ", ") + std::to_string(earlier) + " to " + std::to_string(priority);
    Query::Do(connection, "UPDATE solves SET priority = ? WHERE number = ?", priority, row->number);
    AddAudit(connection, {actor, "set priority", id, "queued", detail}, clock_.WallMicros());
    return std::move(record);
  });
}

Outcome<EventPage> SqlStore::ReadEvents(const std::string& id, int64_t after_sequence, int max_events) {
  if (!CouldBeId(id)) return NoSuchSolve(id);
  return database_->Read([&](SqlConnection& connection) -> Outcome<EventPage> {
    Query solve(connection, "SELECT last_sequence, state, trimmed_sequence FROM solves WHERE id = ?", id);
    Query events(connection,
                 "SELECT sequence, kind, payload FROM events WHERE solve = (SELECT number FROM solves WHERE id = ?) "
                 "AND sequence > ? ORDER BY sequence LIMIT ?",
                 id, after_sequence, max_events);
    if (!solve.Step()) return NoSuchSolve(id);
    EventPage page;
    page.last_sequence = solve.Int(0);
    page.state = static_cast<SolveState>(solve.Int(1));
    const int64_t trimmed = solve.Int(2);
    if (after_sequence >= 0 && after_sequence < trimmed) {
      return Error{ErrorCode::kOutOfRange, "after_sequence is " + std::to_string(after_sequence) +
                                               ", the oldest event held of solves/" + id + " is " +
                                               std::to_string(trimmed + 1) + "; watch after " +
                                               std::to_string(trimmed) + " or a later one"};
    }
    if (after_sequence < 0 || after_sequence > page.last_sequence) {
      return Error{ErrorCode::kOutOfRange,
                   "after_sequence is " + std::to_string(after_sequence) + ", the events of solves/" + id +
                       " are 1 to " + std::to_string(page.last_sequence) + "; use a number from 0 to the last"};
    }
    while (events.Step()) {
      page.events.push_back({events.Int(0), static_cast<EventKind>(events.Int(1)), events.Bytes(2)});
    }
    return page;
  });
}

Outcome<std::map<std::string, int64_t>> SqlStore::LastSequences(const std::vector<std::string>& ids) {
  return database_->Read([&](SqlConnection& connection) -> Outcome<std::map<std::string, int64_t>> {
    std::map<std::string, int64_t> numbers;
    std::deque<Query> queries;  // all are asked before the first is read
    for (size_t first = 0; first < ids.size(); first += kIdsAtOnce) AskLastSequences(connection, ids, first, &queries);
    for (Query& query : queries) {
      while (query.Step()) numbers[query.Bytes(0)] = query.Int(1);
    }
    return numbers;
  });
}

Outcome<SolveCounts> SqlStore::Counts(const std::optional<std::string>& tenant) {
  return database_->ReadOne([&](SqlConnection& connection) -> Outcome<SolveCounts> {
    Query query = CountsOf(connection, tenant);
    ROLLGAIT_CHECK(query.Step());
    return SolveCounts{static_cast<int>(query.Int(0)), static_cast<int>(query.Int(1)), query.Int(2)};
  });
}

Outcome<std::vector<AuditRow>> SqlStore::ReadAudit(int64_t after_number, int max_rows) {
  return database_->ReadOne([&](SqlConnection& connection) -> Outcome<std::vector<AuditRow>> {
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
