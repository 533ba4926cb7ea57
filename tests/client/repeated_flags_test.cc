// One rule for every flag that may be repeated.
#include "client/repeated_flags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "client/command_line.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;

TEST(RepeatedFlagsTest, TheNameIsWhatStandsBefore) {
  EXPECT_EQ(NameOf("knee_l=20"), "knee_l");
  EXPECT_EQ(NameOf("work:0.5"), "work");
  EXPECT_EQ(NameOf("running"), "running");
  EXPECT_EQ(NameOf(""), "");
}

TEST(RepeatedFlagsTest, RefusesANameThatWasGivenAndQuotesBoth) {
  CLI::App app;
  std::vector<std::string> values;
  AddRepeatedFlag(app, "--lock", values, "Fix a joint", "joint");
  app.parse("--lock knee_l=20 --lock knee_r=20");
  EXPECT_THAT(values, testing::ElementsAre("knee_l=20", "knee_r=20"));
  try {
    app.parse("--lock knee_l=20 --lock hip_l=1 --lock knee_l=10");
    ADD_FAILURE() << "taken";
  } catch (const CLI::ValidationError& error) {
    EXPECT_STREQ(error.what(),
                 "--lock knee_l=20 and --lock knee_l=10: say two things of the same joint; give one of them");
  }
}

// A flag takes one value: what follows it is an argument of the command.
TEST(RepeatedFlagsTest, LeavesTheNextWordToTheCommand) {
  CLI::App app;
  std::vector<std::string> values;
  std::string model;
  AddRepeatedFlag(app, "--load", values, "A mass", "segment");
  app.add_option("NAME", model);
  app.parse("--load hand_l=10 planar");
  EXPECT_EQ(model, "planar");
  EXPECT_THAT(values, testing::ElementsAre("hand_l=10"));
}

// No flag that may be given more than once goes past the rule.
TEST(RepeatedFlagsTest, EveryCommandKeepsTheRule) {
  CLI::App app;
  Arguments arguments;
  AddCommandLine(app, arguments);
  int repeated = 0;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_lnames().empty() || option->get_items_expected_max() <= 1) continue;
      ++repeated;
      EXPECT_THAT(option->get_description(), HasSubstr("; may be repeated, once for each "))
          << command->get_name() << " --" << option->get_lnames().front();
    }
  }
  EXPECT_GT(repeated, 20);
}

}  // namespace
}  // namespace rollgait::client
