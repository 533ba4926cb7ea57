#include "client/formats/ground_reaction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client/failure.h"
#include "client/formats/exported_stride.h"
#include "client/report/kinematics.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

// One stance of a foot with two surfaces: ours are the same ellipsoid at two places.
struct TwoSurfaces {
  TwoSurfaces() {
    model = SampleModel();
    v1::ContactSurface& toe = *model.add_contacts();
    toe = model.contacts(1);
    toe.set_name("right_toe");
    toe.mutable_center_m()->set_x(0.2);
    Instant instant;
    instant.position.assign(model.joints_size(), 0.0);
    instant.position[1] = 0.9;
    instant.active = {false, false, false};
    instant.force.assign(3, {0, 0, 0});
    stride = {1, 0, {{0, 0, instant}, {50, 0.5, instant}, {100, 1, instant}}};
    poses = LinkPoses(model, instant.position);
  }
  Eigen::Vector3d Lowest(int contact) const { return LowestPoint(model.contacts(contact), poses); }

  v1::Model model;
  Stride stride;
  std::vector<Pose> poses;
  Plate plate{"right", {1, 2}, 8};
};

TEST(GroundReactionTest, ForcesOfTwoSurfacesTwistTheFoot) {
  TwoSurfaces foot;
  Instant& stance = foot.stride.samples[1].instant;
  stance.active = {false, true, true};
  stance.force = {{{0, 0, 0}, {5, 20, 300}, {-3, -20, 100}}};
  const Reaction found = Reactions(foot.stride, foot.model, foot.plate)[1];
  EXPECT_EQ(found.force, Eigen::Vector3d(2, 0, 400));
  const Eigen::Vector3d heel = foot.Lowest(1), toe = foot.Lowest(2);
  // Moments about an axis across, through the ground: forces along x act a little above or below it.
  const double lift = (heel.z() * 5 - toe.z() * 3) / 400;
  EXPECT_NEAR(found.point.x(), (300 * heel.x() + 100 * toe.x()) / 400 - lift, 1e-12);
  EXPECT_EQ(found.point.z(), 0);
  EXPECT_EQ(found.couple.x(), 0);
  EXPECT_EQ(found.couple.y(), 0);
  EXPECT_NEAR(found.couple.z(), -20 * (toe.x() - heel.x()), 1);
  EXPECT_LT(found.couple.z(), -2);
}

TEST(GroundReactionTest, PointIsKeptInSwing) {
  TwoSurfaces foot;
  foot.stride.samples[1].instant.active = {false, true, false};
  foot.stride.samples[1].instant.force[1] = {0, 0, 200};
  const std::vector<Reaction> found = Reactions(foot.stride, foot.model, foot.plate);
  for (const int swing : {0, 2}) {
    EXPECT_EQ(found[swing].force, Eigen::Vector3d::Zero());
    EXPECT_EQ(found[swing].couple, Eigen::Vector3d::Zero());
    EXPECT_EQ(found[swing].point, found[1].point);
  }
  EXPECT_NEAR(found[1].point.x(), foot.Lowest(1).x(), 1e-12);
}

TEST(GroundReactionTest, WithoutWeightTheCoupleHasTheRest) {
  TwoSurfaces foot;
  Instant& stance = foot.stride.samples[1].instant;
  stance.active = {false, true, true};
  stance.force = {{{0, 0, 0}, {0, 0, 2e-4}, {0, 0, -2e-4}}};
  const Reaction found = Reactions(foot.stride, foot.model, foot.plate)[1];
  EXPECT_NEAR(found.point.x(), foot.Lowest(1).x(), 1e-15);
  EXPECT_NEAR(found.couple.y(), 2e-4 * (foot.Lowest(2).x() - foot.Lowest(1).x()), 1e-15);
}

TEST(GroundReactionTest, PlatesAreFeetOrContacts) {
  v1::Solve solve = SampleSolve("solves/a", 0);
  EXPECT_EQ(FootPlates(solve)[0].name, "right");
  EXPECT_THAT(FootPlates(solve)[0].contacts, testing::ElementsAre(1));
  EXPECT_EQ(FootPlates(solve)[0].joint, solve.result().model().contacts(1).joint());
  // A toe joint divides the foot.
  v1::ContactSurface& toe = *solve.mutable_result()->mutable_model()->add_contacts();
  toe = solve.result().model().contacts(1);
  toe.set_name("right_toe");
  toe.set_joint(7);
  solve.mutable_result()->mutable_gait_events()->mutable_feet(0)->add_contacts("right_toe");
  EXPECT_EQ(FootPlates(solve)[0].joint, -1);
  ASSERT_EQ(LinkPlates(solve).size(), 3u);
  EXPECT_EQ(LinkPlates(solve)[0].name, "foot_r");
  EXPECT_EQ(LinkPlates(solve)[1].name, "shank_r");
  solve.mutable_result()->mutable_gait_events()->mutable_feet(0)->add_contacts("tail");
  EXPECT_THROW(FootPlates(solve), Failure);
  solve.mutable_result()->clear_gait_events();
  EXPECT_EQ(FootPlates(solve)[1].name, "right_foot");
}

}  // namespace
}  // namespace rollgait::client
