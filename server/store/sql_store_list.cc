// SqlStore::List. Every statement is a literal, so that it is prepared once: what a filter does not ask for is bound to
// values that all solves have.
#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>

#include "rollgait/v1/accuracy.pb.h"
#include "server/store/page_token.h"
#include "server/store/sql_rows.h"
#include "server/store/sql_store.h"

namespace rollgait::server {
namespace {

// The sign keeps the states from choosing the index: it would have to be sorted.
#define ROLLGAIT_PASSES                                                                        \
  "AND +state IN (?, ?, ?, ?, ?) AND termination BETWEEN ? AND ? AND verdict BETWEEN ? AND ? " \
  "AND model = COALESCE(NULLIF(?, ''), model) AND create_time_us >= ? AND create_time_us < ? "
// Those that carry one label, and the number of the asked labels that they carry.
#define ROLLGAIT_LABELLED(of_tenant)                                                                         \
  "FROM (SELECT solve AS labelled FROM labels WHERE name = ? AND value = ? " of_tenant                       \
  "AND solve < ?) AS found "                                                                                 \
  "JOIN solves ON number = labelled WHERE (SELECT COUNT(*) FROM labels AS asked WHERE asked.solve = number " \
  "AND (asked.name || '=' || asked.value) IN (?, ?, ?, ?)) = ? "

// The filter as the values of ROLLGAIT_PASSES.
struct Bounds {
  explicit Bounds(const ListQuery& query);

  std::array<int, 5> states{};  // 0 is none
  int termination_from = INT32_MIN, termination_to = INT32_MAX, verdict_from = INT32_MIN, verdict_to = INT32_MAX;
};

Bounds::Bounds(const ListQuery& query) {
  constexpr SolveState kStates[] = {SolveState::kQueued, SolveState::kRunning, SolveState::kSucceeded,
                                    SolveState::kFailed, SolveState::kCancelled};
  static_assert(std::size(kStates) == std::tuple_size_v<decltype(states)>);
  const SolveFilter& filter = query.filter;
  for (size_t i = 0; i < states.size(); ++i) {
    const SolveState state = kStates[i];
    const bool asked =
        filter.states.empty() || std::find(filter.states.begin(), filter.states.end(), state) != filter.states.end();
    // An outcome is what has succeeded.
    const bool judged = state == SolveState::kSucceeded;
    const bool passes =
        asked && query.state.value_or(state) == state && (!filter.verdict || judged == (*filter.verdict != 0));
    states[i] = passes ? static_cast<int>(state) : 0;
  }
  if (filter.termination) termination_from = termination_to = *filter.termination;
  if (!filter.verdict || *filter.verdict == v1::VERDICT_UNSPECIFIED) return;
  verdict_to = *filter.verdict;
  verdict_from = *filter.verdict == v1::VERDICT_NOT_JUDGED ? v1::VERDICT_UNSPECIFIED : *filter.verdict;
}

// A filtered page: `values` are those of the text before ROLLGAIT_PASSES.
template <typename... Values>
Query Filtered(SqlConnection& connection, const char* sql, const ListQuery& query, const Values&... values) {
  const SolveFilter& filter = query.filter;
  const Bounds bounds(query);
  return Query(connection, sql, values..., bounds.states[0], bounds.states[1], bounds.states[2], bounds.states[3],
               bounds.states[4], bounds.termination_from, bounds.termination_to, bounds.verdict_from, bounds.verdict_to,
               filter.model, filter.created_from_us, filter.created_before_us, query.page_size + 1);
}

Query Labelled(SqlConnection& connection, const ListQuery& query, int64_t before) {
  const Labels& labels = query.filter.labels;
  ROLLGAIT_CHECK(labels.size() <= kMostFilterLabels);
  std::array<std::string, kMostFilterLabels> asked;
  size_t count = 0;
  for (const auto& [name, value] : labels) asked[count++] = JoinLabels({{name, value}});
  const auto& [name, value] = *labels.begin();
  const int carried = static_cast<int>(count);
  if (query.tenant.has_value()) {
    return Filtered(connection,
                    "SELECT " ROLLGAIT_SOLVE_COLUMNS ROLLGAIT_LABELLED("AND tenant = ? ") ROLLGAIT_PASSES
                    "ORDER BY labelled DESC LIMIT ?",
                    query, name, value, *query.tenant, before, asked[0], asked[1], asked[2], asked[3], carried);
  }
  return Filtered(connection,
                  "SELECT " ROLLGAIT_SOLVE_COLUMNS ROLLGAIT_LABELLED("") ROLLGAIT_PASSES
                  "ORDER BY labelled DESC LIMIT ?",
                  query, name, value, before, asked[0], asked[1], asked[2], asked[3], carried);
}

// One row more than the page has tells whether there is a next one.
Query PageOf(SqlConnection& connection, const ListQuery& query, int64_t before) {
  const int limit = query.page_size + 1;
  if (!query.filter.labels.empty()) return Labelled(connection, query, before);
  const bool filtered = query.filter != SolveFilter();
  const int state = static_cast<int>(query.state.value_or(SolveState::kQueued));
  if (query.tenant.has_value() && filtered) {
    return Filtered(connection,
                    "SELECT " ROLLGAIT_SOLVE_COLUMNS "FROM solves WHERE tenant = ? AND number < ? " ROLLGAIT_PASSES
                    "ORDER BY number DESC LIMIT ?",
                    query, *query.tenant, before);
  }
  if (filtered) {
    return Filtered(connection,
                    "SELECT " ROLLGAIT_SOLVE_COLUMNS "FROM solves WHERE number < ? " ROLLGAIT_PASSES
                    "ORDER BY number DESC LIMIT ?",
                    query, before);
  }
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

std::string FilterText(const SolveFilter& filter) {
  if (filter == SolveFilter()) return "";
  std::string text = "states";
  for (const SolveState state : filter.states) text += " " + std::to_string(static_cast<int>(state));
  text += "\ntermination " + (filter.termination ? std::to_string(*filter.termination) : "any");
  text += "\nverdict " + (filter.verdict ? std::to_string(*filter.verdict) : "any");
  text += "\ncreated " + std::to_string(filter.created_from_us) + " " + std::to_string(filter.created_before_us);
  // Lengths first: a model's name may hold anything.
  const std::string labels = JoinLabels(filter.labels);
  return text + "\nlabels " + std::to_string(labels.size()) + "\n" + labels + "\nmodel " + filter.model;
}

Outcome<SolvePage> SqlStore::List(const ListQuery& query) {
  int64_t before = INT64_MAX;
  if (!query.page_token.empty()) {
    const std::optional<int64_t> parsed = ParsePageToken(query, page_secret_);
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
        page.next_page_token = MakePageToken(last_number, query, page_secret_);
        break;
      }
      SolveRow row = ReadSolve(rows);
      last_number = row.number;
      bytes += row.record.spec.size() + row.record.error.size() + static_cast<size_t>(BytesOf(row.record.labels));
      page.records.push_back(std::move(row.record));
    }
    return page;
  });
}

}  // namespace rollgait::server
