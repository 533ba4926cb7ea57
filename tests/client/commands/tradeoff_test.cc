// `rollgait tradeoff` as a user sees it: the program as a process, a fake server behind a port.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/client/client_process.h"
#include "tests/client/fake_gait_service.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;

class TradeoffCommandTest : public testing::Test {
 protected:
  Ended Run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"--server", server_.address(), "tradeoff"});
    return RunToEnd(arguments);
  }
  FakeGaitService service_;
  FakeServer server_{service_};
};

TEST_F(TradeoffCommandTest, SolvesThePointsThenAReferenceFromTheFinestAndWritesFiles) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "tradeoff_test";
  std::filesystem::remove_all(folder);
  const std::vector<std::string> line = {"--model", "planar",   "--scheme", "radau2,radau3", "--intervals",
                                         "4,8",     "--errors", "--output", folder.string()};
  const Ended ended = Run(line);
  EXPECT_EQ(ended.code, 0) << ended.err;
  const std::vector<v1::CreateSolveRequest> created = service_.created();
  ASSERT_EQ(created.size(), 4u + 4u + 2u) << "points, those with estimates, two meshes of the reference";
  EXPECT_FALSE(created[3].spec().accuracy().estimate_errors());
  EXPECT_TRUE(created[7].spec().accuracy().estimate_errors());
  EXPECT_TRUE(created[7].spec().warm_start().empty());
  for (int i : {8, 9}) {
    EXPECT_EQ(created[i].spec().discretization().scheme(), v1::Discretization::SCHEME_RADAU3);
    EXPECT_EQ(created[i].spec().discretization().single_support_intervals(), i == 8 ? 16 : 32);
    EXPECT_EQ(created[i].spec().accuracy().kkt_tolerance(), 1e-6);
    EXPECT_EQ(created[i].spec().warm_start(), "solves/planar0");
  }
  EXPECT_THAT(ended.err, HasSubstr("point 4/4"));
  EXPECT_THAT(ended.out, testing::ContainsRegex("\\* +radau2 +4 +1e-06 +optimal +same"));
  std::ifstream json(folder / "tradeoff.json");
  EXPECT_EQ(nlohmann::json::parse(json).at("points").size(), 4u);
  std::stringstream page;
  page << std::ifstream(folder / "tradeoff.html").rdbuf();
  EXPECT_THAT(page.str(), HasSubstr("\"tradeoff\":{\"columns\":[{"));
  EXPECT_THAT(page.str(), HasSubstr("\"points\":[{\"angle_error_deg\""));
  std::stringstream csv;
  csv << std::ifstream(folder / "tradeoff.csv").rdbuf();
  EXPECT_THAT(csv.str(), HasSubstr("\nradau3,8,1e-06,solves/planar0,optimal,"));

  EXPECT_EQ(Run(line).code, 0);
  EXPECT_EQ(service_.created().size(), 10u) << "the same command attaches to its solves";
}

TEST_F(TradeoffCommandTest, WithoutAReferenceTheTableIsPrintedAndThereIsNoError) {
  const Ended ended = Run({"--model", "infeasible", "--intervals", "4", "--scheme", "radau2", "--json"});
  EXPECT_EQ(ended.code, 4) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("no point is optimal"));
  const nlohmann::json data = nlohmann::json::parse(ended.out);
  EXPECT_FALSE(data.contains("reference"));
  EXPECT_FALSE(data.at("points").at(0).contains("angle_error_deg"));
}

TEST_F(TradeoffCommandTest, WrongAxesAreRefusedBeforeAnythingIsMade) {
  const Ended ended = Run({"--model", "planar", "--intervals", "300"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("--intervals 300: 300 must be a whole number in [1, 250]"));
  EXPECT_TRUE(service_.created().empty());
}

}  // namespace
}  // namespace rollgait::client
