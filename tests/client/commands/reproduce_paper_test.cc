// `rollgait reproduce-paper` as a user sees it: the program as a process, a fake server behind a port.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/client/client_process.h"
#include "tests/client/fake_gait_service.h"

namespace rollgait::client {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class ReproducePaperTest : public testing::Test {
 protected:
  std::vector<std::string> Arguments(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"--server", server_.address(), "reproduce-paper"});
    return arguments;
  }

  FakeGaitService service_;
  FakeServer server_{service_};
};

TEST_F(ReproducePaperTest, AsksForThreeSlopesAndWritesThePage) {
  const std::filesystem::path page =
      std::filesystem::temp_directory_path() / ("rollgait-paper-" + std::to_string(getpid()) + ".html");
  ClientProcess client(Arguments({"--model", "planar", "-o", page.string()}));
  EXPECT_EQ(client.Wait(), 0) << client.err();
  ASSERT_EQ(service_.created().size(), 3u);
  const double degree = 0.017453292519943295;
  EXPECT_NEAR(service_.created()[0].spec().slope_rad(), 10 * degree, 1e-12);
  EXPECT_EQ(service_.created()[1].spec().slope_rad(), 0);
  EXPECT_NEAR(service_.created()[2].spec().slope_rad(), -10 * degree, 1e-12);
  for (const v1::CreateSolveRequest& request : service_.created()) {
    EXPECT_EQ(request.spec().motion().speed_m_s(), 1.3);
    ASSERT_EQ(request.spec().costs_size(), 1);
    EXPECT_TRUE(request.spec().costs(0).has_squared_torque());
  }
  EXPECT_THAT(client.out(), HasSubstr("Torque consumption is larger downhill than uphill."));
  EXPECT_THAT(client.err(), HasSubstr("written: "));

  std::ifstream file(page);
  std::ostringstream text;
  text << file.rdbuf();
  std::filesystem::remove(page);
  EXPECT_THAT(text.str(), HasSubstr("<!doctype html>"));
  EXPECT_THAT(text.str(), Not(HasSubstr("{{")));
  EXPECT_THAT(text.str(), HasSubstr("Statement by statement"));
  EXPECT_THAT(text.str(), HasSubstr("\"squared_torque_n2m2s\""));
}

TEST_F(ReproducePaperTest, ThePageMayGoToStandardOutput) {
  ClientProcess client(Arguments({"--model", "planar", "-o", "-"}));
  EXPECT_EQ(client.Wait(), 0) << client.err();
  EXPECT_THAT(client.out(), testing::StartsWith("<!doctype html>"));
  EXPECT_THAT(client.err(), HasSubstr("Torque consumption is larger downhill than uphill."));
  EXPECT_THAT(client.err(), Not(HasSubstr("written: ")));
}

TEST_F(ReproducePaperTest, JsonIsTheData) {
  ClientProcess client(Arguments({"--json", "--model", "planar"}));
  EXPECT_EQ(client.Wait(), 0) << client.err();
  EXPECT_EQ(client.err(), "");
  const json data = json::parse(client.out());
  ASSERT_EQ(data["slopes"].size(), 3u);
  EXPECT_NEAR(data["slopes"][2]["slope_deg"].get<double>(), -10, 1e-9);
  for (const json& slope : data["slopes"]) {
    EXPECT_EQ(slope["solved"], true);
    EXPECT_NEAR(slope["events_percent"]["toe_off"].get<double>(), 60, 1e-9);
    for (const char* joint : {"hip", "knee", "ankle"}) EXPECT_EQ(slope["torques"][joint].size(), 101u);
    EXPECT_EQ(slope["joints"].size(), 6u);
  }
  ASSERT_GE(data["statements"].size(), 10u);
  for (const json& statement : data["statements"]) {
    EXPECT_THAT(statement["verdict"].get<std::string>(), testing::AnyOf("agrees", "disagrees", "open"));
    EXPECT_FALSE(statement["why"].get<std::string>().empty());
  }
}

TEST_F(ReproducePaperTest, TheModelIsTheHumanUnlessAnotherIsNamed) {
  ClientProcess client(Arguments({"--json"}));
  EXPECT_EQ(client.Wait(), 2);  // the fake knows no human29
  ASSERT_EQ(service_.created().size(), 1u);
  EXPECT_EQ(service_.created()[0].spec().model().name(), "human29");
  EXPECT_THAT(client.err(), HasSubstr("model.name"));
}

TEST_F(ReproducePaperTest, WithoutASolutionThePageSaysSo) {
  ClientProcess client(Arguments({"--json", "--model", "infeasible"}));
  EXPECT_EQ(client.Wait(), 4);
  EXPECT_EQ(service_.created().size(), 3u);
  const json page = json::parse(client.out());
  EXPECT_FALSE(page["statements"].empty());
  for (const json& statement : page["statements"]) EXPECT_EQ(statement["verdict"], "open");
  ClientProcess crash(Arguments({"--json", "--model", "crash"}));
  EXPECT_EQ(crash.Wait(), 5);
  EXPECT_EQ(json::parse(crash.out())["slopes"][0]["solved"], false);
}

TEST_F(ReproducePaperTest, CtrlCCancelsTheSolveThatRuns) {
  ClientProcess client(Arguments({"--model", "endless", "-o", "never.html"}));
  ASSERT_TRUE(client.WaitForError("9.960000e+02"));
  client.Signal(SIGINT);
  EXPECT_EQ(client.Wait(), 6);
  EXPECT_EQ(service_.cancelled().size(), 1u);
  EXPECT_EQ(service_.created().size(), 1u);
  EXPECT_FALSE(std::filesystem::exists("never.html"));
}

TEST_F(ReproducePaperTest, RefusesASlopeAndANamelessPage) {
  ClientProcess slope(Arguments({"--slope", "5", "-o", "x.html"}));
  EXPECT_EQ(slope.Wait(), 2);
  ClientProcess nameless(Arguments({"--model", "planar"}));
  EXPECT_EQ(nameless.Wait(), 2);
  EXPECT_THAT(nameless.err(), HasSubstr("--output"));
  EXPECT_TRUE(service_.created().empty());
}

}  // namespace
}  // namespace rollgait::client
