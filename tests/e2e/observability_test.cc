// What can be seen of running programs from outside: metrics, the files that name them, and logs.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include "tests/e2e/daemon.h"
#include "tests/server/store/temporary_directory.h"
#include "tests/support/scrape.h"

namespace rollgait::server {
namespace {

std::string ReadFile(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

// A server with its agent, both with metrics, that has answered one solve.
class ObservabilityTest : public testing::Test {
 protected:
  ObservabilityTest()
      : log_(directory_.path() + "/log"),
        daemon_({directory_.path() + "/data",
                 "127.0.0.1:0",
                 SLOW_SOLVER,
                 {"--metrics-listen", "127.0.0.1:0", "--agent-metrics-listen", "127.0.0.1:0", "--log-format", "json"},
                 {},
                 log_}) {}

  void SetUp() override {
    ASSERT_NE(daemon_.address(), "");
    const auto stub = daemon_.NewStub();
    grpc::ClientContext context;
    context.AddMetadata("traceparent", "00-" + trace_ + "-00f067aa0ba902b7-01");
    v1::RunSolveRequest request;
    request.mutable_spec()->mutable_model()->set_name("planar");
    request.mutable_spec()->mutable_solver_limits()->set_max_iterations(3);
    const auto reader = stub->RunSolve(&context, request);
    v1::SolveEvent event;
    while (reader->Read(&event)) {
    }
    ASSERT_TRUE(reader->Finish().ok());
    id_ = event.name().substr(sizeof("solves/") - 1);
  }

  // The log so far; every line of it must be a JSON object.
  std::vector<nlohmann::json> Log() const {
    std::vector<nlohmann::json> lines;
    std::istringstream text(ReadFile(log_));
    for (std::string line; std::getline(text, line);) {
      lines.push_back(nlohmann::json::parse(line, nullptr, false));
      EXPECT_TRUE(lines.back().is_object()) << line;
    }
    return lines;
  }
  // The first line of a program's event, waited for: the log is written beside the answer.
  nlohmann::json Line(const std::string& program, const std::string& event) const {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    do {
      for (const nlohmann::json& line : Log()) {
        if (line.is_object() && line.value("program", "") == program && line.value("event", "") == event) return line;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    } while (std::chrono::steady_clock::now() < limit);
    ADD_FAILURE() << "no line " << event << " of " << program << " in " << ReadFile(log_);
    return nlohmann::json::object();
  }
  std::string MetricsOf(const std::string& program) const {
    return Scrape(Line(program, "metrics.served").value("address", "127.0.0.1:0"));
  }

  const std::string trace_ = "4bf92f3577b34da6a3ce929d0e0e4736";
  TemporaryDirectory directory_;
  const std::string log_;
  Daemon daemon_;
  std::string id_;
};

// Names of metrics in an expression or a file.
std::set<std::string> MetricsIn(const std::string& text) {
  const std::regex name("\\b(rollgait|grpc_server|process)_[a-z_]+");
  return {std::sregex_token_iterator(text.begin(), text.end(), name), {}};
}

TEST_F(ObservabilityTest, EveryMetricThatAFileNamesIsServed) {
  Line("rollgait-agent", "solve.ended");
  std::set<std::string> served;
  for (const char* program : {"rollgaitd", "rollgait-agent"}) {
    const std::map<std::string, double> samples = ParseExposition(MetricsOf(program));
    EXPECT_FALSE(samples.empty()) << program;
    for (const auto& [sample, value] : samples) served.insert(sample.substr(0, sample.find_first_of("{ ")));
  }
  std::set<std::string> named = MetricsIn(ReadFile(ROLLGAIT_DOCKER "/observability/alerts.yml"));
  const nlohmann::json dashboard = nlohmann::json::parse(ReadFile(ROLLGAIT_DOCKER "/observability/dashboard.json"));
  for (const nlohmann::json& panel : dashboard["panels"]) {
    for (const nlohmann::json& target : panel["targets"]) named.merge(MetricsIn(target["expr"].get<std::string>()));
  }
  EXPECT_GT(named.size(), 20u);
  for (const std::string& name : named) EXPECT_TRUE(served.contains(name)) << name << " is served by neither program";
}

TEST_F(ObservabilityTest, TheNumbersAreThoseOfTheSolve) {
  Line("rollgait-agent", "solve.ended");
  const std::map<std::string, double> agent = ParseExposition(MetricsOf("rollgait-agent"));
  EXPECT_EQ(agent.at("rollgait_solves_total{model=\"planar\",state=\"succeeded\",termination=\"optimal\"}"), 1);
  EXPECT_EQ(agent.at("rollgait_solve_seconds_count{model=\"planar\",termination=\"optimal\"}"), 1);
  EXPECT_EQ(agent.at("rollgait_leases"), 0);
  const std::map<std::string, double> server = ParseExposition(MetricsOf("rollgaitd"));
  EXPECT_EQ(server.at("rollgait_solves_created_total{source=\"queue\"}"), 1);
  EXPECT_EQ(server.at("rollgait_queue_depth"), 0);
  EXPECT_EQ(server.at("rollgait_store_up"), 1);
  EXPECT_GE(server.at("rollgait_store_seconds_count{op=\"create\"}"), 1);
}

TEST_F(ObservabilityTest, OneTraceLeadsThroughThePrograms) {
  const nlohmann::json call = Line("rollgaitd", "call.finished");
  EXPECT_EQ(call.value("method", ""), "/rollgait.v1.GaitService/RunSolve");
  EXPECT_EQ(call.value("code", ""), "OK");
  EXPECT_EQ(call.value("traceparent", "").substr(3, 32), trace_);
  for (const char* event : {"solve.claimed", "solve.ended"}) {
    const nlohmann::json run = Line("rollgait-agent", event);
    EXPECT_EQ(run.value("solve", ""), id_) << event;
    EXPECT_EQ(run.value("traceparent", "").substr(3, 32), trace_) << event;
  }
}

}  // namespace
}  // namespace rollgait::server
