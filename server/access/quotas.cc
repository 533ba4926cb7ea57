#include "server/access/quotas.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace rollgait::server {
namespace {

constexpr double kBurstSeconds = 2;
constexpr size_t kMostBuckets = 10'000;  // idle ones are full and may be forgotten

Error Exhausted(const std::string& tenant, const std::string& text, std::chrono::milliseconds retry) {
  Error error{ErrorCode::kResourceExhausted, text + "; try again later", {}, retry};
  error.quota = {"tenant:" + tenant, text};
  return error;
}

}  // namespace

std::optional<Error> Quotas::TakeCreate(const std::string& tenant, double creates_per_s) {
  if (creates_per_s <= 0) return std::nullopt;
  const double most = std::max(1.0, kBurstSeconds * creates_per_s);
  const std::lock_guard<std::mutex> lock(mutex_);
  const Clock::time_point now = now_();
  if (buckets_.size() >= kMostBuckets) {
    std::erase_if(buckets_, [&](const auto& entry) {
      return entry.second.level >= 0 && now - entry.second.filled > std::chrono::minutes(1);
    });
  }
  const auto [place, is_new] = buckets_.try_emplace(tenant, Bucket{most, now});
  Bucket& bucket = place->second;
  bucket.level =
      std::min(most, bucket.level + creates_per_s * std::chrono::duration<double>(now - bucket.filled).count());
  bucket.filled = now;
  if (bucket.level >= 1) {
    bucket.level -= 1;
    return std::nullopt;
  }
  const auto wait =
      std::chrono::milliseconds(static_cast<int64_t>(std::ceil(1000 * (1 - bucket.level) / creates_per_s)));
  std::ostringstream text;
  text << "tenant \"" << tenant << "\" creates more than its limit of " << creates_per_s << " solves a second";
  return Exhausted(tenant, text.str(), wait);
}

void Quotas::OweCreates(const std::string& tenant, double creates_per_s, int count) {
  if (creates_per_s <= 0) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto bucket = buckets_.find(tenant);
  if (bucket != buckets_.end()) bucket->second.level -= count;
}

std::shared_ptr<void> Quotas::TakeOne(const std::shared_ptr<Counts>& counts, const std::string& tenant, int most) {
  const std::lock_guard<std::mutex> lock(counts->mutex);
  const auto known = counts->of.find(tenant);
  const int count = known == counts->of.end() ? 0 : known->second;
  if (most > 0 && count >= most) return nullptr;
  counts->of[tenant] = count + 1;
  return {counts.get(), [counts, tenant](void*) {
            const std::lock_guard<std::mutex> release(counts->mutex);
            const auto place = counts->of.find(tenant);
            if (--place->second == 0) counts->of.erase(place);
          }};
}

Outcome<std::shared_ptr<void>> Quotas::TakeWatch(const std::string& tenant, int max_watches) {
  if (std::shared_ptr<void> one = TakeOne(watches_, tenant, max_watches)) return one;
  const std::string most = std::to_string(max_watches);
  return Exhausted(tenant, most + " streams of tenant \"" + tenant + "\" are open, its limit is " + most,
                   std::chrono::milliseconds(1000));
}

Outcome<std::shared_ptr<void>> Quotas::TakeSimulation(const std::string& tenant, int max_simulations) {
  if (std::shared_ptr<void> one = TakeOne(simulations_, tenant, max_simulations)) return one;
  const std::string most = std::to_string(max_simulations);
  return Exhausted(tenant, most + " simulations of tenant \"" + tenant + "\" run, its limit is " + most,
                   std::chrono::milliseconds(1000));
}

int Quotas::watches(const std::string& tenant) const {
  const std::lock_guard<std::mutex> lock(watches_->mutex);
  const auto place = watches_->of.find(tenant);
  return place == watches_->of.end() ? 0 : place->second;
}

Outcome<std::shared_ptr<void>> Backpressure::Enter(const std::string& lane) {
  const int most_of_lane = lane.empty() ? most_at_once_ : (3 * most_at_once_ + 3) / 4;
  const std::lock_guard<std::mutex> lock(inside_->mutex);
  const auto known = inside_->of.find(lane);
  const bool lane_is_full = known != inside_->of.end() && known->second >= most_of_lane;
  if (inside_->all >= most_at_once_ || lane_is_full) {
    const bool of_caller = lane_is_full && most_of_lane < most_at_once_;
    return Error{ErrorCode::kResourceExhausted,
                 "the server is answering " + std::to_string(of_caller ? most_of_lane : most_at_once_) +
                     " calls that make work" + (of_caller ? " of the same tenant" : "") +
                     ", the most it does at once; "
                     "try again later",
                 {},
                 std::chrono::milliseconds(500)};
  }
  ++inside_->all;
  ++inside_->of[lane];
  return std::shared_ptr<void>(nullptr, [inside = inside_, lane](void*) {
    const std::lock_guard<std::mutex> leaving(inside->mutex);
    --inside->all;
    const auto mine = inside->of.find(lane);
    if (--mine->second == 0) inside->of.erase(mine);
  });
}

}  // namespace rollgait::server
