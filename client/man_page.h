#ifndef ROLLGAIT_CLIENT_MAN_PAGE_H_
#define ROLLGAIT_CLIENT_MAN_PAGE_H_

#include <string>

#include "client/command_tree.h"

namespace rollgait::client {

// The manual page rollgait(1) in the macros of man(7), written from the tree of commands and the help topics.
std::string ManPage(const ProgramDescription& program);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_MAN_PAGE_H_
