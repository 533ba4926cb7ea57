#include <chrono>
#include <stdexcept>

#include "bench/service_load/event_stream.h"
#include "bench/service_load/open_loop.h"
#include "bench/service_load/scenarios.h"

namespace rollgait::load {
namespace {

nlohmann::ordered_json DeliveryFigures(const Deliveries& seen) {
  nlohmann::ordered_json figures;
  figures["events"] = seen.events;
  figures["heartbeats"] = seen.heartbeats;
  figures["iterations_merged"] = seen.skipped;
  figures["gaps"] = seen.gaps;
  figures["duplicates"] = seen.duplicates;
  figures["terminal_events"] = seen.terminal;
  figures["delivery"] = LatencyFigures(seen.latency);
  figures["terminal_delivery"] = LatencyFigures(seen.terminal_latency);
  for (const auto& [code, count] : seen.ends) figures["ended"][CodeName(code)] = count;
  return figures;
}

}  // namespace

Row WatchScenario(const LoadOptions& options) {
  const int streams = options.streams > 0 ? options.streams : 2000;
  const int solves = options.solves > 0 ? options.solves : 20;
  const int connections = options.connections > 0 ? options.connections : 20;
  const std::string model = options.model.empty() ? "human29" : options.model;
  TargetOptions own = options.target;
  own.solver_slots = solves;
  const Target target(own);
  const auto stubs = target.Connect(connections);
  const std::vector<std::string> names = StartWatchedSolves(target, solves, model, options.seconds + 10);
  const int64_t before = target.ServerMemory();
  MemoryWatch memory(target);
  DeliveryBoard board;
  std::vector<std::unique_ptr<EventStream>> watches;
  for (int i = 0; i < streams; ++i) {
    watches.push_back(std::make_unique<EventStream>(target, *stubs[static_cast<size_t>(i % connections)],
                                                    names[static_cast<size_t>(i % solves)], board));
    watches.back()->Read();
  }
  const bool opened = board.WaitOpened(streams, std::chrono::seconds(60));
  const int64_t open_bytes = target.ServerMemory() - before;
  const bool ended = board.WaitEnded(streams, std::chrono::seconds(static_cast<int>(options.seconds) + 180));
  for (const auto& watch : watches) watch->Cancel();
  board.WaitEnded(streams, std::chrono::seconds(60));

  const Deliveries seen = board.Get();
  const double per_stream_kb = static_cast<double>(memory.Largest() - before) / streams / 1000;
  const double p99 = seen.latency.PercentileMs(99);
  Row row;
  row.scenario = std::to_string(streams) + " watched streams over " + std::to_string(solves) + " solves";
  row.asked = "no gap, no duplicate; delivery p99 ≤ 250 ms; ≤ 40 kB a stream";
  row.measured = std::to_string(seen.gaps) + " gaps, " + std::to_string(seen.duplicates) + " duplicates in " +
                 std::to_string(seen.events) + " events; delivery p99 " + Number(p99) + " ms, of terminal events " +
                 Number(seen.terminal_latency.PercentileMs(99)) + " ms; " +
                 Number(static_cast<double>(open_bytes) / streams / 1000) + " kB a stream when open, " +
                 Number(per_stream_kb) + " kB at most";
  row.met = opened && ended && seen.gaps == 0 && seen.duplicates == 0 && seen.terminal == streams && p99 <= 250 &&
            per_stream_kb <= 40;
  row.figures = DeliveryFigures(seen);
  row.figures["model"] = model;
  row.figures["connections"] = connections;
  row.figures["kilobytes_a_stream_open"] = static_cast<double>(open_bytes) / streams / 1000;
  row.figures["kilobytes_a_stream_largest"] = per_stream_kb;
  return row;
}

Row StalledReadersScenario(const LoadOptions& options) {
  const int streams = options.streams > 0 ? options.streams : 200;
  const int solves = options.solves > 0 ? options.solves : 2;
  const int connections = options.connections > 0 ? options.connections : 20;
  TargetOptions own = options.target;
  own.solver_slots = solves;
  const Target target(own);
  const auto stubs = target.Connect(connections, Target::Windows::kFixed);
  const auto reading = target.Connect(1);
  const std::vector<std::string> names =
      StartWatchedSolves(target, solves, options.model.empty() ? "planar" : options.model, options.seconds);
  DeliveryBoard stalled_board, reading_board;
  std::vector<std::unique_ptr<EventStream>> readers, stalled;
  for (int i = 0; i < 20; ++i) {
    const std::string& name = names[static_cast<size_t>(i % solves)];
    readers.push_back(std::make_unique<EventStream>(target, *reading[0], name, reading_board));
    readers.back()->Read();
  }
  const int64_t before = target.ServerMemory();
  MemoryWatch memory(target);
  for (int i = 0; i < streams; ++i) {
    stalled.push_back(std::make_unique<EventStream>(target, *stubs[static_cast<size_t>(i % connections)],
                                                    names[static_cast<size_t>(i % solves)], stalled_board));
  }
  const bool readers_ended = reading_board.WaitEnded(20, std::chrono::seconds(static_cast<int>(options.seconds) + 120));
  const double grown_mb = static_cast<double>(memory.Largest() - before) / 1e6;
  const double late_growth_mb = static_cast<double>(memory.Growth()) / 1e6;
  // Now they read: nothing but merged iterations may be missing.
  for (const auto& stream : stalled) stream->Read();
  const bool stalled_ended = stalled_board.WaitEnded(streams, std::chrono::seconds(120));
  for (const auto& stream : stalled) stream->Cancel();
  for (const auto& stream : readers) stream->Cancel();
  stalled_board.WaitEnded(streams, std::chrono::seconds(60));
  reading_board.WaitEnded(20, std::chrono::seconds(60));

  const Deliveries late = stalled_board.Get(), prompt = reading_board.Get();
  Row row;
  row.scenario = std::to_string(streams) + " readers that stop reading";
  row.asked = "memory grows by a bounded amount and then no more; others notice nothing; no terminal event lost";
  row.measured = "+" + Number(grown_mb) + " MB, then " + Number(late_growth_mb) +
                 " MB more; readers beside them: p99 " + Number(prompt.latency.PercentileMs(99)) +
                 " ms; terminal events " + std::to_string(late.terminal) + " of " + std::to_string(streams) + ", " +
                 std::to_string(late.skipped) + " iterations merged, " + std::to_string(late.gaps + prompt.gaps) +
                 " gaps";
  row.met = readers_ended && stalled_ended && late.terminal == streams && prompt.terminal == 20 &&
            late.gaps + prompt.gaps + late.duplicates + prompt.duplicates == 0 && grown_mb <= 50 &&
            prompt.latency.PercentileMs(99) <= 250;
  row.figures["stalled"] = DeliveryFigures(late);
  row.figures["reading"] = DeliveryFigures(prompt);
  row.figures["megabytes_grown"] = grown_mb;
  row.figures["megabytes_grown_late"] = late_growth_mb;
  return row;
}

}  // namespace rollgait::load
