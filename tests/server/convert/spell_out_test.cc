#include "server/convert/spell_out.h"

#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include "server/convert/cost_convert.h"
#include "server/convert/gait_request_convert.h"

namespace rollgait::server {
namespace {

using google::protobuf::util::MessageDifferencer;

v1::SolveSpec Planar(v1::Preset preset) {
  v1::SolveSpec spec;
  spec.mutable_model()->set_name("planar");
  spec.set_preset(preset);
  return spec;
}

// The costs as they are checked and completed, as messages.
std::vector<std::string> Costs(const GaitSpec& spec) {
  std::vector<std::string> costs;
  for (const GaitSpec::CostTerm& cost : spec.costs) costs.push_back(EncodeCost({cost.term, cost.weight}).DebugString());
  return costs;
}

// The question is the same question, and spelled out again it stays as it is.
void ExpectTheSameQuestion(const v1::SolveSpec& spec) {
  const v1::SolveSpec spelled = SpellOut(spec).value();
  EXPECT_GT(spelled.costs_size(), 0);
  const GaitSpec before = DecodeSpec(spec).value(), after = DecodeSpec(spelled).value();
  EXPECT_EQ(Costs(after), Costs(before));
  EXPECT_EQ(after.passive_scale, before.passive_scale);
  EXPECT_EQ(after.swing_clearance, before.swing_clearance);
  EXPECT_EQ(after.duty_factor.has_value(), before.duty_factor.has_value());
  EXPECT_EQ(after.duty_factor.value_or(GaitRequest::Range{}).min,
            before.duty_factor.value_or(GaitRequest::Range{}).min);
  ASSERT_EQ(after.scene.contacts.size(), before.scene.contacts.size());
  for (int joint = 0; joint < before.scene.model.nv(); ++joint) {
    EXPECT_EQ(after.scene.model.joint(joint).effort_max, before.scene.model.joint(joint).effort_max);
    EXPECT_EQ(after.scene.model.joint(joint).velocity_max, before.scene.model.joint(joint).velocity_max);
  }
  EXPECT_TRUE(MessageDifferencer::Equals(SpellOut(spelled).value(), spelled));
}

TEST(SpellOut, EveryPresetIsTheSameQuestion) {
  for (const v1::Preset preset : {v1::PRESET_TORQUE, v1::PRESET_TRANSPORT, v1::PRESET_HUMAN}) {
    SCOPED_TRACE(v1::Preset_Name(preset));
    v1::SolveSpec spec = Planar(preset);
    EXPECT_EQ(SpellOut(spec).value().preset(), v1::PRESET_UNSPECIFIED);
    ExpectTheSameQuestion(spec);
    spec.mutable_model()->set_body_mass_kg(60);
    spec.add_costs()->mutable_squared_force_rate();
    spec.mutable_costs(0)->set_weight(1e-9);
    spec.add_costs()->mutable_muscle_effort();
    spec.mutable_costs(1)->set_weight(2);
    ExpectTheSameQuestion(spec);
  }
}

// Where gravity is another, the preset also scales the body, which nothing else can say.
TEST(SpellOut, ThePresetStaysOnTheMoon) {
  v1::SolveSpec spec = Planar(v1::PRESET_HUMAN);
  spec.set_gravity_m_s2(1.62);
  EXPECT_EQ(SpellOut(spec).value().preset(), v1::PRESET_HUMAN);
  ExpectTheSameQuestion(spec);
}

TEST(SpellOut, WithoutAPresetNothingChanges) {
  v1::SolveSpec spec = Planar(v1::PRESET_UNSPECIFIED);
  EXPECT_TRUE(MessageDifferencer::Equals(SpellOut(spec).value(), spec));
}

TEST(SpellOut, RefusesWhatASolveRefuses) {
  v1::SolveSpec spec = Planar(v1::PRESET_HUMAN);
  spec.set_slope_rad(3);
  const Result<v1::SolveSpec> spelled = SpellOut(spec);
  ASSERT_FALSE(spelled.ok());
  EXPECT_EQ(spelled.violations()[0].field, "slope_rad");
}

}  // namespace
}  // namespace rollgait::server
