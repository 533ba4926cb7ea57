#include "server/service/full_queue.h"

namespace rollgait::server {

void FullQueue::Note(const std::string& tenant, const Error& error) {
  if (error.code != ErrorCode::kResourceExhausted) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  const Clock::time_point now = Clock::now();
  std::erase_if(of_tenant_, [&](const auto& entry) { return entry.second.until < now; });
  const Full full{error, now + kMemory};
  if (error.quota) {
    of_tenant_.insert_or_assign(tenant, full);
  } else {
    of_all_ = full;
  }
}

std::optional<Error> FullQueue::Refusal(const std::string& tenant) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (of_all_ && of_all_->until >= now) return of_all_->error;
  const auto place = of_tenant_.find(tenant);
  if (place == of_tenant_.end() || place->second.until < now) return std::nullopt;
  return place->second.error;
}

}  // namespace rollgait::server
