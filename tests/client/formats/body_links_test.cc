#include "client/formats/body_links.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client/failure.h"
#include "client/formats/custom_joint.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

template <typename Act>
std::string Refusal(const Act& act) {
  try {
    act();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    return failure.what();
  }
  return "nothing was refused";
}

// base_x, base_z, base_pitch (pelvis), then hip, knee and ankle of each leg.
v1::Model WalkerWithLightBase() {
  v1::Model model = SampleModel();
  for (const int i : {0, 1}) model.mutable_joints(i)->set_mass_kg(0);
  return model;
}

TEST(BodyLinksTest, LinksWithoutMassBelongToTheNextOne) {
  const v1::Model model = WalkerWithLightBase();
  const std::vector<BodyLink> bodies = BodyLinks(model);
  ASSERT_EQ(bodies.size(), 7u);
  EXPECT_THAT(bodies[0].joints, ElementsAre(0, 1, 2));
  EXPECT_EQ(bodies[0].parent, -1);
  EXPECT_THAT(bodies[4].joints, ElementsAre(6));
  EXPECT_EQ(bodies[4].parent, 0);
  EXPECT_EQ(bodies[6].parent, 5);
  EXPECT_THAT(BodyOfJoint(model, bodies), ElementsAre(0, 0, 0, 1, 2, 3, 4, 5, 6));
}

TEST(BodyLinksTest, RefusesWhatNoBodyIs) {
  v1::Model leaf = WalkerWithLightBase();
  leaf.mutable_joints(8)->set_mass_kg(0);
  EXPECT_THAT(Refusal([&] { BodyLinks(leaf); }), HasSubstr("model.joints[8].mass_kg is 0, but 0 joints"));
  v1::Model branch = WalkerWithLightBase();
  branch.mutable_joints(2)->set_mass_kg(0);
  EXPECT_THAT(Refusal([&] { BodyLinks(branch); }), HasSubstr("model.joints[2].mass_kg is 0, but 2 joints"));
  v1::Model late = WalkerWithLightBase();
  late.mutable_joints(3)->set_parent(5);
  EXPECT_THAT(Refusal([&] { BodyLinks(late); }), HasSubstr("model.joints[3].parent is 5, must be in [-1, 2]"));
  v1::Model free = WalkerWithLightBase();
  free.mutable_joints(0)->set_type(v1::Joint::TYPE_FREE);
  EXPECT_THAT(Refusal([&] { BodyLinks(free); }), HasSubstr("model.joints[0].type"));
  v1::Model tensor = WalkerWithLightBase();
  tensor.mutable_joints(4)->mutable_inertia_kg_m2()->RemoveLast();
  EXPECT_THAT(Refusal([&] { MassOf(tensor.joints(4)); }), HasSubstr("knee_l: inertia_kg_m2 has 5 values, must have 6"));
}

TEST(CustomJointTest, CompletesTheAxes) {
  const v1::Model model = WalkerWithLightBase();
  const CustomJoint root = ToCustomJoint(model, BodyLinks(model)[0]);
  ASSERT_EQ(root.rotations.size(), 3u);
  ASSERT_EQ(root.translations.size(), 3u);
  EXPECT_EQ(root.rotations[0].joint, 2);
  EXPECT_EQ(root.rotations[1].joint, -1);
  EXPECT_EQ(root.translations[1].joint, 1);
  for (const auto& axes : {root.rotations, root.translations}) {
    Eigen::Matrix3d matrix;
    for (int k = 0; k < 3; ++k) matrix.col(k) = axes[k].axis;
    EXPECT_NEAR(std::abs(matrix.determinant()), 1, 1e-12);
  }
}

TEST(CustomJointTest, RefusesOtherChains) {
  v1::Model apart = WalkerWithLightBase();
  apart.mutable_joints(1)->mutable_origin_m()->set_x(0.1);
  EXPECT_THAT(Refusal([&] { ToCustomJoint(apart, BodyLinks(apart)[0]); }), HasSubstr("joint base_z: its origin"));
  v1::Model late = WalkerWithLightBase();
  late.mutable_joints(0)->set_type(v1::Joint::TYPE_REVOLUTE);
  EXPECT_THAT(Refusal([&] { ToCustomJoint(late, BodyLinks(late)[0]); }), HasSubstr("joint base_z: it slides after"));
}

}  // namespace
}  // namespace rollgait::client
