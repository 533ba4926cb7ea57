// Which parts of a drawn leg stand, and where their ellipsoids are.
#include "client/import/foot_proposal.h"

#include <gmock/gmock.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "client/import/tree_file.h"

namespace rollgait::client {
namespace {

using Eigen::Vector3d;
using google::protobuf::util::MessageDifferencer;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

constexpr double kLeg = 0.9;     // m, from the hip to the sole
constexpr double kHigh = 0.021;  // of the leg: just more than parts that stand may differ
constexpr double kLow = 0.019;

// What a joint of the leg moves: a box whose bottom is at `height` (of the leg) above the sole.
struct Part {
  std::string joint;
  double height;
  bool has_shape = true, has_mass = true;
};

// Joint and part of what stands in a leg of these parts, from the hip on.
std::vector<std::pair<std::string, v1::ContactSurface::FootPart>> StandingOf(const std::vector<Part>& parts) {
  std::string text = "<robot name=\"r\"><link name=\"body\"/>", parent = "body";
  for (const Part& part : parts) {
    const std::string link = part.joint + "_link";
    text += "<link name=\"" + link + "\">";
    if (part.has_mass) {
      text +=
          "<inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/>"
          "</inertial>";
    }
    if (part.has_shape) {
      text += "<collision><origin xyz=\"0 0 " + std::to_string((part.height - 1) * kLeg + 0.05) +
              "\"/><geometry><box size=\"0.1 0.1 0.1\"/></geometry></collision>";
    }
    text += "</link><joint name=\"" + part.joint + "\" type=\"continuous\"><axis xyz=\"0 1 0\"/><parent link=\"" +
            parent + "\"/><child link=\"" + link + "\"/></joint>";
    parent = link;
  }
  const LinkTree tree = ReadLinkTreeText("x.urdf", text + "</robot>");
  const TreePosture posture = PostureOf(tree, kNoMotion, {}, std::vector<bool>(tree.joints.size(), false));
  std::vector<int> chain;
  for (const Part& part : parts) chain.push_back(tree.FindJoint(part.joint));
  std::vector<std::pair<std::string, v1::ContactSurface::FootPart>> standing;
  for (const StandingPart& part : StandingParts(tree, posture, chain, kLeg)) {
    standing.emplace_back(tree.joints[static_cast<size_t>(part.joint)].name, part.part);
  }
  return standing;
}

constexpr auto kWhole = v1::ContactSurface::FOOT_PART_WHOLE, kHeel = v1::ContactSurface::FOOT_PART_HEEL,
               kToe = v1::ContactSurface::FOOT_PART_TOE;

TEST(StandingPartsTest, AreAsLowAsTheLowest) {
  EXPECT_THAT(StandingOf({{"hip", 0.5}, {"knee", 0.08}, {"ankle", 0}}), ElementsAre(Pair("ankle", kWhole)));
  EXPECT_THAT(StandingOf({{"hip", 0.5}, {"knee", 0.08}, {"ankle", 0}, {"toe", 0}}),
              ElementsAre(Pair("ankle", kHeel), Pair("toe", kToe)));
  EXPECT_THAT(StandingOf({{"knee", 0.08}, {"ankle", kLow}, {"toe", 0}}),
              ElementsAre(Pair("ankle", kHeel), Pair("toe", kToe)));
  EXPECT_THAT(StandingOf({{"knee", 0.08}, {"ankle", kHigh}, {"toe", 0}}), ElementsAre(Pair("toe", kWhole)));
  EXPECT_THAT(StandingOf({{"knee", 0.08}, {"ankle", 0}, {"toe", kLow}}),
              ElementsAre(Pair("ankle", kHeel), Pair("toe", kToe)));
  EXPECT_THAT(StandingOf({{"knee", 0.08}, {"ankle", 0}, {"toe", kHigh}}), ElementsAre(Pair("ankle", kWhole)));
}

// Of three parts the outer ones; where the last is turned up, the two before it.
TEST(StandingPartsTest, OfMoreThanTwoTheFirstAndTheLastStand) {
  EXPECT_THAT(StandingOf({{"knee", 0.08}, {"ankle", 0}, {"middle", 0}, {"toe", 0}}),
              ElementsAre(Pair("ankle", kHeel), Pair("toe", kToe)));
  EXPECT_THAT(StandingOf({{"knee", 0.08}, {"ankle", 0}, {"middle", 0}, {"toe", kHigh}}),
              ElementsAre(Pair("ankle", kHeel), Pair("middle", kToe)));
}

// A joint of several axes has links without mass or shape between them; a part with mass is one, though not drawn.
TEST(StandingPartsTest, LinksBetweenAxesAreNoParts) {
  EXPECT_THAT(StandingOf({{"knee", 0.08}, {"ankle", 0}, {"toe_roll", 0, false, false}, {"toe", 0}}),
              ElementsAre(Pair("ankle", kHeel), Pair("toe", kToe)));
  EXPECT_THAT(StandingOf({{"knee", 0.08}, {"ankle", 0}, {"middle", 0, false, true}, {"toe", 0}}),
              ElementsAre(Pair("toe", kWhole)));
  EXPECT_THAT(StandingOf({{"knee", 0.08}, {"ankle", 0}, {"toe", 0, false, true}}), IsEmpty());
}

// Seen from the world the ellipsoid is where it was fitted, its axes along those of the world.
TEST(ContactOfTest, IsWhereItWasFittedWhateverTheLinksFrame) {
  const Pose place = {
      (Eigen::AngleAxisd(0.7, Vector3d::UnitX()) * Eigen::AngleAxisd(-1.1, Vector3d::UnitZ())).toRotationMatrix(),
      Vector3d(0.3, -0.2, 0.9)};
  const FittedEllipsoid foot = {Vector3d(0.35, 0.1, 0.05), Vector3d(0.12, 0.05, 0.04)};
  const v1::SideContact contact = ContactOf("left_foot", "foot", place, foot);
  EXPECT_EQ(contact.name(), "left_foot");
  EXPECT_EQ(contact.link(), "foot");
  EXPECT_EQ(ToVector(contact.surface().ellipsoid().semi_axes_m()), foot.semi_axes);
  EXPECT_LT((place.rotation * ToVector(contact.center_m()) + place.position - foot.center).norm(), 1e-11)
      << "coordinates are rounded to 1e-12 m";
  EXPECT_LT((place.rotation * ToRotation(contact.orientation()) - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_FALSE(ContactOf("f", "foot", {Eigen::Matrix3d::Identity(), place.position}, foot).has_orientation());
}

// Heel and toes of both feet; those of the right differ by `apart` (m) along y, as rounding makes them differ.
v1::ModelSideFile Feet(double apart) {
  v1::ModelSideFile side;
  for (const std::string foot : {"left", "right"}) {
    for (const std::string part : {"_heel", "_toes"}) {
      const double y = 0.03 + (foot == "right" ? apart : 0);
      const Pose turned = {Eigen::AngleAxisd(0.2, Vector3d::UnitZ()).toRotationMatrix(), Vector3d(0.1, 0, 0)};
      v1::SideContact& contact = *side.add_contacts();
      contact = ContactOf(foot + part, foot + part + "_link", turned,
                          {Vector3d(0.1, part == "_heel" ? 0.2 : 0.3, 0), Vector3d(0.1, y, 0.05)});
      contact.set_side(foot == "left" ? v1::BODY_SIDE_LEFT : v1::BODY_SIDE_RIGHT);
    }
  }
  return side;
}

TEST(AddFeetPairsTest, EachOfTheLeftIsPairedWithEachOfTheRight) {
  v1::ModelSideFile side = Feet(0);
  AddFeetPairs(&side);
  ASSERT_EQ(side.bodies_size(), 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(side.bodies(i).name(), side.contacts(i).name());
    EXPECT_EQ(side.bodies(i).link(), side.contacts(i).link());
    EXPECT_TRUE(MessageDifferencer::Equals(side.bodies(i).surface(), side.contacts(i).surface()));
    EXPECT_TRUE(MessageDifferencer::Equals(side.bodies(i).center_m(), side.contacts(i).center_m()));
    EXPECT_TRUE(MessageDifferencer::Equals(side.bodies(i).orientation(), side.contacts(i).orientation()));
    EXPECT_TRUE(side.bodies(i).has_orientation());
  }
  std::set<std::pair<std::string, std::string>> pairs;
  for (const v1::BodyPair& pair : side.body_pairs()) {
    EXPECT_TRUE(pair.usual());
    pairs.emplace(pair.first(), pair.second());
  }
  EXPECT_EQ(side.body_pairs_size(), 4);
  EXPECT_THAT(pairs, ElementsAre(Pair("left_heel", "right_heel"), Pair("left_heel", "right_toes"),
                                 Pair("left_toes", "right_heel"), Pair("left_toes", "right_toes")));
}

TEST(AddFeetPairsTest, InThePlaneLegsPassEachOther) {
  v1::ModelSideFile side = Feet(1e-6);
  side.set_base(v1::ModelSideFile::BASE_PLANE);
  AddFeetPairs(&side);
  EXPECT_EQ(side.bodies_size(), 0);
  EXPECT_EQ(side.body_pairs_size(), 0);
  EXPECT_EQ(side.contacts(2).surface().ellipsoid().semi_axes_m().y(), 0.03);
}

TEST(AddFeetPairsTest, OnlyRoundingIsMadeEqual) {
  for (const auto& [apart, expected] : {std::pair(1e-6, 0.03), std::pair(1e-4, 0.0301)}) {
    v1::ModelSideFile side = Feet(apart);
    AddFeetPairs(&side);
    for (const int right : {2, 3}) {
      EXPECT_EQ(side.contacts(right).surface().ellipsoid().semi_axes_m().y(), expected);
      EXPECT_EQ(side.bodies(right).surface().ellipsoid().semi_axes_m().y(), expected) << "the body is the contact";
      EXPECT_EQ(side.contacts(right - 2).surface().ellipsoid().semi_axes_m().y(), 0.03);
    }
  }
}

}  // namespace
}  // namespace rollgait::client
