#ifndef ROLLGAIT_SERVER_STORE_OPEN_STORE_H_
#define ROLLGAIT_SERVER_STORE_OPEN_STORE_H_

#include <memory>
#include <string>

#include "server/base/clock.h"
#include "server/store/sql_store.h"

namespace rollgait::server {

// Where the solves are.
struct StoreLocation {
  std::string sqlite_path;
};

// Opens the store, making what is missing. kUnavailable with the reason. The clock outlives it.
Outcome<std::unique_ptr<SqlStore>> OpenStore(const StoreLocation& location, const Clock& clock);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_OPEN_STORE_H_
