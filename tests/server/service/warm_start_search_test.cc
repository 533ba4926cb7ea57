#include "server/service/warm_start_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <numbers>

#include "server/base/sanitized.h"
#include "server/base/wire.pb.h"
#include "server/service/solve_key.h"
#include "tests/server/service/service_fixture.h"

namespace rollgait::server {
namespace {

using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180;

// The request of a solve that starts from another.
v1::CreateSolveRequest From(const std::string& start, double slope = 0.1) {
  v1::CreateSolveRequest request;
  *request.mutable_spec() = PlanarSpec(slope);
  request.mutable_spec()->set_warm_start(start);
  return request;
}

class WarmStartSearchTest : public ::testing::Test {
 protected:
  // Id of a solve that has ended; what the fixture knows as a solution for slopes below `objective`.
  std::string Solved(const v1::SolveSpec& spec, v1::Termination termination = v1::TERMINATION_OPTIMAL,
                     double objective = 1) {
    const std::string id = bench_.Create(spec);
    v1::SolveResult result;
    result.set_termination(termination);
    result.set_objective(objective);
    result.set_speed_m_s(spec.motion().has_speed_m_s() ? spec.motion().speed_m_s() : 1.3);
    result.mutable_trajectory()->set_duration_s(0.5);
    result.mutable_multipliers()->add_rows(7);
    const Lease lease = bench_.Claim();
    EXPECT_EQ(lease.solve_id, id);
    EXPECT_TRUE(bench_.store().Finish(lease, {}, {SolveState::kSucceeded, result.SerializeAsString(), "", true}).ok());
    return id;
  }
  Outcome<v1::Solve> Create(const v1::CreateSolveRequest& request) { return bench_.service().CreateSolve({}, request); }
  // What the agent would hand to the solver.
  wire::WarmStart Claimed() {
    wire::WarmStart start;
    EXPECT_TRUE(start.ParseFromString(bench_.store().ClaimNext("agent", kLeaseDuration).value().value().warm_start));
    return start;
  }
  std::string Refusal(const std::string& start, double slope = 0.1) {
    const Outcome<v1::Solve> refused = Create(From(start, slope));
    if (refused.ok() || refused.error().violations.size() != 1) return "not refused";
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    return refused.error().violations[0].field + " " + refused.error().violations[0].message;
  }

  ServiceBench bench_;
};

TEST_F(WarmStartSearchTest, ANamedSolveIsHandedOver) {
  const std::string id = Solved(PlanarSpec(0.1));
  ASSERT_TRUE(Create(From("solves/" + id, 0.1 + kDegree)).ok());
  EXPECT_TRUE(bench_.service()
                  .DeleteSolve({},
                               [&] {
                                 v1::DeleteSolveRequest request;
                                 request.set_name("solves/" + id);
                                 return request;
                               }())
                  .ok());  // a copy was taken
  const wire::WarmStart start = Claimed();
  EXPECT_EQ(start.source().name(), "solves/" + id);
  EXPECT_NEAR(start.source().slope_difference_rad(), kDegree, 1e-15);
  EXPECT_NEAR(start.source().speed_difference_m_s(), 0, 1e-15);
  EXPECT_EQ(start.trajectory().duration_s(), 0.5);
  EXPECT_EQ(start.multipliers().rows(0), 7);
}

TEST_F(WarmStartSearchTest, TheNearestOfTheSameQuestionIsChosen) {
  Solved(PlanarSpec(0.1));
  const std::string near = Solved(PlanarSpec(0.1 + 2 * kDegree));
  v1::SolveSpec other = PlanarSpec(0.1 + 3 * kDegree);
  other.mutable_ground_contact()->set_friction_coefficient(0.7);
  Solved(other);                                                        // another question
  Solved(PlanarSpec(0.1 + 2.9 * kDegree), v1::TERMINATION_ACCEPTABLE);  // no optimum
  v1::SolveSpec fast = PlanarSpec(0.1 + 3 * kDegree);
  fast.mutable_motion()->set_speed_m_s(1.3 + 0.05 * 1.5);  // as far as 1.5 degrees
  Solved(fast);
  ASSERT_TRUE(Create(From("nearest", 0.1 + 3 * kDegree)).ok());
  EXPECT_EQ(Claimed().source().name(), "solves/" + near);
}

TEST_F(WarmStartSearchTest, NothingNearIsAColdStartAndHasItsKey) {
  Solved(PlanarSpec(0.1));
  const v1::Solve far = Create(From("nearest", 0.1 + 5.1 * kDegree)).value();
  EXPECT_FALSE(Claimed().has_trajectory());
  const v1::Solve cold = Create([] {
                           v1::CreateSolveRequest request;
                           *request.mutable_spec() = PlanarSpec(0.1 + 5.1 * kDegree);
                           return request;
                         }())
                             .value();
  const auto key = [this](const v1::Solve& solve) {
    return bench_.store().Get(solve.name().substr(7)).value().solve_key;
  };
  EXPECT_EQ(key(far), key(cold));
}

TEST_F(WarmStartSearchTest, DifferentStartsAreDifferentQuestions) {
  const std::string a = Solved(PlanarSpec(0.1)), b = Solved(PlanarSpec(0.12));
  const auto key = [this](const std::string& start) {
    const v1::Solve solve = Create(From(start, 0.105)).value();
    return bench_.store().Get(solve.name().substr(7)).value().solve_key;
  };
  EXPECT_NE(key("solves/" + a), key("solves/" + b));
  EXPECT_NE(key("solves/" + a), key(""));
  EXPECT_EQ(key("solves/" + a), key("nearest"));
}

TEST_F(WarmStartSearchTest, WhatCannotBeStartedFromIsRefused) {
  EXPECT_THAT(Refusal("yesterday"), HasSubstr("spec.warm_start is \"yesterday\"; give the name of a solve"));
  EXPECT_THAT(Refusal("solves/gone"), HasSubstr("there is no such solve"));
  const std::string poor = Solved(PlanarSpec(0.2), v1::TERMINATION_INFEASIBLE);
  EXPECT_THAT(Refusal("solves/" + poor), HasSubstr("ended TERMINATION_INFEASIBLE"));
  const std::string other = Solved(PlanarSpec(0.3), v1::TERMINATION_OPTIMAL, 0.01);
  EXPECT_THAT(Refusal("solves/" + other), HasSubstr("of another world"));
  const std::string queued = bench_.Create(PlanarSpec(0.4));
  EXPECT_THAT(Refusal("solves/" + queued), HasSubstr("has no result"));
}

TEST_F(WarmStartSearchTest, SolvesOfAnOlderStoreAreFoundOnceTheyAreIndexed) {
  const std::string old = Solved(PlanarSpec(0.1));
  ASSERT_TRUE(bench_.store()
                  .database()
                  .Write([](SqlConnection& connection) -> Outcome<Done> {
                    Query::Do(connection, "DELETE FROM places");
                    return Done{};
                  })
                  .ok());
  ASSERT_TRUE(Create(From("nearest", 0.11)).ok());
  EXPECT_FALSE(Claimed().has_trajectory());
  EXPECT_EQ(PlaceOldSolves(bench_.store()).value(), 1);
  EXPECT_EQ(PlaceOldSolves(bench_.store()).value(), 0);
  ASSERT_TRUE(Create(From("nearest", 0.12)).ok());
  EXPECT_EQ(Claimed().source().name(), "solves/" + old);
}

TEST_F(WarmStartSearchTest, NoTenantStartsFromAnothers) {
  Caller acme, lab;
  acme.authentication = lab.authentication = Authentication::kToken;
  acme.tenant = "acme";
  lab.tenant = "lab";
  v1::CreateSolveRequest first;
  *first.mutable_spec() = PlanarSpec(0.1);
  ASSERT_TRUE(bench_.service().CreateSolve(acme, first).ok());
  bench_.Finish(bench_.Claim());
  v1::CreateSolveRequest second = From("nearest", 0.11);
  EXPECT_TRUE(bench_.service().CreateSolve(lab, second).ok());
  EXPECT_EQ(Claimed().source().name(), "");
}

// 300 solves with specs of 2.6 MB took 10 s to look through.
TEST_F(WarmStartSearchTest, LongSpecsAreNotRead) {
  v1::SolveSpec spec = PlanarSpec(0.1);
  spec.add_costs()->mutable_tracking()->add_channels()->mutable_positions()->Resize(2'600'000 / 8, 0.5);
  const std::string bytes = CanonicalBytes(spec);
  v1::SolveResult result;
  result.set_termination(v1::TERMINATION_OPTIMAL);
  result.set_objective(1);
  const SolveEnd end{SolveState::kSucceeded, result.SerializeAsString(), "", false};
  for (int i = 0; i < 40; ++i) {
    NewSolve solve{"long-" + std::to_string(i), "", bytes, ""};
    solve.place = PlaceOf(PlanarSpec(0.1 + 1e-3 * i));
    ASSERT_TRUE(bench_.store().Create(solve).ok());
    ASSERT_TRUE(bench_.store().Finish(bench_.Claim(), {}, end).ok());
  }
  v1::CreateSolveRequest request = From("nearest", 0.1);
  request.set_validate_only(true);
  const auto start = std::chrono::steady_clock::now();
  constexpr int kCalls = 20;
  for (int i = 0; i < kCalls; ++i) ASSERT_TRUE(Create(request).ok());
  const std::chrono::duration<double> each = (std::chrono::steady_clock::now() - start) / kCalls;
  EXPECT_LT(each.count(), kSanitized ? 0.5 : 0.1) << "s a call: one spec is read, not all";
}

TEST(PlaceOf, SeparatesQuestionsAndPrescribedFromFreeSpeeds) {
  v1::SolveSpec a = PlanarSpec(0), b = PlanarSpec(3 * kDegree);
  EXPECT_EQ(PlaceOf(a).question, PlaceOf(b).question);
  EXPECT_NEAR(PlaceOf(b).slope_rad, 3 * kDegree, 1e-15);
  EXPECT_NEAR(PlaceOf(a).speed_m_s, 1.3, 0.01);
  b.mutable_motion()->set_step_length_m(0.75);
  b.mutable_motion()->set_step_duration_s(0.5);
  EXPECT_EQ(PlaceOf(a).question, PlaceOf(b).question);
  EXPECT_NEAR(PlaceOf(b).speed_m_s, 1.5, 1e-12);
  b.mutable_motion()->set_free_speed(true);
  EXPECT_NE(PlaceOf(a).question, PlaceOf(b).question);
  EXPECT_EQ(PlaceOf(b).speed_m_s, 0);
  a.mutable_ground_contact()->set_friction_coefficient(0.7);
  EXPECT_NE(PlaceOf(a).question, PlaceOf(PlanarSpec(0)).question);
}

}  // namespace
}  // namespace rollgait::server
