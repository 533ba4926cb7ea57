#ifndef ROLLGAIT_SERVER_GATEWAY_PLACES_H_
#define ROLLGAIT_SERVER_GATEWAY_PLACES_H_

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "server/base/outcome.h"

namespace rollgait::server {

// Somebody's place, until the last copy is gone.
using Place = std::shared_ptr<const std::string>;

// So many of a kind at once, and so many of one source. Threads may share it.
class Places : public std::enable_shared_from_this<Places> {
 public:
  // `what` are "long bodies".
  Places(std::string what, int total, int per_source)
      : what_(std::move(what)), total_(total), per_source_(per_source) {}
  // kUnavailable: there is no place, or the source has its part already; the message says which.
  Outcome<Place> Take(const std::string& source);

 private:
  void GiveBack(const std::string& source);

  const std::string what_;
  const int total_, per_source_;
  std::mutex mutex_;  // protects what follows
  int taken_ = 0;
  std::map<std::string, int> of_source_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_PLACES_H_
