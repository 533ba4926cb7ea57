// rollgait simulate and rollgait poincare against a fake server: what goes to which stream, and the exit codes.
#include <gmock/gmock.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/client/client_process.h"
#include "tests/client/fake_gait_service.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Answers by the scene's name: "early" ends early, "refused" is INVALID_ARGUMENT, "late" DEADLINE_EXCEEDED, "endless"
// waits for the client to go, "adrift" finds no gait; anything else is well.
class FakeSimulator : public FakeGaitService {
 public:
  grpc::Status Simulate(grpc::ServerContext* context, const v1::SimulateRequest* request,
                        grpc::ServerWriter<v1::SimulationMessage>* writer) override {
    const std::string& name = request->scene().name();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      last_ = *request;
    }
    if (name == "refused") return {grpc::StatusCode::INVALID_ARGUMENT, "the scene cannot be simulated"};
    if (name == "late") return {grpc::StatusCode::DEADLINE_EXCEEDED, "the run took longer than max_wall_time_s"};
    if (request->validate_only()) return grpc::Status::OK;
    v1::SimulationMessage message;
    for (int i = 0; i < 3; ++i) {
      v1::SimulationSample* sample = message.mutable_samples()->add_samples();
      sample->set_time_s(0.1 * i);
      for (const double value : {1.0, 0.0, 0.0, 0.0, 0.1 / 3, 2.0, 3.0}) sample->add_positions(value);
      for (int v = 0; v < 6; ++v) sample->add_velocities(v);
      sample->add_contacts()->set_active(true);
    }
    writer->Write(message);
    message.mutable_event()->set_kind(v1::SimulationEvent::KIND_LIFT_OFF);
    message.mutable_event()->set_contact("foot");
    message.mutable_event()->set_time_s(0.15);
    writer->Write(message);
    while (name == "endless" && !context->IsCancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    message.mutable_report()->set_end(name == "early" ? v1::SimulationReport::END_STEP_TOO_SMALL
                                                      : v1::SimulationReport::END_DURATION);
    message.mutable_report()->set_end_time_s(0.2);
    writer->Write(message);
    return grpc::Status::OK;
  }

  grpc::Status FindPeriodicGait(grpc::ServerContext*, const v1::FindPeriodicGaitRequest* request,
                                grpc::ServerWriter<v1::SimulationMessage>* writer) override {
    v1::SimulationMessage message;
    message.mutable_gait_iteration()->set_residual(1e-3);
    writer->Write(message);
    v1::PeriodicGait* gait = message.mutable_gait();
    gait->set_converged(request->scene().name() != "adrift");
    gait->set_stable(true);
    gait->set_period_s(0.8035280510832882);
    gait->add_positions(0.125), gait->add_velocities(-0.5);
    gait->add_eigenvalues()->set_re(0.25), gait->mutable_eigenvalues(0)->set_im(-0.5);
    writer->Write(message);
    return grpc::Status::OK;
  }

  v1::SimulateRequest last() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return last_;
  }

 private:
  mutable std::mutex mutex_;
  v1::SimulateRequest last_;
};

class SimulateCommandTest : public testing::Test {
 protected:
  std::string Scene(const std::string& name) const {
    const std::string path = testing::TempDir() + "rollgait_simulate_test_" + name + ".json";
    std::ofstream(path) << "{\"name\": \"" << name
                        << "\", \"joints\": [{\"name\": \"ball\", \"type\": \"TYPE_FREE\"}], "
                        << "\"contacts\": [{\"name\": \"foot\"}], \"duration_s\": 0.2}";
    return path;
  }
  Ended Run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"--server", server_.address()});
    return RunToEnd(arguments);
  }

  FakeSimulator service_;
  FakeServer server_{service_};
};

TEST_F(SimulateCommandTest, SamplesGoToStandardOutputTheRestToStandardError) {
  const Ended ended = Run({"simulate", "--scene", Scene("good"), "--tolerance", "1e-7", "--output-step", "0.1"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, StartsWith("time_s,ball.qw,ball.qx,ball.qy,ball.qz,ball.x,ball.y,ball.z,ball.wx"));
  std::istringstream lines(ended.out);
  std::string header, line;
  std::getline(lines, header);
  int rows = 0;
  while (std::getline(lines, line)) {
    ++rows;
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(header.begin(), header.end(), ','));
  }
  EXPECT_EQ(rows, 3);
  // All digits: what is read back is the number that was sent.
  EXPECT_THAT(ended.out, HasSubstr("0.033333333333333333"));
  EXPECT_THAT(ended.err, HasSubstr("0.15 s  foot lifts off"));
  EXPECT_THAT(ended.err, HasSubstr("reached the end"));
  EXPECT_EQ(service_.last().scene().tolerance(), 1e-7);
  EXPECT_EQ(service_.last().scene().output_step_s(), 0.1);
}

TEST_F(SimulateCommandTest, JsonIsAMessageALine) {
  const Ended ended = Run({"--json", "-q", "simulate", "--scene", Scene("good")});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err, "");
  std::istringstream lines(ended.out);
  std::vector<v1::SimulationMessage> messages;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(line, &messages.emplace_back()).ok()) << line;
  }
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_TRUE(messages[0].has_samples());
  EXPECT_TRUE(messages[1].has_event());
  EXPECT_TRUE(messages[2].has_report());
}

TEST_F(SimulateCommandTest, OutputIsADocumentBesideTheData) {
  const std::string path = testing::TempDir() + "rollgait_simulate_test.json";
  std::filesystem::remove(path);
  const Ended ended = Run({"simulate", "--scene", Scene("good"), "--output", path});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, StartsWith("time_s,"));
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  v1::Simulation whole;
  const auto status = google::protobuf::util::JsonStringToMessage(text.str(), &whole);
  ASSERT_TRUE(status.ok()) << status.ToString();
  EXPECT_EQ(whole.scene().name(), "good");
  ASSERT_EQ(whole.samples_size(), 3);
  EXPECT_EQ(whole.samples(2).positions(4), 0.1 / 3);
  ASSERT_EQ(whole.events_size(), 1);
  EXPECT_EQ(whole.events(0).contact(), "foot");
  EXPECT_EQ(whole.report().end_time_s(), 0.2);
}

TEST_F(SimulateCommandTest, TheDocumentMayTakeThePlaceOfTheData) {
  const Ended ended = Run({"simulate", "--scene", Scene("good"), "-o", "-"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  v1::Simulation whole;
  const auto status = google::protobuf::util::JsonStringToMessage(ended.out, &whole);
  ASSERT_TRUE(status.ok()) << status.ToString();
  EXPECT_EQ(whole.samples_size(), 3);
  EXPECT_EQ(whole.report().end_time_s(), 0.2);
  const Ended refused = Run({"simulate", "--scene", Scene("refused"), "-o", "-"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.out, "");
  EXPECT_EQ(Run({"simulate", "--json", "--scene", Scene("good"), "-o", "-"}).code, 2);
}

TEST_F(SimulateCommandTest, NoDocumentWithoutAWholeRun) {
  const std::string path = testing::TempDir() + "rollgait_simulate_none.json";
  std::filesystem::remove(path);
  EXPECT_EQ(Run({"simulate", "--scene", Scene("refused"), "--output", path}).code, 2);
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_EQ(Run({"simulate", "--scene", Scene("good"), "--output", "/nowhere/x.json"}).code, 2);
  const Ended table = Run({"simulate", "--scene", Scene("good"), "--output", "x.csv"});
  EXPECT_EQ(table.code, 2);
  EXPECT_THAT(table.err, HasSubstr("must end in .json"));
}

TEST_F(SimulateCommandTest, AdviceIsThatOfScenes) {
  const Ended refused = Run({"simulate", "--scene", Scene("refused")});
  EXPECT_THAT(refused.err, HasSubstr("SimulationScene"));
  EXPECT_THAT(refused.err, testing::Not(HasSubstr("rollgait solve")));
  const Ended late = Run({"simulate", "--scene", Scene("late")});
  EXPECT_EQ(late.code, 3);
  EXPECT_THAT(late.err, HasSubstr("--max-wall-time"));
}

TEST_F(SimulateCommandTest, ExitCodesTellWhatHappened) {
  EXPECT_EQ(Run({"simulate", "--scene", Scene("early")}).code, 4);
  EXPECT_EQ(Run({"simulate", "--scene", Scene("refused")}).code, 2);
  EXPECT_EQ(Run({"simulate", "--scene", "/nowhere/scene.json"}).code, 2);
  EXPECT_EQ(Run({"simulate"}).code, 2);
  const Ended valid = Run({"simulate", "--scene", Scene("good"), "--validate-only"});
  EXPECT_EQ(valid.code, 0);
  EXPECT_THAT(valid.out, HasSubstr("valid"));
}

TEST_F(SimulateCommandTest, CtrlCEndsTheRun) {
  ClientProcess client({"--server", server_.address(), "simulate", "--scene", Scene("endless")});
  ASSERT_TRUE(client.WaitForError("lifts off"));
  client.Signal(SIGINT);
  EXPECT_EQ(client.Wait(), 6);
}

TEST_F(SimulateCommandTest, PoincarePrintsTheFixedPointAndTheEigenvalues) {
  const Ended ended = Run({"poincare", "--scene", Scene("walker")});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("0.8035280510832882  s"));
  EXPECT_THAT(ended.out, HasSubstr("0.25 - 0.5 i"));
  EXPECT_THAT(ended.out, HasSubstr("stable"));
  EXPECT_THAT(ended.err, HasSubstr("iteration 0  residual 0.001"));
  EXPECT_EQ(Run({"poincare", "--scene", Scene("adrift")}).code, 4);
}

}  // namespace
}  // namespace rollgait::client
