#ifndef ROLLGAIT_SERVER_STORE_AUDIT_H_
#define ROLLGAIT_SERVER_STORE_AUDIT_H_

#include <cstdint>
#include <string>

namespace rollgait::server {

// Who asked for a change; goes into the audit row of its transaction.
struct Actor {
  std::string tenant, token_id, peer;
};

struct AuditRow {
  int64_t number = 0;  // grows with time
  int64_t time_us = 0;
  Actor actor;
  std::string action;   // create, cancel, delete, end, expire, create model, delete model; others by server/access
  std::string solve;    // id; empty: of none
  std::string outcome;  // the solve's state, or what became of the call
  std::string detail;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_AUDIT_H_
