// Every long flag of every command is known to the bash completion.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "client/bound_flags.h"
#include "client/formats/format_table.h"
#include "tests/client/client_process.h"

namespace rollgait::client {
namespace {

TEST(CompletionTest, KnowsEveryFlag) {
  std::ifstream file(ROLLGAIT_COMPLETION);
  std::ostringstream text;
  text << file.rdbuf();
  ASSERT_FALSE(text.str().empty()) << ROLLGAIT_COMPLETION;
  std::set<std::string> completed;
  const std::regex flag("--[a-z][a-z-]+");
  const std::string script = text.str();
  for (std::sregex_iterator at(script.begin(), script.end(), flag), end; at != end; ++at) completed.insert(at->str());
  for (const std::string command :
       {"", "solve", "watch", "get", "list", "models", "export", "report", "reproduce-paper", "simulate", "poincare"}) {
    ClientProcess client(command.empty() ? std::vector<std::string>{"--help"}
                                         : std::vector<std::string>{command, "--help"});
    ASSERT_EQ(client.Wait(), 0);
    std::istringstream help(client.out());
    int flags = 0;
    for (std::string line; std::getline(help, line);) {
      std::smatch match;
      // "  --slope FLOAT ..." or "  -o,--output TEXT ...": the start of a line only, not what a description mentions.
      if (!std::regex_search(line, match, std::regex("^  (-[a-z],)?(--[a-z][a-z-]+)"))) continue;
      ++flags;
      EXPECT_EQ(completed.count(match[2]), 1u) << command << " " << match[2];
    }
    EXPECT_GE(flags, 1) << command;
  }
}

TEST(CompletionTest, KnowsEveryBound) {
  std::ifstream file(ROLLGAIT_COMPLETION);
  std::ostringstream text;
  text << file.rdbuf();
  ASSERT_FALSE(BoundNames().empty());
  for (const std::string& name : BoundNames()) {
    EXPECT_TRUE(std::regex_search(text.str(), std::regex("[\" ]" + name + "[\" \n]"))) << name;
  }
}

TEST(CompletionTest, KnowsEveryFormat) {
  std::ifstream file(ROLLGAIT_COMPLETION);
  std::ostringstream text;
  text << file.rdbuf();
  const std::regex formats("--format\\) COMPREPLY=\\(\\$\\(compgen -W \"([a-z ]+)\"");
  const std::string script = text.str();
  std::smatch match;
  ASSERT_TRUE(std::regex_search(script, match, formats));
  std::string expected;
  for (const Format& format : Formats()) expected += (expected.empty() ? "" : " ") + format.name;
  EXPECT_EQ(match[1], expected);
}

}  // namespace
}  // namespace rollgait::client
