#include "bench/service_load/report.h"

#include <cmath>
#include <cstdio>

namespace rollgait::load {

std::string Number(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", std::abs(value) < 10 ? 2 : std::abs(value) < 100 ? 1 : 0, value);
  return text;
}

std::string RowText(const Row& row) {
  return "| " + row.scenario + " | " + row.asked + " | " + row.measured + " | " + (row.met ? "met" : "NOT MET") + " |";
}

std::string RowJson(const Row& row) {
  nlohmann::ordered_json json;
  json["scenario"] = row.scenario;
  json["asked"] = row.asked;
  json["measured"] = row.measured;
  json["met"] = row.met;
  json["figures"] = row.figures;
  return json.dump();
}

nlohmann::ordered_json LatencyFigures(const Latencies& latencies) {
  nlohmann::ordered_json figures;
  figures["count"] = latencies.count();
  figures["median_ms"] = latencies.PercentileMs(50);
  figures["p95_ms"] = latencies.PercentileMs(95);
  figures["p99_ms"] = latencies.PercentileMs(99);
  figures["p99_9_ms"] = latencies.PercentileMs(99.9);
  figures["largest_ms"] = latencies.largest_ms();
  return figures;
}

}  // namespace rollgait::load
