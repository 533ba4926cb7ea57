#include "client/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <map>

#include "client/failure.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;

class SettingsTest : public testing::Test {
 protected:
  SettingsTest() {
    app_.add_option("--server", server_);
    app_.add_option("--time-out", timeout_)->check(CLI::Range(1.0, 10.0));
    app_.add_flag("-q,--quiet", quiet_);
    app_.set_version_flag("--version", "1");
    app_.fallthrough();  // before the commands, which inherit it
    app_.add_subcommand("walk")->add_option("--slope", slope_);
  }
  void Configure(const std::string& text) {
    const std::string path = testing::TempDir() + "settings_test.toml";
    std::ofstream(path) << text;
    variables_["ROLLGAIT_CONFIG"] = path;
  }
  void Parse(const std::string& line) {
    ApplySettings(app_, [this](const std::string& name) -> std::optional<std::string> {
      const auto found = variables_.find(name);
      return found == variables_.end() ? std::nullopt : std::optional(found->second);
    });
    app_.parse(line);
  }
  std::string Refusal() {
    try {
      Parse("walk");
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage);
      return failure.what();
    }
    return "was accepted";
  }

  CLI::App app_;
  std::string server_ = "default";
  double timeout_ = 5, slope_ = 0;
  bool quiet_ = false;
  std::map<std::string, std::string> variables_;
};

TEST_F(SettingsTest, NothingSetIsTheDefault) {
  Parse("walk");
  EXPECT_EQ(server_, "default");
  EXPECT_EQ(timeout_, 5);
  EXPECT_FALSE(quiet_);
}

TEST_F(SettingsTest, TheFileGivesDefaults) {
  Configure("# where it is\nserver = \"a:1\"\ntime-out = 7.5\nquiet = true\n");
  Parse("walk");
  EXPECT_EQ(server_, "a:1");
  EXPECT_EQ(timeout_, 7.5);
  EXPECT_TRUE(quiet_);
}

TEST_F(SettingsTest, TheEnvironmentComesBeforeTheFileAndTheCommandLineFirst) {
  Configure("server = \"file:1\"\ntime-out = 7\n");
  variables_["ROLLGAIT_SERVER"] = "environment:1";
  variables_["ROLLGAIT_TIME_OUT"] = "";  // as if it were not set
  Parse("walk --slope 3");
  EXPECT_EQ(server_, "environment:1");
  EXPECT_EQ(timeout_, 7);
  EXPECT_EQ(slope_, 3);
  app_.parse("walk --server line:1");
  EXPECT_EQ(server_, "line:1");
}

TEST_F(SettingsTest, WhatCannotBeIsRefusedByName) {
  Configure("sever = \"a:1\"\n");
  EXPECT_THAT(Refusal(), HasSubstr("sever: no such setting; did you mean server?"));
  Configure("time-out = 70\n");
  EXPECT_THAT(Refusal(), HasSubstr("settings_test.toml: time-out = 70"));
  Configure("version = true\n");
  EXPECT_THAT(Refusal(), HasSubstr("version: no such setting"));
  Configure("[walk]\nslope = 3\n");
  EXPECT_THAT(Refusal(), HasSubstr("no sections"));
  variables_["ROLLGAIT_CONFIG"] = "/no/such/file.toml";
  EXPECT_THAT(Refusal(), HasSubstr("ROLLGAIT_CONFIG=/no/such/file.toml: cannot be read"));
  variables_["ROLLGAIT_CONFIG"] = "";
  variables_["ROLLGAIT_TIME_OUT"] = "long";
  EXPECT_THAT(Refusal(), HasSubstr("ROLLGAIT_TIME_OUT = long"));
}

TEST_F(SettingsTest, TheFileIsFoundInItsPlaces) {
  std::map<std::string, std::string> variables;
  const Environment environment = [&](const std::string& name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional(found->second);
  };
  EXPECT_EQ(FindConfiguration(environment).path, "");
  variables["HOME"] = "/me";
  EXPECT_EQ(FindConfiguration(environment).path, "/me/.config/rollgait/config.toml");
  variables["XDG_CONFIG_HOME"] = "/xdg";
  EXPECT_EQ(FindConfiguration(environment).path, "/xdg/rollgait/config.toml");
  EXPECT_FALSE(FindConfiguration(environment).required);
  variables["ROLLGAIT_CONFIG"] = "mine.toml";
  EXPECT_EQ(FindConfiguration(environment).path, "mine.toml");
  EXPECT_TRUE(FindConfiguration(environment).required);
}

TEST_F(SettingsTest, VariablesAreNamedAfterFlags) { EXPECT_EQ(VariableOf("--tls-ca"), "ROLLGAIT_TLS_CA"); }

}  // namespace
}  // namespace rollgait::client
