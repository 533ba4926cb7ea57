#include "core/nlp/barrier_parameter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rollgait {
namespace {

NlpOptions Fast() {
  NlpOptions options;
  options.tolerance = 1e-6;
  options.initial_barrier = 1e-3;
  options.barrier_tolerance = 1000;
  options.barrier_exponent = 2.2;
  return options;
}

double NoError(double) { return 0; }

// Short steps until μ is raised; -1: it never is.
int StepsUntilRaised(BarrierParameter* parameter, double step) {
  for (int i = 1; i <= 100; ++i) {
    if (parameter->RaiseWhereStepsAreShort(step)) return i;
  }
  return -1;
}

TEST(BarrierParameter, FallsToWhereTheToleranceEndsIt) {
  BarrierParameter parameter{NlpOptions()};
  EXPECT_EQ(parameter.mu(), 0.1);
  EXPECT_EQ(parameter.tau(), 0.99);
  int asked = 0;
  // Equation 7 of Wächter and Biegler, by hand: max(1e-6/11, min(0.2 μ, μ^1.5)).
  EXPECT_TRUE(parameter.Reduce(false, [&](double mu) { return ++asked == 1 ? 10 * mu : 11 * mu; }));
  EXPECT_DOUBLE_EQ(parameter.mu(), 0.02);
  EXPECT_FALSE(parameter.Reduce(false, [](double mu) { return 10.001 * mu; }));
  EXPECT_TRUE(parameter.Reduce(true, [](double) { return 1e9; }));
  EXPECT_DOUBLE_EQ(parameter.mu(), std::pow(0.02, 1.5));
  EXPECT_TRUE(parameter.Reduce(false, NoError));
  EXPECT_DOUBLE_EQ(parameter.mu(), 1e-6 / 11);
  EXPECT_EQ(parameter.mu(), BarrierParameter::Least(1e-6));
  EXPECT_FALSE(parameter.Reduce(true, NoError));
  EXPECT_DOUBLE_EQ(parameter.tau(), 1 - 1e-6 / 11);
}

TEST(BarrierParameter, IsRaisedWhereStepsStayShort) {
  BarrierParameter parameter(Fast());
  EXPECT_TRUE(parameter.Reduce(false, [](double mu) { return 999 * mu; }));
  EXPECT_DOUBLE_EQ(parameter.mu(), 1e-6 / 11);
  const int first = StepsUntilRaised(&parameter, 0.05);
  EXPECT_GE(first, 5);
  EXPECT_LE(first, 8);
  EXPECT_EQ(parameter.mu(), 1e-2);
  // From there on it falls as Ipopt lets it, not by the fast settings.
  EXPECT_FALSE(parameter.Reduce(false, [](double mu) { return 10.001 * mu; }));
  EXPECT_TRUE(parameter.Reduce(true, [](double) { return 1e9; }));
  EXPECT_DOUBLE_EQ(parameter.mu(), 1e-3);
  EXPECT_EQ(StepsUntilRaised(&parameter, 0.05), first);
  EXPECT_TRUE(parameter.Reduce(false, NoError));
  EXPECT_EQ(StepsUntilRaised(&parameter, 0.05), -1) << "twice is enough";
}

TEST(BarrierParameter, StaysWhereOneStepInThreeIsLong) {
  BarrierParameter parameter(Fast());
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(parameter.RaiseWhereStepsAreShort(i % 3 == 2 ? 1 : 0.05)) << i;
}

// Short steps after a slow fall have other causes: squared torque crawls along valleys.
TEST(BarrierParameter, StaysWhereItDidNotFallFasterThanThatOfIpopt) {
  NlpOptions options = Fast();
  options.barrier_tolerance = 10;
  options.barrier_exponent = 1.5;
  BarrierParameter slow(options);
  EXPECT_TRUE(slow.Reduce(false, NoError));
  EXPECT_EQ(StepsUntilRaised(&slow, 0.01), -1);
}

TEST(BarrierParameter, IsRaisedToTenTimesItsFirstValue) {
  for (const double first : {1e-1, 1e-2, 1e-4, 1e-6}) {
    NlpOptions options = Fast();
    options.initial_barrier = first;
    BarrierParameter parameter(options);
    EXPECT_TRUE(parameter.Reduce(false, NoError));
    EXPECT_GT(StepsUntilRaised(&parameter, 0.01), 0);
    EXPECT_DOUBLE_EQ(parameter.mu(), std::min(1e-2, 10 * first));
  }
}

TEST(BarrierParameter, GoesOnFromItsMemory) {
  BarrierParameter whole(Fast()), resumed(Fast());
  whole.Reduce(false, NoError);
  for (int i = 0; i < 3; ++i) whole.RaiseWhereStepsAreShort(0.05);
  resumed.Restore(whole.memory());
  EXPECT_EQ(StepsUntilRaised(&resumed, 0.05), StepsUntilRaised(&whole, 0.05));
  EXPECT_EQ(resumed.mu(), whole.mu());
  EXPECT_EQ(resumed.memory().raised, 1);
}

}  // namespace
}  // namespace rollgait
