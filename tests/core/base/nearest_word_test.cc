#include "core/base/nearest_word.h"

#include <gtest/gtest.h>

namespace rollgait {
namespace {

TEST(NearestWordTest, DistanceCountsEdits) {
  EXPECT_EQ(EditDistance("", ""), 0);
  EXPECT_EQ(EditDistance("slope", "slope"), 0);
  EXPECT_EQ(EditDistance("", "abc"), 3);
  EXPECT_EQ(EditDistance("abc", ""), 3);
  EXPECT_EQ(EditDistance("slop", "slope"), 1);
  EXPECT_EQ(EditDistance("slope", "slo"), 2);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
  EXPECT_EQ(EditDistance("waklt", "walk"), 2);
  EXPECT_EQ(EditDistance("wlak", "walk"), 1);  // neighbours swapped
}

TEST(NearestWordTest, NearestIsNearOrNothing) {
  const std::vector<std::string> flags = {"--slope", "--speed", "--step-length", "--step-duration"};
  EXPECT_EQ(Nearest("--sloep", flags), "--slope");
  EXPECT_EQ(Nearest("--sped", flags), "--speed");
  EXPECT_EQ(Nearest("--step-lenght", flags), "--step-length");
  EXPECT_EQ(Nearest("--step", flags), "--step-length");  // begins with it
  EXPECT_EQ(Nearest("--friction", flags), "");
  EXPECT_EQ(Nearest("--", flags), "");
  EXPECT_EQ(Nearest("x", {"a"}), "a");
  EXPECT_EQ(Nearest("", {"torque"}), "");
  EXPECT_EQ(Nearest("slope", {}), "");
}

TEST(NearestWordTest, SaysSo) {
  EXPECT_EQ(DidYouMean("hlaf", {"full", "half"}), "; did you mean half?");
  EXPECT_EQ(DidYouMean("third", {"full", "half"}), "");
}

}  // namespace
}  // namespace rollgait
