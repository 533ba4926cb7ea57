// What of a subject stays when its sides are made alike, and what may differ without making it one-sided.
#include "core/models/sides_alike.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/models/catalog.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

BodyRequest AnyOf(const std::string& model) {
  BodyRequest request;
  request.model = model;
  return request;
}

Scene SceneFor(const BodyRequest& request) { return BuildScene(request).value(); }
const Joint& JointNamed(const Scene& scene, const char* name) { return scene.model.joint(scene.model.Find(name)); }

TEST(WithSidesAlike, KeepsWhatBothSidesHave) {
  BodyRequest request = AnyOf("human29");
  request.stature = 1.6;
  request.mass = 90;
  request.segment_lengths = {{"torso", 0.5}, {"shank", 0.4}, {"thigh_l", 0.41}, {"thigh_r", 0.41}};
  request.changes.strengths = {{"knee_l", 0.5}, {"knee_r", 0.5}, {"trunk_bending", 0.7}};
  request.changes.springs = {{"ankle_l", {300, 0.1, 2}}, {"ankle_r", {300, 0.1, 2}}, {"trunk_flexion", {50, 0.2, 1}}};
  request.changes.loads = {{.segment = "hand_l", .mass = 3, .position = Vector3(0.1, -0.1, 0.02)},
                           {.segment = "hand_r", .mass = 3, .position = Vector3(0.1, -0.1, -0.02)},
                           {.segment = "foot_r", .mass = 1, .position = {}},
                           {.segment = "foot_l", .mass = 1, .position = {}},
                           {.segment = "torso", .mass = 12, .position = Vector3(-0.2, -0.2, 0)}};
  request.locked_joints = {{"elbow_l", 0.3}, {"elbow_r", 0.3}, {"trunk_rotation", 0.0}};
  const Scene scene = SceneFor(request), alike = SceneFor(WithSidesAlike(request));
  ASSERT_TRUE(scene.symmetric && alike.symmetric);
  ASSERT_EQ(alike.model.size(), scene.model.size());
  for (int i = 0; i < scene.model.size(); ++i) {
    const Joint &joint = scene.model.joint(i), &kept = alike.model.joint(i);
    EXPECT_EQ(kept.name, joint.name);
    EXPECT_EQ(kept.mass, joint.mass) << joint.name;
    EXPECT_EQ(kept.center_of_mass, joint.center_of_mass) << joint.name;
    EXPECT_EQ(kept.p_PJ, joint.p_PJ) << joint.name;
    EXPECT_EQ(kept.effort_max, joint.effort_max) << joint.name;
    EXPECT_EQ(kept.stiffness, joint.stiffness) << joint.name;
    EXPECT_EQ(kept.rest_position, joint.rest_position) << joint.name;
  }
}

TEST(WithSidesAlike, LeavesOutWhatOneSideHasAlone) {
  BodyRequest request = AnyOf("human29");
  request.segment_lengths = {{"thigh", 0.41}, {"thigh_r", 0.4}, {"shank_l", 0.4}, {"foot_l", 0.25}, {"foot_r", 0.26}};
  request.changes.strengths = {{"knee_l", 0.5}, {"hip_l", 0.5}, {"hip_r", 0.6}, {"trunk_flexion", 0.8}};
  request.changes.springs = {{"ankle_l", {300, 0.1, 2}}, {"knee_l", {300, 0.1, 2}}, {"knee_r", {300, 0.2, 2}}};
  request.changes.loads = {{.segment = "hand_l", .mass = 3, .position = {}},
                           {.segment = "hand_r", .mass = 2, .position = {}},
                           {.segment = "hand_l", .mass = 2, .position = {}},
                           {.segment = "shank_l", .mass = 1, .position = Vector3(0, 0, 0.1)},
                           {.segment = "shank_r", .mass = 1, .position = Vector3(0, 0, 0.1)},
                           {.segment = "torso", .mass = 5, .position = {}}};
  request.locked_joints = {{"elbow_l", 0.3}, {"elbow_r", 0.4}, {"ankle_inversion_l", 0.0}, {"trunk_rotation", 0.0}};
  const BodyRequest alike = WithSidesAlike(request);
  EXPECT_EQ(alike.segment_lengths, (std::map<std::string, double>{{"thigh", 0.41}}));
  EXPECT_EQ(alike.changes.strengths, (std::map<std::string, double>{{"trunk_flexion", 0.8}}));
  EXPECT_TRUE(alike.changes.springs.empty());
  EXPECT_EQ(alike.locked_joints, (std::map<std::string, double>{{"trunk_rotation", 0.0}}));
  ASSERT_EQ(alike.changes.loads.size(), 3u);
  EXPECT_EQ(alike.changes.loads[0].segment, "hand_r");
  EXPECT_EQ(alike.changes.loads[1].segment, "hand_l");
  EXPECT_EQ(alike.changes.loads[1].mass, 2);
  EXPECT_EQ(alike.changes.loads[2].segment, "torso");
  EXPECT_FALSE(SceneFor(request).symmetric);
  EXPECT_TRUE(SceneFor(alike).symmetric);
}

// A load beside the spine stays with its mass, a joint that is locked to one side stays locked.
TEST(WithSidesAlike, PutsWhatIsOfTheMiddleIntoTheMiddle) {
  BodyRequest request = AnyOf("human29");
  request.changes.loads = {{.segment = "torso", .mass = 12, .position = Vector3(-0.2, -0.1, 0.1)}};
  request.changes.springs = {{"trunk_rotation", {50, 0.2, 3}}};
  request.locked_joints = {{"trunk_bending", 0.1}, {"trunk_flexion", 0.2}};
  const BodyRequest alike = WithSidesAlike(request);
  ASSERT_EQ(alike.changes.loads.size(), 1u);
  EXPECT_EQ(*alike.changes.loads[0].position, Vector3(-0.2, -0.1, 0));
  EXPECT_EQ(alike.changes.springs.at("trunk_rotation").rest, 0);
  EXPECT_EQ(alike.locked_joints, (std::map<std::string, double>{{"trunk_bending", 0.0}, {"trunk_flexion", 0.2}}));
  const Scene scene = SceneFor(request), middle = SceneFor(alike);
  EXPECT_FALSE(scene.symmetric);
  EXPECT_TRUE(middle.symmetric);
  EXPECT_EQ(middle.model.total_mass(), scene.model.total_mass());
  EXPECT_EQ(JointNamed(middle, "trunk_rotation").stiffness, 50);
  EXPECT_EQ(JointNamed(middle, "trunk_rotation").damping, 3);
}

bool HasSymmetry(const BodyRequest& request) { return SceneFor(request).symmetric; }

// What lies beside the plane cannot be felt by a motion within it.
TEST(Symmetry, InTheSagittalPlaneIsThatOfTheMotion) {
  BodyRequest request = AnyOf("human29");
  request.changes.loads = {
      {.segment = "torso", .mass = 12, .position = Vector3(-0.2, -0.2, 0.1), .moments = {1, 2, 2}}};
  EXPECT_FALSE(HasSymmetry(request));
  request.sagittal = true;
  EXPECT_TRUE(HasSymmetry(request));
  request.changes.loads = {{.segment = "hand_l", .mass = 3, .position = {}}};
  EXPECT_FALSE(HasSymmetry(request));
  request.drop_arms = true;  // part of the trunk
  EXPECT_TRUE(HasSymmetry(request));
  const Scene scene = SceneFor(request);
  EXPECT_EQ(JointNamed(scene, "knee_l").mirror_joint, scene.model.Find("knee_r"));
  request.segment_lengths = {{"forearm_r", 0.25}};
  EXPECT_TRUE(HasSymmetry(request));

  const auto shanks = [](double left, double right, double forward) {
    BodyRequest body = AnyOf("planar");
    body.changes.loads = {{.segment = "shank_l", .mass = 1, .position = Vector3(0, -0.2, left)},
                          {.segment = "shank_r", .mass = 1, .position = Vector3(forward, -0.2, right)}};
    return body;
  };
  EXPECT_TRUE(HasSymmetry(shanks(0.05, 0.02, 0)));
  EXPECT_FALSE(HasSymmetry(shanks(0.05, -0.05, 0.01)));
  BodyRequest planar = AnyOf("planar");
  planar.changes.springs = {{"ankle_l", {300, 0, 1}}};
  EXPECT_FALSE(HasSymmetry(planar));
  planar = AnyOf("planar");
  planar.changes.strengths = {{"knee_r", 0.9}};
  EXPECT_FALSE(HasSymmetry(planar));
  planar.changes.strengths = {{"ankle_r", 0}};
  EXPECT_FALSE(HasSymmetry(planar));
  planar = AnyOf("planar");
  planar.segment_lengths = {{"foot_r", 0.25}};
  EXPECT_FALSE(HasSymmetry(planar));
}

TEST(OneSidedFields, AreNoneOfABodyWhoseSidesAreAlike) {
  BodyRequest request = AnyOf("human29");
  EXPECT_THAT(OneSidedFields(request), IsEmpty());
  request.segment_lengths = {{"thigh", 0.45}, {"foot_l", 0.26}, {"foot_r", 0.26}};
  request.changes.foot_semi_axes = {{"foot", Vector3(0.13, 0.05, 0.05)}};
  request.changes.foot_exponents = {{"foot_l", 0.8}, {"foot_r", 0.8}};
  request.locked_joints = {{"knee_l", 0.1}, {"knee_r", 0.1}, {"trunk_flexion", 0.1}, {"trunk_bending", 0}};
  request.changes.strengths = {{"hip_l", 0.5}, {"hip_r", 0.5}};
  request.changes.springs = {{"ankle_l", {300, 0.1, 2}}, {"ankle_r", {300, 0.1, 2}}};
  request.changes.loads = {{.segment = "hand_l", .mass = 3, .position = Vector3(0.1, 0, 0.02)},
                           {.segment = "hand_r", .mass = 3, .position = Vector3(0.1, 0, -0.02)},
                           {.segment = "torso", .mass = 5, .position = {}}};
  EXPECT_THAT(OneSidedFields(request), IsEmpty());
  EXPECT_TRUE(BuildScene(request).value().symmetric);
}

TEST(OneSidedFields, NameWhatDiffers) {
  const auto of = [](void (*change)(BodyRequest * request)) {
    BodyRequest request = AnyOf("human29");
    change(&request);
    EXPECT_FALSE(BuildScene(request).value().symmetric);
    return OneSidedFields(request);
  };
  EXPECT_THAT(of([](BodyRequest* r) { r->segment_lengths["thigh_l"] = 0.42; }),
              ElementsAre("segment_lengths_m[\"thigh_l\"]"));
  EXPECT_THAT(of([](BodyRequest* r) {
                r->locked_joints = {{"knee_l", 0.1}, {"knee_r", 0.2}};
              }),
              ElementsAre("locked_joints_rad[\"knee_l\"]", "locked_joints_rad[\"knee_r\"]"));
  EXPECT_THAT(of([](BodyRequest* r) { r->locked_joints["trunk_bending"] = 0.1; }),
              ElementsAre("locked_joints_rad[\"trunk_bending\"]"));
  EXPECT_THAT(of([](BodyRequest* r) { r->changes.strengths["knee_r"] = 0.5; }),
              ElementsAre("joint_strengths[\"knee_r\"]"));
  EXPECT_THAT(of([](BodyRequest* r) {
                r->changes.springs["ankle_l"] = {300, 0, 0};
              }),
              ElementsAre("joint_springs[\"ankle_l\"]"));
  EXPECT_THAT(of([](BodyRequest* r) {
                r->changes.springs["trunk_rotation"] = {300, 0.1, 0};
              }),
              ElementsAre("joint_springs[\"trunk_rotation\"]"));
  EXPECT_THAT(of([](BodyRequest* r) { r->changes.foot_semi_axes["foot_r"] = Vector3(0.13, 0.05, 0.05); }),
              ElementsAre("foot_semi_axes_m[\"foot_r\"]"));
  EXPECT_THAT(of([](BodyRequest* r) { r->changes.foot_exponents["foot_r"] = 0.8; }),
              ElementsAre("foot_exponents[\"foot_r\"]"));
  EXPECT_THAT(of([](BodyRequest* r) {
                r->changes.loads = {{.segment = "torso", .mass = 1, .position = {}},
                                    {.segment = "hand_l", .mass = 1, .position = {}}};
              }),
              ElementsAre("loads[1]"));
  EXPECT_THAT(
      of([](BodyRequest* r) { r->changes.loads = {{.segment = "torso", .mass = 1, .position = Vector3(0, 0, 0.1)}}; }),
      ElementsAre("loads[0]"));
}

// A random request with things on joints, segments and in hands: on both sides alike, or also on one side alone, or
// with a value that is not the mirror image.
BodyRequest RandomSubject(SeededRandom& random) {
  BodyRequest request = AnyOf("human29");
  const Model model = SceneFor(request).model;
  const auto flip = [&] { return random.Uniform(0, 1) < 0.5; };
  const bool is_alike = flip();
  const auto on_joints = [&](auto& values, auto value, auto image) {
    for (int count = flip() ? 2 : 0; count > 0; --count) {
      const Joint& joint = model.joint(static_cast<int>(random.Uniform(6, model.size())));
      if (is_alike && joint.mirror_sign < 0 && joint.mirror_joint == model.Find(joint.name)) continue;
      values[joint.name] = value;
      if (is_alike || flip()) {
        values[model.joint(joint.mirror_joint).name] = is_alike || flip() ? image(joint.mirror_sign) : value;
      }
    }
  };
  on_joints(request.changes.strengths, 0.5, [](double) { return 0.5; });
  on_joints(request.changes.springs, JointSpring{100, 0.1, 1}, [](double sign) {
    return JointSpring{100, sign * 0.1, 1};
  });
  on_joints(request.locked_joints, 0.05, [](double sign) { return sign * 0.05; });
  for (const auto& [segment, length] : {std::pair("thigh", 0.42), std::pair("forearm", 0.27)}) {
    const bool has = flip();
    for (const char* side : {"_l", "_r"}) {
      if (is_alike ? has : flip()) request.segment_lengths[segment + std::string(side)] = length;
    }
  }
  const double in_left = flip() ? 2 : 3, in_right = is_alike || flip() ? in_left : 1;
  if (is_alike || flip()) {
    request.changes.loads = {{.segment = "hand_l", .mass = in_left, .position = Vector3(0.1, 0, -0.02)},
                             {.segment = "hand_r", .mass = in_right, .position = Vector3(0.1, 0, 0.02)}};
  }
  request.changes.loads.push_back(
      {.segment = "torso", .mass = 2, .position = Vector3(0.1, 0, is_alike || flip() ? 0 : 0.02)});
  return request;
}

TEST(OneSidedFields, AreThoseThatDecideHowTheBodyIsBuilt) {
  SeededRandom random(20261126);
  int symmetric = 0, one_sided = 0;
  for (int i = 0; i < 300; ++i) {
    const BodyRequest request = RandomSubject(random);
    const Result<Scene> scene = BuildScene(request);
    if (!scene.ok()) continue;  // a joint that does not reach where it is locked, or that is locked and has a spring
    EXPECT_EQ(scene.value().symmetric, OneSidedFields(request).empty()) << i;
    const Result<Scene> alike = BuildScene(WithSidesAlike(request));
    ASSERT_TRUE(alike.ok()) << i << ' ' << alike.violations().front().field;
    EXPECT_TRUE(alike.value().symmetric) << i;
    ++(scene.value().symmetric ? symmetric : one_sided);
  }
  EXPECT_GT(symmetric, 50);
  EXPECT_GT(one_sided, 50);
}

TEST(WithSidesAlike, KeepsFeetOfBothSides) {
  BodyRequest request = AnyOf("human29");
  request.segment_lengths = {{"thigh", 0.43}, {"shank_l", 0.42}};
  request.changes.foot_semi_axes = {{"foot", Vector3(0.13, 0.05, 0.05)}, {"foot_l", Vector3(0.12, 0.05, 0.05)}};
  request.changes.springs = {{"ankle_l", {300, 0, 0}}};
  const BodyRequest alike = WithSidesAlike(request);
  EXPECT_EQ(alike.segment_lengths.size(), 1u);
  EXPECT_EQ(alike.changes.foot_semi_axes.size(), 1u);
  EXPECT_EQ(alike.changes.foot_semi_axes.count("foot"), 1u);
  EXPECT_TRUE(alike.changes.springs.empty());
  EXPECT_TRUE(BuildScene(alike).value().symmetric);
}

}  // namespace
}  // namespace rollgait
