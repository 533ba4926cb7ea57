// Where a command writes, and what may be written there.
#ifndef ROLLGAIT_CLIENT_TERMINAL_H_
#define ROLLGAIT_CLIENT_TERMINAL_H_

#include <ostream>
#include <string>

namespace rollgait::client {

struct Terminal {
  std::ostream& out;  // Data.
  std::ostream& err;  // Progress, notes, errors.
  bool out_color = false;
  bool err_color = false;
  // True if `err` is a terminal that can rewrite a line.
  bool err_live = false;
  // Width of `err` in characters; meaningful if err_live.
  int err_width = 80;
};

// std::cout and std::cerr, judged by isatty, TERM and NO_COLOR (any non-empty value forbids colour).
Terminal StandardTerminal();

enum class Tone { kPlain, kGood, kBad, kDim, kBold };

// The text in the tone's colour if `color`, else as it is.
std::string Paint(const std::string& text, Tone tone, bool color);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_TERMINAL_H_
