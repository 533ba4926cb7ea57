// Which turn lets the legs of a drawing hang.
#include "client/import/upright.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "client/import/tree_file.h"

namespace rollgait::client {
namespace {

using Eigen::Vector3d;
using Places = std::vector<std::pair<std::string, Vector3d>>;

// A body whose joints of these names are in these places.
std::optional<Eigen::Matrix3d> TurnOf(const Places& places) {
  std::string text = "<robot name=\"r\"><link name=\"body\"/>";
  for (size_t i = 0; i < places.size(); ++i) {
    const auto& [name, place] = places[i];
    const std::string link = "link" + std::to_string(i);
    text += "<link name=\"" + link + "\"/><joint name=\"" + name +
            "\" type=\"continuous\"><parent link=\"body\"/><child link=\"" + link + "\"/><origin xyz=\"" +
            std::to_string(place.x()) + " " + std::to_string(place.y()) + " " + std::to_string(place.z()) +
            "\"/></joint>";
  }
  const LinkTree tree = ReadLinkTreeText("x.urdf", text + "</robot>");
  return TurnUpright(tree, PostureOf(tree, kNoMotion, {}, std::vector<bool>(tree.joints.size(), false)));
}

// Legs whose hips are aside of the origin and whose ankles are `down` from there.
Places Legs(const Vector3d& down) {
  const Vector3d aside(0.1, 0.2, 0.3);
  return {{"hip", aside}, {"ankle", aside + down}};
}

// The turn takes the leg to −z, leaves hands as they are, and x what it is wherever the legs do not lie along it.
TEST(UprightTest, LegsAlongAnyAxisHang) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const Vector3d down = 0.9 * sign * Vector3d::Unit(axis);
      SCOPED_TRACE(down.transpose());
      const auto turn = TurnOf(Legs(down));
      if (axis == 2 && sign < 0) {
        EXPECT_FALSE(turn.has_value()) << "they hang";
        continue;
      }
      ASSERT_TRUE(turn.has_value());
      EXPECT_LT((*turn * down - Vector3d(0, 0, -0.9)).norm(), 1e-12);
      EXPECT_NEAR(turn->determinant(), 1, 1e-12);
      EXPECT_LT((*turn * turn->transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
      if (axis != 0) {
        EXPECT_EQ(*turn * Vector3d::UnitX(), Vector3d::UnitX());
      }
    }
  }
}

// Of a leg bent by 30° the next axis is told; one that lies between two axes is left as it is.
TEST(UprightTest, BentLegsAreToldFromObliqueOnes) {
  const auto bent = TurnOf(Legs(Vector3d(0.5, 0.9, 0)));
  ASSERT_TRUE(bent.has_value());
  EXPECT_LT((*bent * Vector3d::UnitY() + Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_FALSE(TurnOf(Legs(Vector3d(0.7, 0.9, 0))).has_value());
  EXPECT_FALSE(TurnOf(Legs(Vector3d(0.6, 0.9, 0.6))).has_value());
}

// Both legs tell, and each by the mean of its joints: single ones would be oblique.
TEST(UprightTest, TheMeanOfAllHipsAndFeetTells) {
  const auto turn = TurnOf({{"hip_l", {0, 0, 1}},
                            {"hip_r", {0, 0, -1}},
                            {"thigh_twist", {0, 0, 0}},
                            {"foot_l", {0, 0.9, 1}},
                            {"toe_r", {0, 0.9, -1}}});
  ASSERT_TRUE(turn.has_value());
  EXPECT_LT((*turn * Vector3d::UnitY() + Vector3d::UnitZ()).norm(), 1e-12);
}

// As many joints of the hips as a robot has move no mean.
TEST(UprightTest, TheMeanDoesNotGrowWithTheNumberOfJoints) {
  const Vector3d hip(2, 0, 0), foot(2, 0.9, 0);
  const auto turn = TurnOf({{"hip_1", hip}, {"hip_2", hip}, {"hip_3", hip}, {"foot", foot}});
  ASSERT_TRUE(turn.has_value());
  EXPECT_LT((*turn * Vector3d::UnitY() + Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(UprightTest, KneesTellWhereNoFootHasAName) {
  EXPECT_TRUE(TurnOf({{"Hip", {0, 0, 0}}, {"Knee", {0, 0.4, 0}}}).has_value());
  EXPECT_FALSE(TurnOf({{"hip", {0, 0, 0}}, {"j2", {0, 0.4, 0}}}).has_value());
  EXPECT_FALSE(TurnOf({{"j1", {0, 0, 0}}, {"ankle", {0, 0.4, 0}}}).has_value());
  // Feet come before knees: this leg is bent at the knee.
  EXPECT_TRUE(TurnOf({{"hip", {0, 0, 0}}, {"knee", {0.4, 0.4, 0}}, {"ankle", {0, 0.9, 0}}}).has_value());
}

}  // namespace
}  // namespace rollgait::client
