#include "bench/verdict_audit/friction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/models/catalog.h"

namespace rollgait::audit {
namespace {

Scene TwoEllipsoids(const std::string& model) {
  BodyRequest request;
  request.model = model;
  request.feet = FootShape::kTwoEllipsoids;
  return BuildScene(request).value();
}

// Contacts of the right foot.
std::vector<int> RightFoot(const Scene& scene) {
  std::vector<int> contacts;
  for (size_t c = 0; c < scene.contacts.size(); ++c) {
    if (scene.contacts[c].name.find("right") != std::string::npos) contacts.push_back(static_cast<int>(c));
  }
  return contacts;
}

TEST(LeastFrictionRatio, OneContactNeedsWhatItsForceSays) {
  const Scene scene = TwoEllipsoids("human29");
  const std::vector<int> one = {RightFoot(scene).front()};
  EXPECT_DOUBLE_EQ(LeastFrictionRatio(scene, one, {Vector3::Zero()}, {Vector3(30, 40, 100)}, 1), 0.5);
  EXPECT_DOUBLE_EQ(LeastFrictionRatio(scene, one, {Vector3::Zero()}, {Vector3(3, 0, -100)}, 6), 0.5) << "the floor";
}

// Along the line together 70 N on 700 N, however large the internal force.
TEST(LeastFrictionRatio, ForcesAlongTheLineDoNotCount) {
  for (const char* model : {"planar", "human29"}) {
    const Scene scene = TwoEllipsoids(model);
    const std::vector<int> both = RightFoot(scene);
    ASSERT_EQ(both.size(), 2u);
    ASSERT_EQ(scene.contacts[both[0]].joint, scene.contacts[both[1]].joint);
    const std::vector<Vector3> points = {Vector3(0.1, 0, 0), Vector3(0.28, 0, 0)};
    for (const double internal : {0.0, 250.0, -900.0}) {
      const std::vector<Vector3> forces = {Vector3(70 + internal, 0, 400), Vector3(-internal, 0, 300)};
      EXPECT_NEAR(LeastFrictionRatio(scene, both, points, forces, 1), 0.1, 1e-9) << model << internal;
    }
  }
}

// Across the line each contact holds its own: 60 on 300 N; along it 0.
TEST(LeastFrictionRatio, ForcesAcrossTheLineCount) {
  const Scene scene = TwoEllipsoids("human29");
  const std::vector<Vector3> points = {Vector3(0.1, 0, 0), Vector3(0.28, 0, 0)};
  const std::vector<Vector3> forces = {Vector3(500, 0, 400), Vector3(-500, 60, 300)};
  EXPECT_NEAR(LeastFrictionRatio(scene, RightFoot(scene), points, forces, 1), 0.2, 1e-9);
}

}  // namespace
}  // namespace rollgait::audit
