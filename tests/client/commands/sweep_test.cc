// `rollgait sweep` as a user sees it: the program as a process, a fake server behind a port.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/client/client_process.h"
#include "tests/client/fake_gait_service.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;

class SweepCommandTest : public testing::Test {
 protected:
  std::vector<std::string> Line(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"--server", server_.address(), "sweep"});
    return arguments;
  }
  Ended Run(const std::vector<std::string>& arguments) const { return RunToEnd(Line(arguments)); }

  FakeGaitService service_;
  FakeServer server_{service_};
};

TEST_F(SweepCommandTest, MakesAGridWithOneLabelWritesFilesAndATable) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "sweep_test" / "hills";
  std::filesystem::remove_all(folder);
  const Ended ended = Run(
      {"--model", "planar", "--slope", "-5:5:5", "--speed", "1.2", "--output", folder.string(), "--priority", "-4"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const std::vector<v1::CreateSolveRequest> created = service_.created();
  ASSERT_EQ(created.size(), 3u);
  std::set<std::string> labels, ids;
  for (const v1::CreateSolveRequest& request : created) {
    labels.insert(request.labels().at("sweep"));
    ids.insert(request.request_id());
    EXPECT_EQ(request.spec().motion().speed_m_s(), 1.2);
    EXPECT_EQ(request.priority(), -4);
  }
  EXPECT_EQ(labels.size(), 1u);
  EXPECT_EQ(ids.size(), 3u);
  EXPECT_NEAR(created[0].spec().slope_rad(), -0.0872664625997165, 1e-15);
  EXPECT_THAT(ended.out, testing::ContainsRegex("slope_deg +speed_m_s +solve"));
  EXPECT_THAT(ended.out, testing::ContainsRegex("-5 +1.2 +solves/planar-5 +optimal +within"));
  EXPECT_THAT(ended.err, HasSubstr("3/3"));
  EXPECT_THAT(ended.err, HasSubstr("rollgait list --label sweep=" + *labels.begin()));
  for (const char* name : {"slope_-5_speed_1.2.json", "slope_0_speed_1.2.json", "slope_5_speed_1.2.json"}) {
    std::ifstream file(folder / name);
    nlohmann::json solve;
    ASSERT_NO_THROW(file >> solve) << name;
    EXPECT_TRUE(solve.contains("result")) << name;
  }
}

TEST_F(SweepCommandTest, TheSameCommandAttachesAndReadsTheEndsAlone) {
  const std::vector<std::string> line = {"--model", "planar", "--slope", "0,5", "--name", "mine"};
  ASSERT_EQ(Run(line).code, 0);
  const Ended again = Run(line);
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.out, HasSubstr("solves/planar5"));
  EXPECT_EQ(service_.created().size(), 2u) << "nothing was made the second time";
  const std::vector<v1::WatchSolvesRequest> watched = service_.watched_together();
  ASSERT_EQ(watched.size(), 2u);
  v1::GetSolveRequest get;
  get.set_name("solves/planar5");
  v1::Solve finished;
  ASSERT_TRUE(service_.GetSolve(nullptr, &get, &finished).ok());
  for (const v1::WatchSolveRequest& one : watched[1].solves()) {
    EXPECT_EQ(one.after_sequence(), finished.last_sequence() - 1);
  }
  ASSERT_EQ(Run({"--model", "planar", "--slope", "0,5", "--name", "another"}).code, 0);
  EXPECT_EQ(service_.created().size(), 4u) << "another name is another sweep";
  EXPECT_EQ(service_.created()[3].labels().at("sweep"), "another");
}

TEST_F(SweepCommandTest, ABrokenStreamGoesOnWithThoseThatHaveNotFinished) {
  service_.BreakAfter({7});  // the end of one of the two
  const Ended ended = Run({"--model", "planar", "--slope", "0,5", "--json"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const nlohmann::json data = nlohmann::json::parse(ended.out);
  ASSERT_EQ(data.at("points").size(), 2u);
  for (const auto& point : data.at("points")) EXPECT_EQ(point.at("state"), "SOLVE_STATE_SUCCEEDED");
  const std::vector<v1::WatchSolvesRequest> watched = service_.watched_together();
  ASSERT_EQ(watched.size(), 2u);
  EXPECT_EQ(watched[0].solves_size(), 2);
  EXPECT_EQ(watched[1].solves_size(), 1);
}

TEST_F(SweepCommandTest, TheExitCodeIsThatOfTheFirstPointThatIsNoSuccess) {
  const Ended infeasible = Run({"--model", "infeasible", "--slope", "0,5"});
  EXPECT_EQ(infeasible.code, 4);
  EXPECT_THAT(infeasible.out, testing::ContainsRegex("5 +solves/infeasible5 +infeasible"));
  EXPECT_EQ(Run({"--model", "crash", "--slope", "0,5"}).code, 5);
  const Ended refused = Run({"--model", "refused", "--slope", "0,5"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.out, "");
  EXPECT_EQ(Run({"--model", "planar"}).code, 2);
  EXPECT_EQ(Run({"--model", "planar", "--slope", "0,x"}).code, 2);
  EXPECT_EQ(Run({"--model", "planar", "--slope", "0,5", "--csv", "-", "--json"}).code, 2);
}

TEST_F(SweepCommandTest, WhatFailedIsSolvedAgainOnlyIfAsked) {
  const std::vector<std::string> line = {"--model", "crash", "--slope", "0,5", "--name", "mine"};
  ASSERT_EQ(Run(line).code, 5);
  ASSERT_EQ(Run(line).code, 5);
  ASSERT_EQ(service_.created().size(), 2u);
  std::vector<std::string> again = line;
  again.push_back("--again");
  EXPECT_EQ(Run(again).code, 5);
  // The fake's solves of this model have failed at once, so that the command tries as often as it does at most.
  EXPECT_GT(service_.created().size(), 2u);
  EXPECT_THAT(service_.created()[2].request_id(), testing::EndsWith("-2"));
}

TEST_F(SweepCommandTest, ABatchThatIsTooLongIsSentInParts) {
  service_.SetBatchLimit(2);
  const Ended ended = Run({"--model", "planar", "--slope", "0:4:1", "--csv", "-"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(service_.created().size(), 5u);
  for (const char* row : {"\n0,solves/planar0,", "\n2,solves/planar2,", "\n4,solves/planar4,"}) {
    EXPECT_THAT(ended.out, HasSubstr(row));
  }
  service_.SetBatchLimit(0);
  const Ended refused = Run({"--model", "planar", "--slope", "5,6"});
  EXPECT_EQ(refused.code, 2) << "one alone is not divided";
  EXPECT_THAT(refused.err, HasSubstr("send it in several batches"));
}

TEST_F(SweepCommandTest, ABusyServerIsWaitedForAsLongAsItSays) {
  service_.SetBusy(1);
  const auto start = std::chrono::steady_clock::now();
  const Ended ended = Run({"--model", "planar", "--slope", "0,5"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  EXPECT_THAT(ended.err, HasSubstr("the server asks to wait 1"));
  service_.SetBusy(600);
  ClientProcess client(Line({"--model", "planar", "--slope", "0,6"}));
  ASSERT_TRUE(client.WaitForError("the server asks to wait"));
  client.Signal(SIGINT);
  EXPECT_EQ(client.Wait(), 6);
}

TEST_F(SweepCommandTest, TablesAsCommaSeparatedValues) {
  const Ended ended = Run({"--model", "planar", "--slope", "0,5", "--csv", "-"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.out, testing::StartsWith("slope_deg,solve,"));
  EXPECT_THAT(ended.out, HasSubstr("\n5,solves/planar5,succeeded,optimal,within,"));
  EXPECT_THAT(ended.err, HasSubstr("slope_deg  solve"));
}

TEST_F(SweepCommandTest, ATerminalHasOneLineAndOneForEachFailure) {
  ClientProcess good(Line({"--model", "planar", "--slope", "0,5", "--name", "g"}), {true, {}});
  EXPECT_EQ(good.Wait(), 0);
  EXPECT_THAT(good.err(), testing::Not(HasSubstr("1/2  slope 0: optimal, within\r\n")));
  EXPECT_THAT(good.err(), testing::EndsWith("2/2  slope 5: optimal, within\r\n"));
  ClientProcess bad(Line({"--model", "crash", "--slope", "0,5", "--name", "b"}), {true, {}});
  EXPECT_EQ(bad.Wait(), 5);
  EXPECT_THAT(bad.err(), HasSubstr("1/2  slope 0: failed: the solver died three times\r\n"));
}

TEST_F(SweepCommandTest, CtrlCLeavesTheSolvesAlone) {
  ClientProcess client(Line({"--model", "endless", "--slope", "0,5"}));
  ASSERT_TRUE(client.WaitForError("2 solves"));
  client.Signal(SIGINT);
  EXPECT_EQ(client.Wait(), 6);
  EXPECT_THAT(client.err(), HasSubstr("the solves go on"));
  EXPECT_TRUE(service_.cancelled().empty());
}

}  // namespace
}  // namespace rollgait::client
