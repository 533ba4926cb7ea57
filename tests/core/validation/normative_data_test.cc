// The compiled-in table against figures read from the file by hand.
#include "core/validation/normative_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace rollgait {
namespace {

const NormativeDataset& Set(std::string_view name) {
  const auto& sets = NormativeDatasets();
  return *std::find_if(sets.begin(), sets.end(), [&](const NormativeDataset& set) { return set.name == name; });
}

const NormativeCurve& Curve(const NormativeDataset& set, NormativeQuantity quantity, std::string_view joint) {
  return *std::find_if(set.curves.begin(), set.curves.end(),
                       [&](const NormativeCurve& curve) { return curve.quantity == quantity && curve.joint == joint; });
}

double Max(const NormativeCurve& curve) { return *std::max_element(curve.mean.begin(), curve.mean.end()); }
double Min(const NormativeCurve& curve) { return *std::min_element(curve.mean.begin(), curve.mean.end()); }

TEST(NormativeDataTest, EveryCurveOfTheLegs) {
  ASSERT_EQ(NormativeDatasets().size(), 2u);
  EXPECT_EQ(Set("Winter_BioMAC").curves.size(), 5u);         // three angles, two forces
  EXPECT_EQ(Set("Falisse2019_subject1").curves.size(), 8u);  // three moments more
  for (const NormativeDataset& set : NormativeDatasets()) {
    EXPECT_FALSE(set.source.empty());
    EXPECT_FALSE(set.deviation.empty());
    for (const NormativeCurve& curve : set.curves) {
      ASSERT_EQ(curve.mean.size(), static_cast<size_t>(kNormativeSamples));
      ASSERT_EQ(curve.deviation.size(), static_cast<size_t>(kNormativeSamples));
      for (const double deviation : curve.deviation) EXPECT_GE(deviation, 0);
    }
  }
}

TEST(NormativeDataTest, FiguresOfTheFile) {
  const NormativeDataset& winter = Set("Winter_BioMAC");
  EXPECT_EQ(winter.speed, 1.325);
  EXPECT_EQ(Min(Curve(winter, NormativeQuantity::kAngle, "hip")), -10.95);
  EXPECT_EQ(Max(Curve(winter, NormativeQuantity::kAngle, "knee")), 64.86);
  EXPECT_EQ(Max(Curve(winter, NormativeQuantity::kVerticalForce, "foot")), 110.2956);
  EXPECT_EQ(Curve(winter, NormativeQuantity::kForwardForce, "foot").mean[5], -19.5719);  // braking at 10 %
  const NormativeDataset& subject = Set("Falisse2019_subject1");
  EXPECT_EQ(Curve(subject, NormativeQuantity::kAngle, "hip").mean[0], 27.3433);
  EXPECT_EQ(Curve(subject, NormativeQuantity::kAngle, "hip").deviation[1], 0.5724);
  EXPECT_EQ(Max(Curve(subject, NormativeQuantity::kMoment, "ankle")), 1.4559);
  EXPECT_EQ(Curve(subject, NormativeQuantity::kMoment, "hip").mean[0], 0.5592);
}

// Peaks where literature has them: ankle push-off near 50 %, knee flexion in swing near 72 %.
TEST(NormativeDataTest, SignsAreClinical) {
  const NormativeDataset& subject = Set("Falisse2019_subject1");
  const NormativeCurve& push_off = Curve(subject, NormativeQuantity::kMoment, "ankle");
  const auto peak = std::max_element(push_off.mean.begin(), push_off.mean.end()) - push_off.mean.begin();
  EXPECT_GE(2 * peak, 44);
  EXPECT_LE(2 * peak, 54);
  for (const NormativeDataset& set : NormativeDatasets()) {
    const NormativeCurve& knee = Curve(set, NormativeQuantity::kAngle, "knee");
    const auto swing = std::max_element(knee.mean.begin(), knee.mean.end()) - knee.mean.begin();
    EXPECT_GE(2 * swing, 66);
    EXPECT_LE(2 * swing, 78);
  }
}

}  // namespace
}  // namespace rollgait
