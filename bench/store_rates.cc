// How much the stores take: claims and results of 100 kB a second, by several threads, on SQLite and on a PostgreSQL of
// the program's own, both with fsync.
// A network can be put before PostgreSQL: then each wait for it costs a round trip.
// Before the claims so many solves more can be queued, of so many tenants.
//   store_rates [--seconds S] [--threads N] [--round-trip-ms MS] [--queued N] [--tenants N]
#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>
#include <vector>

#include "bench/delayed_socket.h"
#include "server/store/open_store.h"
#include "tests/server/store/temporary_directory.h"
#include "tests/support/postgres_cluster.h"

namespace rollgait::server {
namespace {

struct Load {
  double seconds = 5;
  int threads = 8;
  int queued = 0, tenants = 1;
};

void Queue(SqlStore& store, const Load& load) {
  constexpr int kAtOnce = 256;
  std::vector<NewSolve> solves;
  for (int i = 0; i < load.queued; ++i) {
    NewSolve solve{"q" + std::to_string(i), "", std::string(300, 's'), ""};
    solve.max_queued = 10'000'000;
    solve.actor.tenant = "tenant " + std::to_string(i / kAtOnce % load.tenants);
    solve.priority = i % 5 - 2;
    solves.push_back(std::move(solve));
    if ((i + 1) % kAtOnce != 0 && i + 1 != load.queued) continue;
    if (!store.CreateAll(solves).ok()) std::fprintf(stderr, "a batch was not stored\n");
    solves.clear();
  }
}

// Calls of `work(store, thread, count)` a second.
template <typename Work>
double Rate(SqlStore& store, const Load& load, Work work) {
  std::atomic<int64_t> calls{0};
  const auto start = std::chrono::steady_clock::now();
  const auto end = start + std::chrono::duration<double>(load.seconds);
  std::vector<std::thread> threads;
  for (int t = 0; t < load.threads; ++t) {
    threads.emplace_back([&, t] {
      for (int64_t i = 0; std::chrono::steady_clock::now() < end && work(store, t, i); ++i) ++calls;
    });
  }
  for (std::thread& thread : threads) thread.join();
  return static_cast<double>(calls) / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void Measure(const char* name, SqlStore& store, const Load& load) {
  const double creates = Rate(store, load, [](SqlStore& s, int thread, int64_t i) {
    NewSolve solve{"c" + std::to_string(thread) + "-" + std::to_string(i), "", std::string(300, 's'), ""};
    solve.max_queued = 10'000'000;
    return s.Create(solve).ok();
  });
  Queue(store, load);
  std::vector<std::vector<Lease>> leases(static_cast<size_t>(load.threads));
  const double claims = Rate(store, load, [&](SqlStore& s, int thread, int64_t) {
    const auto claimed = s.ClaimNext("agent-" + std::to_string(thread), kLeaseDuration);
    if (!claimed.ok() || !claimed.value().has_value()) return false;
    leases[static_cast<size_t>(thread)].push_back(claimed.value()->lease);
    return true;
  });
  const SolveEnd end{SolveState::kSucceeded, std::string(100'000, 'r'), "", true};
  const double results = Rate(store, load, [&](SqlStore& s, int thread, int64_t i) {
    const std::vector<Lease>& own = leases[static_cast<size_t>(thread)];
    return i < static_cast<int64_t>(own.size()) && s.Finish(own[static_cast<size_t>(i)], {}, end).ok();
  });
  const std::string read = leases[0].empty() ? "" : leases[0][0].solve_id;
  const double reads = Rate(store, load, [&](SqlStore& s, int, int64_t) { return s.Get(read).ok(); });
  std::printf("| %s | %.0f | %.0f | %.0f | %.0f |\n", name, creates, claims, results, reads);
  std::fflush(stdout);
}

int Main(int argc, char** argv) {
  Load load;
  double round_trip_ms = 0;
  CLI::App app("Rates of the stores.", "store_rates");
  app.add_option("--seconds", load.seconds, "of each figure")->capture_default_str();
  app.add_option("--threads", load.threads)->check(CLI::Range(1, 64))->capture_default_str();
  app.add_option("--round-trip-ms", round_trip_ms, "to PostgreSQL; 0: no network")->check(CLI::Range(0.0, 1000.0));
  app.add_option("--queued", load.queued, "solves that wait before the claims, of --tenants tenants")
      ->check(CLI::Range(0, 10'000'000));
  app.add_option("--tenants", load.tenants)->check(CLI::Range(1, 10'000))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::printf(
      "| store, %d threads | creates/s | claims/s | results of 100 kB/s | reads of 100 kB/s |\n|---|---|---|---|---|\n",
      load.threads);
  const SystemClock clock;
  {
    const TemporaryDirectory directory;
    Measure("SQLite", *OpenStore({directory.path() + "/rollgait.db"}, clock).value(), load);
  }
  const PostgresCluster cluster({.durable = true});
  const TemporaryDirectory directory;
  const std::string name = "/.s.PGSQL.5432";
  std::unique_ptr<DelayedSocket> network;
  std::string url = cluster.Url();
  if (round_trip_ms > 0) {
    network = std::make_unique<DelayedSocket>(directory.path() + name, cluster.directory() + name,
                                              std::chrono::microseconds(static_cast<int64_t>(500 * round_trip_ms)));
    url = "postgresql://rollgait@/postgres?host=" + directory.path();
  }
  StoreLocation location = LocateStore(url, "").value();
  location.connections = load.threads;
  Measure(round_trip_ms > 0 ? "PostgreSQL, network" : "PostgreSQL, Unix socket", *OpenStore(location, clock).value(),
          load);
  return 0;
}

}  // namespace
}  // namespace rollgait::server

int main(int argc, char** argv) { return rollgait::server::Main(argc, argv); }
