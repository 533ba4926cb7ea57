#include "server/gateway/places.h"

#include <utility>

namespace rollgait::server {

Outcome<Place> Places::Take(const std::string& source) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = of_source_.find(source);
  if (taken_ >= total_) {
    return Error{ErrorCode::kUnavailable, std::to_string(total_) + " " + what_ + " are under way already; try again"};
  }
  if (found != of_source_.end() && found->second >= per_source_) {
    return Error{ErrorCode::kUnavailable,
                 std::to_string(per_source_) + " " + what_ + " of your address are under way already; try again"};
  }
  ++taken_;
  ++of_source_[source];
  return Place(new std::string(source), [self = shared_from_this()](const std::string* place) {
    self->GiveBack(*place);
    delete place;
  });
}

void Places::GiveBack(const std::string& source) {
  const std::lock_guard<std::mutex> lock(mutex_);
  --taken_;
  const auto found = of_source_.find(source);
  if (--found->second == 0) of_source_.erase(found);
}

}  // namespace rollgait::server
