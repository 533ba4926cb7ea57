// export, and models --format: files for other programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/client/client_process.h"
#include "tests/client/fake_gait_service.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ExportCommandTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(Run({"-q", "solve", "--model", "planar", "--slope", "10"}).code, 0);
    std::filesystem::remove_all(folder_);
  }
  Ended Run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"--server", server_.address()});
    return RunToEnd(arguments);
  }
  static std::string Read(const std::string& path) {
    std::ifstream stream(path);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  FakeGaitService service_;
  FakeServer server_{service_};
  const std::string folder_ = testing::TempDir() + "export_test_" + std::to_string(getpid());
};

TEST_F(ExportCommandTest, WritesToStandardOutputOrAFile) {
  const Ended mjcf = Run({"export", "planar", "--format", "mjcf"});
  EXPECT_EQ(mjcf.code, 0);
  EXPECT_EQ(mjcf.err, "");
  EXPECT_THAT(mjcf.out, HasSubstr("<mujoco model=\"planar\">"));
  EXPECT_EQ(Run({"export", "planar", "--format", "mjcf", "-o", "-"}).out, mjcf.out);
  const std::string file = folder_ + ".bvh";
  const Ended bvh = Run({"export", "solves/planar", "-o", file});
  EXPECT_EQ(bvh.code, 0);
  EXPECT_EQ(bvh.out, "");
  EXPECT_THAT(Read(file), StartsWith("HIERARCHY"));
  const std::string saved = folder_ + ".json";
  ASSERT_EQ(Run({"export", "planar", "-o", saved}).code, 0);
  EXPECT_EQ(Run({"export", saved, "--format", "mjcf"}).out, mjcf.out);
}

TEST_F(ExportCommandTest, MakesTheFolderOfSeveralFiles) {
  const Ended ended = Run({"export", "planar", "--format", "opensim", "-o", folder_});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* const name :
       {"model.osim", "motion.mot", "ground_reaction.mot", "external_loads.xml", "markers.trc"}) {
    EXPECT_TRUE(std::filesystem::is_regular_file(folder_ + "/" + name)) << name;
  }
  EXPECT_EQ(Run({"export", "planar", "--format", "mjcf", "-o", folder_}).code, 2);
}

TEST_F(ExportCommandTest, RefusesBeforeItAsksTheServer) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"export", "planar"}, "--format: is needed for standard output; one of json, csv"},
      {{"export", "planar", "--format", "fbx"}, "--format fbx: must be one of json, csv"},
      {{"export", "planar", "--format", "opensim"}, "--format opensim: several files; name their folder"},
      {{"export", "planar", "-o", "walk.fbx"}, "--output walk.fbx: the name must end in one of .json"},
      {{"export", "planar", "-o", folder_ + "/nowhere/a.trc"}, "cannot write in"},
      {{"models", "planar", "-o", "a.xml"}, "need --format, one of mjcf, urdf, urdf-side, osim"},
      {{"models", "--format", "mjcf"}, "--format: needs the NAME of a model"},
      {{"models", "planar", "--format", "trc"}, "--format trc: needs a solve"},
      {{"models", "planar", "--format", "json"}, "--format json: is the flag --json for a model"},
      {{"models", "planar", "--format", "mjcf", "--slope", "60"}, "--slope"},
  };
  for (auto [arguments, message] : cases) {
    arguments.insert(arguments.begin(), {"--server", "127.0.0.1:1"});
    const Ended ended = RunToEnd(arguments);
    EXPECT_EQ(ended.code, 2) << testing::PrintToString(arguments);
    EXPECT_THAT(ended.err, HasSubstr(message));
    EXPECT_EQ(ended.out, "");
  }
}

TEST_F(ExportCommandTest, OnlyFinishedSolves) {
  ASSERT_EQ(Run({"-q", "solve", "--model", "endless", "--detach"}).code, 0);
  const Ended early = Run({"export", "endless", "--format", "stride"});
  EXPECT_EQ(early.code, 2);
  EXPECT_THAT(early.err, HasSubstr("rollgait watch endless"));
  EXPECT_EQ(Run({"export", "nosuch", "--format", "stride"}).code, 7);
}

TEST_F(ExportCommandTest, ModelsOnASlope) {
  const Ended level = Run({"models", "planar", "--format", "mjcf"});
  EXPECT_EQ(level.code, 0);
  EXPECT_THAT(level.out, HasSubstr("gravity=\"0 0 -9.81\""));
  const Ended uphill = Run({"models", "planar", "--format", "mjcf", "--slope", "30"});
  EXPECT_THAT(uphill.out, HasSubstr("gravity=\"-4.90"));
  const std::string file = folder_ + ".urdf";
  ASSERT_EQ(Run({"models", "planar", "--format", "urdf", "-o", file}).code, 0);
  EXPECT_THAT(Read(file), HasSubstr("<robot name=\"planar\">"));
}

}  // namespace
}  // namespace rollgait::client
