// Bodies with a thickness: who can meet whom, and that people who stand do not overlap.
#include "core/models/limb_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/models/catalog.h"
#include "core/multibody/body_dynamics.h"

namespace rollgait {
namespace {

Scene SceneOf(const BodyRequest& request) { return BuildScene(request).value(); }

BodyRequest HumanRequest(bool toes) {
  BodyRequest request;
  request.model = "human29";
  if (toes) request.toes = true;
  return request;
}

int FindBody(const Scene& scene, const std::string& name) {
  for (size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

bool Meet(const Scene& scene, const std::string& a, const std::string& b) {
  const int i = FindBody(scene, a), k = FindBody(scene, b);
  EXPECT_TRUE(i >= 0 && k >= 0) << a << " " << b;
  return std::any_of(scene.pairs.begin(), scene.pairs.end(), [&](const BodyPair& pair) {
    return (pair.first == i && pair.second == k) || (pair.first == k && pair.second == i);
  });
}

// Where the surface of a body is, at the given state of the links: its extent along a world direction.
double Extent(const BodySurface& body, const BodyDynamics::State& state, const Vector3& direction) {
  const BodyDynamics::Link& link = state[body.joint];
  const Matrix3 R_WE = link.R_WL * body.placed.R_BE;
  return direction.dot(link.p_WL + link.R_WL * body.placed.p_BE) +
         body.placed.surface.Support(R_WE.transpose() * direction);
}

TEST(LimbBodiesTest, LegsArmsAndFeetThatCanMeet) {
  const Scene scene = SceneOf(HumanRequest(true));
  EXPECT_TRUE(Meet(scene, "left_heel", "right_forefoot"));
  EXPECT_TRUE(Meet(scene, "left_instep", "right_instep"));
  EXPECT_TRUE(Meet(scene, "left_shank", "right_heel"));
  EXPECT_TRUE(Meet(scene, "left_shank", "right_shank"));
  EXPECT_TRUE(Meet(scene, "left_thigh", "right_thigh"));
  EXPECT_TRUE(Meet(scene, "left_thigh", "right_shank"));
  EXPECT_TRUE(Meet(scene, "left_forearm", "left_thigh"));
  EXPECT_TRUE(Meet(scene, "left_forearm", "right_thigh"));
  EXPECT_TRUE(Meet(scene, "left_forearm", "right_forearm"));
  EXPECT_FALSE(Meet(scene, "left_thigh", "left_shank"));
  EXPECT_FALSE(Meet(scene, "left_heel", "left_forefoot"));
  EXPECT_FALSE(Meet(scene, "left_forearm", "left_shank"));
  // Five bodies of one leg against five of the other; a forearm and a thigh four times; the forearms.
  EXPECT_EQ(scene.pairs.size(), 25u + 4u + 1u);
  EXPECT_EQ(SceneOf(HumanRequest(false)).pairs.size(), 9u + 4u + 1u);
}

TEST(LimbBodiesTest, PairsAndBodiesMirrorEachOther) {
  for (const bool toes : {false, true}) {
    const Scene scene = SceneOf(HumanRequest(toes));
    for (size_t i = 0; i < scene.bodies.size(); ++i) {
      const BodySurface &body = scene.bodies[i], &image = scene.bodies[body.mirror_body];
      EXPECT_NE(body.name, image.name);
      EXPECT_EQ(image.mirror_body, static_cast<int>(i));
      EXPECT_EQ(scene.model.joint(body.joint).mirror_joint, image.joint);
      EXPECT_EQ(body.placed.p_BE, image.placed.p_BE);  // on the sagittal plane of its segment
      EXPECT_EQ(body.placed.p_BE.y(), 0);
    }
    for (size_t i = 0; i < scene.pairs.size(); ++i) {
      const BodyPair &pair = scene.pairs[i], &image = scene.pairs[pair.mirror_pair];
      EXPECT_EQ(image.mirror_pair, static_cast<int>(i));
      const auto images = std::minmax(scene.bodies[pair.first].mirror_body, scene.bodies[pair.second].mirror_body);
      EXPECT_EQ(images, std::minmax(image.first, image.second)) << scene.PairName(static_cast<int>(i));
    }
  }
}

TEST(LimbBodiesTest, FeetAreTheContactSurfaces) {
  const Scene scene = SceneOf(HumanRequest(true));
  for (const ContactSurface& contact : scene.contacts) {
    const int index = FindBody(scene, contact.name);
    ASSERT_GE(index, 0);
    const BodySurface& body = scene.bodies[index];
    EXPECT_EQ(body.joint, contact.joint);
    EXPECT_EQ(body.placed.p_BE, contact.p_LE);
    EXPECT_EQ(body.placed.surface.ellipsoid()->semi_axes(), contact.surface.ellipsoid()->semi_axes());
  }
}

// Standing straight, everything of the left side of the body is left of the middle, everything of the right side right
// of it, arms are beside the thighs, and nothing is below the sole. A woman of 1.45 m and a man of 2.1 m, and others.
TEST(LimbBodiesTest, WhoStandsDoesNotOverlap) {
  for (const Sex sex : {Sex::kFemale, Sex::kMale}) {
    for (const double stature : {1.45, 1.7, 2.1}) {
      BodyRequest request = HumanRequest(stature > 1.5);
      request.sex = sex;
      request.stature = stature;
      const Scene scene = SceneOf(request);
      BodyDynamics::State state;
      const VectorX zero = VectorX::Zero(scene.model.size());
      BodyDynamics(scene.model).ComputeState(zero, zero, &state);
      for (const BodySurface& body : scene.bodies) {
        const double side = body.name.starts_with("left_") ? 1 : -1;
        EXPECT_LT(Extent(body, state, Vector3(0, -side, 0)), -0.008) << body.name;
        EXPECT_LT(Extent(body, state, Vector3(0, 0, -1)), scene.leg_length + 1e-12) << body.name;
      }
      const BodySurface &arm = scene.bodies[FindBody(scene, "left_forearm")],
                        &thigh = scene.bodies[FindBody(scene, "left_thigh")];
      EXPECT_LT(Extent(thigh, state, Vector3(0, 1, 0)) + Extent(arm, state, Vector3(0, -1, 0)), -0.01);
    }
  }
}

// Limbs as thick as people's: circumferences of 1988 within the tolerance that an ellipsoid needs.
TEST(LimbBodiesTest, ThicknessIsThatOfPeople) {
  const SegmentTable table(Sex::kMale, 1.756, 78);
  const LimbBody shank = ShankBody(table);
  const double length = table.Length(Segment::kShank);
  const auto radius = [](const LimbBody& limb, double height) {  // at a height over the joint centre, m
    const Vector3 axes = *limb.surface.semi_axes();
    const double along = (height - limb.center.z()) / axes.z();
    return axes.y() * std::sqrt(1 - along * along);
  };
  const double pi = 3.14159265358979;
  EXPECT_NEAR(2 * pi * radius(shank, -0.3 * length), 0.378, 0.03);  // calf
  EXPECT_NEAR(2 * pi * radius(shank, -length), 0.222, 0.03);        // ankle
  const double thigh = table.Length(Segment::kThigh);
  EXPECT_NEAR(2 * pi * radius(ThighBody(table), -thigh), 0.386 * 0.77, 0.02);  // knee, flesh yields
  // Mass does not make limbs thicker: gaits of equal people of different mass are the same.
  EXPECT_EQ(*ShankBody(SegmentTable(Sex::kMale, 1.756, 120)).surface.semi_axes(), *shank.surface.semi_axes());
}

TEST(LimbBodiesTest, ReductionsKeepThePairsThatMove) {
  BodyRequest sagittal = HumanRequest(true);
  sagittal.sagittal = true;
  EXPECT_EQ(SceneOf(sagittal).bodies.size(), 12u);
  EXPECT_TRUE(SceneOf(sagittal).pairs.empty());
  // Arms fixed to the trunk meet the thighs still, but not each other.
  BodyRequest dropped = HumanRequest(true);
  dropped.drop_arms = true;
  const Scene hanging = SceneOf(dropped), whole = SceneOf(HumanRequest(true));
  EXPECT_EQ(hanging.pairs.size(), whole.pairs.size() - 1);
  EXPECT_TRUE(Meet(hanging, "left_forearm", "left_thigh"));
  EXPECT_FALSE(Meet(hanging, "left_forearm", "right_forearm"));
  for (size_t i = 0; i < hanging.pairs.size(); ++i) {
    EXPECT_EQ(hanging.pairs[hanging.pairs[i].mirror_pair].mirror_pair, static_cast<int>(i));
  }
  // At zero the reduced body is where the whole one is.
  BodyDynamics::State reduced, full;
  const VectorX zero = VectorX::Zero(hanging.model.size()), zeros = VectorX::Zero(whole.model.size());
  BodyDynamics(hanging.model).ComputeState(zero, zero, &reduced);
  BodyDynamics(whole.model).ComputeState(zeros, zeros, &full);
  for (size_t i = 0; i < whole.bodies.size(); ++i) {
    const Vector3 direction(0.48, 0.6, 0.64);
    EXPECT_NEAR(Extent(hanging.bodies[i], reduced, direction), Extent(whole.bodies[i], full, direction), 1e-14);
  }
}

}  // namespace
}  // namespace rollgait
