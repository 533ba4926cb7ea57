// The scripts and the manual page know every command and flag, because they are written from the same tree; and the
// shells take them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "client/command_line.h"
#include "client/command_tree.h"
#include "client/completion_scripts.h"
#include "client/man_page.h"
#include "tests/client/client_process.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;

ProgramDescription Program() {
  CLI::App app{"Optimal walking gaits from a Rollgait server", "rollgait"};
  Arguments arguments;
  AddCommandLine(app, arguments);
  return DescribeProgram(app);
}

CommandDescription CommandOf(const ProgramDescription& program, const std::string& name) {
  for (const CommandDescription& command : program.commands) {
    if (command.name == name) return command;
  }
  throw std::logic_error("no command " + name);
}

FlagDescription FlagOf(const CommandDescription& command, const std::string& name) {
  for (const FlagDescription& flag : command.flags) {
    if (flag.name == name) return flag;
  }
  throw std::logic_error("no flag " + name);
}

TEST(CommandTreeTest, KnowsWhatFlagsTake) {
  using Value = FlagDescription::Value;
  const ProgramDescription program = Program();
  const CommandDescription solve = CommandOf(program, "solve");
  EXPECT_EQ(FlagOf(solve, "--detach").value, Value::kNone);
  EXPECT_EQ(FlagOf(solve, "--output").value, Value::kFile);
  EXPECT_EQ(FlagOf(solve, "--output").short_name, "-o");
  EXPECT_EQ(FlagOf(solve, "--model").value, Value::kModel);
  EXPECT_EQ(FlagOf(solve, "--slope").value, Value::kOther);
  EXPECT_EQ(FlagOf(solve, "--preset").value, Value::kWords);
  EXPECT_THAT(FlagOf(solve, "--preset").words, testing::ElementsAre("human", "torque", "transport"));
  EXPECT_THAT(FlagOf(solve, "--bound").words, testing::Contains("max_pull_bw"));
  EXPECT_THAT(FlagOf(CommandOf(program, "export"), "--format").words, testing::Contains("opensim"));
  EXPECT_EQ(FlagOf(program.program, "--quiet").value, Value::kNone);
  const CommandDescription cancel = CommandOf(program, "cancel");
  ASSERT_EQ(cancel.arguments.size(), 1u);
  EXPECT_FALSE(cancel.arguments[0].required);
  EXPECT_TRUE(CommandOf(program, "get").arguments.at(0).required);
  EXPECT_TRUE(cancel.arguments[0].many);
  EXPECT_EQ(cancel.arguments[0].value, ArgumentDescription::Value::kSolve);
}

// The words that bash offers for a line that ends where the cursor is.
std::vector<std::string> BashOffers(const std::vector<std::string>& line) {
  const std::string script = testing::TempDir() + "completion_test.sh",
                    answer = testing::TempDir() + "completion_test.txt";
  std::ofstream file(script);
  file << CompletionScript("bash", Program()) << "COMP_WORDS=(";
  for (const std::string& word : line) file << "'" << word << "' ";
  file << ")\nCOMP_CWORD=" << line.size() - 1 << "\n_rollgait\nprintf '%s\\n' \"${COMPREPLY[@]}\" > " << answer << "\n";
  file.close();
  EXPECT_EQ(std::system(("bash " + script).c_str()), 0);
  std::vector<std::string> words;
  std::ifstream result(answer);
  for (std::string word; std::getline(result, word);) words.push_back(word);
  return words;
}

TEST(CompletionTest, BashOffersCommandsFlagsAndWords) {
  EXPECT_THAT(BashOffers({"rollgait", "ex"}), testing::UnorderedElementsAre("explain", "export"));
  EXPECT_THAT(BashOffers({"rollgait", "solve", "--sl"}), testing::ElementsAre("--slope"));
  EXPECT_THAT(BashOffers({"rollgait", "solve", "--tim"}), testing::UnorderedElementsAre("--time-limit", "--timeout"));
  EXPECT_THAT(BashOffers({"rollgait", "--json", "solve", "--preset", ""}),
              testing::UnorderedElementsAre("human", "torque", "transport"));
  EXPECT_THAT(BashOffers({"rollgait", "solve", "--bound", "max_pull"}), testing::ElementsAre("max_pull_bw="));
  EXPECT_THAT(BashOffers({"rollgait", "list", "--sl"}), testing::ElementsAre(""));
  EXPECT_THAT(BashOffers({"rollgait", "models", "cre"}), testing::ElementsAre("create"));
  EXPECT_THAT(BashOffers({"rollgait", "model", "fit"}), testing::ElementsAre("fit-feet"));
  EXPECT_THAT(BashOffers({"rollgait", "models", "create", "--i"}), testing::UnorderedElementsAre("--id", "--insecure"));
  EXPECT_THAT(BashOffers({"rollgait", "help", "exit"}), testing::ElementsAre("exit-codes"));
  EXPECT_THAT(BashOffers({"rollgait", "completion", "z"}), testing::ElementsAre("zsh"));
}

TEST(CompletionTest, EveryCommandAndFlagIsInEveryScriptAndInTheManualPage) {
  const ProgramDescription program = Program();
  ASSERT_GE(program.commands.size(), 20u);
  const std::string bash = CompletionScript("bash", program), zsh = CompletionScript("zsh", program),
                    fish = CompletionScript("fish", program), page = ManPage(program);
  for (const CommandDescription& command : program.commands) {
    EXPECT_THAT(zsh, HasSubstr("    '" + command.name + ":"));
    EXPECT_THAT(fish, HasSubstr("__fish_use_subcommand -a " + command.name + " "));
    std::string names = command.name;
    for (const std::string& alias : command.aliases) names += " " + alias;
    for (const FlagDescription& flag : command.flags) {
      EXPECT_THAT(bash, HasSubstr(flag.name)) << command.name;
      EXPECT_THAT(zsh, HasSubstr("'*" + flag.name + "[")) << command.name;
      EXPECT_THAT(fish, HasSubstr("from " + names + "' -l " + flag.name.substr(2) + " ")) << command.name;
    }
  }
  EXPECT_THAT(page, HasSubstr(".SS rollgait solve [flags]"));
  EXPECT_THAT(page, HasSubstr(".SS rollgait models create [flags] FILE"));
  EXPECT_THAT(page, HasSubstr(".B \\-o, \\-\\-output"));
  EXPECT_THAT(page, HasSubstr(".SH EXIT CODES"));
}

// Runs a program on a file made of `text`; skips the test where the program is not installed.
void ExpectTakes(const std::string& program, const std::string& arguments, const std::string& text) {
  if (std::system(("command -v " + program + " > /dev/null").c_str()) != 0)
    GTEST_SKIP() << program << " is not installed";
  const std::string file = testing::TempDir() + "completion_test." + program, said = file + ".said";
  std::ofstream(file) << text;
  EXPECT_EQ(std::system((program + " " + arguments + " " + file + " > /dev/null 2> " + said).c_str()), 0);
  std::ostringstream words;
  words << std::ifstream(said).rdbuf();
  EXPECT_EQ(words.str(), "");
}

TEST(CompletionTest, BashTakesItsScript) { ExpectTakes("bash", "-n", CompletionScript("bash", Program())); }
TEST(CompletionTest, ZshTakesItsScript) { ExpectTakes("zsh", "-n", CompletionScript("zsh", Program())); }
TEST(CompletionTest, FishTakesItsScript) { ExpectTakes("fish", "--no-execute", CompletionScript("fish", Program())); }
TEST(CompletionTest, GroffTakesTheManualPage) { ExpectTakes("groff", "-man -ww -z -k -Tutf8", ManPage(Program())); }

TEST(CompletionTest, TheProgramPrintsThem) {
  const Ended bash = RunToEnd({"completion", "bash"});
  EXPECT_EQ(bash.code, 0);
  EXPECT_EQ(bash.out, CompletionScript("bash", Program()));
  const Ended other = RunToEnd({"completion", "bsh"});
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("must be one of bash, fish, zsh; did you mean bash?"));
  EXPECT_EQ(RunToEnd({"man"}).out, ManPage(Program()));
}

}  // namespace
}  // namespace rollgait::client
