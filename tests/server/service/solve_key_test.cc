#include "server/service/solve_key.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace rollgait::server {
namespace {

v1::SolveSpec SpecWithWeights(const std::vector<std::string>& joints) {
  v1::SolveSpec spec;
  auto& weights = *spec.add_costs()->mutable_squared_torque()->mutable_joint_weights();
  for (const std::string& joint : joints) weights[joint] = 1.0;
  return spec;
}

TEST(SolveKeyTest, TheOrderOfMapEntriesDoesNotMatter) {
  const v1::Model model;
  const v1::SolveSpec one = SpecWithWeights({"a", "b", "c", "d", "e", "f", "g", "h"});
  const v1::SolveSpec two = SpecWithWeights({"h", "g", "f", "e", "d", "c", "b", "a"});
  EXPECT_EQ(SolveKey(one, model, "build"), SolveKey(two, model, "build"));
  EXPECT_EQ(CanonicalBytes(one), CanonicalBytes(two));
}

TEST(SolveKeyTest, RequestModelAndBuildAllCount) {
  v1::SolveSpec other_spec;
  other_spec.set_slope_rad(0.1);
  v1::Model other_model;
  other_model.set_total_mass_kg(70);
  const std::set<std::string> keys = {
      SolveKey({}, {}, "build"),       SolveKey(other_spec, {}, "build"),    SolveKey({}, other_model, "build"),
      SolveKey({}, {}, "other build"), SolveKey({}, {}, "build", "a start"), SolveKey({}, {}, "build", "another")};
  EXPECT_EQ(keys.size(), 6u);
  EXPECT_EQ(keys.begin()->size(), 64u);
}

}  // namespace
}  // namespace rollgait::server
