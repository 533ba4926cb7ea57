#ifndef ROLLGAIT_BENCH_SERVICE_LOAD_EVENT_STREAM_H_
#define ROLLGAIT_BENCH_SERVICE_LOAD_EVENT_STREAM_H_

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bench/service_load/latencies.h"
#include "bench/service_load/target.h"

namespace rollgait::load {

// What all streams of a run have seen.
struct Deliveries {
  int64_t events = 0;  // heartbeats apart
  int64_t heartbeats = 0;
  int64_t skipped = 0;     // iterations merged for slow readers
  int64_t gaps = 0;        // a number that does not follow: sequence > last + skipped + 1
  int64_t duplicates = 0;  // sequence ≤ last
  int64_t terminal = 0;    // streams that got their terminal event
  Latencies latency;       // from event.time to arrival, for events younger than their stream; iterations and states
  Latencies terminal_latency;
  std::map<grpc::StatusCode, int64_t> ends;
};

// Shared by the streams of a run.
class DeliveryBoard {
 public:
  void Add(const v1::SolveEvent& event, int64_t last, bool live, std::chrono::system_clock::time_point arrival);
  void Ended(grpc::StatusCode code);
  // A stream has got its first event.
  void Opened();
  // Waits until so many have opened or ended; false: not in time.
  bool WaitOpened(int64_t streams, std::chrono::seconds at_most);
  bool WaitEnded(int64_t streams, std::chrono::seconds at_most);
  Deliveries Get();

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  Deliveries seen_;
  int64_t opened_ = 0, ended_ = 0;
};

// One WatchSolve stream on the callback API.
class EventStream : public grpc::ClientReadReactor<v1::SolveEvent> {
 public:
  // `board` outlives the stream.
  EventStream(const Target& target, Stub& stub, const std::string& name, DeliveryBoard& board);

  // Starts to read. Without it the stream is opened and never read: a stalled reader.
  void Read();
  void Cancel() { context_.TryCancel(); }

  void OnReadDone(bool ok) override;
  void OnDone(const grpc::Status& status) override;

 private:
  grpc::ClientContext context_;
  v1::WatchSolveRequest request_;
  v1::SolveEvent event_;
  DeliveryBoard& board_;
  const std::chrono::system_clock::time_point start_ = std::chrono::system_clock::now();
  int64_t last_ = 0;
  bool opened_ = false;
};

// Solves to be watched, which run at once and end by themselves: `seconds` after their start at the latest, the first
// after 60 % of that. Returns their names when all run.
std::vector<std::string> StartWatchedSolves(const Target& target, int solves, const std::string& model, double seconds);

}  // namespace rollgait::load

#endif  // ROLLGAIT_BENCH_SERVICE_LOAD_EVENT_STREAM_H_
