// Which solves `rollgait list` shows.
#ifndef ROLLGAIT_CLIENT_LIST_FILTER_H_
#define ROLLGAIT_CLIENT_LIST_FILTER_H_

#include <chrono>
#include <optional>
#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// As given on the command line; empty: any.
struct ListFilter {
  std::string state = {};        // the server filters by it
  std::string tenant = {};       // the server filters by it; empty: the caller's own, "-": of all
  std::string verdict = {};      // within, exceeded, not-judged, none
  std::string termination = {};  // optimal, time-limit … or none
  std::string model = {};
  std::string name_prefix = {};  // of the ID, with or without "solves/"
  std::string since = {};        // see ParseSince
};

// The instant that "90s", "30m", "12h" or "7d" before `now`, "2026-11-24" or "2026-11-24T12:30" (UTC) means. Throws
// Failure(kUsage) for another text.
std::chrono::system_clock::time_point ParseSince(const std::string& text, std::chrono::system_clock::time_point now);

// The model of a solve as the list shows it and --model means it: "own" for one that the request carries.
std::string ListedModel(const v1::Solve& solve);

// The filter with its words understood.
class SolveMatcher {
 public:
  // Throws Failure(kUsage) for a word that is not in a flag's list.
  SolveMatcher(const ListFilter& filter, std::chrono::system_clock::time_point now);

  v1::SolveState state() const { return state_; }  // unspecified: any
  // Nothing but the state is asked for: every solve that the server lists matches.
  bool IsOfStateAlone() const;
  bool Matches(const v1::Solve& solve) const;
  // The solve is older than what is asked for, and so are all after it: the server lists the newest first.
  bool IsTooOld(const v1::Solve& solve) const;

 private:
  v1::SolveState state_ = v1::SOLVE_STATE_UNSPECIFIED;
  std::optional<v1::Verdict> verdict_;
  std::optional<v1::Termination> termination_;
  std::string model_, name_prefix_;
  std::optional<std::chrono::system_clock::time_point> since_;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_LIST_FILTER_H_
