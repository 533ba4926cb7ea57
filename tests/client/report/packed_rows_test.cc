#include "client/report/packed_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "client/base64.h"
#include "client/failure.h"

namespace rollgait::client {
namespace {

TEST(PackedRowsTest, IntegersAndScale) {
  PackedRows rows(3);
  EXPECT_EQ(rows.Add({-2, 0, 1}), 0);
  EXPECT_EQ(rows.Add({std::numeric_limits<double>::quiet_NaN(), 0, 0}), 1);
  const nlohmann::json packed = rows.ToJson();
  EXPECT_EQ(packed["columns"], 3);
  EXPECT_NEAR(packed["scales"][0].get<double>(), 2.0 / 32767, 1e-18);
  // −32767, 0 and 16384 in two bytes each, then −32768, 0, 0.
  EXPECT_EQ(packed["data"], Base64(std::string("\x01\x80\x00\x00\x00\x40\x00\x80\x00\x00\x00\x00", 12)));
}

TEST(PackedRowsTest, RefusesARowOfAnotherLength) {
  PackedRows rows(3);
  EXPECT_THROW(rows.Add({1, 2}), Failure);
}

}  // namespace
}  // namespace rollgait::client
