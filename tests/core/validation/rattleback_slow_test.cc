// The rattleback from its start to the reversal of its spin: a motion that enlarges errors 6000 times.
#include <gtest/gtest.h>

#include "tests/support/matrix_near.h"
#include "tests/support/roller.h"

namespace rollgait {
namespace {

TEST(Rattleback, ReversesWhenItMust) {
  const auto rows = ReadReference(ROLLGAIT_TEST_DATA "/rattleback_KL82_undamped.csv");
  ASSERT_EQ(rows.size(), 3u);
  Roller roller(Rattleback(), Vector3(0, 0, -9.81), 1e-12);
  VectorX q, v;
  SetRolling(kRattlebackAxes, rows[0].R, rows[0].R * rows[0].omega, 0, 0, &q, &v);
  roller.Advance(0, rows[1].t, &q, &v);
  EXPECT_TRUE(MatrixNear(roller.CenterOfMass(), rows[1].com, 1e-11));
  EXPECT_NEAR(NextReversal(rows[1].t, 2.7, &roller, &q, &v), 2.761109153800631, 1e-8);
}

}  // namespace
}  // namespace rollgait
