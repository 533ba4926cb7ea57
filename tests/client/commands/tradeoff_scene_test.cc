// `rollgait tradeoff --scene` as a user sees it: the program as a process, a fake server behind a port.
#include <gmock/gmock.h>
#include <google/rpc/error_details.pb.h>
#include <google/rpc/status.pb.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "tests/client/client_process.h"
#include "tests/client/fake_gait_service.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;

// A slider that is off by its tolerance; a finer tolerance takes longer. The call with the number `fails_at` is
// refused.
class FakeTolerances : public FakeGaitService {
 public:
  grpc::Status Simulate(grpc::ServerContext*, const v1::SimulateRequest* request,
                        grpc::ServerWriter<v1::SimulationMessage>* writer) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    tolerances_.push_back(request->scene().tolerance());
    const int calls = static_cast<int>(tolerances_.size());
    if (calls == full_at_) {
      google::rpc::Status details;
      details.set_code(grpc::StatusCode::RESOURCE_EXHAUSTED);
      google::rpc::RetryInfo retry;
      retry.mutable_retry_delay()->set_nanos(1'000'000);
      details.add_details()->PackFrom(retry);
      return {grpc::StatusCode::RESOURCE_EXHAUSTED, "no place", details.SerializeAsString()};
    }
    if (calls == fails_at_) return {grpc::StatusCode::UNAVAILABLE, "gone"};
    v1::SimulationMessage message;
    v1::SimulationSample& sample = *message.mutable_samples()->add_samples();
    sample.set_time_s(request->scene().duration_s());
    sample.add_positions(1 + tolerances_.back());
    sample.add_velocities(0);
    writer->Write(message);
    v1::SimulationReport& report = *message.mutable_report();
    const bool early = request->scene().name() == "early" && tolerances_.back() < 1e-7;
    report.set_end(early ? v1::SimulationReport::END_STEP_TOO_SMALL : v1::SimulationReport::END_DURATION);
    if (request->scene().name() != "old" && calls != stands_at_)
      report.set_cpu_time_s(1e-5 / tolerances_.back() + 1.0 / calls);
    writer->Write(message);
    return grpc::Status::OK;
  }
  std::vector<double> tolerances() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return tolerances_;
  }
  void FailAt(int call) { fails_at_ = call; }
  void StandStillAt(int call) { stands_at_ = call; }
  void BeFullAt(int call) { full_at_ = call; }

 private:
  mutable std::mutex mutex_;
  std::vector<double> tolerances_;
  std::atomic<int> fails_at_{0}, full_at_{0}, stands_at_{0};
};

class SceneTradeoffCommandTest : public testing::Test {
 protected:
  std::string Scene(const std::string& name) const {
    const std::string path = testing::TempDir() + "tradeoff_scene_" + name + ".json";
    std::ofstream(path) << "{\"name\": \"" << name
                        << "\", \"joints\": [{\"name\": \"x\", \"type\": \"TYPE_PRISMATIC\"}], \"duration_s\": 1}";
    return path;
  }
  std::string Folder() const {
    const std::string folder = testing::TempDir() + "tradeoff_scene_folder";
    std::filesystem::remove_all(folder);
    return folder;
  }
  Ended Run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"--server", server_.address(), "tradeoff"});
    return RunToEnd(arguments);
  }
  FakeTolerances service_;
  FakeServer server_{service_};
};

TEST_F(SceneTradeoffCommandTest, AReferenceThenThePointsAndTheMedianTimeOfTheRepeats) {
  const Ended ended = Run({"--scene", Scene("good"), "--tolerance", "1e-3,1e-5", "--repeats", "2", "--json"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const auto tolerances = service_.tolerances();
  ASSERT_EQ(tolerances.size(), 2u + 2 * 2);
  EXPECT_NEAR(tolerances[0], 1e-6, 1e-15);
  EXPECT_NEAR(tolerances[1], 3.1623e-6, 1e-9);
  const nlohmann::json data = nlohmann::json::parse(ended.out);
  EXPECT_THAT(std::string(data.at("reference")), HasSubstr("1e-06"));
  ASSERT_EQ(data.at("points").size(), 2u) << "the reference is no point";
  const nlohmann::json& fast = data.at("points").at(0);
  EXPECT_NEAR(fast.at("position_error_m"), 1e-3 - 1e-6, 1e-12);
  EXPECT_NEAR(fast.at("cpu_time_s"), 0.01 + 0.25, 1e-9) << "of runs 3 and 4";
  EXPECT_EQ(fast.at("on_front"), true);
  EXPECT_EQ(data.at("points").at(1).at("on_front"), true);
}

TEST_F(SceneTradeoffCommandTest, WhatBreaksOffGoesOnBehindThePointsThatAreKept) {
  const std::string folder = Folder();
  const std::vector<std::string> line = {"--scene",   Scene("good"), "--tolerance", "1e-3,1e-4,1e-5",
                                         "--repeats", "1",           "--output",    folder};
  service_.FailAt(5);
  EXPECT_EQ(Run(line).code, 3);
  EXPECT_EQ(service_.tolerances().size(), 5u);
  service_.FailAt(0);
  const Ended rest = Run(line);
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_THAT(rest.err, HasSubstr("2 of 3 points are in"));
  EXPECT_EQ(service_.tolerances().size(), 5u + 2 + 1) << "the references and the last point";
  EXPECT_TRUE(std::filesystem::exists(folder + "/tradeoff.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder + "/tradeoff.html"));
  const Ended again = Run(line);
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(again.out, rest.out);
  EXPECT_EQ(service_.tolerances().size(), 8u) << "nothing is left to run";
  std::vector<std::string> other = line;
  other[3] = "1e-2";
  EXPECT_EQ(Run(other).code, 0);
  EXPECT_EQ(service_.tolerances().size(), 8u + 2 + 1) << "another command begins anew";
  std::ofstream(folder + "/tradeoff.json") << "[";
  EXPECT_EQ(Run(line).code, 2) << "no file is overwritten that is of something else";
}

TEST_F(SceneTradeoffCommandTest, ItWaitsForAPlace) {
  service_.BeFullAt(2);
  const Ended ended = Run({"--scene", Scene("good"), "--tolerance", "1e-3", "--repeats", "1"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(service_.tolerances().size(), 4u);
}

TEST_F(SceneTradeoffCommandTest, ARunDuringWhichTheClockStoodStillDoesNotCount) {
  service_.StandStillAt(4);
  const Ended ended = Run({"--scene", Scene("good"), "--tolerance", "1e-3", "--repeats", "3", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(service_.tolerances().size(), 2u + 4);
  const nlohmann::json data = nlohmann::json::parse(ended.out);
  EXPECT_NEAR(data.at("points").at(0).at("cpu_time_s"), 0.01 + 1.0 / 5, 1e-9) << "the median of runs 3, 5 and 6";
}

TEST_F(SceneTradeoffCommandTest, WithoutAReferenceThereIsNoSolution) {
  const Ended ended = Run({"--scene", Scene("early"), "--tolerance", "1e-3,1e-7"});
  EXPECT_EQ(ended.code, 4);
  EXPECT_THAT(ended.err, HasSubstr("the reference with tolerance 1e-08"));
  EXPECT_EQ(service_.tolerances().size(), 1u);
  const Ended old = Run({"--scene", Scene("old")});
  EXPECT_EQ(old.code, 2);
  EXPECT_THAT(old.err, HasSubstr("no cpu_time_s"));
}

TEST_F(SceneTradeoffCommandTest, WhatContradictsIsRefusedByName) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--scene", Scene("good"), "--scheme", "radau2"}, "--scheme does not go with --scene"},
      {{"--scene", Scene("good"), "--model", "planar"}, "--model does not go with --scene"},
      {{"--scene", Scene("good"), "--errors"}, "--errors does not go with --scene"},
      {{"--model", "planar", "--drift", "none"}, "--drift takes --scene"},
      {{"--scene", Scene("good"), "--drift", "weld"}, "must be one of baumgarte, none, projection"},
      {{"--scene", Scene("good"), "--repeats", "0"}, "--repeats"}};
  for (const auto& [line, why] : wrong) {
    const Ended ended = Run(line);
    EXPECT_EQ(ended.code, 2) << why;
    EXPECT_THAT(ended.err, HasSubstr(why));
  }
  EXPECT_TRUE(service_.tolerances().empty());
}

}  // namespace
}  // namespace rollgait::client
