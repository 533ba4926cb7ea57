#ifndef ROLLGAIT_TESTS_SCHEDULES_STORE_VIEW_H_
#define ROLLGAIT_TESTS_SCHEDULES_STORE_VIEW_H_

#include <cstdint>
#include <string>
#include <vector>

namespace rollgait::server {

// One solve as it lies in the database.
struct SeenSolve {
  int64_t number = 0;
  std::string id = {}, key = {}, owner = {}, tag = {};  // tag: its label of that name
  int state = 0;                                        // v1::SolveState
  int64_t epoch = 0, last_sequence = 0, trimmed = 0, held_events = 0;
  bool cancel_requested = false;
  std::string result = {}, error = {};
  std::string tenant = {};
  int priority = 0;
};

// One event. `what` says what it tells without the time, so that the event in the database and the one that a reader
// gets can be compared.
struct SeenEvent {
  int64_t sequence = 0;
  std::string what;
};

// Looks into the database with statements of its own, past everything that is tested.
class StoreView {
 public:
  virtual ~StoreView() = default;
  // In the order of their numbers.
  virtual std::vector<SeenSolve> Solves() = 0;
  // Of one solve, with a larger sequence, in order.
  virtual std::vector<SeenEvent> Events(int64_t number, int64_t after_sequence) = 0;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SCHEDULES_STORE_VIEW_H_
