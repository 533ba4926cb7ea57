// Follows the events of several solves to their ends in one stream, through broken connections.
#ifndef ROLLGAIT_CLIENT_SWEEP_GROUP_FOLLOWER_H_
#define ROLLGAIT_CLIENT_SWEEP_GROUP_FOLLOWER_H_

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "client/connection.h"
#include "client/stream_breaks.h"

namespace rollgait::client {

class GroupFollower {
 public:
  // At most 256 solves, by name, with the number of the newest event of each that is not wanted. `reconnect_s` as in
  // StreamBreaks.
  GroupFollower(Connection& connection, std::map<std::string, int64_t> after, double reconnect_s);

  // Calls `on_event` for every event after those once, each solve's in order, heartbeats excepted, and `on_note` with a
  // sentence about the connection. Returns when all solves have finished. Throws Failure: kUnreachable when the stream
  // broke and could not be re-attached in time, kCancelled after Stop, otherwise what the server answered.
  void Follow(const std::function<void(const v1::SolveEvent&)>& on_event,
              const std::function<void(const std::string&)>& on_note);

  // Leaves the solves alone and makes Follow throw. Any thread may call.
  void Stop();

 private:
  StreamEnd ReadStream(const std::function<void(const v1::SolveEvent&)>& on_event);
  void WaitBeforeRetry(double seconds);

  Connection& connection_;
  std::map<std::string, int64_t> after_;  // of those that have not finished
  const double reconnect_s_;

  std::mutex mutex_;
  std::condition_variable stopped_changed_;
  grpc::ClientContext* context_ = nullptr;  // Of the stream being read; guarded by mutex_.
  bool stopped_ = false;                    // Guarded by mutex_.
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SWEEP_GROUP_FOLLOWER_H_
