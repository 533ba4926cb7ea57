#include "core/gait/combined_costs.h"

#include <gtest/gtest.h>

#include <variant>

#include "core/gait/presets.h"

namespace rollgait {
namespace {

class CombinedCosts : public testing::Test {
 protected:
  static GaitRequest Human() {
    GaitRequest request;
    request.body.model = "planar";
    request.preset = Preset::kHuman;
    return request;
  }
  std::vector<CombinedCost> Combine(const GaitRequest& request) const {
    return CombineCosts(request, &scene_, Similarity{});
  }
  // Index of the only term of the kind; -1: none or several.
  template <typename Term>
  static int Find(const std::vector<CombinedCost>& costs) {
    int found = -1, count = 0;
    for (size_t i = 0; i < costs.size(); ++i) {
      if (std::holds_alternative<Term>(costs[i].cost.term)) found = static_cast<int>(i), ++count;
    }
    return count == 1 ? found : -1;
  }

  const Scene scene_ = CheckRequest(Human()).value().scene;
  const std::vector<GaitRequest::CostTerm> preset_ = PresetCosts(Preset::kHuman, scene_, Similarity{});
};

TEST_F(CombinedCosts, NothingGivenIsSquaredTorque) {
  const std::vector<CombinedCost> costs = Combine(GaitRequest());
  ASSERT_EQ(costs.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<cost::SquaredTorque>(costs[0].cost.term));
}

TEST_F(CombinedCosts, APresetAloneIsItsTerms) {
  const std::vector<CombinedCost> costs = Combine(Human());
  ASSERT_EQ(costs.size(), preset_.size());
  for (size_t i = 0; i < costs.size(); ++i) {
    EXPECT_EQ(costs[i].field, "preset");
    EXPECT_EQ(costs[i].cost.term.index(), preset_[i].term.index());
    EXPECT_EQ(costs[i].cost.weight, preset_[i].weight);
  }
}

TEST_F(CombinedCosts, AnotherKindIsAdded) {
  GaitRequest request = Human();
  request.costs = {{cost::SquaredForceRate{}, 1e-9}, {cost::Time{}, 2.0}};
  const std::vector<CombinedCost> costs = Combine(request);
  ASSERT_EQ(costs.size(), preset_.size() + 2);
  EXPECT_TRUE(std::holds_alternative<cost::SquaredForceRate>(costs[preset_.size()].cost.term));
  EXPECT_EQ(costs[preset_.size()].cost.weight, 1e-9);
  EXPECT_EQ(costs[preset_.size()].field, "costs[0]");
  EXPECT_EQ(costs.back().field, "costs[1]");
}

TEST_F(CombinedCosts, TheSameKindGetsTheNewWeightAndKeepsTheRest) {
  GaitRequest request = Human();
  request.costs = {{cost::MuscleEffort{}, 3.0}};
  const std::vector<CombinedCost> costs = Combine(request);
  ASSERT_EQ(costs.size(), preset_.size());
  const int effort = Find<cost::MuscleEffort>(costs);
  ASSERT_EQ(effort, 0);
  EXPECT_EQ(costs[0].cost.weight, 3.0);
  EXPECT_EQ(costs[0].field, "costs[0]");
  const auto& of_preset = std::get<cost::MuscleEffort>(preset_[0].term);
  ASSERT_FALSE(of_preset.joint_weights.empty());
  EXPECT_EQ(std::get<cost::MuscleEffort>(costs[0].cost.term).joint_weights, of_preset.joint_weights);
}

TEST_F(CombinedCosts, TheSameKindGetsNewParametersAndKeepsTheWeight) {
  GaitRequest request = Human();
  request.costs = {{cost::MuscleWork{0.3, {}, {}, {}}, {}}, {cost::Tracking{{{"hip_l", {0, 1}, 2.0}}}, {}}};
  const std::vector<CombinedCost> costs = Combine(request);
  const int work = Find<cost::MuscleWork>(costs), tracking = Find<cost::Tracking>(costs);
  ASSERT_GE(work, 0);
  ASSERT_GE(tracking, 0);
  EXPECT_EQ(costs[static_cast<size_t>(work)].cost.weight, 5e-4);
  EXPECT_EQ(std::get<cost::MuscleWork>(costs[static_cast<size_t>(work)].cost.term).positive_efficiency, 0.3);
  EXPECT_EQ(costs[static_cast<size_t>(tracking)].cost.weight, 0.5);
  const auto& channels = std::get<cost::Tracking>(costs[static_cast<size_t>(tracking)].cost.term).channels;
  ASSERT_EQ(channels.size(), 1u);
  EXPECT_EQ(channels[0].joint, "hip_l");
}

TEST_F(CombinedCosts, ASecondTermOfAKindIsAdded) {
  GaitRequest request = Human();
  request.costs = {{cost::PassiveLoad{}, 1.0}, {cost::PassiveLoad{}, 2.0}};
  const std::vector<CombinedCost> costs = Combine(request);
  ASSERT_EQ(costs.size(), preset_.size() + 1);
  EXPECT_EQ(costs.back().cost.weight, 2.0);
}

// A term that a request takes out of the preset is checked and completed like every other.
TEST_F(CombinedCosts, ReachTheSpecification) {
  GaitRequest request = Human();
  request.costs = {{cost::SquaredAcceleration{}, 0.0}, {cost::SquaredForceRate{}, 1e-9}};
  const GaitSpec spec = CheckRequest(request).value();
  ASSERT_EQ(spec.costs.size(), preset_.size() + 1);
  EXPECT_EQ(spec.costs[4].weight, 0);
  EXPECT_EQ(std::get<cost::SquaredAcceleration>(spec.costs[4].term).joint_weights.at("ankle_l"), 2.7);
  EXPECT_EQ(spec.costs.back().weight, 1e-9);
  EXPECT_TRUE(spec.duty_factor);
}

}  // namespace
}  // namespace rollgait
