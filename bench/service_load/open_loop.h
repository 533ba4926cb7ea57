#ifndef ROLLGAIT_BENCH_SERVICE_LOAD_OPEN_LOOP_H_
#define ROLLGAIT_BENCH_SERVICE_LOAD_OPEN_LOOP_H_

#include <grpcpp/grpcpp.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "bench/service_load/latencies.h"

namespace rollgait::load {

// Calls at times that are fixed beforehand, whether earlier ones were answered or not: a server that stalls meets the
// load that its users would send, and the wait counts (no coordinated omission).
struct OpenLoopOptions {
  double rate = 100;  // calls/s on average, Poisson arrivals
  double seconds = 10;
  unsigned seed = 1;
  double warm_up = 1;          // s at the beginning that are sent and not counted
  int64_t most_open = 50'000;  // unanswered calls at which the run is given up
};

struct OpenLoopResult {
  std::map<grpc::StatusCode, Latencies> by_code;  // from the time a call was due to its answer
  Latencies lag;                                  // how late calls were sent
  int64_t sent = 0;                               // counted ones
  double seconds = 0;                             // from the first counted call to the last one's due time
  bool gave_up = false;                           // most_open was reached

  int64_t Count(grpc::StatusCode code) const;
  // Answers of this code for each second.
  double Rate(grpc::StatusCode code) const;
};

// One call: `send(number, done)` starts it and has `done` called once, from any thread.
using Send = std::function<void(int64_t number, std::function<void(grpc::StatusCode)> done)>;

// Returns when every call was answered.
OpenLoopResult RunOpenLoop(const OpenLoopOptions& options, const Send& send);

// "OK 5000, UNAVAILABLE 2"
std::string CodesText(const OpenLoopResult& result);
std::string CodeName(grpc::StatusCode code);

}  // namespace rollgait::load

#endif  // ROLLGAIT_BENCH_SERVICE_LOAD_OPEN_LOOP_H_
