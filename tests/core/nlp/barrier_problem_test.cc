// Where a start is put inside of its bounds.
#include "core/nlp/barrier_problem.h"

#include <gtest/gtest.h>

#include "core/nlp/timed_problem.h"
#include "tests/core/nlp/hs071.h"

namespace rollgait {
namespace {

// HS071 with a first variable between 0.02 and 5 that matters at hundredths, and a second one that does not.
class SmallVariable : public Hs071 {
 public:
  SmallVariable() { lower_.head(2).setConstant(0.02); }
  double variable_size(int variable) const override { return variable == 0 ? 0.02 : 1; }
};

TEST(BarrierProblemTest, StartsKeepADistanceRelativeToTheSizeOfAVariable) {
  SmallVariable problem;
  TimedProblem timed(problem);  // as the solver sees it
  constexpr double kPush = 1e-2;
  for (NlpProblem* seen : {static_cast<NlpProblem*>(&problem), static_cast<NlpProblem*>(&timed)}) {
    BarrierProblem barrier(*seen, 0);
    BarrierProblem::Point point;
    ASSERT_TRUE(barrier.MakeInterior(Eigen::Vector4d(0.02, 0.02, 1, 5), kPush, &point));
    EXPECT_DOUBLE_EQ(point.w(0), 0.02 + kPush * 0.02);
    EXPECT_DOUBLE_EQ(point.w(1), 0.02 + kPush * 1);
    // The bound where that is larger than the size, and the distance of the bounds where that is smaller.
    EXPECT_DOUBLE_EQ(point.w(2), 1 + kPush * 1);
    EXPECT_DOUBLE_EQ(point.w(3), 5 - kPush * 4);
  }
}

}  // namespace
}  // namespace rollgait
