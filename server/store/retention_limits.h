#ifndef ROLLGAIT_SERVER_STORE_RETENTION_LIMITS_H_
#define ROLLGAIT_SERVER_STORE_RETENTION_LIMITS_H_

#include <chrono>
#include <cstdint>

namespace rollgait::server {

// How long things are kept; 0: for ever. Ages are of the wall clock.
struct RetentionLimits {
  std::chrono::seconds solves{0};  // since the end of a solve
  std::chrono::seconds events{0};  // the same, for its event log but for the terminal event
  std::chrono::seconds audit{0};
  int64_t solve_bytes = 0;  // of the finished solves of each tenant

  RetentionLimits WithoutAges() const { return {.solve_bytes = solve_bytes}; }
  bool any() const { return solves.count() > 0 || events.count() > 0 || audit.count() > 0 || solve_bytes > 0; }
};

// What one step has removed.
struct Removed {
  int solves = 0;
  int event_logs = 0;
  int audit_rows = 0;

  bool any() const { return solves > 0 || event_logs > 0 || audit_rows > 0; }
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_RETENTION_LIMITS_H_
