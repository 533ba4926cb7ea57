// SqlStore::Create: all that it asks goes out at once, then it decides, and what it writes goes out with the commit.
#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "rollgait/v1/solve.pb.h"
#include "server/store/sql_rows.h"
#include "server/store/sql_store.h"

namespace rollgait::server {
namespace {

using LockMode = SqlConnection::LockMode;

// Answered in the order of the members; those that are not needed are not asked.
struct Questions {
  // Without the result: those of `earlier` and `reusable` are read as empty.
  Questions(SqlConnection& connection, const NewSolve& solve, bool with_result);

  std::optional<Query> earlier;        // the solve that its tenant made before with this request_id, with its result
  std::optional<Query> reusable;       // a result of the same key
  std::optional<Query> equal;          // a solve of the same key that has not ended
  std::optional<Query> queued;         // how many are
  std::optional<Query> queued_tenant;  // how many of the tenant
  std::optional<Query> number;         // of the new one
};

Questions::Questions(SqlConnection& connection, const NewSolve& solve, bool with_result) {
  if (!solve.request_id.empty()) {
    earlier.emplace(connection,
                    "SELECT " ROLLGAIT_SOLVE_COLUMNS
                    ", (SELECT CASE WHEN ? = 1 THEN payload END FROM results WHERE results.id = solves.result_id) "
                    "FROM solves WHERE tenant = ? AND request_id = ?",
                    with_result, solve.actor.tenant, solve.request_id);
  }
  if (!solve.solve_key.empty()) {
    reusable.emplace(
        connection,
        "SELECT id, CASE WHEN ? = 1 THEN payload END, termination, verdict FROM results WHERE solve_key = ? AND "
        "reusable = 1 LIMIT 1",
        with_result, solve.solve_key);
    equal.emplace(connection, "SELECT id FROM solves WHERE solve_key = ? AND state IN (1, 2) ORDER BY number LIMIT 1",
                  solve.solve_key);
  }
  queued.emplace(connection, "SELECT COUNT(*) FROM solves WHERE state = 1");
  if (solve.max_queued_tenant > 0) {
    queued_tenant.emplace(connection, "SELECT COUNT(*) FROM solves WHERE tenant = ? AND state = 1", solve.actor.tenant);
  }
  number.emplace(connection, "SELECT {next_solve}");
}

int64_t IntOf(std::optional<Query>& query) {
  ROLLGAIT_CHECK(query->Step());
  return query->Int(0);
}

// Of those who count at the same time under a shared lock each may add one that the others do not see. All see `queued`
// or more before they add, and are `writers` at most: so the limit holds if there is room for all of them. Whoever sees
// less room counts again alone.
enum class Room { kEnough, kUncertain, kNone };
Room RoomFor(int64_t queued, int limit, int writers) {
  if (queued >= limit) return Room::kNone;
  return queued + writers <= limit ? Room::kEnough : Room::kUncertain;
}

Error TooMany(const std::string& text) {
  return {ErrorCode::kResourceExhausted, text + "; try again later", {}, std::chrono::milliseconds(1000)};
}

Error QueueFull(int64_t queued, int limit) {
  return TooMany(std::to_string(queued) + " solves are queued, the limit is " + std::to_string(limit));
}

Error QueueOfTenantFull(const std::string& tenant, int64_t own, int limit) {
  const std::string text =
      std::to_string(own) + " solves of tenant \"" + tenant + "\" are queued, its limit is " + std::to_string(limit);
  Error error = TooMany(text);
  error.quota = {"tenant:" + tenant, text};
  return error;
}

// Whether it may be queued: false if that is uncertain.
Outcome<bool> MayQueue(Questions& questions, const NewSolve& solve, int writers) {
  const int64_t queued = IntOf(questions.queued);
  const Room room = RoomFor(queued, solve.max_queued, writers);
  if (room == Room::kNone) return QueueFull(queued, solve.max_queued);
  if (solve.max_queued_tenant <= 0) return room == Room::kEnough;
  const int64_t own = IntOf(questions.queued_tenant);
  const Room own_room = RoomFor(own, solve.max_queued_tenant, writers);
  if (own_room != Room::kNone) return room == Room::kEnough && own_room == Room::kEnough;
  return QueueOfTenantFull(solve.actor.tenant, own, solve.max_queued_tenant);
}

bool NeedsPlaceIn(SqlConnection& connection, const NewSolve& solve) {
  Query earlier(connection, "SELECT 1 FROM solves WHERE tenant = ? AND request_id = NULLIF(?, '')", solve.actor.tenant,
                solve.request_id);
  Query reusable(connection, "SELECT 1 FROM results WHERE solve_key = NULLIF(?, '') AND reusable = 1 LIMIT 1",
                 solve.solve_key);
  return !earlier.Step() && !reusable.Step();
}

int64_t CountQueued(SqlConnection& connection) {
  Query query(connection, "SELECT COUNT(*) FROM solves WHERE state = 1");
  return query.Step() ? query.Int(0) : 0;
}

int64_t CountQueued(SqlConnection& connection, const std::string& tenant) {
  Query query(connection, "SELECT COUNT(*) FROM solves WHERE tenant = ? AND state = 1", tenant);
  return query.Step() ? query.Int(0) : 0;
}

// What the first event of a queued solve says: why it waits, if it waits for another (single flight).
std::string QueuedDetail(Questions& questions) {
  if (!questions.equal.has_value() || !questions.equal->Step()) return "";
  return "waits for the result of the equal request solves/" + questions.equal->Bytes(0);
}

SolveRow NewRow(const NewSolve& solve, int64_t number, int64_t now_us) {
  SolveRow row;
  row.number = number;
  row.bytes = static_cast<int64_t>(solve.spec.size()) + BytesOf(solve.labels);
  row.record.id = solve.id;
  row.record.spec = solve.spec;
  row.record.solve_key = solve.solve_key;
  row.record.tenant = solve.actor.tenant;
  row.record.solver_fingerprint = solve.solver_fingerprint;
  row.record.traceparent = solve.traceparent;
  row.record.create_time_us = now_us;
  row.record.labels = solve.labels;
  row.record.priority = solve.priority;
  return row;
}

// The queued solve with its first event.
void Insert(SqlConnection& connection, const NewSolve& solve, const std::string& detail, SolveRow& row) {
  SolveRecord& record = row.record;
  const std::string event = StateChangeEvent(row, detail, record.create_time_us);
  CountEvent(row, event);
  Query::Do(
      connection,
      "INSERT INTO solves (number, id, tenant, request_id, spec, solve_key, solver_fingerprint, traceparent, state, "
      "create_time_us, last_sequence, bytes, model, priority) {given_key} VALUES (?, ?, ?, NULLIF(?, ''), ?, ?, ?, ?, "
      "?, ?, ?, ?, ?, ?)",
      row.number, record.id, record.tenant, solve.request_id, Blob{record.spec}, record.solve_key,
      record.solver_fingerprint, record.traceparent, static_cast<int>(record.state), record.create_time_us,
      record.last_sequence, row.bytes, solve.model, record.priority);
  InsertEvent(connection, row.number, {record.last_sequence, EventKind::kStateChange, event});
  Query::Do(connection,
            "INSERT INTO places (solve, tenant, question, slope_rad, speed_m_s, optimal) VALUES (?, ?, ?, ?, ?, 0)",
            row.number, record.tenant, solve.place.question, solve.place.slope_rad, solve.place.speed_m_s);
  for (const auto& [name, value] : record.labels) {
    Query::Do(connection, "INSERT INTO labels (solve, tenant, name, value) VALUES (?, ?, ?, ?)", row.number,
              record.tenant, name, value);
  }
  if (solve.warm_start.empty()) return;
  Query::Do(connection, "INSERT INTO warm_starts (solve, payload) VALUES (?, ?)", row.number, Blob{solve.warm_start});
}

// Everybody in this order. What is counted under a lock is counted after it is held.
void LockQueues(SqlConnection& connection, const NewSolve& solve, LockMode mode) {
  connection.Lock("queue", mode);
  if (solve.max_queued_tenant > 0) connection.Lock("queue of tenant " + solve.actor.tenant, mode);
}

// The error of one of several that are created together.
Error OfBatch(Error error, size_t index, size_t count) {
  if (error.code == ErrorCode::kResourceExhausted) {
    const std::string text = "there is no room for all of " + std::to_string(count) + " requests: with the first " +
                             std::to_string(index) + " of them ";
    error.message = text + error.message;
    if (error.quota) error.quota->description = text + error.quota->description;
  } else if (error.code == ErrorCode::kAlreadyExists) {
    error.message = "requests[" + std::to_string(index) + "]." + error.message;
  }
  return error;
}

// Refuses a batch that does not fit before any of it is written: all others wait while it is, and while it is undone.
// With the locks held exclusively.
std::optional<Error> NoRoomForAll(SqlConnection& connection, const std::vector<NewSolve>& solves) {
  const NewSolve& limits = solves.front();
  const std::string& tenant = limits.actor.tenant;
  const int64_t queued = CountQueued(connection);
  const bool has_own = limits.max_queued_tenant > 0;
  const int64_t own = has_own ? CountQueued(connection, tenant) : 0;
  const int64_t room = limits.max_queued - queued, own_room = limits.max_queued_tenant - own;
  const int64_t least = std::max<int64_t>(0, has_own ? std::min(room, own_room) : room);
  if (static_cast<int64_t>(solves.size()) <= least) return std::nullopt;
  std::set<std::string> before;
  int64_t places = 0;
  for (size_t i = 0; i < solves.size(); ++i) {
    const std::string& request_id = solves[i].request_id;
    const bool is_repeated = !request_id.empty() && !before.insert(request_id).second;
    if (is_repeated || !NeedsPlaceIn(connection, solves[i]) || ++places <= least) continue;
    return OfBatch(room <= least ? QueueFull(queued + places - 1, limits.max_queued)
                                 : QueueOfTenantFull(tenant, own + places - 1, limits.max_queued_tenant),
                   i, solves.size());
  }
  return std::nullopt;
}

}  // namespace

Outcome<CreatedSolve> SqlStore::Create(const NewSolve& solve) {
  Outcome<std::optional<CreatedSolve>> created = TryCreate(solve, LockMode::kShared);
  if (created.ok() && !created.value().has_value()) created = TryCreate(solve, LockMode::kExclusive);
  if (!created.ok()) return created.error();
  ROLLGAIT_CHECK(created.value().has_value());
  return *std::move(created).value();
}

Outcome<bool> SqlStore::NeedsPlace(const NewSolve& solve) {
  return database_->Read([&](SqlConnection& connection) -> Outcome<bool> { return NeedsPlaceIn(connection, solve); });
}

Outcome<std::optional<CreatedSolve>> SqlStore::TryCreate(const NewSolve& solve, LockMode mode) {
  return database_->Write([&](SqlConnection& connection) {
    LockQueues(connection, solve, mode);
    return CreateIn(connection, solve, mode == LockMode::kExclusive ? 1 : connection.MostWriters(), true);
  });
}

Outcome<std::vector<CreatedSolve>> SqlStore::CreateAll(const std::vector<NewSolve>& solves) {
  using Made = std::vector<CreatedSolve>;
  if (solves.empty()) return Made();
  Outcome<Made> outcome = database_->Write([&](SqlConnection& connection) -> Outcome<Made> {
    LockQueues(connection, solves.front(), LockMode::kExclusive);
    if (std::optional<Error> full = NoRoomForAll(connection, solves)) return *std::move(full);
    Made made;
    for (const NewSolve& solve : solves) {
      ROLLGAIT_CHECK(solve.actor.tenant == solves.front().actor.tenant);
      Outcome<std::optional<CreatedSolve>> created = CreateIn(connection, solve, 1, false);
      if (!created.ok()) return OfBatch(created.error(), made.size(), solves.size());
      ROLLGAIT_CHECK(created.value().has_value());
      made.push_back(*std::move(created).value());
    }
    return made;
  });
  if (!outcome.ok()) storage_use_.Forget();  // it counted what was not stored
  return outcome;
}

Outcome<std::optional<CreatedSolve>> SqlStore::CreateIn(SqlConnection& connection, const NewSolve& solve, int writers,
                                                        bool with_result) {
  Questions questions(connection, solve, with_result);
  if (questions.earlier.has_value() && questions.earlier->Step()) {
    SolveRecord old = ReadSolve(*questions.earlier).record;
    old.result = questions.earlier->Bytes(kSolveColumns);
    const bool same_spec = old.spec == solve.spec;
    if (same_spec && old.labels == solve.labels) return std::optional(CreatedSolve{std::move(old), false});
    return Error{ErrorCode::kAlreadyExists, "request_id \"" + solve.request_id + "\" belongs to solves/" + old.id +
                                                ", which has " + (same_spec ? "other labels" : "another spec") +
                                                "; use a new request_id"};
  }
  if (std::optional<Error> full = room_.Refusal()) return *full;
  if (reserve_ != nullptr) reserve_->Restore(room_.reserve_bytes());
  const auto bytes = static_cast<int64_t>(solve.spec.size() + solve.warm_start.size()) + BytesOf(solve.labels);
  const StorageUse::Claim claim{solve.actor.tenant, bytes, solve.max_bytes_tenant};
  if (std::optional<Error> full = storage_use_.Refusal(connection, claim)) return *full;
  const bool held = questions.reusable.has_value() && questions.reusable->Step();
  if (!held) {
    const Outcome<bool> may = MayQueue(questions, solve, writers);
    if (!may.ok()) return may.error();
    if (!may.value()) return std::optional<CreatedSolve>();
  }
  const int64_t now_us = clock_.WallMicros();
  SolveRow row = NewRow(solve, IntOf(questions.number), now_us);
  Insert(connection, solve, QueuedDetail(questions), row);
  AddAudit(connection, {solve.actor, "create", solve.id, held ? "succeeded" : "queued"}, now_us);
  if (held) {
    row.record.from_cache = true;
    const ResultRow result{questions.reusable->Int(0), static_cast<int>(questions.reusable->Int(2)),
                           static_cast<int>(questions.reusable->Int(3))};
    EndSolve(connection, row, SolveState::kSucceeded, result, "", now_us);
    row.record.result = questions.reusable->Bytes(1);
    if (row.record.termination == v1::TERMINATION_OPTIMAL) MarkOptimal(connection, row.number);
  }
  return std::optional(CreatedSolve{std::move(row.record), true});
}

}  // namespace rollgait::server
