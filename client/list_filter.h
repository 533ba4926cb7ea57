// Which solves `rollgait list` shows.
#ifndef ROLLGAIT_CLIENT_LIST_FILTER_H_
#define ROLLGAIT_CLIENT_LIST_FILTER_H_

#include <chrono>
#include <string>
#include <vector>

#include "rollgait/v1/gait_service.pb.h"

namespace rollgait::client {

// As given on the command line; empty: any. The server filters by all but the name.
struct ListFilter {
  std::vector<std::string> states = {};  // one of them
  std::string tenant = {};               // empty: the caller's own, "-": of all
  std::string verdict = {};              // within, exceeded, not-judged, none
  std::string termination = {};          // optimal, time-limit … or none
  std::vector<std::string> labels = {};  // "KEY=VALUE", all of them
  std::string model = {};
  std::string name_prefix = {};         // of the ID, with or without "solves/"
  std::string since = {}, before = {};  // see ParseTime
};

// The instant that "90s", "30m", "12h" or "7d" before `now`, "2026-11-24" or "2026-11-24T12:30" (UTC) means. Throws
// Failure(kUsage), which names the flag, for another text.
std::chrono::system_clock::time_point ParseTime(const std::string& flag, const std::string& text,
                                                std::chrono::system_clock::time_point now);

// The model of a solve as the list shows it and --model means it: "own" for one that the request carries.
std::string ListedModel(const v1::Solve& solve);

// The first page of what passes the filter but for the name. It has a filter only where one is asked for that servers
// of version 0.4.0 and before do not know. Throws Failure(kUsage) for a word that is not in a flag's list.
v1::ListSolvesRequest ListRequest(const ListFilter& filter, std::chrono::system_clock::time_point now);

// Whether the name begins as the filter asks.
bool HasNameOf(const ListFilter& filter, const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_LIST_FILTER_H_
