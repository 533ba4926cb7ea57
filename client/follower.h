// Follows the events of one solve to the end, through broken connections.
#ifndef ROLLGAIT_CLIENT_FOLLOWER_H_
#define ROLLGAIT_CLIENT_FOLLOWER_H_

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>

#include "client/connection.h"
#include "client/stream_breaks.h"

namespace rollgait::client {

struct FollowOptions {
  // Events with a larger sequence number are wanted.
  int64_t after_sequence = 0;
  // How long to try to re-attach after the stream broke, s. 0: not at all.
  double reconnect_s = 60.0;
  // WatchSolveRequest.iterates_per_second; events with iterates are extra, and may be missed.
  int iterates_per_second = 0;
};

// Calls `on_event` for every event after options.after_sequence once and in order (heartbeats excepted, which are
// dropped), and `on_note` with a sentence about the connection. Both are called by the thread that calls Follow.
// Cancel and Stop may be called by any other thread.
class SolveFollower {
 public:
  SolveFollower(Connection& connection, std::string name, const FollowOptions& options);

  // Returns the finished solve. Throws Failure: kUnreachable when the stream broke and could not be re-attached in
  // time, kCancelled after Stop, otherwise what the server answered.
  v1::Solve Follow(const std::function<void(const v1::SolveEvent&)>& on_event,
                   const std::function<void(const std::string&)>& on_note);

  // Asks the server to stop the solve; the stream then ends with the terminal event. Asked again after a re-attachment
  // if the server did not answer. Returns the status of the attempt.
  grpc::Status Cancel();

  // Leaves the solve alone and makes Follow throw.
  void Stop();

 private:
  StreamEnd ReadStream(const std::function<void(const v1::SolveEvent&)>& on_event,
                       const std::function<void(const std::string&)>& on_note);
  bool Accept(const v1::SolveEvent& event, const std::function<void(const std::string&)>& on_note);
  void WaitBeforeRetry(double seconds);

  Connection& connection_;
  const std::string name_;
  const FollowOptions options_;
  int64_t last_sequence_;
  bool heard_ = false;  // Something arrived on the current stream.
  v1::Solve finished_;

  std::mutex mutex_;
  std::condition_variable stopped_changed_;
  grpc::ClientContext* context_ = nullptr;  // Of the stream being read; guarded by mutex_.
  bool stopped_ = false;                    // Guarded by mutex_.
  std::atomic<bool> cancel_pending_ = false;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FOLLOWER_H_
