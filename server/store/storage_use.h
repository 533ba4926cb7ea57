#ifndef ROLLGAIT_SERVER_STORE_STORAGE_USE_H_
#define ROLLGAIT_SERVER_STORE_STORAGE_USE_H_

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "server/base/outcome.h"
#include "server/store/sql_connection.h"

namespace rollgait::server {

// Holds what tenants store against their limits. The sum over a tenant's solves and models is asked for at most every
// two seconds, more seldom where it takes long; what this process adds meanwhile is counted, what solves that run add,
// and what other processes do, only with the next sum. Any thread may call.
class StorageUse {
 public:
  // What is to be stored.
  struct Claim {
    std::string tenant;
    int64_t bytes = 0;
    int64_t limit = 0;  // of all that the tenant stores, this included; 0: none
  };

  // kResourceExhausted with what is stored and the limit; nullopt: there is room, and the claim is counted.
  std::optional<Error> Refusal(SqlConnection& connection, const Claim& claim);
  // Something was removed: sums are asked for again.
  void Forget();

 private:
  using Clock = std::chrono::steady_clock;
  struct Known {
    int64_t bytes = 0;
    Clock::time_point good_until;
  };

  std::mutex mutex_;  // protects what follows
  std::map<std::string, Known> known_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_STORAGE_USE_H_
