// Feet that a request shapes: semi-axes and exponents of their surfaces, and what is refused of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/models/catalog.h"
#include "core/models/foot.h"

namespace rollgait {
namespace {

using ::testing::HasSubstr;

BodyRequest Human() {
  BodyRequest request;
  request.model = "human29";
  return request;
}

Scene Built(const BodyRequest& request) { return BuildScene(request).value(); }

// The ellipsoids have the semi-axes that are asked for, and touch the ground where the foot does: lowest points at the
// sole, the heel's end at the heel, the forefoot's end at the toes.
TEST(SubjectFeet, HaveTheSemiAxesOfTheRequest) {
  BodyRequest request = Human();
  request.feet = FootShape::kTwoEllipsoids;
  const Scene bare = Built(request);
  const Vector3 heel(0.03, 0.025, 0.02), left(0.06, 0.04, 0.018);
  request.changes.foot_semi_axes = {{"heel", heel}, {"forefoot_l", left}};
  const Scene scene = Built(request);
  EXPECT_FALSE(scene.symmetric);
  const auto contact = [](const Scene& of, const char* name) {
    return of.contacts[static_cast<size_t>(of.FindContact(name))];
  };
  const auto axes = [&](const Scene& of, const char* name) {
    return contact(of, name).surface.ellipsoid()->semi_axes();
  };
  EXPECT_EQ(axes(scene, "left_heel"), heel);
  EXPECT_EQ(axes(scene, "right_heel"), heel);
  EXPECT_EQ(axes(scene, "left_forefoot"), left);
  EXPECT_EQ(axes(scene, "right_forefoot"), axes(bare, "right_forefoot"));
  for (const char* name : {"left_heel", "right_heel", "left_forefoot", "right_forefoot"}) {
    const Vector3 now = contact(scene, name).p_LE, before = contact(bare, name).p_LE;
    const Vector3 size = axes(scene, name), usual = axes(bare, name);
    EXPECT_NEAR(now.z() - size.z(), before.z() - usual.z(), 1e-15) << name;
    const double end = std::string(name).ends_with("heel") ? -1 : 1;
    EXPECT_NEAR(now.x() + end * size.x(), before.x() + end * usual.x(), 1e-15) << name;
  }
  EXPECT_EQ(scene.model.total_mass(), bare.model.total_mass());
  request.changes.foot_semi_axes = {{"heel", heel}, {"forefoot", left}};
  EXPECT_TRUE(Built(request).symmetric);
}

TEST(SubjectFeet, AreRefusedByNameAndRange) {
  BodyRequest request = Human();
  const auto refusal = [&](const std::string& name, const Vector3& axes) {
    request.changes.foot_semi_axes = {{name, axes}};
    const Result<Scene> scene = BuildScene(request);
    if (scene.ok()) return std::string("taken");
    EXPECT_EQ(scene.violations().size(), 1u);
    EXPECT_EQ(scene.violations()[0].field, "foot_semi_axes_m[\"" + name + "\"]");
    return scene.violations()[0].message;
  };
  const Vector3 usual = Built(request).contacts[0].surface.ellipsoid()->semi_axes();
  EXPECT_EQ(refusal("foot", usual), "taken");
  EXPECT_EQ(refusal("foot_r", usual.cwiseProduct(Vector3(0.5, 1.5, 0.25))), "taken");
  EXPECT_THAT(refusal("foot", usual.cwiseProduct(Vector3(1.51, 1, 1))), HasSubstr("m; must be between ("));
  EXPECT_THAT(refusal("foot_l", usual.cwiseProduct(Vector3(1, 1, 2.01))), HasSubstr("up 0.25 to 2 times"));
  EXPECT_THAT(refusal("foot", Vector3(0.1, std::nan(""), 0.05)), HasSubstr("must be between"));
  EXPECT_THAT(refusal("heel", usual), HasSubstr("is no surface of these feet; choose from foot"));
  EXPECT_THAT(refusal("foto", usual), HasSubstr("did you mean foot?"));
  // What suits the longer foot alone is not left out of the shorter one without a word.
  request.segment_lengths = {{"foot_r", 0.2}};
  EXPECT_THAT(refusal("foot", usual.cwiseProduct(Vector3(1.45, 1, 1))), HasSubstr("m; must be between ("));
  EXPECT_EQ(refusal("foot_l", usual.cwiseProduct(Vector3(1.45, 1, 1))), "taken");
}

TEST(SubjectFeet, HaveTheExponentsOfTheRequest) {
  BodyRequest request = Human();
  request.feet = FootShape::kTwoEllipsoids;
  const Scene bare = Built(request);
  request.changes.foot_semi_axes = {{"heel", Vector3(0.03, 0.025, 0.02)}};
  request.changes.foot_exponents = {{"heel", 0.8}, {"forefoot_l", 1.2}};
  const Scene scene = Built(request);
  EXPECT_FALSE(scene.symmetric);
  const auto shape = [&](const char* name) {
    return scene.contacts[static_cast<size_t>(scene.FindContact(name))].surface.plain<SmoothSuperellipsoid>();
  };
  for (const char* name : {"left_heel", "right_heel"}) {
    ASSERT_NE(shape(name), nullptr) << name;
    EXPECT_EQ(shape(name)->exponent_1(), 0.8);
    EXPECT_EQ(shape(name)->exponent_2(), 0.8);
    EXPECT_EQ(shape(name)->smoothing(), kFootSmoothing);
    EXPECT_EQ(shape(name)->semi_axes(), Vector3(0.03, 0.025, 0.02));
  }
  ASSERT_NE(shape("left_forefoot"), nullptr);
  EXPECT_EQ(shape("left_forefoot")->exponent_1(), 1.2);
  EXPECT_EQ(shape("left_forefoot")->semi_axes(),
            *bare.contacts[static_cast<size_t>(bare.FindContact("left_forefoot"))].surface.semi_axes());
  EXPECT_EQ(shape("right_forefoot"), nullptr);
  request.changes.foot_exponents = {{"heel", 0.8}, {"forefoot", 1.2}};
  EXPECT_TRUE(Built(request).symmetric);
}

TEST(SubjectFeet, ExponentsAreRefusedByNameAndRange) {
  BodyRequest request = Human();
  const auto refusal = [&](const std::string& name, double exponent) {
    request.changes.foot_exponents = {{name, exponent}};
    const Result<Scene> scene = BuildScene(request);
    if (scene.ok()) return std::string("taken");
    EXPECT_EQ(scene.violations().size(), 1u);
    EXPECT_EQ(scene.violations()[0].field, "foot_exponents[\"" + name + "\"]");
    return scene.violations()[0].message;
  };
  EXPECT_EQ(refusal("foot", kLeastFootExponent), "taken");
  EXPECT_EQ(refusal("foot_l", kMostFootExponent), "taken");
  EXPECT_EQ(refusal("foot", 0.1),
            "is 0.1; must be between 0.4 and 1.8 (1 is the ellipsoid): boxier feet are not known to walk");
  EXPECT_THAT(refusal("foot_r", 1.95), HasSubstr("more pointed feet"));
  EXPECT_THAT(refusal("foot", std::nan("")), HasSubstr("must be between"));
  EXPECT_THAT(refusal("heel", 0.8), HasSubstr("is no surface of these feet; choose from foot"));
}

// A refused length or foot does not make toe joints unknown.
TEST(SubjectFeet, DoNotTakeTheToesAway) {
  BodyRequest request = Human();
  request.model = "human29";
  request.feet = FootShape::kTwoEllipsoids;
  request.toes = true;
  request.changes.foot_semi_axes = {{"heel", Vector3(1, 1, 1)}};
  request.changes.strengths = {{"toe_l", 0.5}};
  const Result<Scene> scene = BuildScene(request);
  ASSERT_FALSE(scene.ok());
  ASSERT_EQ(scene.violations().size(), 1u);
  EXPECT_EQ(scene.violations()[0].field, "foot_semi_axes_m[\"heel\"]");
}

}  // namespace
}  // namespace rollgait
