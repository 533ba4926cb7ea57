#ifndef ROLLGAIT_BENCH_SERVICE_LOAD_SCENARIOS_H_
#define ROLLGAIT_BENCH_SERVICE_LOAD_SCENARIOS_H_

#include <string>

#include "bench/service_load/report.h"
#include "bench/service_load/target.h"

namespace rollgait::load {

// What a scenario may be told. 0 or empty: what the acceptance table asks.
struct LoadOptions {
  TargetOptions target;
  double seconds = 20;  // of measurement
  double rate = 0;      // calls/s
  int streams = 0;
  int solves = 0;
  int connections = 0;
  std::string model;
  bool idle_cores = false;  // do not let the cores solve meanwhile
};

// Each measures one row of the acceptance table of the service. They throw std::runtime_error with a sentence where
// they cannot measure.

// 2000 streams watch 20 running solves: gaps, duplicates, delivery from the event's time to its arrival, memory a
// stream.
Row WatchScenario(const LoadOptions& options);
// Finished solves are read 2000 times a second.
Row ResultsScenario(const LoadOptions& options);
// 300 different solves a second are created; every acknowledged one is in the list afterwards.
Row CreatesScenario(const LoadOptions& options);
// Creates at ten times that rate against a full queue.
Row OverloadScenario(const LoadOptions& options);
// RunSolve with a free slot: from the call to the first iteration.
Row FirstIterationScenario(const LoadOptions& options);
// 200 streams that stop reading: memory, and what other clients notice.
Row StalledReadersScenario(const LoadOptions& options);

}  // namespace rollgait::load

#endif  // ROLLGAIT_BENCH_SERVICE_LOAD_SCENARIOS_H_
