#include "client/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;
using testing::Not;

// Beside the energy that was minimised stands the one without smoothing, where the two differ and the server told it.
TEST(SummaryTest, TellsTheEnergyWithoutSmoothing) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  EXPECT_THAT(Summarize(solve, false), Not(HasSubstr("without smoothing"))) << "equal";
  solve.mutable_result()->mutable_costs(0)->set_unsmoothed_value(612.25);
  EXPECT_THAT(Summarize(solve, false), HasSubstr("without smoothing"));
  EXPECT_THAT(Summarize(solve, false), HasSubstr("612.25"));
  solve.mutable_result()->mutable_costs(0)->clear_unsmoothed_value();
  EXPECT_THAT(Summarize(solve, false), Not(HasSubstr("without smoothing"))) << "of an older server";
}

}  // namespace
}  // namespace rollgait::client
