#include "client/list_filter.h"

#include <gtest/gtest.h>

#include "client/failure.h"

namespace rollgait::client {
namespace {

using WallClock = std::chrono::system_clock;
constexpr int64_t kListNow_s = 1764028800;  // 2025-11-25 00:00:00 UTC
const WallClock::time_point kListNow = WallClock::from_time_t(kListNow_s);

v1::Solve ListedSolve() {
  v1::Solve solve;
  solve.set_name("solves/ab12");
  solve.set_state(v1::SOLVE_STATE_SUCCEEDED);
  solve.mutable_spec()->mutable_model()->set_name("planar");
  solve.mutable_outcome()->set_termination(v1::TERMINATION_TIME_LIMIT);
  solve.mutable_outcome()->set_verdict(v1::VERDICT_NOT_JUDGED);
  solve.mutable_create_time()->set_seconds(kListNow_s - 3600);
  return solve;
}

bool FilterMatches(const ListFilter& filter, const v1::Solve& solve) {
  return SolveMatcher(filter, kListNow).Matches(solve);
}

TEST(ListFilterTest, NothingAskedForMatchesAll) {
  EXPECT_TRUE(FilterMatches({}, ListedSolve()));
  EXPECT_TRUE(FilterMatches({}, v1::Solve()));
  EXPECT_TRUE(SolveMatcher({}, kListNow).IsOfStateAlone());
  EXPECT_TRUE(SolveMatcher({.state = "running"}, kListNow).IsOfStateAlone());
  EXPECT_FALSE(SolveMatcher({.model = "planar"}, kListNow).IsOfStateAlone());
}

TEST(ListFilterTest, EveryFilterTakesAndLeaves) {
  const struct {
    ListFilter takes, leaves;
  } kCases[] = {
      {{.state = "succeeded"}, {.state = "running"}},
      {{.verdict = "not-judged"}, {.verdict = "within"}},
      {{.termination = "time-limit"}, {.termination = "optimal"}},
      {{.model = "planar"}, {.model = "plan"}},
      {{.name_prefix = "ab"}, {.name_prefix = "b1"}},
      {{.name_prefix = "solves/ab12"}, {.name_prefix = "solves/ab123"}},
      {{.since = "2h"}, {.since = "30m"}},
      {{.since = "2025-11-24"}, {.since = "2025-11-25"}},
  };
  for (const auto& [takes, leaves] : kCases) {
    EXPECT_TRUE(FilterMatches(takes, ListedSolve()));
    EXPECT_FALSE(FilterMatches(leaves, ListedSolve()));
  }
}

TEST(ListFilterTest, AModelThatTheRequestCarriesIsOwn) {
  v1::Solve solve = ListedSolve();
  EXPECT_EQ(ListedModel(solve), "planar");
  solve.mutable_spec()->mutable_model()->clear_name();
  solve.mutable_spec()->mutable_model()->mutable_own();
  EXPECT_EQ(ListedModel(solve), "own");
  EXPECT_TRUE(FilterMatches({.model = "own"}, solve));
  EXPECT_FALSE(FilterMatches({.model = "planar"}, solve));
}

TEST(ListFilterTest, NoneIsWhatHasNoOutcomeYet) {
  v1::Solve running = ListedSolve();
  running.clear_outcome();
  EXPECT_TRUE(FilterMatches({.verdict = "none"}, running));
  EXPECT_TRUE(FilterMatches({.termination = "none"}, running));
  EXPECT_FALSE(FilterMatches({.verdict = "none"}, ListedSolve()));
  v1::Solve old = ListedSolve();
  old.mutable_outcome()->set_verdict(v1::VERDICT_UNSPECIFIED);
  EXPECT_TRUE(FilterMatches({.verdict = "not-judged"}, old));
}

TEST(ListFilterTest, SinceIsAnAgeOrADate) {
  EXPECT_EQ(ParseSince("90s", kListNow), kListNow - std::chrono::seconds(90));
  EXPECT_EQ(ParseSince("7d", kListNow), kListNow - std::chrono::hours(7 * 24));
  EXPECT_EQ(ParseSince("2025-11-25", kListNow), kListNow);
  EXPECT_EQ(ParseSince("2025-11-25T12:30", kListNow), kListNow + std::chrono::minutes(750));
  for (const char* text : {"", "d", "7", "7w", "-7d", "99999999999d", "2025-02-31", "2025-11-25T12", "yesterday"}) {
    EXPECT_THROW(ParseSince(text, kListNow), Failure) << text;
  }
}

TEST(ListFilterTest, UnknownWordsAreRefused) {
  EXPECT_THROW(SolveMatcher({.state = "walking"}, kListNow), Failure);
  EXPECT_THROW(SolveMatcher({.verdict = "good"}, kListNow), Failure);
  EXPECT_THROW(SolveMatcher({.termination = "optimum"}, kListNow), Failure);
}

}  // namespace
}  // namespace rollgait::client
