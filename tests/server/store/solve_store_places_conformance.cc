// The index of `nearest`.
#include <string>

#include "tests/server/store/store_bench.h"

namespace rollgait::server {
namespace {

constexpr double kSlope = 0.02, kSpeed = 0.05;

void Solve(StoreBench& bench, const std::string& id, const SolvePlace& place,
           v1::Termination termination = v1::TERMINATION_OPTIMAL, const std::string& tenant = "") {
  NewSolve solve{id, "", "spec", ""};
  solve.place = place;
  solve.actor.tenant = tenant;
  ASSERT_TRUE(bench.store().Create(solve).ok());
  v1::SolveResult result;
  result.set_termination(termination);
  ASSERT_TRUE(
      bench.store().Finish(bench.Claim(), {}, {SolveState::kSucceeded, result.SerializeAsString(), "", true}).ok());
}

std::string Nearest(StoreBench& bench, const SolvePlace& place,
                    const std::optional<std::string>& tenant = std::nullopt) {
  return bench.store().Nearest({place, tenant, kSlope, kSpeed, 5}).value();
}

TEST_P(SolveStoreConformance, TheNearestIsFoundByItsDistance) {
  StoreBench bench(GetParam());
  Solve(bench, "a", {"q", 0, 1.3});
  Solve(bench, "b", {"q", 2 * kSlope, 1.3});
  Solve(bench, "fast", {"q", 3 * kSlope, 1.3 + 1.5 * kSpeed});
  Solve(bench, "other", {"another question", 3 * kSlope, 1.3});
  Solve(bench, "poor", {"q", 3 * kSlope, 1.3}, v1::TERMINATION_ACCEPTABLE);
  EXPECT_EQ(Nearest(bench, {"q", 3 * kSlope, 1.3}), "b") << "1 away; fast is 1.5 away";
  EXPECT_EQ(Nearest(bench, {"q", 0.4 * kSlope, 1.3}), "a");
  EXPECT_EQ(Nearest(bench, {"q", 3 * kSlope, 1.3 + kSpeed}), "fast");
  EXPECT_EQ(Nearest(bench, {"q", -5.1 * kSlope, 1.3}), "") << "too far";
  EXPECT_EQ(Nearest(bench, {"q", -4 * kSlope, 1.3 - 4 * kSpeed}), "") << "within the rectangle, not the circle";
  EXPECT_EQ(Nearest(bench, {"none", 0, 1.3}), "");
  EXPECT_EQ(Nearest(bench, {"", 0, 0}), "") << "nowhere";
}

TEST_P(SolveStoreConformance, TheNearestIsTheTenantsOwnTheYoungestAndGoesWithItsSolve) {
  StoreBench bench(GetParam());
  Solve(bench, "a", {"q", 0, 0}, v1::TERMINATION_OPTIMAL, "acme");
  Solve(bench, "b", {"q", 0, 0}, v1::TERMINATION_OPTIMAL, "lab");
  Solve(bench, "c", {"q", 0, 0}, v1::TERMINATION_OPTIMAL, "lab");
  EXPECT_EQ(Nearest(bench, {"q", 0, 0}, "acme"), "a");
  EXPECT_EQ(Nearest(bench, {"q", 0, 0}, "lab"), "c");
  EXPECT_EQ(Nearest(bench, {"q", 0, 0}, "nobody"), "");
  EXPECT_EQ(Nearest(bench, {"q", 0, 0}), "c");
  ASSERT_TRUE(bench.store().Delete("c").ok());
  EXPECT_EQ(Nearest(bench, {"q", 0, 0}), "b");
}

TEST_P(SolveStoreConformance, ASolveThatIsAnsweredFromTheCacheHasAPlaceToo) {
  StoreBench bench(GetParam());
  v1::SolveResult result;
  result.set_termination(v1::TERMINATION_OPTIMAL);
  const SolveEnd end{SolveState::kSucceeded, result.SerializeAsString(), "", true};
  const auto add = [&](const std::string& id) {
    NewSolve solve{id, "", "spec", "key"};
    solve.place = {"q", 0, 0};
    ASSERT_TRUE(bench.store().Create(solve).ok());
  };
  add("first");
  add("waits");
  ASSERT_TRUE(bench.store().Finish(bench.Claim(), {}, end).ok());
  add("cached");
  EXPECT_EQ(Nearest(bench, {"q", 0, 0}), "cached");
  ASSERT_TRUE(bench.store().Delete("cached").ok());
  EXPECT_EQ(Nearest(bench, {"q", 0, 0}), "waits");
  EXPECT_TRUE(bench.store().Unplaced(0, 10).value().empty());
}

}  // namespace
}  // namespace rollgait::server
