// Whose turn it is to run.
#include <algorithm>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "server/store/fair_order.h"
#include "tests/server/store/store_bench.h"

namespace rollgait::server {
namespace {

using Ids = std::vector<std::string>;

class Queue {
 public:
  explicit Queue(const StoreKind& kind) : bench_(kind) {}

  StoreBench& bench() { return bench_; }
  SolveStore& store() { return bench_.store(); }
  void Add(const std::string& tenant, const std::string& id, int priority = 0, const std::string& key = "") {
    NewSolve solve{id, "", "spec of " + id, key};
    solve.actor.tenant = tenant;
    solve.priority = priority;
    ASSERT_TRUE(store().Create(solve).ok());
  }
  void AddMany(const std::string& tenant, int count) {
    for (int i = 0; i < count; ++i) Add(tenant, tenant + std::to_string(made_++));
  }
  void SetWeight(const std::string& tenant, int weight) { SetTenant(tenant, weight, -1); }
  void SetTenant(const std::string& tenant, int weight, int max_running) {
    const auto set = bench_.OpenAgain()->database().Write([&](SqlConnection& connection) -> Outcome<Done> {
      Query::Do(connection, "INSERT INTO tenants (tenant, weight, max_running) VALUES (?, ?, ?)", tenant, weight,
                max_running);
      return Done{};
    });
    ASSERT_TRUE(set.ok());
  }
  SolveRecord Claim() { return store().ClaimNext("agent", kLeaseDuration).value().value().record; }
  // The initials of the tenants of the next claims.
  std::string Tenants(int claims) {
    std::string tenants;
    for (int i = 0; i < claims; ++i) tenants += Claim().tenant[0];
    return tenants;
  }
  Ids ClaimIds(int claims) {
    Ids ids;
    for (int i = 0; i < claims; ++i) ids.push_back(Claim().id);
    return ids;
  }

 private:
  StoreBench bench_;
  int made_ = 0;
};

int64_t Count(const std::string& text, char letter) { return std::count(text.begin(), text.end(), letter); }

TEST_P(SolveStoreConformance, TenantsTakeTurnsWhateverTheLengthOfTheirQueues) {
  Queue queue(GetParam());
  queue.AddMany("red", 20);
  queue.AddMany("blue", 3);
  EXPECT_EQ(queue.Tenants(8), "brbrbrrr");
  queue.AddMany("green", 2);
  EXPECT_EQ(Count(queue.Tenants(4), 'g'), 2);
}

TEST_P(SolveStoreConformance, ATenantGetsTurnsInProportionToItsWeight) {
  Queue queue(GetParam());
  queue.SetWeight("red", 3);
  queue.AddMany("blue", 40);
  queue.AddMany("red", 40);
  const std::string turns = queue.Tenants(40);
  EXPECT_EQ(Count(turns, 'r'), 30);
  for (size_t from = 0; from + 8 <= turns.size(); ++from) {
    const int64_t reds = Count(turns.substr(from, 8), 'r');
    EXPECT_TRUE(reds >= 5 && reds <= 7) << turns << " from " << from;
  }
}

TEST_P(SolveStoreConformance, ATenantThatWasAwayHasNoCredit) {
  Queue queue(GetParam());
  queue.AddMany("blue", 1);
  queue.AddMany("red", 60);
  queue.AddMany("green", 60);
  EXPECT_EQ(Count(queue.Tenants(41), 'b'), 1);
  queue.AddMany("blue", 20);
  const std::string turns = queue.Tenants(12);
  EXPECT_LE(Count(turns, 'b'), 5) << turns;
  EXPECT_GE(Count(turns, 'b'), 3) << turns;
  EXPECT_GE(Count(turns, 'r'), 3) << turns;
}

TEST_P(SolveStoreConformance, ATenantThatWasAloneHasNoDebt) {
  Queue queue(GetParam());
  queue.AddMany("red", 40);
  EXPECT_EQ(Count(queue.Tenants(20), 'r'), 20);
  queue.AddMany("blue", 20);
  const std::string turns = queue.Tenants(12);
  EXPECT_EQ(Count(turns, 'r'), 6) << turns;
}

TEST_P(SolveStoreConformance, ATenantThatMayNotRunMoreIsPassedOver) {
  Queue queue(GetParam());
  queue.SetTenant("blue", -1, 1);
  queue.AddMany("blue", 5);
  queue.AddMany("red", 5);
  EXPECT_EQ(queue.Tenants(6), "brrrrr");
  EXPECT_FALSE(queue.bench().CanClaim());
  queue.Add("green", "g", 0, "key");
  queue.Add("green", "h", 0, "key");
  queue.AddMany("red", 1);
  EXPECT_EQ(Count(queue.Tenants(2), 'g'), 1) << "single flight holds the other back";
  EXPECT_FALSE(queue.bench().CanClaim());
}

TEST_P(SolveStoreConformance, TheHighestPriorityOfATenantIsFirstAndThenTheOldest) {
  Queue queue(GetParam());
  queue.Add("red", "low", -10);
  queue.Add("red", "first");
  queue.Add("red", "second");
  queue.Add("red", "high", 10);
  EXPECT_EQ(queue.bench().Get("high").priority, 10);
  EXPECT_EQ(queue.bench().store().List({}).value().records.back().priority, -10);
  EXPECT_EQ(queue.ClaimIds(4), (Ids{"high", "first", "second", "low"}));
}

TEST_P(SolveStoreConformance, APriorityMeansNothingToOtherTenants) {
  Queue queue(GetParam());
  for (int i = 0; i < 6; ++i) queue.Add("red", "red" + std::to_string(i), kMostPriority);
  for (int i = 0; i < 6; ++i) queue.Add("blue", "blue" + std::to_string(i), kLeastPriority);
  EXPECT_EQ(Count(queue.Tenants(6), 'b'), 3);
}

TEST_P(SolveStoreConformance, ThePriorityOfAQueuedSolveCanBeChanged) {
  Queue queue(GetParam());
  queue.Add("red", "a");
  queue.Add("red", "b");
  const Actor boss{"operators", "boss", "unix:"};
  EXPECT_EQ(queue.store().SetPriority("b", 3, boss).value().priority, 3);
  EXPECT_EQ(queue.store().SetPriority("b", 3, boss).value().priority, 3) << "nothing changes the second time";
  EXPECT_EQ(queue.bench().Get("b").priority, 3);
  EXPECT_EQ(queue.bench().Get("b").last_sequence, 1) << "no event";
  const AuditRow audit = queue.store().ReadAudit(0, 100).value().back();
  EXPECT_EQ(audit.action + " " + audit.solve + " " + audit.outcome + " " + audit.detail,
            "set priority b queued of tenant red, 0 to 3");
  EXPECT_EQ(queue.store().ReadAudit(0, 100).value().size(), 3u);
  EXPECT_EQ(queue.Claim().id, "b");
  EXPECT_EQ(queue.store().SetPriority("b", 3, boss).value().state, SolveState::kRunning) << "a late retry";
  const auto running = queue.store().SetPriority("b", 4, boss);
  ASSERT_FALSE(running.ok());
  EXPECT_EQ(running.error().code, ErrorCode::kFailedPrecondition);
  EXPECT_NE(running.error().message.find("has begun to run"), std::string::npos) << running.error().message;
  EXPECT_EQ(queue.store().SetPriority("none", 4, boss).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(queue.bench().Get("b").priority, 3);
}

// As agents of PostgreSQL do: none of them sees the claims of the others when it chooses.
TEST_P(SolveStoreConformance, AgentsThatChooseOneTenantAtTheSameTimeTakeNothingFromTheOther) {
  Queue queue(GetParam());
  queue.AddMany("red", 20);
  queue.AddMany("blue", 20);
  const auto claims_of = [&](const std::string& tenant, int claims, const Share& chosen_by) {
    const auto counted = queue.bench().OpenAgain()->database().Write([&](SqlConnection& connection) -> Outcome<Done> {
      for (int i = 0; i < claims; ++i) CountClaim(connection, tenant, chosen_by);
      return Done{};
    });
    ASSERT_TRUE(counted.ok());
  };
  claims_of("blue", 4, {});
  EXPECT_EQ(queue.Tenants(6), "rrrrbr") << "red catches up";
  claims_of("red", 3, {.finish_tag = 5 * kClaimCost, .virtual_time = 4 * kClaimCost});
  EXPECT_EQ(queue.Tenants(4), "bbbb") << "and blue";
}

TEST_P(SolveStoreConformance, AgentsThatClaimAtTheSameTimeShareAllTheSame) {
  constexpr int kAgents = 4, kClaims = 10;
  Queue queue(GetParam());
  queue.AddMany("red", 60);
  queue.AddMany("blue", 40);
  std::mutex mutex;
  std::map<std::string, int> claims;
  std::vector<std::thread> agents;
  for (int i = 0; i < kAgents; ++i) {
    agents.emplace_back([&] {
      for (int k = 0; k < kClaims; ++k) {
        const std::string tenant = queue.Claim().tenant;
        const std::lock_guard<std::mutex> lock(mutex);
        ++claims[tenant];
      }
    });
  }
  for (std::thread& agent : agents) agent.join();
  EXPECT_EQ(claims["red"] + claims["blue"], kAgents * kClaims);
  EXPECT_LE(std::abs(claims["red"] - claims["blue"]), 1 + kAgents) << claims["red"] << " red";
}

}  // namespace
}  // namespace rollgait::server
