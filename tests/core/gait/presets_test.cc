#include "core/gait/presets.h"

#include <gtest/gtest.h>

#include <variant>

namespace rollgait {
namespace {

GaitRequest Request(const char* model, Preset preset) {
  GaitRequest request;
  request.body.model = model;
  request.preset = preset;
  return request;
}

TEST(Presets, FitEveryBody) {
  for (const char* model : {"planar", "human29"}) {
    for (const Preset preset : {Preset::kTorque, Preset::kTransport, Preset::kHuman}) {
      const Result<GaitSpec> spec = CheckRequest(Request(model, preset));
      ASSERT_TRUE(spec.ok()) << model << ": " << spec.violations()[0].message;
      EXPECT_FALSE(spec.value().costs.empty());
    }
  }
  GaitRequest armless = Request("human29", Preset::kHuman);
  armless.body.drop_arms = armless.body.rigid_trunk = true;
  EXPECT_TRUE(CheckRequest(armless).ok());
}

TEST(Presets, TorqueIsTheCostOfThePaper) {
  const GaitSpec spec = CheckRequest(Request("planar", Preset::kTorque)).value();
  ASSERT_EQ(spec.costs.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<cost::SquaredTorque>(spec.costs[0].term));
  EXPECT_EQ(spec.starts, 1);
  EXPECT_FALSE(spec.duty_factor);
}

TEST(Presets, HumanFillsOnlyWhatIsLeftOpen) {
  const GaitSpec spec = CheckRequest(Request("planar", Preset::kHuman)).value();
  EXPECT_EQ(spec.scene.contacts.size(), 4u);
  ASSERT_TRUE(spec.duty_factor);
  EXPECT_EQ(spec.duty_factor->min, 0.605);
  EXPECT_EQ(spec.starts, 1);

  GaitRequest given = Request("planar", Preset::kHuman);
  given.body.feet = FootShape::kOneEllipsoid;
  given.motion.duty_factor = GaitRequest::Range{0.55, 0.56};
  given.ground_contact.swing_clearance = 0.02;
  given.starts = 2;
  const GaitSpec own = CheckRequest(given).value();
  EXPECT_EQ(own.scene.contacts.size(), 2u);
  EXPECT_EQ(own.duty_factor->max, 0.56);
  EXPECT_EQ(own.swing_clearance, 0.02);
  EXPECT_EQ(own.starts, 2);
}

// Terms that grow with mass have weights that fall with it: all contribute the same share to a body twice as heavy.
TEST(Presets, WeightsScaleWithMass) {
  GaitRequest light = Request("planar", Preset::kHuman), heavy = light;
  light.body.mass = 60;
  heavy.body.mass = 120;
  const GaitSpec a = CheckRequest(light).value(), b = CheckRequest(heavy).value();
  for (size_t t = 0; t < a.costs.size(); ++t) {
    const bool rate = std::holds_alternative<cost::SquaredTorqueRate>(a.costs[t].term);
    const bool work = std::holds_alternative<cost::MuscleWork>(a.costs[t].term);
    EXPECT_NEAR(a.costs[t].weight / b.costs[t].weight, rate ? 4 : work ? 2 : 1, 1e-12);
  }
}

}  // namespace
}  // namespace rollgait
