#include "server/base/trace_context.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rollgait::server {
namespace {

const std::string kGood = "00-4bf92f3577b34da6a3ce929d0e0e4736-00f067aa0ba902b7-01";  // the example of the W3C

TEST(TraceContextTest, KnowsTheForm) {
  EXPECT_TRUE(IsTraceparent(kGood));
  for (const std::string& bad : std::vector<std::string>{
           std::string(), kGood + "0", kGood.substr(1), "01" + kGood.substr(2),
           "00-" + std::string(32, '0') + kGood.substr(35), kGood.substr(0, 36) + std::string(16, '0') + "-01",
           "00-4BF92F3577B34DA6A3CE929D0E0E4736-00f067aa0ba902b7-01",
           "00-4bf92f3577b34da6a3ce929d0e0e4736 00f067aa0ba902b7-01"}) {
    EXPECT_FALSE(IsTraceparent(bad)) << bad;
  }
}

TEST(TraceContextTest, ContinuesAGoodTraceAndBeginsANewOneElse) {
  const std::string continued = ContinueTrace(kGood);
  EXPECT_TRUE(IsTraceparent(continued));
  EXPECT_EQ(continued.substr(0, 36), kGood.substr(0, 36));
  EXPECT_NE(continued.substr(36, 16), kGood.substr(36, 16));
  EXPECT_EQ(continued.substr(52), kGood.substr(52));
  const std::string fresh = ContinueTrace("nonsense\n");
  EXPECT_TRUE(IsTraceparent(fresh));
  EXPECT_NE(fresh, ContinueTrace("nonsense\n"));
}

}  // namespace
}  // namespace rollgait::server
