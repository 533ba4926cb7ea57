#include "client/view/iterate_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "client/failure.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

using ::testing::HasSubstr;

TEST(IterateMotionTest, IsTheSampledMotionAndStraightBetween) {
  const v1::Model model = SampleModel();
  const v1::Iterate iterate = SampleIterate(model, 3, 1);
  const StrideSource motion = IterateMotion(iterate, model);
  EXPECT_EQ(motion.duration_s, kSampleSpan_s);
  EXPECT_EQ(motion.displacement_m, kSampleDisplacement_m);
  EXPECT_TRUE(motion.is_half);
  for (int p = 0; p < iterate.phases_size(); ++p) {
    const v1::Iterate::Phase& phase = iterate.phases(p);
    for (int k = 0; k + 1 < phase.times_s_size(); ++k) {
      const double begin = phase.times_s(k), end = phase.times_s(k + 1);
      const Instant at = motion.at(begin, false), between = motion.at((begin + end) / 2, false);
      for (int j = 0; j < model.joints_size(); ++j) {
        EXPECT_NEAR(at.position[j], SamplePosition(model, j, begin), 1e-5);
        const double chord = (SamplePosition(model, j, begin) + SamplePosition(model, j, end)) / 2;
        EXPECT_NEAR(between.position[j], chord, 1e-5);
      }
      for (int c = 0; c < model.contacts_size(); ++c) {
        const auto& contacts = phase.contacts();
        const bool active = std::find(contacts.begin(), contacts.end(), model.contacts(c).name()) != contacts.end();
        EXPECT_EQ(between.active[c], active) << "phase " << p;
      }
    }
  }
}

TEST(IterateMotionTest, ABorderBelongsToThePhaseThatIsAskedFor) {
  const v1::Model model = SampleModel();
  const v1::Iterate iterate = SampleIterate(model, 3, 1);
  ASSERT_GE(iterate.phases_size(), 2);
  const StrideSource motion = IterateMotion(iterate, model);
  const double border = iterate.phases(1).start_s();
  EXPECT_NE(motion.at(border, true).active, motion.at(border, false).active);
}

TEST(IterateDataTest, IsAWholeCycleWithItsMirrorImage) {
  const v1::Model model = SampleModel();
  const nlohmann::json data = IterateData(SampleIterate(model, 3, 1), model);
  EXPECT_EQ(data.at("index"), 3);
  EXPECT_EQ(data.at("mesh"), 1);
  const nlohmann::json stride = data.at("stride");
  EXPECT_EQ(stride.at("duration"), 2 * kSampleSpan_s);
  EXPECT_EQ(stride.at("displacement"), 2 * kSampleDisplacement_m);
  EXPECT_EQ(stride.at("scene").at("contacts").size(), static_cast<size_t>(model.contacts_size()));
  EXPECT_GT(stride.at("scene").at("shapes").size(), 3u);
  EXPECT_GT(stride.at("scene").at("height"), 1.0);
}

TEST(IterateDataTest, NamesWhatDoesNotFit) {
  const v1::Model model = SampleModel();
  const auto refusal = [&](const auto& spoil) {
    v1::Iterate iterate = SampleIterate(model, 0, 0);
    spoil(iterate);
    try {
      IterateData(iterate, model);
    } catch (const Failure& failure) {
      return std::string(failure.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(refusal([](v1::Iterate& i) { i.clear_phases(); }), HasSubstr("phases is empty"));
  EXPECT_THAT(refusal([](v1::Iterate& i) { i.set_duration_s(0); }), HasSubstr("duration_s must be > 0"));
  EXPECT_THAT(refusal([](v1::Iterate& i) { i.mutable_joint_names(0)->assign("tail"); }),
              HasSubstr("joint_names has \"tail\""));
  EXPECT_THAT(refusal([](v1::Iterate& i) { i.mutable_phases(1)->add_positions(0); }),
              HasSubstr("phases[1].positions must have "));
  EXPECT_THAT(refusal([](v1::Iterate& i) { i.mutable_phases(0)->clear_times_s(); }),
              HasSubstr("phases[0].times_s must have at least 2 values"));
}

}  // namespace
}  // namespace rollgait::client
