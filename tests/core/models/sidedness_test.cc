// Which fields of a request make left and right differ: against the bodies that they make.
#include "core/models/sidedness.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/models/catalog.h"

namespace rollgait {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

BodyRequest Human29() {
  BodyRequest request;
  request.model = "human29";
  return request;
}

TEST(OneSidedFields, AreNoneOfABodyWhoseSidesAreAlike) {
  BodyRequest request = Human29();
  EXPECT_THAT(OneSidedFields(request), IsEmpty());
  request.segment_lengths = {{"thigh", 0.45}, {"foot_l", 0.26}, {"foot_r", 0.26}};
  request.changes.foot_semi_axes = {{"foot", Vector3(0.13, 0.05, 0.05)}};
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
    BodyRequest request = Human29();
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
  EXPECT_THAT(of([](BodyRequest* r) {
                r->changes.loads = {{.segment = "torso", .mass = 1, .position = {}},
                                    {.segment = "hand_l", .mass = 1, .position = {}}};
              }),
              ElementsAre("loads[1]"));
  EXPECT_THAT(
      of([](BodyRequest* r) { r->changes.loads = {{.segment = "torso", .mass = 1, .position = Vector3(0, 0, 0.1)}}; }),
      ElementsAre("loads[0]"));
}

TEST(WithSidesAlike, KeepsWhatIsOfBothSides) {
  BodyRequest request = Human29();
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
