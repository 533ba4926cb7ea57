// Words of a program that completion scripts of every shell hold.
#ifndef ROLLGAIT_CLIENT_COMPLETION_WORDS_H_
#define ROLLGAIT_CLIENT_COMPLETION_WORDS_H_

#include <string>
#include <vector>

#include "client/command_tree.h"

namespace rollgait::client {

// With blanks between.
std::string JoinWords(const std::vector<std::string>& words);
std::vector<std::string> CommandNames(const ProgramDescription& program);
// A line of bash and zsh that gives a $word that is an alias the name of its command.
std::string NameOfAlias(const ProgramDescription& program);
// Of the command and of those below it.
std::vector<FlagDescription> AllFlags(const CommandDescription& command);
std::vector<std::string> FlagNames(const CommandDescription& command);
// The names of the commands below, as words of a command line that end with a blank; empty: none.
std::string WordsBelow(const CommandDescription& command);
// What `rollgait help` knows: commands and topics.
std::vector<std::string> TopicNames(const ProgramDescription& program);
// 'text' in single quotes of bash, zsh and fish; a quote in it becomes a typographic one.
std::string QuotedForShell(const std::string& text);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMPLETION_WORDS_H_
