#ifndef ROLLGAIT_SERVER_SERVICE_FULL_QUEUE_H_
#define ROLLGAIT_SERVER_SERVICE_FULL_QUEUE_H_

#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "server/base/outcome.h"

namespace rollgait::server {

// Remembers for a moment that the store refused a solve because a queue is full, so that a flood of further ones costs
// no transaction each. Any thread may call; nothing blocks.
class FullQueue {
 public:
  using Clock = std::chrono::steady_clock;

  // What the store answered to a new solve of the tenant. An error with a quota is the tenant's own limit, one without
  // is everybody's; errors that are no kResourceExhausted are not remembered.
  void Note(const std::string& tenant, const Error& error);
  // That error, for everybody or for this tenant, if it was a moment ago.
  std::optional<Error> Refusal(const std::string& tenant);

 private:
  static constexpr std::chrono::milliseconds kMemory{100};  // a tenth of the retry_after that such an error names

  struct Full {
    Error error;
    Clock::time_point until;
  };

  std::mutex mutex_;  // protects what follows
  std::optional<Full> of_all_;
  std::map<std::string, Full> of_tenant_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_FULL_QUEUE_H_
