#include "server/base/lane_load.h"

#include <cmath>
#include <numbers>

namespace rollgait::server {
namespace {

constexpr double kHalfLife = 1;                 // s: an attack is noticed, and forgotten, about so fast
constexpr std::chrono::milliseconds kStep(50);  // between two times of halving; a twentieth of it is no difference
// A lane that has used less is forgotten: one call of a millisecond for about three seconds, so that whoever calls now
// and then counts in the average.
constexpr double kLeast = 1e-4;  // s
// Of a core: then somebody else who wakes up finds the lane at work every fourth time.
constexpr double kBusyShare = 0.25;

}  // namespace

void LaneLoad::Decay(Clock::time_point now) {
  if (now - decayed_ < kStep) return;
  const double factor = std::exp2(-std::chrono::duration<double>(now - decayed_).count() / kHalfLife);
  decayed_ = now;
  sum_ = 0;
  for (auto& [lane, seconds] : seconds_) seconds *= factor;
  std::erase_if(seconds_, [](const auto& entry) { return entry.second < kLeast; });
  for (const auto& [lane, seconds] : seconds_) sum_ += seconds;
}

void LaneLoad::Add(const std::string& lane, std::chrono::nanoseconds took, Clock::time_point now) {
  Decay(now);
  const double seconds = std::chrono::duration<double>(took).count();
  seconds_[lane] += seconds;
  sum_ += seconds;
}

bool LaneLoad::IsBusy(const std::string& lane, Clock::time_point now) {
  Decay(now);
  const auto known = seconds_.find(lane);
  if (known == seconds_.end()) return false;
  // What a constant share comes to: the integral of 2^(-t / half-life).
  if (known->second < kBusyShare * kHalfLife / std::numbers::ln2) return false;
  return known->second * static_cast<double>(seconds_.size()) > sum_;
}

}  // namespace rollgait::server
