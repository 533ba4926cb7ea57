// What the page of a running solve is told.
#ifndef ROLLGAIT_CLIENT_VIEW_LIVE_FEED_H_
#define ROLLGAIT_CLIENT_VIEW_LIVE_FEED_H_

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Holds the log so far, the newest iterate and how the solve stands, and tells each stream what is new to it, as
// server-sent events (data in JSON):
//   begin       null                 everything follows from the start
//   state       text                 how the solve stands, in words
//   iterations  [[index, mesh, objective, primal, dual, barrier, elapsed s], …]    further rows
//   iterate     IterateData          the newest one; those that a stream was too slow for are left out
//   end         null                 the solve has ended; nothing follows
// Any thread may call.
class LiveFeed {
 public:
  void SetState(const std::string& text);
  void Add(const v1::Iteration& iteration);
  void ShowIterate(const nlohmann::json& iterate);
  void End();

  // What one stream has been told.
  struct Position {
    bool begun = false;
    size_t iterations = 0;
    int state = 0, iterate = 0;
    bool ended = false;
  };
  // The events that follow `position`, which moves on; waits for some at most so long, else empty.
  std::string Wait(Position* position, std::chrono::milliseconds at_most);

 private:
  std::string New(Position* position) const;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> iterations_;  // rows
  std::string state_, iterate_;          // JSON
  int states_ = 0, iterates_ = 0;        // how many there were
  bool ended_ = false;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_VIEW_LIVE_FEED_H_
