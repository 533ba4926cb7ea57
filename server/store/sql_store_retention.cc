// What SqlStore removes in time.
#include <optional>
#include <string>
#include <vector>

#include "server/store/sql_rows.h"
#include "server/store/sql_store.h"

namespace rollgait::server {
namespace {

constexpr int kSolvesAtOnce = 50;
constexpr int kAuditRowsAtOnce = 1000;

int64_t Micros(std::chrono::seconds time) { return std::chrono::microseconds(time).count(); }

// The oldest finished solves that ended before a time.
std::vector<SolveRow> Oldest(SqlConnection& connection, int64_t before_us) {
  std::vector<SolveRow> rows;
  Query query(connection,
              "SELECT " ROLLGAIT_SOLVE_COLUMNS
              "FROM solves WHERE end_time_us > 0 AND end_time_us < ? ORDER BY end_time_us LIMIT ? {skip_locked}",
              before_us, kSolvesAtOnce);
  while (query.Step()) rows.push_back(ReadSolve(query));
  return rows;
}

// A tenant whose finished solves are above the limit, and by how much.
struct Excess {
  std::string tenant;
  int64_t bytes = 0;
};
std::optional<Excess> FindExcess(SqlConnection& connection, int64_t limit) {
  Query query(connection,
              "SELECT tenant, CAST(SUM(bytes) AS BIGINT) FROM solves WHERE end_time_us > 0 GROUP BY tenant "
              "HAVING SUM(bytes) > ? ORDER BY tenant LIMIT 1",
              limit);
  if (!query.Step()) return std::nullopt;
  return Excess{query.Bytes(0), query.Int(1) - limit};
}

std::vector<SolveRow> OldestOf(SqlConnection& connection, const std::string& tenant) {
  std::vector<SolveRow> rows;
  Query query(connection,
              "SELECT " ROLLGAIT_SOLVE_COLUMNS
              "FROM solves WHERE tenant = ? AND end_time_us > 0 ORDER BY end_time_us LIMIT ? {skip_locked}",
              tenant, kSolvesAtOnce);
  while (query.Step()) rows.push_back(ReadSolve(query));
  return rows;
}

void Expire(SqlConnection& connection, const SolveRow& row, const std::string& why, int64_t now_us) {
  RemoveSolve(connection, row);
  AddAudit(connection, {Actor{row.record.tenant, "", ""}, "expire", row.record.id, "deleted", why}, now_us);
}

int ExpireSolves(SqlConnection& connection, const RetentionLimits& limits, int64_t now_us) {
  int count = 0;
  if (limits.solves.count() > 0) {
    for (const SolveRow& row : Oldest(connection, now_us - Micros(limits.solves))) {
      Expire(connection, row, "age", now_us);
      ++count;
    }
  }
  if (count > 0 || limits.solve_bytes <= 0) return count;
  std::optional<Excess> excess = FindExcess(connection, limits.solve_bytes);
  if (!excess.has_value()) return 0;
  for (const SolveRow& row : OldestOf(connection, excess->tenant)) {
    if (excess->bytes <= 0) break;
    Expire(connection, row, "size", now_us);
    excess->bytes -= row.bytes;
    ++count;
  }
  return count;
}

// The terminal event stays: whoever watches the solve learns how it ended.
int TrimEvents(SqlConnection& connection, int64_t before_us) {
  std::vector<SolveRow> rows;
  {
    Query query(connection,
                "SELECT " ROLLGAIT_SOLVE_COLUMNS
                "FROM solves WHERE end_time_us > 0 AND end_time_us < ? AND trimmed_sequence < last_sequence - 1 "
                "ORDER BY end_time_us LIMIT ? {skip_locked}",
                before_us, kSolvesAtOnce);
    while (query.Step()) rows.push_back(ReadSolve(query));
  }
  for (const SolveRow& row : rows) {
    const int64_t last = row.record.last_sequence - 1;
    Query::Do(connection,
              "UPDATE solves SET trimmed_sequence = ?, bytes = bytes - CAST(COALESCE((SELECT SUM(LENGTH(payload)) FROM "
              "events "
              "WHERE solve = ? AND sequence <= ?), 0) AS BIGINT) WHERE number = ?",
              last, row.number, last, row.number);
    Query::Do(connection, "DELETE FROM events WHERE solve = ? AND sequence <= ?", row.number, last);
  }
  return static_cast<int>(rows.size());
}

}  // namespace

Outcome<Removed> SqlStore::Retain(const RetentionLimits& limits) {
  return WriteForRoom([&](SqlConnection& connection) -> Outcome<Removed> {
    const int64_t now_us = clock_.WallMicros();
    Removed removed;
    removed.solves = ExpireSolves(connection, limits, now_us);
    if (removed.solves > 0) storage_use_.Forget();
    if (limits.events.count() > 0) removed.event_logs = TrimEvents(connection, now_us - Micros(limits.events));
    if (limits.audit.count() > 0) {
      removed.audit_rows = Query(connection,
                                 "DELETE FROM audit WHERE number IN "
                                 "(SELECT number FROM audit WHERE time_us < ? ORDER BY number LIMIT ?)",
                                 now_us - Micros(limits.audit), kAuditRowsAtOnce)
                               .Run();
    }
    return removed;
  });
}

}  // namespace rollgait::server
