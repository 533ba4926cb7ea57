#include "server/convert/iterate_convert.h"

#include <gtest/gtest.h>

#include "core/gait/gait_request.h"
#include "core/gait/request_check.h"

namespace rollgait::server {
namespace {

TEST(EncodeIterateTest, CarriesEveryField) {
  GaitRequest request;
  request.body.model = "planar";
  request.motion.speed = 1.3;
  const GaitSpec spec = CheckRequest(request).value();
  const int n = spec.scene.model.size();
  CoarseMotion motion;
  motion.cycle = Cycle::kFull;
  motion.duration = 0.5;
  motion.displacement = 0.75;
  for (int p = 0; p < 2; ++p) {
    MatrixX positions(n, 3);
    for (int i = 0; i < positions.size(); ++i) positions(i) = 100 * p + i;
    motion.phases.push_back({{p}, 0.25 * p, 0.25, {0.25 * p, 0.25 * p + 0.125, 0.25 * p + 0.25}, positions});
  }
  IterationInfo iteration;
  iteration.index = 12;
  iteration.mesh = 3;
  const v1::Iterate iterate = EncodeIterate(iteration, motion, spec.scene);
  EXPECT_EQ(iterate.index(), 12);
  EXPECT_EQ(iterate.mesh(), 3);
  EXPECT_EQ(iterate.cycle(), v1::CYCLE_FULL);
  EXPECT_EQ(iterate.duration_s(), 0.5);
  EXPECT_EQ(iterate.displacement_m(), 0.75);
  ASSERT_EQ(iterate.joint_names_size(), n);
  EXPECT_EQ(iterate.joint_names(n - 1), spec.scene.model.joint(n - 1).name);
  ASSERT_EQ(iterate.phases_size(), 2);
  for (int p = 0; p < 2; ++p) {
    const v1::Iterate::Phase& phase = iterate.phases(p);
    ASSERT_EQ(phase.contacts_size(), 1);
    EXPECT_EQ(phase.contacts(0), spec.scene.contacts[p].name);
    EXPECT_EQ(phase.start_s(), 0.25 * p);
    EXPECT_EQ(phase.duration_s(), 0.25);
    ASSERT_EQ(phase.times_s_size(), 3);
    EXPECT_EQ(phase.times_s(1), 0.25f * static_cast<float>(p) + 0.125f);
    ASSERT_EQ(phase.positions_size(), 3 * n);
    // positions[time * joints + joint]
    EXPECT_EQ(phase.positions(2 * n + 1), static_cast<float>(motion.phases[p].positions(1, 2)));
  }
}

}  // namespace
}  // namespace rollgait::server
