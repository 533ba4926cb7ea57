// A solve outlives its solver, its agent and its server: the next attempt goes on where the last one was, in the same
// numbered log and to the same answer. The real solver.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/e2e/daemon.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

using Place = std::pair<int, int>;  // mesh and index of an iteration

v1::SolveSpec Request(v1::Accuracy::Level level) {
  v1::SolveSpec spec;
  spec.mutable_model()->set_name("human29");
  spec.mutable_accuracy()->set_level(level);
  return spec;
}

// A server that can be ended and started again on its directory, and the one solve that it has.
class Outlived {
 public:
  explicit Outlived(const v1::SolveSpec& spec) {
    options_.data_dir = directory_.path() + "/data";
    options_.log_file = directory_.path() + "/log";
    Start();
    v1::CreateSolveRequest request;
    *request.mutable_spec() = spec;
    grpc::ClientContext context;
    v1::Solve solve;
    const grpc::Status status = daemon_->NewStub()->CreateSolve(&context, request, &solve);
    EXPECT_TRUE(status.ok()) << status.error_message();
    name_ = solve.name();
  }

  Daemon& daemon() { return *daemon_; }
  const std::string& data_dir() const { return options_.data_dir; }
  void Start() {
    if (daemon_) past_.push_back(std::move(daemon_));
    daemon_ = std::make_unique<Daemon>(options_);
    ASSERT_NE(daemon_->address(), "");
  }
  // Reads on in the log of the solve, over all servers: until it has ended, or so many iterations are known.
  void ReadUntil(size_t iterations) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::minutes(10));
    v1::WatchSolveRequest request;
    request.set_name(name_);
    request.set_after_sequence(sequence_);
    const auto stream = daemon_->NewStub()->WatchSolve(&context, request);
    v1::SolveEvent event;
    while (places_.size() < iterations && stream->Read(&event)) {
      if (event.has_heartbeat()) continue;
      EXPECT_EQ(event.sequence(), sequence_ + 1 + event.skipped_count());
      EXPECT_EQ(event.skipped_count(), 0);
      sequence_ = event.sequence();
      if (event.has_iteration()) places_.emplace_back(event.iteration().mesh(), event.iteration().index());
      const bool is_queued = event.has_state_change() && event.state_change().state() == v1::SOLVE_STATE_QUEUED;
      if (is_queued && !places_.empty() && (before_.empty() || before_.back() != places_.back())) {
        before_.push_back(places_.back());
      }
      if (event.has_finished()) {
        solve_ = event.finished();
        return;
      }
    }
    context.TryCancel();
  }
  std::vector<pid_t> Solvers() const {
    std::vector<pid_t> solvers;
    for (const pid_t agent : AgentsOf(data_dir())) {
      for (const pid_t child : ChildrenOf(agent)) solvers.push_back(child);
    }
    return solvers;
  }
  std::string Log() const {
    std::ifstream file(options_.log_file);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  // Lines of the log with this event.
  std::vector<nlohmann::json> Logged(const std::string& event) const {
    std::vector<nlohmann::json> lines;
    std::ifstream file(options_.log_file);
    for (std::string line; std::getline(file, line);) {
      nlohmann::json parsed = nlohmann::json::parse(line, nullptr, false);
      if (parsed.is_object() && parsed.value("event", "") == event) lines.push_back(std::move(parsed));
    }
    return lines;
  }

  const std::vector<Place>& places() const { return places_; }
  // The last iteration of each run that came to one and returned to the queue.
  const std::vector<Place>& before() const { return before_; }
  const v1::Solve& solve() const { return solve_; }

 private:
  TemporaryDirectory directory_;
  Daemon::Options options_;
  std::vector<std::unique_ptr<Daemon>> past_;  // their end would kill agents that go on
  std::unique_ptr<Daemon> daemon_;
  std::string name_;
  int64_t sequence_ = 0;
  std::vector<Place> places_, before_;
  v1::Solve solve_;
};

struct Fault {
  const char* name;
  std::function<void(Outlived&)> happen;
  int runs = 2;  // in the end, that came to an iteration
};

Fault AllThree() {
  return {"kill -9 of all three", [](Outlived& outlived) {
            outlived.daemon().Kill();
            KillAgents(outlived.data_dir());
            outlived.Start();
          }};
}

std::vector<Fault> Faults() {
  const auto kill_solver = [](Outlived& outlived) {
    const std::vector<nlohmann::json> claims = outlived.Logged("solve.claimed");
    ASSERT_EQ(claims.size(), 1u);
    kill(claims[0].at("pid").get<pid_t>(), SIGKILL);
  };
  const auto kill_solvers = [](Outlived& outlived) {
    for (const pid_t solver : outlived.Solvers()) kill(solver, SIGKILL);
  };
  const auto kill_agents = [](Outlived& outlived) {
    for (const pid_t agent : AgentsOf(outlived.data_dir())) kill(agent, SIGKILL);
  };
  return {
      {"kill -9 of the solver", kill_solver},
      {"kill -9 of those that wait, too", kill_solvers},
      {"kill -9 of the agent", kill_agents},
      {"kill -9 of rollgaitd",
       [](Outlived& outlived) {
         outlived.daemon().Kill();
         outlived.Start();
       },
       1},
      AllThree(),
      {"SIGTERM of rollgaitd",
       [](Outlived& outlived) {
         EXPECT_EQ(outlived.daemon().Terminate(), 0);
         outlived.Start();
       }},
  };
}

// Iterations that are solved twice: those after the one from which the attempt goes on, up to the last before it.
int Extra(const Place& before, const nlohmann::json& goes_on) {
  const Place from(goes_on.value("programs", -1), goes_on.value("iteration", -1));
  return from.first == before.first ? std::max(0, before.second - from.second) : 0;
}

// Prints a row for each fault.
void ExpectToOutlive(const v1::SolveSpec& spec, const std::vector<Fault>& faults) {
  Outlived whole(spec);
  const auto start = std::chrono::steady_clock::now();
  whole.ReadUntil(SIZE_MAX);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const v1::SolveResult& expected = whole.solve().result();
  ASSERT_EQ(expected.termination(), v1::TERMINATION_OPTIMAL) << expected.message();
  const size_t count = whole.places().size();
  ASSERT_GT(count, 20u);
  std::printf("undisturbed: %zu iterations, %d programs, %.1f s\n", count, expected.meshes_size(), seconds);
  for (const Fault& fault : faults) {
    SCOPED_TRACE(fault.name);
    Outlived outlived(spec);
    outlived.ReadUntil(2 * count / 3);
    ASSERT_FALSE(outlived.Solvers().empty()) << "the solve was over before the fault";
    fault.happen(outlived);
    outlived.ReadUntil(SIZE_MAX);
    ASSERT_EQ(outlived.solve().state(), v1::SOLVE_STATE_SUCCEEDED) << outlived.solve().error().message();
    const v1::SolveResult& result = outlived.solve().result();
    const std::vector<nlohmann::json> goes_on = outlived.Logged("solve.goes_on");
    ASSERT_EQ(static_cast<int>(goes_on.size()), fault.runs - 1) << outlived.Log();
    ASSERT_EQ(static_cast<int>(outlived.before().size()), fault.runs - 1);
    int extra = 0;
    for (size_t i = 0; i < goes_on.size(); ++i) {
      EXPECT_EQ(goes_on[i].value("ignored", "?"), "");
      extra += Extra(outlived.before()[i], goes_on[i]);
    }
    EXPECT_LE(extra, 3);
    EXPECT_EQ(outlived.places(), whole.places()) << "every iteration once";
    EXPECT_NEAR(result.objective(), expected.objective(), 1e-9 * std::abs(expected.objective()));
    std::printf("%-31s  %d attempts  %d iterations twice  objective differs by %.1e\n", fault.name,
                outlived.solve().attempts(), extra, std::abs(result.objective() / expected.objective() - 1));
  }
}

TEST(OutlivingTest, ASolveOfOneProgramGoesOnAfterEveryFault) {
  ExpectToOutlive(Request(v1::Accuracy::LEVEL_DRAFT), Faults());
}

TEST(OutlivingTest, ASolveGoesOnInALaterProgram) {
  ExpectToOutlive(Request(v1::Accuracy::LEVEL_STANDARD), {AllThree()});
}

// For the table of docs/explanation/life_of_a_request.md: takes minutes.
TEST(OutlivingTest, DISABLED_ALongSolveGoesOnAfterEveryFault) {
  v1::SolveSpec spec = Request(v1::Accuracy::LEVEL_FINE);
  spec.mutable_accuracy()->set_estimate_errors(true);
  ExpectToOutlive(spec, Faults());
}

// What is damaged in the spool costs time, and nothing else.
TEST(OutlivingTest, ADamagedJournalIsLeft) {
  const v1::SolveSpec spec = Request(v1::Accuracy::LEVEL_DRAFT);
  Outlived outlived(spec);
  outlived.ReadUntil(25);
  outlived.daemon().Kill();
  KillAgents(outlived.data_dir());
  int damaged = 0;
  for (const auto& entry : std::filesystem::directory_iterator(outlived.data_dir() + "/spool")) {
    if (entry.path().extension() != ".journal") continue;
    std::filesystem::resize_file(entry.path(), std::filesystem::file_size(entry.path()) / 2);
    ++damaged;
  }
  ASSERT_EQ(damaged, 1);
  outlived.Start();
  outlived.ReadUntil(SIZE_MAX);
  EXPECT_EQ(outlived.solve().result().termination(), v1::TERMINATION_OPTIMAL);
  EXPECT_EQ(outlived.Logged("solve.journal_damaged").size(), 1u);
  EXPECT_TRUE(outlived.Logged("solve.goes_on").empty());
  EXPECT_TRUE(std::filesystem::is_empty(outlived.data_dir() + "/spool"));
}

}  // namespace
}  // namespace rollgait::server
