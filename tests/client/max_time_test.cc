#include <gtest/gtest.h>

#include <map>
#include <string>

#include "client/spec_flags.h"
#include "tests/client/parse_spec.h"

namespace rollgait::client {
namespace {

TEST(MaxTimeTest, MayHaveAUnitAndAnotherName) {
  const std::map<std::string, double> good = {{"90", 90},  {"90s", 90},    {"0.5s", 0.5},
                                              {"5m", 300}, {"1.5h", 5400}, {"1d", 86400}};
  for (const auto& [text, s] : good) {
    EXPECT_EQ(Parse("--max-time " + text).solver_limits().max_wall_time_s(), s) << text;
    EXPECT_EQ(Parse("--time-limit " + text).solver_limits().max_wall_time_s(), s) << text;
  }
  for (const std::string text : {"s", "5min", "nans", "5M", "1 2s"}) {
    EXPECT_THROW(Parse("--max-time " + text), CLI::ParseError) << text;
  }
}

}  // namespace
}  // namespace rollgait::client
