// What lists filter by, and solves that are created together.
#include <vector>

#include "tests/server/store/store_bench.h"

namespace rollgait::server {
namespace {

using Ids = std::vector<std::string>;

NewSolve Labelled(const std::string& id, const Labels& labels, const std::string& tenant = "") {
  NewSolve solve{id, "", "spec of " + id, ""};
  solve.labels = labels;
  solve.actor.tenant = tenant;
  return solve;
}

TEST_P(SolveStoreConformance, LabelsComeBackWhateverIsAsked) {
  StoreBench bench(GetParam());
  const Labels labels = {{"sweep", "hills = \"steep\" ~"}, {"author", "me"}};
  NewSolve solve = Labelled("a", labels);
  solve.request_id = "r";
  EXPECT_EQ(bench.store().Create(solve).value().record.labels, labels);
  bench.Restart();
  EXPECT_EQ(bench.Get("a").labels, labels);
  EXPECT_EQ(bench.store().Create(solve).value().record.labels, labels) << "an earlier request";
  EXPECT_EQ(bench.store().List({10, "", std::nullopt}).value().records[0].labels, labels);
  const ClaimedSolve claimed = bench.store().ClaimNext("agent", kLeaseDuration).value().value();
  EXPECT_EQ(claimed.record.labels, labels);
  ASSERT_TRUE(bench.store().Finish(claimed.lease, {}, kAnswer).ok());
  EXPECT_EQ(bench.Get("a").labels, labels);
  ASSERT_TRUE(bench.store().Delete("a").ok());
  EXPECT_EQ(Listed(bench.store(), {.labels = {{"author", "me"}}}), Ids());
}

TEST_P(SolveStoreConformance, ARequestIdWithOtherLabelsIsAnotherRequest) {
  StoreBench bench(GetParam());
  NewSolve solve = Labelled("a", {{"sweep", "x"}});
  solve.request_id = "r";
  ASSERT_TRUE(bench.store().Create(solve).ok());
  solve.labels = {{"sweep", "y"}};
  const auto refused = bench.store().Create(solve);
  EXPECT_EQ(refused.error().code, ErrorCode::kAlreadyExists);
  EXPECT_NE(refused.error().message.find("other labels"), std::string::npos) << refused.error().message;
}

TEST_P(SolveStoreConformance, LabelsCountTowardsWhatATenantStores) {
  StoreBench bench(GetParam());
  NewSolve solve = Labelled("a", {{"key", std::string(64, 'v')}}, "red");
  solve.max_bytes_tenant = static_cast<int64_t>(solve.spec.size()) + 66;
  EXPECT_EQ(bench.store().Create(solve).error().code, ErrorCode::kResourceExhausted);
  solve.max_bytes_tenant += 1;
  EXPECT_TRUE(bench.store().Create(solve).ok());
}

TEST_P(SolveStoreConformance, ListsAreOfThoseThatCarryAllLabels) {
  StoreBench bench(GetParam());
  ASSERT_TRUE(bench.store().Create(Labelled("a", {{"sweep", "x"}, {"slope", "1"}}, "red")).ok());
  ASSERT_TRUE(bench.store().Create(Labelled("b", {{"sweep", "x"}, {"slope", "2"}}, "red")).ok());
  ASSERT_TRUE(bench.store().Create(Labelled("c", {{"sweep", "x"}}, "blue")).ok());
  ASSERT_TRUE(bench.store().Create(Labelled("d", {{"slope", "x"}, {"other", "1"}}, "red")).ok());
  EXPECT_EQ(Listed(bench.store(), {.labels = {{"sweep", "x"}}}), (Ids{"c", "b", "a"}));
  EXPECT_EQ(Listed(bench.store(), {.labels = {{"sweep", "x"}}}, "red"), (Ids{"b", "a"}));
  EXPECT_EQ(Listed(bench.store(), {.labels = {{"sweep", "x"}, {"slope", "1"}}}), Ids{"a"});
  EXPECT_EQ(Listed(bench.store(), {.labels = {{"sweep", "x"}, {"slope", "1"}}}, "blue"), Ids());
  EXPECT_EQ(Listed(bench.store(), {.labels = {{"sweep", "1"}}}), Ids());
  EXPECT_EQ(Listed(bench.store(), {.labels = {{"sweep", "x"}, {"slope", "1"}, {"a", ""}, {"b", ""}}}), Ids());
}

TEST_P(SolveStoreConformance, ListsFilterByAllThatIsAsked) {
  StoreBench bench(GetParam());
  const auto add = [&](const std::string& id, const std::string& model) {
    NewSolve solve = Labelled(id, {{"l", "v"}});
    solve.model = model;
    ASSERT_TRUE(bench.store().Create(solve).ok());
    bench.clock().Advance(std::chrono::seconds(10));
  };
  const auto finish = [&](v1::Termination termination, v1::Verdict verdict) {
    v1::SolveResult result;
    result.set_termination(termination);
    result.mutable_accuracy()->set_verdict(verdict);
    const std::string text = result.SerializeAsString();
    ASSERT_TRUE(bench.store().Finish(bench.Claim(), {}, {SolveState::kSucceeded, text, "", true}).ok());
  };
  const int64_t start_us = bench.clock().WallMicros();
  add("optimal", "planar");
  add("infeasible", "planar");
  add("silent", "own");
  add("runs", "planar");
  add("waits", "human29");
  finish(v1::TERMINATION_OPTIMAL, v1::VERDICT_EXCEEDED);
  finish(v1::TERMINATION_INFEASIBLE, v1::VERDICT_NOT_JUDGED);
  finish(v1::TERMINATION_OPTIMAL, v1::VERDICT_UNSPECIFIED);
  bench.Claim();
  const int64_t second_us = 1'000'000;
  const struct {
    SolveFilter filter;
    Ids ids;
  } kCases[] = {
      {{}, {"waits", "runs", "silent", "infeasible", "optimal"}},
      {{.states = {SolveState::kQueued, SolveState::kRunning}}, {"waits", "runs"}},
      {{.states = {SolveState::kFailed}}, {}},
      {{.termination = v1::TERMINATION_OPTIMAL}, {"silent", "optimal"}},
      {{.termination = v1::TERMINATION_UNSPECIFIED}, {"waits", "runs"}},
      {{.verdict = v1::VERDICT_EXCEEDED}, {"optimal"}},
      {{.verdict = v1::VERDICT_NOT_JUDGED}, {"silent", "infeasible"}},
      {{.verdict = v1::VERDICT_UNSPECIFIED}, {"waits", "runs"}},
      {{.model = "planar"}, {"runs", "infeasible", "optimal"}},
      {{.model = "plan"}, {}},
      {{.created_from_us = start_us + 10 * second_us}, {"waits", "runs", "silent", "infeasible"}},
      {{.created_from_us = start_us + 10 * second_us, .created_before_us = start_us + 20 * second_us}, {"infeasible"}},
      {{.states = {SolveState::kSucceeded}, .termination = v1::TERMINATION_OPTIMAL, .model = "own"}, {"silent"}},
  };
  for (const auto& [filter, ids] : kCases) {
    for (const bool labelled : {false, true}) {
      for (const std::optional<std::string>& tenant : {std::optional<std::string>(), std::optional<std::string>("")}) {
        SolveFilter asked = filter;
        if (labelled) asked.labels = {{"l", "v"}};
        EXPECT_EQ(Listed(bench.store(), asked, tenant), ids) << FilterText(asked) << (tenant ? " of a tenant" : "");
      }
    }
  }
  SolveFilter running;
  running.model = "planar";
  EXPECT_EQ(bench.store().List({10, "", SolveState::kRunning, std::nullopt, running}).value().records.size(), 1u);
}

TEST_P(SolveStoreConformance, PagesOfAFilterAreWholeAndTheirTokensBelongToIt) {
  StoreBench bench(GetParam());
  for (size_t i = 0; i < 7; ++i) {
    NewSolve solve = Labelled(Numbered("s", i), {{"parity", i % 2 == 0 ? "even" : "odd"}});
    solve.model = i % 2 == 0 ? "planar" : "human29";
    ASSERT_TRUE(bench.store().Create(solve).ok());
  }
  const SolveFilter of_model = {.model = "planar"}, of_label = {.labels = {{"parity", "even"}}};
  for (const SolveFilter& filter : {of_model, of_label}) {
    ListQuery query{2, "", std::nullopt, std::nullopt, filter};
    Ids ids;
    do {
      const SolvePage page = bench.store().List(query).value();
      for (const SolveRecord& record : page.records) ids.push_back(record.id);
      query.page_token = page.next_page_token;
    } while (!query.page_token.empty());
    EXPECT_EQ(ids, (Ids{"s6", "s4", "s2", "s0"}));
  }
  const std::string token = bench.store().List({1, "", std::nullopt, std::nullopt, of_label}).value().next_page_token;
  EXPECT_TRUE(bench.store().List({1, token, std::nullopt, std::nullopt, of_label}).ok());
  SolveFilter of_other = of_label;
  of_other.labels = {{"parity", "odd"}};
  for (const SolveFilter& other : {SolveFilter(), of_model, of_other}) {
    const auto refused = bench.store().List({1, token, std::nullopt, std::nullopt, other});
    ASSERT_FALSE(refused.ok()) << FilterText(other);
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  }
}

TEST_P(SolveStoreConformance, NewestNumbersOfManySolvesAreReadAtOnce) {
  StoreBench bench(GetParam());
  std::vector<std::string> ids = {"nobody", "' OR ''='"};
  for (size_t i = 0; i < 40; ++i) {
    bench.Add(Numbered("s", i));
    ids.push_back(Numbered("s", i));
  }
  bench.Claim();  // s0
  const std::map<std::string, int64_t> numbers = bench.store().LastSequences(ids).value();
  EXPECT_EQ(numbers.size(), 40u);
  EXPECT_EQ(numbers.at("s0"), 2);
  EXPECT_EQ(numbers.at("s39"), 1);
  EXPECT_TRUE(bench.store().LastSequences({}).value().empty());
}

std::vector<NewSolve> Batch(size_t count, int max_queued = 1000) {
  std::vector<NewSolve> solves;
  for (size_t i = 0; i < count; ++i) {
    solves.push_back({Numbered("b", i), Numbered("request", i), Numbered("spec", i), "", max_queued});
  }
  return solves;
}

TEST_P(SolveStoreConformance, ABatchIsCreatedInItsOrderAndOnce) {
  StoreBench bench(GetParam());
  for (const bool first : {true, false}) {
    std::vector<NewSolve> batch = Batch(5);
    if (!first) {
      for (NewSolve& solve : batch) solve.id += "again";
    }
    const std::vector<CreatedSolve> made = bench.store().CreateAll(batch).value();
    ASSERT_EQ(made.size(), 5u);
    for (size_t i = 0; i < made.size(); ++i) {
      EXPECT_EQ(made[i].record.id, Numbered("b", i));
      EXPECT_EQ(made[i].created, first);
    }
  }
  EXPECT_EQ(Listed(bench.store(), {}), (Ids{"b4", "b3", "b2", "b1", "b0"}));
  EXPECT_EQ(bench.Events("b3").size(), 1u);
  EXPECT_TRUE(bench.store().CreateAll({}).value().empty());
}

TEST_P(SolveStoreConformance, ABatchThatDoesNotFitLeavesNothing) {
  StoreBench bench(GetParam());
  ASSERT_TRUE(bench.store().Create({"old", "request1", "spec1", ""}).ok());
  const auto full = bench.store().CreateAll(Batch(4, 3));
  ASSERT_FALSE(full.ok());
  EXPECT_EQ(full.error().code, ErrorCode::kResourceExhausted);
  EXPECT_TRUE(full.error().retry_after.has_value());
  EXPECT_NE(full.error().message.find("all of 4 requests"), std::string::npos) << full.error().message;
  EXPECT_EQ(Listed(bench.store(), {}), Ids{"old"});
  EXPECT_EQ(bench.store().CreateAll(Batch(3, 3)).value()[1].record.id, "old") << "one of them needs no place";
  std::vector<NewSolve> clash = Batch(5);
  clash[4].request_id = "request0";
  const auto refused = bench.store().CreateAll(clash);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kAlreadyExists);
  EXPECT_EQ(refused.error().message.find("requests[4].request_id"), 0u) << refused.error().message;
  EXPECT_EQ(bench.store().Counts().value().queued, 3);
}

TEST_P(SolveStoreConformance, ABatchIsHeldAgainstTheTenantsLimits) {
  StoreBench bench(GetParam());
  std::vector<NewSolve> batch = Batch(3);
  for (NewSolve& solve : batch) {
    solve.actor.tenant = "red";
    solve.max_queued_tenant = 2;
  }
  const auto queued = bench.store().CreateAll(batch);
  ASSERT_FALSE(queued.ok());
  ASSERT_TRUE(queued.error().quota.has_value());
  EXPECT_EQ(queued.error().quota->subject, "tenant:red");
  for (NewSolve& solve : batch) {
    solve.max_queued_tenant = 3;
    solve.max_bytes_tenant = 14;  // of 15
  }
  EXPECT_EQ(bench.store().CreateAll(batch).error().code, ErrorCode::kResourceExhausted);
  for (NewSolve& solve : batch) solve.max_bytes_tenant = 15;
  EXPECT_TRUE(bench.store().CreateAll(batch).ok()) << "what was refused does not count";
}

TEST_P(SolveStoreConformance, ABatchIsAnsweredFromTheStoreToo) {
  StoreBench bench(GetParam());
  bench.Add("a", "key");
  ASSERT_TRUE(bench.store().Finish(bench.Claim(), {}, kAnswer).ok());
  std::vector<NewSolve> batch = Batch(2);
  batch[1].solve_key = "key";
  const std::vector<CreatedSolve> made = bench.store().CreateAll(batch).value();
  EXPECT_EQ(made[0].record.state, SolveState::kQueued);
  EXPECT_EQ(made[1].record.state, SolveState::kSucceeded);
  EXPECT_TRUE(made[1].record.from_cache);
  EXPECT_EQ(made[1].record.result, "") << "a batch has no results";
  EXPECT_EQ(bench.Get("b1").result, "the result");
}

}  // namespace
}  // namespace rollgait::server
