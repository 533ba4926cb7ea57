#ifndef ROLLGAIT_SERVER_STORAGE_MAIN_H_
#define ROLLGAIT_SERVER_STORAGE_MAIN_H_

#include <cstdint>

#include "server/store/retention_limits.h"

namespace CLI {
class App;
}

namespace rollgait::server {

// What a server keeps, for how long, and what it leaves free: docs/explanation/stores.md.
struct StorageFlags {
  double keep_solves_days = 0, keep_events_days = 0, keep_audit_days = 0;
  int64_t keep_solves_mb = 0, reserve_mb = 64;

  RetentionLimits Retention() const;
};
void AddStorageFlags(CLI::App& app, StorageFlags& flags);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORAGE_MAIN_H_
