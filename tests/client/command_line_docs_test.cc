// The commands that the documentation shows are commands.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "client/command_line.h"

namespace rollgait::client {
namespace {

// The words of a command that a shell would hand to `rollgait`, from behind that word to the end of the command.
std::vector<std::string> ShellWords(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; stream >> word;) {
    const bool ends = word[0] == '#' || word == "|" || word == ">" || word == "&&" || word == "&";
    if (ends) break;
    words.push_back(word);
  }
  return words;
}

// Every command of the client in the code blocks of a page; `rollgait` may stand behind a pipe or in <( ).
std::vector<std::string> CommandsOf(const std::string& page) {
  std::ifstream file(std::string(ROLLGAIT_SOURCE) + "/" + page);
  std::vector<std::string> commands;
  bool code = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("```", 0) == 0) code = !code;
    if (!code) continue;
    for (size_t at = 0; (at = line.find("rollgait ", at)) != std::string::npos; at += 9) {
      const bool begins = at == 0 || line.compare(at - 2, 2, "| ") == 0 || line.compare(at - 2, 2, "<(") == 0;
      if (begins) commands.push_back(line.substr(at + 9, line.find(')', at) - at - 9));
    }
  }
  return commands;
}

void ExpectCommands(const std::string& page, size_t at_least) {
  const std::vector<std::string> commands = CommandsOf(page);
  EXPECT_GE(commands.size(), at_least);
  for (const std::string& command : commands) {
    CLI::App app{"", "rollgait"};
    Arguments arguments;
    AddCommandLine(app, arguments);
    std::vector<std::string> words = ShellWords(command);
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    EXPECT_NO_THROW(app.parse(words)) << page << ": rollgait " << command;
    // The words of flags are looked up when the request is built; a file that is not there is none of this test.
    if (arguments.solve.spec.file.empty()) {
      EXPECT_NO_THROW(BuildSpec(arguments.solve.spec)) << command;
    }
    EXPECT_NO_THROW(ListRequest(arguments.list.filter, std::chrono::system_clock::now())) << command;
  }
}

TEST(CommandLineDocsTest, CommandsOfThePageParse) { ExpectCommands("docs/how-to/command_line.md", 12); }
TEST(CommandLineDocsTest, CommandsOfTheReadmeParse) { ExpectCommands("README.md", 8); }

TEST(CommandLineDocsTest, AWrongCommandIsSeen) {
  CLI::App app{"", "rollgait"};
  Arguments arguments;
  AddCommandLine(app, arguments);
  std::vector<std::string> words = {"10", "--sloep", "solve"};
  EXPECT_THROW(app.parse(words), CLI::Error);
}

}  // namespace
}  // namespace rollgait::client
