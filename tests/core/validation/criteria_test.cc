#include "core/validation/criteria.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace rollgait {
namespace {

class CriteriaTest : public ::testing::TestWithParam<int> {};

TEST_P(CriteriaTest, TheTableIsInTheOrderOfTheEnumeration) {
  const CriterionTraits& traits = Criteria()[GetParam()];
  EXPECT_EQ(static_cast<int>(traits.criterion), GetParam());
  EXPECT_LE(traits.least, traits.fine);
  EXPECT_LE(traits.fine, 0.2 * traits.standard * (1 + 1e-12));
  EXPECT_LE(traits.standard, traits.most);
  EXPECT_EQ(StandardBounds()[traits.criterion], traits.standard);
  EXPECT_EQ(FineBounds()[traits.criterion], traits.fine);
  EXPECT_EQ(NoBounds()[traits.criterion], kInfinity);
}

// What "standard" promises, in the order of the enumeration (proto/rollgait/v1/accuracy.proto says the same).
TEST(Criteria, StandardIsWhatIsPromised) {
  const double degree = M_PI / 180;
  const std::array<double, kCriterionCount> promised = {1e-4, 1e-3, 1e-4, 1e-6, 5e-3, 0.2,  0.05 * degree, 0.01,
                                                        0.01, 1e-3, 0.01, 5e-6, 1e-4, 5e-3, 5e-3};
  for (int c = 0; c < kCriterionCount; ++c) {
    EXPECT_NEAR(Criteria()[c].standard, promised[c], 1e-12 * promised[c]) << Criteria()[c].field;
  }
}

// Every criterion alone: at its bound, over it, not a number, not judged.
TEST_P(CriteriaTest, EveryBoundCounts) {
  const auto criterion = static_cast<Criterion>(GetParam());
  const double bound = TraitsOf(criterion).standard;
  std::array<Finding, kCriterionCount> findings;
  Finding& finding = findings[GetParam()];
  finding = {bound, "place", 2, 0.75};
  EXPECT_EQ(JudgeFindings(findings, StandardBounds()).kind, Verdict::Kind::kWithin);
  finding.value = 1.001 * bound;
  Verdict verdict = JudgeFindings(findings, StandardBounds());
  ASSERT_EQ(verdict.kind, Verdict::Kind::kExceeded);
  ASSERT_EQ(verdict.excesses.size(), 1u);
  EXPECT_EQ(verdict.excesses[0].criterion, criterion);
  EXPECT_EQ(verdict.excesses[0].bound, bound);
  EXPECT_NEAR(verdict.excesses[0].ratio(), 1.001, 1e-12);
  EXPECT_EQ(verdict.excesses[0].finding.where, "place");
  EXPECT_EQ(verdict.excesses[0].finding.phase, 2);
  EXPECT_EQ(verdict.excesses[0].finding.time, 0.75);
  finding.value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(JudgeFindings(findings, StandardBounds()).kind, Verdict::Kind::kExceeded);
  finding.value = kInfinity;
  EXPECT_EQ(JudgeFindings(findings, StandardBounds()).kind, Verdict::Kind::kExceeded);
  // Judged by another criterion alone, it does not count.
  CriterionValues others = StandardBounds();
  others[criterion] = kInfinity;
  EXPECT_EQ(JudgeFindings(findings, others).kind, Verdict::Kind::kWithin);
  EXPECT_EQ(JudgeFindings(findings, NoBounds()).kind, Verdict::Kind::kNotJudged);
}

INSTANTIATE_TEST_SUITE_P(All, CriteriaTest, ::testing::Range(0, kCriterionCount));

TEST(JudgeFindings, TheWorstComesFirst) {
  std::array<Finding, kCriterionCount> findings;
  CriterionValues bounds = NoBounds();
  const auto plant = [&](Criterion criterion, double bound, double value) {
    bounds[criterion] = bound;
    findings[static_cast<int>(criterion)].value = value;
  };
  plant(Criterion::kGap, 1e-4, 2e-4);
  plant(Criterion::kEnergy, 0.01, 0.05);
  plant(Criterion::kPull, 0, 1e-9);  // a bound of zero is exceeded infinitely
  plant(Criterion::kSlip, 1e-3, 1e-4);
  plant(Criterion::kFriction, 0.01, 0.03);
  const Verdict verdict = JudgeFindings(findings, bounds);
  ASSERT_EQ(verdict.excesses.size(), 4u);
  EXPECT_EQ(verdict.excesses[0].criterion, Criterion::kPull);
  EXPECT_EQ(verdict.excesses[1].criterion, Criterion::kEnergy);
  EXPECT_EQ(verdict.excesses[2].criterion, Criterion::kFriction);
  EXPECT_EQ(verdict.excesses[3].criterion, Criterion::kGap);
}

}  // namespace
}  // namespace rollgait
