#include "core/validation/findings.h"

#include <gtest/gtest.h>

#include <limits>

namespace rollgait {
namespace {

TEST(RaiseTo, KeepsTheLargestAndSeesNaN) {
  double worst = 0;
  RaiseTo(2, &worst);
  RaiseTo(1, &worst);
  EXPECT_EQ(worst, 2);
  RaiseTo(std::numeric_limits<double>::quiet_NaN(), &worst);
  EXPECT_EQ(worst, kInfinity);
  RaiseTo(3, &worst);
  EXPECT_EQ(worst, kInfinity);
}

TEST(FindingLog, KeepsTheLargestWithItsPlace) {
  FindingLog log(3);
  log.Raise(Criterion::kGap, 2, "heel", {1, 0.5, 2});
  log.Raise(Criterion::kGap, 2, "toe", {2, 0.7, 1});
  log.Raise(Criterion::kGap, 1, "hand", {0, 0.1, 0});
  EXPECT_EQ(log[Criterion::kGap].value, 2);
  EXPECT_EQ(log[Criterion::kGap].where, "heel");
  EXPECT_EQ(log[Criterion::kGap].phase, 1);
  EXPECT_EQ(log[Criterion::kGap].time, 0.5);
  EXPECT_EQ(log.intervals()[0][Criterion::kGap], 1);
  EXPECT_EQ(log.intervals()[1][Criterion::kGap], 2);
  EXPECT_EQ(log.intervals()[2][Criterion::kGap], 2);
  EXPECT_EQ(log.intervals()[2][Criterion::kSlip], 0);
  // A place that is no interval's counts for the whole alone, an interval's own measure not for the whole.
  log.Raise(Criterion::kGap, 3, "border", {1, 0.6});
  log.RaiseInterval(Criterion::kGap, 7, 0);
  EXPECT_EQ(log[Criterion::kGap].value, 3);
  EXPECT_EQ(log[Criterion::kGap].where, "border");
  EXPECT_EQ(log.intervals()[0][Criterion::kGap], 7);
  EXPECT_EQ(log.intervals()[1][Criterion::kGap], 2);
}

TEST(FindingLog, NaNIsInfinite) {
  FindingLog log(1);
  log.Raise(Criterion::kSlip, std::numeric_limits<double>::quiet_NaN(), "heel", {0, 0.5, 0});
  log.Raise(Criterion::kSlip, 5, "toe", {0, 0.7, 0});
  EXPECT_EQ(log[Criterion::kSlip].value, kInfinity);
  EXPECT_EQ(log[Criterion::kSlip].where, "heel");
  EXPECT_EQ(log.intervals()[0][Criterion::kSlip], kInfinity);
}

}  // namespace
}  // namespace rollgait
