// A request from the flags of a command line.
#ifndef ROLLGAIT_TESTS_CLIENT_PARSE_SPEC_H_
#define ROLLGAIT_TESTS_CLIENT_PARSE_SPEC_H_

#include <CLI/CLI.hpp>
#include <string>

#include "client/spec_flags.h"

namespace rollgait::client {

inline v1::SolveSpec Parse(const std::string& line) {
  CLI::App app;
  SpecFlags flags;
  AddSpecFlags(app, flags);
  app.parse(line);
  return BuildSpec(flags);
}

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_CLIENT_PARSE_SPEC_H_
