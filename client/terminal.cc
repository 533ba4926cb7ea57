#include "client/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>

namespace rollgait::client {

Terminal StandardTerminal() {
  const char* const no_color = std::getenv("NO_COLOR");
  const char* const term = std::getenv("TERM");
  const bool color = no_color == nullptr || *no_color == '\0';
  const bool smart = term != nullptr && std::string(term) != "dumb" && *term != '\0';
  Terminal terminal{std::cout, std::cerr};
  terminal.err_live = smart && isatty(STDERR_FILENO) == 1;
  terminal.err_color = color && terminal.err_live;
  terminal.out_color = color && smart && isatty(STDOUT_FILENO) == 1;
  winsize size{};
  if (terminal.err_live && ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    terminal.err_width = size.ws_col;
  }
  return terminal;
}

std::string Paint(const std::string& text, Tone tone, bool color) {
  if (!color || tone == Tone::kPlain) return text;
  const char* const code = tone == Tone::kGood ? "32" : tone == Tone::kBad ? "31" : tone == Tone::kDim ? "2" : "1";
  return std::string("\x1b[") + code + "m" + text + "\x1b[0m";
}

}  // namespace rollgait::client
