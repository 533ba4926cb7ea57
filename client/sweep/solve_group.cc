#include "client/sweep/solve_group.h"

#include <algorithm>
#include <map>
#include <utility>

#include "client/sweep/batches.h"
#include "client/sweep/group_follower.h"

namespace rollgait::client {
namespace {

constexpr int kMostAttempts = 100;  // of a point, with --again

bool EndedWithoutAnswer(const v1::Solve& solve) {
  return solve.state() == v1::SOLVE_STATE_FAILED || solve.state() == v1::SOLVE_STATE_CANCELLED;
}

// Follows the solves from solves[first] on, as many as one stream takes.
void FollowSome(Connection& connection, const std::vector<v1::Solve>& solves, size_t first, double reconnect_s,
                Leave& leave, const std::function<void(size_t, const v1::SolveEvent&)>& on_event,
                const std::function<void(const std::string&)>& on_note) {
  std::map<std::string, int64_t> after;
  std::multimap<std::string, size_t> places;
  for (size_t i = first; i < std::min(solves.size(), first + kMostAtOnce); ++i) {
    after[solves[i].name()] =
        std::max<int64_t>(solves[i].last_sequence() - 1, 0);  // its newest event, and what follows
    places.emplace(solves[i].name(), i);
  }
  GroupFollower follower(connection, std::move(after), reconnect_s);
  leave.Attach(&follower);
  try {
    follower.Follow(
        [&](const v1::SolveEvent& event) {
          const auto [begin, end] = places.equal_range(event.name());
          for (auto place = begin; place != end; ++place) on_event(place->second, event);
        },
        on_note);
  } catch (...) {
    leave.Attach(nullptr);
    throw;
  }
  leave.Attach(nullptr);
}

}  // namespace

std::vector<v1::Solve> CreateAgain(Connection& connection, std::vector<v1::CreateSolveRequest> requests,
                                   const std::function<void(double seconds)>& wait) {
  std::vector<v1::Solve> solves = CreateInBatches(connection, requests, wait);
  for (int attempt = 2; attempt <= kMostAttempts; ++attempt) {
    std::vector<size_t> places;
    std::vector<v1::CreateSolveRequest> further;
    for (size_t i = 0; i < solves.size(); ++i) {
      if (!EndedWithoutAnswer(solves[i])) continue;
      places.push_back(i);
      further.push_back(requests[i]);
      further.back().set_request_id(requests[i].request_id() + "-" + std::to_string(attempt));
    }
    if (places.empty()) break;
    std::vector<v1::Solve> made = CreateInBatches(connection, further, wait);
    for (size_t i = 0; i < places.size(); ++i) solves[places[i]] = std::move(made[i]);
  }
  return solves;
}

void FollowAll(Connection& connection, const std::vector<v1::Solve>& solves, double reconnect_s, Leave& leave,
               const std::function<void(size_t, const v1::SolveEvent&)>& on_event,
               const std::function<void(const std::string&)>& on_note) {
  for (size_t first = 0; first < solves.size(); first += kMostAtOnce) {
    FollowSome(connection, solves, first, reconnect_s, leave, on_event, on_note);
  }
}

}  // namespace rollgait::client
