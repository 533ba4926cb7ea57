#include "server/store/sql_rows.h"

#include <algorithm>
#include <cctype>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::server {
namespace {

v1::SolveEvent EventAt(int64_t now_us) {
  v1::SolveEvent event;
  event.mutable_time()->set_seconds(now_us / 1'000'000);
  event.mutable_time()->set_nanos(static_cast<int32_t>(now_us % 1'000'000) * 1000);
  return event;
}

const char* NameOf(SolveState state) {
  switch (state) {
    case SolveState::kQueued:
      return "queued";
    case SolveState::kRunning:
      return "running";
    case SolveState::kSucceeded:
      return "succeeded";
    case SolveState::kFailed:
      return "failed";
    case SolveState::kCancelled:
      return "cancelled";
  }
  return "unknown";
}

}  // namespace

bool CouldBeId(const std::string& text) {
  const auto is_plain = [](unsigned char letter) { return std::isalnum(letter) || letter == '-' || letter == '_'; };
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), is_plain);
}

SolveRow ReadSolve(const Query& query) {
  SolveRow row;
  SolveRecord& record = row.record;
  row.number = query.Int(0);
  record.id = query.Bytes(1);
  record.spec = query.Bytes(2);
  record.solve_key = query.Bytes(3);
  record.state = static_cast<SolveState>(query.Int(4));
  record.create_time_us = query.Int(5);
  record.start_time_us = query.Int(6);
  record.end_time_us = query.Int(7);
  record.attempts = static_cast<int>(query.Int(8));
  record.crashes = static_cast<int>(query.Int(9));
  record.cancel_requested = query.Int(10) != 0;
  record.from_cache = query.Int(11) != 0;
  record.last_sequence = query.Int(12);
  row.result_id = query.Int(13);
  record.error = query.Bytes(14);
  row.owner = query.Bytes(15);
  row.epoch = query.Int(16);
  record.tenant = query.Bytes(17);
  record.solver_fingerprint = query.Bytes(18);
  record.traceparent = query.Bytes(19);
  record.trimmed_sequence = query.Int(20);
  row.bytes = query.Int(21);
  record.termination = static_cast<int>(query.Int(22));
  record.verdict = static_cast<int>(query.Int(23));
  record.labels = SplitLabels(query.Bytes(24));
  record.priority = static_cast<int>(query.Int(25));
  return row;
}

std::optional<SolveRow> FindSolve(SqlConnection& connection, const std::string& id) {
  if (!CouldBeId(id)) return std::nullopt;
  Query query(connection, "SELECT " ROLLGAIT_SOLVE_COLUMNS "FROM solves WHERE id = ? {for_update}", id);
  if (!query.Step()) return std::nullopt;
  return ReadSolve(query);
}

Error LeaseLost(const Lease& lease) {
  return {ErrorCode::kLeaseLost, "the lease of " + lease.owner + " on solves/" + lease.solve_id + ", epoch " +
                                     std::to_string(lease.epoch) + ", is lost; stop working on it"};
}

void SaveSolve(SqlConnection& connection, const SolveRow& row) {
  const SolveRecord& record = row.record;
  Query::Do(connection,
            "UPDATE solves SET state = ?, start_time_us = ?, end_time_us = ?, attempts = ?, crashes = ?, "
            "cancel_requested = ?, from_cache = ?, last_sequence = ?, result_id = NULLIF(?, 0), error = ?, "
            "owner = NULLIF(?, ''), epoch = ?, bytes = ?, termination = ?, verdict = ? WHERE number = ?",
            static_cast<int>(record.state), record.start_time_us, record.end_time_us, record.attempts, record.crashes,
            record.cancel_requested, record.from_cache, record.last_sequence, row.result_id, Blob{record.error},
            row.owner, row.epoch, row.bytes, record.termination, record.verdict, row.number);
}

void CountEvent(SolveRow& row, const std::string& payload) {
  row.bytes += static_cast<int64_t>(payload.size());
  ++row.record.last_sequence;
}

void InsertEvent(SqlConnection& connection, int64_t solve, const StoredEvent& event) {
  Query::Do(connection, "INSERT INTO events (solve, sequence, kind, payload) VALUES (?, ?, ?, ?)", solve,
            event.sequence, static_cast<int>(event.kind), Blob{event.payload});
}

void AppendEvent(SqlConnection& connection, SolveRow& row, EventKind kind, const std::string& payload) {
  CountEvent(row, payload);
  InsertEvent(connection, row.number, {row.record.last_sequence, kind, payload});
}

std::string StateChangeEvent(const SolveRow& row, const std::string& detail, int64_t now_us) {
  v1::SolveEvent event = EventAt(now_us);
  event.mutable_state_change()->set_state(static_cast<v1::SolveState>(row.record.state));
  event.mutable_state_change()->set_attempt(row.record.attempts);
  event.mutable_state_change()->set_detail(detail);
  return event.SerializeAsString();
}

void ChangeState(SqlConnection& connection, SolveRow& row, SolveState state, const std::string& detail,
                 int64_t now_us) {
  row.record.state = state;
  AppendEvent(connection, row, EventKind::kStateChange, StateChangeEvent(row, detail, now_us));
}

void EndSolve(SqlConnection& connection, SolveRow& row, SolveState state, const ResultRow& result,
              const std::string& error, int64_t now_us) {
  row.record.state = state;
  row.record.end_time_us = now_us;
  row.record.error = error;
  row.bytes += static_cast<int64_t>(error.size());
  const int64_t solution = row.result_id;  // that it had so far; 0: none
  if (result.id != 0) row.result_id = result.id;
  row.record.termination = result.termination;
  row.record.verdict = result.verdict;
  row.owner.clear();
  Query::Do(connection, "DELETE FROM warm_starts WHERE solve = ?", row.number);
  Query::Do(connection, "DELETE FROM journals WHERE solve = ?", row.number);
  AppendEvent(connection, row, EventKind::kFinished, EventAt(now_us).SerializeAsString());
  SaveSolve(connection, row);
  if (solution != row.result_id) {
    Query::Do(connection, "DELETE FROM results WHERE id = ?", solution);
  } else if (solution != 0) {
    Query::Do(connection,
              "UPDATE solves SET bytes = bytes + (SELECT LENGTH(payload) FROM results WHERE id = ?) WHERE number = ?",
              solution, row.number);
  }
  const std::string detail = row.record.from_cache ? "from cache" : "attempts " + std::to_string(row.record.attempts);
  AddAudit(connection, {Actor{row.record.tenant, "", ""}, "end", row.record.id, NameOf(state), detail}, now_us);
}

void RequeueSolve(SqlConnection& connection, SolveRow& row, const std::string& detail, int64_t now_us) {
  if (row.record.cancel_requested) {
    EndSolve(connection, row, SolveState::kCancelled, {}, CancelledError(), now_us);
    return;
  }
  row.owner.clear();
  ChangeState(connection, row, SolveState::kQueued, detail, now_us);
  SaveSolve(connection, row);
}

void MarkOptimal(SqlConnection& connection, int64_t solve) {
  Query::Do(connection, "UPDATE places SET optimal = 1 WHERE solve = ?", solve);
}

void RemoveSolve(SqlConnection& connection, const SolveRow& row) {
  Query::Do(connection, "DELETE FROM solves WHERE number = ?", row.number);
  Query::Do(connection, "DELETE FROM results WHERE id = ? AND NOT EXISTS (SELECT 1 FROM solves WHERE result_id = ?)",
            row.result_id, row.result_id);
}

void AddAudit(SqlConnection& connection, const AuditEntry& entry, int64_t now_us) {
  Query::Do(connection,
            "INSERT INTO audit (time_us, tenant, token_id, peer, action, solve, outcome, detail) "
            "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
            now_us, entry.actor.tenant, entry.actor.token_id, entry.actor.peer, entry.action, entry.solve,
            entry.outcome, entry.detail);
}

std::string CancelledError() {
  v1::SolveError error;
  error.set_kind(v1::SolveError::KIND_CANCELLED);
  error.set_message("cancelled on request");
  return error.SerializeAsString();
}

}  // namespace rollgait::server
