#ifndef ROLLGAIT_SERVER_BASE_LANE_LOAD_H_
#define ROLLGAIT_SERVER_BASE_LANE_LOAD_H_

#include <chrono>
#include <map>
#include <string>

namespace rollgait::server {

// How much of the processor's time the tasks of each lane have taken lately: sums that halve every second. One thread
// at a time.
class LaneLoad {
 public:
  using Clock = std::chrono::steady_clock;

  // A task of the lane took so long, and ended now.
  void Add(const std::string& lane, std::chrono::nanoseconds took, Clock::time_point now);
  // Whether the lane takes more than a quarter of a core, and more than the average of the lanes that took any. False
  // where it is alone.
  bool IsBusy(const std::string& lane, Clock::time_point now);

 private:
  void Decay(Clock::time_point now);

  std::map<std::string, double> seconds_;  // at decayed_
  double sum_ = 0;
  Clock::time_point decayed_{};
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_LANE_LOAD_H_
