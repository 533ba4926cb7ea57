#ifndef ROLLGAIT_BENCH_SERVICE_LOAD_REPORT_H_
#define ROLLGAIT_BENCH_SERVICE_LOAD_REPORT_H_

#include <nlohmann/json.hpp>
#include <string>

#include "bench/service_load/latencies.h"

namespace rollgait::load {

// One row of the acceptance table.
struct Row {
  std::string scenario;
  std::string asked;
  std::string measured;
  bool met = false;
  nlohmann::ordered_json figures;  // everything that was measured, by name and unit
};

// One line for people, or the row as one line of JSON.
std::string RowText(const Row& row);
std::string RowJson(const Row& row);

// Count, median, 95 %, 99 %, 99.9 % and largest in ms.
nlohmann::ordered_json LatencyFigures(const Latencies& latencies);

// "12.3", with as many digits as say something.
std::string Number(double value);

}  // namespace rollgait::load

#endif  // ROLLGAIT_BENCH_SERVICE_LOAD_REPORT_H_
