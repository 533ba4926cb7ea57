// Two tenants of one rollgaitd, one of them hostile: what the other's calls take alone and under attack.
//
//   rollgait_two_tenants [--rounds N] [--seconds S] [--good-ms G]
//
// A round measures the good tenant alone, then under attack, so that what else the machine does falls on both. Times in
// which the whole machine stood still are left out of both. Prints a table. Exit code 1: a p99 is more than twice what
// it is alone, a call of the good tenant was refused, a solve of its own was lost, or an attack did nothing.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <fstream>
#include <future>
#include <set>

#include "bench/service_load/latencies.h"
#include "tests/faults/faults.h"
#include "tests/faults/hostile_process.h"
#include "tests/faults/stalls.h"

namespace rollgait::faults {
namespace {

using Clock = std::chrono::steady_clock;
using load::Latencies;
using std::chrono::milliseconds;

constexpr milliseconds kPeriod{20};
constexpr milliseconds kDeadline{20'000};
constexpr double kMostRatio = 2;

enum Measure { kCreate, kFirstEvent, kWaiting, kGet, kList, kValidate, kMeasures };
constexpr std::array<const char*, kMeasures> kNames = {
    "CreateSolve", "WatchSolve, first event", "short solve waits in the queue", "GetSolve", "ListSolves", "Validate"};

struct Phase {
  std::array<Latencies, kMeasures> latencies;
  int64_t refused = 0;
  std::string first_refusal;
};

double Seconds(const google::protobuf::Timestamp& time) {
  return static_cast<double>(time.seconds()) + 1e-9 * time.nanos();
}

// A tenant that makes short solves one after the other and reads meanwhile.
class GoodTenant {
 public:
  GoodTenant(std::string address, std::string token) : address_(std::move(address)), token_(std::move(token)) {
    Phase ignored;
    last_ = MakeAndWatch(*Connect(address_), &ignored);
    if (last_.empty()) throw std::runtime_error("the first solve failed: " + ignored.first_refusal);
  }

  const std::string& solve() const { return last_; }

  Phase Run(double seconds) {
    const Clock::time_point end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    std::vector<std::future<Phase>> parts;
    parts.push_back(std::async(std::launch::async, [&] { return MakeSolves(end); }));
    for (const Measure measure : {kGet, kList, kValidate}) {
      parts.push_back(std::async(std::launch::async, [this, end, measure] { return Read(measure, end); }));
    }
    Phase all;
    for (std::future<Phase>& future : parts) {
      const Phase part = future.get();
      for (size_t i = 0; i < kMeasures; ++i) all.latencies[i].Add(part.latencies[i]);
      all.refused += part.refused;
      if (all.first_refusal.empty()) all.first_refusal = part.first_refusal;
    }
    return all;
  }

  int64_t made() const { return static_cast<int64_t>(names_.size()); }

  // Solves of its own that are not there with success.
  int64_t CountLost() {
    std::set<std::string> missing = names_;
    const std::unique_ptr<Stub> stub = Connect(address_);
    v1::ListSolvesRequest request;
    request.set_page_size(1000);
    do {
      v1::ListSolvesResponse page;
      const grpc::Status status = stub->ListSolves(CallAs(token_, kDeadline).get(), request, &page);
      if (!status.ok())
        throw std::runtime_error("the good tenant's solves cannot be listed: " + status.error_message());
      for (const v1::Solve& solve : page.solves()) {
        if (solve.state() == v1::SOLVE_STATE_SUCCEEDED) missing.erase(solve.name());
      }
      request.set_page_token(page.next_page_token());
    } while (!request.page_token().empty());
    return static_cast<int64_t>(missing.size());
  }

 private:
  static v1::SolveSpec Spec(int64_t number) {
    v1::SolveSpec spec;
    spec.mutable_model()->set_name("planar");
    spec.set_slope_rad(1e-8 * static_cast<double>(1 + number));
    spec.mutable_solver_limits()->set_max_iterations(2);
    return spec;
  }

  static void Refused(const std::string& call, const grpc::Status& status, Phase* phase) {
    ++phase->refused;
    if (phase->first_refusal.empty()) {
      phase->first_refusal = call + ": " + std::to_string(status.error_code()) + " " + status.error_message();
    }
  }

  // The name; empty: refused.
  std::string MakeAndWatch(Stub& stub, Phase* phase) {
    v1::CreateSolveRequest request;
    *request.mutable_spec() = Spec(number_++);
    v1::Solve solve;
    const Clock::time_point asked = Clock::now();
    const grpc::Status made = stub.CreateSolve(CallAs(token_, kDeadline).get(), request, &solve);
    phase->latencies[kCreate].Add(stalls_.RanSince(asked));
    const Clock::time_point answered = Clock::now();
    if (!made.ok()) return Refused("CreateSolve", made, phase), "";
    names_.insert(solve.name());

    v1::WatchSolveRequest watch;
    watch.set_name(solve.name());
    const auto context = CallAs(token_, kDeadline);
    const Clock::time_point start = Clock::now();
    const auto stream = stub.WatchSolve(context.get(), watch);
    v1::SolveEvent event;
    for (bool first = true; stream->Read(&event); first = false) {
      if (first) phase->latencies[kFirstEvent].Add(stalls_.RanSince(start));
      if (!event.has_finished()) continue;
      const auto waited = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(
          Seconds(event.finished().start_time()) - Seconds(event.finished().create_time())));
      // It was made before the answer, so it did not wait for longer than this after it; what came later is not
      // waiting.
      const Clock::time_point latest_start = std::min(answered + waited, Clock::now());
      phase->latencies[kWaiting].Add(std::max(Clock::duration::zero(), waited - stalls_.Between(asked, latest_start)));
    }
    const grpc::Status watched = stream->Finish();
    if (!watched.ok()) return Refused("WatchSolve", watched, phase), "";
    return solve.name();
  }

  Phase MakeSolves(Clock::time_point end) {
    Phase phase;
    const std::unique_ptr<Stub> stub = Connect(address_);
    while (Clock::now() < end) {
      MakeAndWatch(*stub, &phase);
      std::this_thread::sleep_for(kPeriod);
    }
    return phase;
  }

  // At fixed times, from which latencies count: a stall is paid by every call that falls into it.
  Phase Read(Measure measure, Clock::time_point end) {
    Phase phase;
    const std::unique_ptr<Stub> stub = Connect(address_);
    for (Clock::time_point due = Clock::now(); due < end; due += kPeriod) {
      std::this_thread::sleep_until(due);
      const auto context = CallAs(token_, kDeadline);
      const grpc::Status status = measure == kGet    ? Get(*stub, context.get())
                                  : measure == kList ? List(*stub, context.get())
                                                     : Validate(*stub, context.get());
      phase.latencies[measure].Add(stalls_.RanSince(due));
      if (!status.ok()) Refused(kNames[measure], status, &phase);
    }
    return phase;
  }

  grpc::Status Get(Stub& stub, grpc::ClientContext* context) const {
    v1::GetSolveRequest request;
    request.set_name(last_);
    v1::Solve solve;
    return stub.GetSolve(context, request, &solve);
  }
  static grpc::Status List(Stub& stub, grpc::ClientContext* context) {
    v1::ListSolvesRequest request;
    request.set_page_size(20);
    v1::ListSolvesResponse response;
    return stub.ListSolves(context, request, &response);
  }
  static grpc::Status Validate(Stub& stub, grpc::ClientContext* context) {
    v1::CreateSolveRequest request;
    *request.mutable_spec() = Spec(0);
    request.set_validate_only(true);
    v1::Solve solve;
    return stub.CreateSolve(context, request, &solve);
  }

  const std::string address_, token_;
  const Stalls stalls_;
  int64_t number_ = 0;           // of the thread that makes solves
  std::set<std::string> names_;  // likewise
  std::string last_;
};

// Between two rounds the hostile tenant takes back what waits, so that the next "alone" is alone.
void DrainQueue(const std::string& address, const std::string& token) {
  const std::unique_ptr<Stub> stub = Connect(address);
  v1::ListSolvesRequest request;
  request.set_page_size(1000);
  for (const v1::SolveState state : {v1::SOLVE_STATE_QUEUED, v1::SOLVE_STATE_RUNNING}) {
    request.set_state(state);
    Await("an empty queue", [&] {
      v1::ListSolvesResponse page;
      if (!stub->ListSolves(CallAs(token, kDeadline).get(), request, &page).ok()) return false;
      for (const v1::Solve& solve : page.solves()) {
        v1::CancelSolveRequest cancel;
        cancel.set_name(solve.name());
        v1::Solve cancelled;
        stub->CancelSolve(CallAs(token, kDeadline).get(), cancel, &cancelled);
      }
      return page.solves().empty();
    });
  }
}

struct Options {
  int rounds = 3;
  double seconds = 10;
  double good_ms = 0;
  int most_running = 3;
  std::string only;
};

// Prints a row for each measure. False: one is above its bound.
bool Judge(const std::vector<Phase>& alone, const std::vector<Phase>& attacked, const Options& options) {
  bool good = true;
  std::printf(
      "| call | alone: p50, p99 ms | under attack: p50, p99 ms | ratio of p99 (by round) | calls | "
      "|\n|---|---|---|---|---|---|\n");
  for (size_t i = 0; i < kMeasures; ++i) {
    Latencies before, after;
    std::string by_round;
    for (size_t round = 0; round < alone.size(); ++round) {
      const Latencies &one = alone[round].latencies[i], &other = attacked[round].latencies[i];
      before.Add(one);
      after.Add(other);
      char text[32];
      std::snprintf(text, sizeof text, "%s%.1f", round == 0 ? "" : ", ", other.PercentileMs(99) / one.PercentileMs(99));
      by_round += text;
    }
    const double bound = std::max(options.good_ms, kMostRatio * before.PercentileMs(99));
    const bool met = before.count() > 0 && after.count() > 0 && after.PercentileMs(99) <= bound;
    good = good && met;
    std::printf("| %s | %.1f, %.1f | %.1f, %.1f | %.2f (%s) | %ld, %ld | %s |\n", kNames[i], before.PercentileMs(50),
                before.PercentileMs(99), after.PercentileMs(50), after.PercentileMs(99),
                after.PercentileMs(99) / before.PercentileMs(99), by_round.c_str(), static_cast<long>(before.count()),
                static_cast<long>(after.count()), met ? "met" : "NOT MET");
  }
  return good;
}

int Run(const Options& options) {
  server::TemporaryDirectory directory;
  server::Daemon::Options daemon;
  daemon.data_dir = directory.path() + "/data";
  daemon.flags = {"--require-token"};
  FaultyServer server(daemon);
  const std::string of_store = " --data-dir " + daemon.data_dir;
  const auto token = [&](const std::string& tenant) {
    server::OutputOfRollgaitd("tenant set " + tenant + of_store + " --max-running " +
                              std::to_string(options.most_running));
    return server::OutputOfRollgaitd("token create" + of_store + " --tenant " + tenant + " --scopes read,solve");
  };
  GoodTenant good(server.address(), token("good"));
  const std::string hostile_token = token("hostile"), token_file = directory.path() + "/token";
  std::ofstream(token_file) << hostile_token;
  const GoodTenant first(server.address(), hostile_token);  // makes a solve for answers that are not read
  HostileProcess hostile(server.address(), token_file, first.solve(), options.only);

  good.Run(1);  // connections, caches
  std::vector<Phase> alone, attacked;
  for (int round = 0; round < options.rounds; ++round) {
    alone.push_back(good.Run(options.seconds));
    std::future<void> attack = std::async(std::launch::async, [&] { hostile.Attack(options.seconds + 1); });
    std::this_thread::sleep_for(std::chrono::seconds(1));
    attacked.push_back(good.Run(options.seconds));
    attack.get();
    DrainQueue(server.address(), hostile_token);
  }
  bool met = Judge(alone, attacked, options);
  int64_t refused = 0;
  for (const auto* phases : {&alone, &attacked}) {
    for (const Phase& phase : *phases) {
      if (refused == 0 && phase.refused > 0) std::printf("\nfirst refusal: %s\n", phase.first_refusal.c_str());
      refused += phase.refused;
    }
  }
  const int64_t lost = good.CountLost();
  std::printf("\ngood tenant: %ld solves, %ld lost, %ld calls refused\nhostile tenant, served + refused:",
              static_cast<long>(good.made()), static_cast<long>(lost), static_cast<long>(refused));
  met = met && !hostile.tallies().empty();
  for (const auto& [name, tally] : hostile.tallies()) {
    std::printf(" %s %ld + %ld;", name.c_str(), static_cast<long>(tally.served), static_cast<long>(tally.refused));
    met = met && tally.served > 0;
  }
  std::printf("\n%s\n", met && lost == 0 && refused == 0 ? "met" : "NOT MET");
  return met && lost == 0 && refused == 0 ? 0 : 1;
}

int Main(int argc, char** argv) {
  CLI::App app("Two tenants, one hostile.", "rollgait_two_tenants");
  Options options;
  app.add_option("--rounds", options.rounds, "Alone, then under attack")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  app.add_option("--seconds", options.seconds, "Of each")->check(CLI::Range(1.0, 600.0))->capture_default_str();
  app.add_option("--good-ms", options.good_ms, "A p99 up to this is good whatever it is alone")
      ->check(CLI::Range(0.0, 1e4))
      ->capture_default_str();
  app.add_option("--max-running", options.most_running, "Solves of a tenant that run at once, of 4")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  app.add_option("--only", options.only, "One attack alone, by its name in the last lines");
  CLI11_PARSE(app, argc, argv);
  try {
    return Run(options);
  } catch (const std::exception& exception) {
    std::printf("failed: %s\n", exception.what());
    return 1;
  }
}

}  // namespace
}  // namespace rollgait::faults

int main(int argc, char** argv) { return rollgait::faults::Main(argc, argv); }
