#ifndef ROLLGAIT_TESTS_SCHEDULES_EVENT_WORDS_H_
#define ROLLGAIT_TESTS_SCHEDULES_EVENT_WORDS_H_

#include <cstdio>
#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::server {

// What an event tells, without its time; see SeenEvent.
inline std::string WordsOf(const v1::SolveEvent& event) {
  char text[96] = "finished";
  if (event.has_iteration()) {
    std::snprintf(text, sizeof text, "iteration %d %d %.0f", event.iteration().mesh(), event.iteration().index(),
                  event.iteration().objective());
  } else if (event.has_state_change()) {
    std::snprintf(text, sizeof text, "state %d attempt %d", static_cast<int>(event.state_change().state()),
                  event.state_change().attempt());
  }
  return text;
}

// The same of a stored one: the last event of a solve says so by its kind.
inline std::string WordsOf(const std::string& payload) {
  v1::SolveEvent event;
  if (!event.ParseFromString(payload)) return "unreadable";
  return WordsOf(event);
}

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_EVENT_WORDS_H_
