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

v1::ListSolvesRequest Asked(const ListFilter& filter) { return ListRequest(filter, kListNow); }

TEST(ListFilterTest, WithoutAFilterTheRequestHasNone) {
  EXPECT_EQ(Asked({}).ByteSizeLong(), 0u);
  EXPECT_EQ(Asked({.states = {"running"}}).state(), v1::SOLVE_STATE_RUNNING);
  EXPECT_FALSE(Asked({.states = {"running"}}).has_filter()) << "older servers know no filter";
  EXPECT_FALSE(Asked({.tenant = "lab", .name_prefix = "ab"}).has_filter());
  EXPECT_EQ(Asked({.tenant = "lab"}).tenant(), "lab");
}

TEST(ListFilterTest, EveryFlagIsAFieldOfTheFilter) {
  const v1::ListSolvesRequest states = Asked({.states = {"queued", "failed"}});
  EXPECT_EQ(states.state(), v1::SOLVE_STATE_UNSPECIFIED);
  ASSERT_EQ(states.filter().states_size(), 2);
  EXPECT_EQ(states.filter().states(1), v1::SOLVE_STATE_FAILED);
  EXPECT_EQ(Asked({.verdict = "not-judged"}).filter().verdict(), v1::VERDICT_NOT_JUDGED);
  EXPECT_TRUE(Asked({.verdict = "none"}).filter().has_verdict());
  EXPECT_EQ(Asked({.termination = "time-limit"}).filter().termination(), v1::TERMINATION_TIME_LIMIT);
  EXPECT_TRUE(Asked({.termination = "none"}).filter().has_termination());
  EXPECT_EQ(Asked({.model = "planar"}).filter().model(), "planar");
  const v1::SolveFilter labels = Asked({.labels = {"sweep=hills", "by=a=b"}}).filter();
  EXPECT_EQ(labels.labels().at("sweep"), "hills");
  EXPECT_EQ(labels.labels().at("by"), "a=b");
  const v1::SolveFilter times = Asked({.since = "2h", .before = "2025-11-24T12:30"}).filter();
  EXPECT_EQ(times.create_time_from().seconds(), kListNow_s - 7200);
  EXPECT_EQ(times.create_time_before().seconds(), kListNow_s - 41400);
}

TEST(ListFilterTest, NamesAreFilteredHere) {
  EXPECT_TRUE(HasNameOf({}, ListedSolve()));
  EXPECT_TRUE(HasNameOf({.name_prefix = "ab"}, ListedSolve()));
  EXPECT_TRUE(HasNameOf({.name_prefix = "solves/ab12"}, ListedSolve()));
  EXPECT_FALSE(HasNameOf({.name_prefix = "b1"}, ListedSolve()));
  EXPECT_FALSE(HasNameOf({.name_prefix = "solves/ab123"}, ListedSolve()));
}

TEST(ListFilterTest, AModelThatTheRequestCarriesIsOwn) {
  v1::Solve solve = ListedSolve();
  EXPECT_EQ(ListedModel(solve), "planar");
  solve.mutable_spec()->mutable_model()->clear_name();
  solve.mutable_spec()->mutable_model()->mutable_own();
  EXPECT_EQ(ListedModel(solve), "own");
}

TEST(ListFilterTest, SinceIsAnAgeOrADate) {
  EXPECT_EQ(ParseTime("--since", "90s", kListNow), kListNow - std::chrono::seconds(90));
  EXPECT_EQ(ParseTime("--since", "7d", kListNow), kListNow - std::chrono::hours(7 * 24));
  EXPECT_EQ(ParseTime("--since", "2025-11-25", kListNow), kListNow);
  EXPECT_EQ(ParseTime("--since", "2025-11-25T12:30", kListNow), kListNow + std::chrono::minutes(750));
  for (const char* text : {"", "d", "7", "7w", "-7d", "99999999999d", "2025-02-31", "2025-11-25T12", "yesterday"}) {
    EXPECT_THROW(ParseTime("--since", text, kListNow), Failure) << text;
  }
}

TEST(ListFilterTest, UnknownWordsAreRefused) {
  EXPECT_THROW(Asked({.states = {"walking"}}), Failure);
  EXPECT_THROW(Asked({.verdict = "good"}), Failure);
  EXPECT_THROW(Asked({.termination = "optimum"}), Failure);
  EXPECT_THROW(Asked({.labels = {"sweep"}}), Failure);
  EXPECT_THROW(Asked({.labels = {"=hills"}}), Failure);
}

}  // namespace
}  // namespace rollgait::client
