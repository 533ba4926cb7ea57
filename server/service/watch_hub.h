#ifndef ROLLGAIT_SERVER_SERVICE_WATCH_HUB_H_
#define ROLLGAIT_SERVER_SERVICE_WATCH_HUB_H_

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/base/hint_channel.h"
#include "server/base/iterate_files.h"
#include "server/service/solve_feed.h"
#include "server/service/solve_message.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

class WatchHub;

// Of WatchSolveRequest.iterates_per_second: as many as a solver sends (kIteratePause).
inline constexpr int kMostIteratesPerSecond = 4;

// What a reader gets next.
struct WatchBatch {
  std::vector<EventPtr> events;
  bool ended = false;  // the terminal event is in `events` or was delivered before: nothing will follow
};

// Where a reader goes on, and what it wants besides events.
struct WatchPosition {
  std::string id;
  int64_t after_sequence = 0;   // number of the newest event that it has
  int iterates_per_second = 0;  // at most so many, in [0, kMostIteratesPerSecond]; 0: none
};

// What a stream is fed from. One thread at a time.
class EventSource {
 public:
  virtual ~EventSource() = default;
  // What follows on what was taken before; no events if there is nothing new.
  virtual Outcome<WatchBatch> Take() = 0;
};

// One reader's place in the events of one solve. One thread at a time; destroy it before the hub.
class Watch : public EventSource {
 public:
  ~Watch() override;
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  // Events that follow those taken before, at most kMaxBatch, and the newest iterate if the reader wants one now; none
  // if there is nothing new, or a heartbeat if nothing was taken for the heartbeat interval. May read the store.
  // kUnavailable: the server is stopping. kNotFound: it was deleted. kOutOfRange: retention has removed what follows.
  Outcome<WatchBatch> Take() override;

  static constexpr int kMaxBatch = 64;

 private:
  friend class WatchHub;
  Watch(WatchHub& hub, std::shared_ptr<SolveFeed> feed, int64_t position, std::chrono::nanoseconds iterate_pause,
        std::function<void()> wake);
  bool HeartbeatDue() const;
  bool wants_iterates() const { return iterate_pause_.count() > 0; }
  // There is one that the reader has not taken, and its pause is over.
  bool IterateDue() const;
  std::shared_ptr<v1::SolveEvent> NewEvent() const;

  WatchHub& hub_;
  const std::shared_ptr<SolveFeed> feed_;
  const std::shared_ptr<const std::function<void()>> wake_;
  std::atomic<int64_t> position_;  // number of the last event taken
  std::atomic<int64_t> last_taken_ns_;
  const std::chrono::nanoseconds iterate_pause_;  // 0: none are wanted
  std::atomic<int64_t> iterate_taken_{0};         // SolveFeed::iterate_number
  std::atomic<int64_t> iterate_taken_ns_{0};
};

// Tells readers of new events. A thread learns of them from the agent's notifications and, should one be lost, by
// looking into the store every kNotifyPollMillis; events that several readers want are read and decoded once.
class WatchHub {
 public:
  // Store and hints outlive the hub, which alone receives from them. Heartbeats come within a poll of their time.
  // `iterates`: where the agents of this machine keep those of running solves.
  // `drive`: kCaller has no thread, and its owner calls Turn.
  enum class Drive { kThread, kCaller };
  WatchHub(SolveStore& store, HintChannel& hints, std::chrono::milliseconds heartbeat_interval, IterateFiles iterates,
           Drive drive = Drive::kThread);
  ~WatchHub();

  // A reader from a position. `wake` is called, from any thread, when Take may have something: soon after opening too.
  // It must not block, nor call the hub, and may come once more after the reader's end. kNotFound, kOutOfRange,
  // kUnavailable when stopped.
  Outcome<std::unique_ptr<Watch>> Open(const WatchPosition& position, std::function<void()> wake);
  // This process has changed a solve: look at once.
  void Changed(const std::string& id);
  // Wakes every reader; from now on Take and Open answer kUnavailable.
  void Stop();
  bool stopped() const { return stopped_; }
  // One turn of the loop, without waiting: tells readers of what was hinted at or, if `look`, of all that is new in the
  // store.
  void Turn(bool look);
  std::chrono::milliseconds heartbeat_interval() const { return heartbeat_interval_; }
  struct Stats {
    int readers = 0;
    int64_t max_lag = 0;  // events that the reader furthest behind has not taken yet
  };
  Stats GetStats();

 private:
  friend class Watch;
  struct Entry {
    std::shared_ptr<SolveFeed> feed;
    std::vector<Watch*> watches;
    bool WantsIterates() const;
  };
  using Wakes = std::vector<std::shared_ptr<const std::function<void()>>>;

  void Loop();
  // Tells the readers of a solve what is new: its iterate, and its events if they are to be read.
  void Refresh(const std::string& id, bool read_events);
  // Wakes those for whom a heartbeat or an iterate is due.
  void WakeTheDue();
  void Close(Watch* watch);
  // Those that have changed in the store since they were read, or were deleted there.
  std::vector<std::string> ChangedIds();
  // Those with a reader that wants iterates.
  std::vector<std::string> IteratedIds();

  SolveStore& store_;
  HintChannel& hints_;
  const IterateFiles iterates_;
  const std::chrono::milliseconds heartbeat_interval_;
  const int event_fd_;
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;  // protects what follows
  std::map<std::string, Entry> entries_;
  std::vector<std::string> changed_;
  std::thread thread_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_WATCH_HUB_H_
