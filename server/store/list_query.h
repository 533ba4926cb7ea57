#ifndef ROLLGAIT_SERVER_STORE_LIST_QUERY_H_
#define ROLLGAIT_SERVER_STORE_LIST_QUERY_H_

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/store/solve_record.h"

namespace rollgait::server {

// What a solve must meet to be listed, all of it.
struct SolveFilter {
  std::vector<SolveState> states = {};  // one of them; empty: any
  // v1::Termination and v1::Verdict of its outcome, 0: it has none. A verdict that was not judged is also one that a
  // result does not say.
  std::optional<int> termination = std::nullopt, verdict = std::nullopt;
  Labels labels = {};      // it carries them all; at most kMostFilterLabels
  std::string model = {};  // NewSolve::model; empty: any
  // µs since 1970: from the first on, before the second.
  int64_t created_from_us = INT64_MIN, created_before_us = INT64_MAX;

  bool operator==(const SolveFilter&) const = default;
};
inline constexpr size_t kMostFilterLabels = 4;

// Different texts for different filters; empty for one that passes all.
std::string FilterText(const SolveFilter& filter);

// A page ends early when its specs and errors exceed this, so that it fits into one message.
inline constexpr size_t kMaxPageBytes = 1 << 20;

struct ListQuery {
  int page_size = 50;
  std::string page_token;  // from the previous page; empty: first page
  std::optional<SolveState> state;
  std::optional<std::string> tenant = std::nullopt;  // nullopt: of all
  SolveFilter filter = {};
};

struct SolvePage {
  std::vector<SolveRecord> records;  // newest first; `result` is left empty
  std::string next_page_token;       // empty: last page
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_LIST_QUERY_H_
