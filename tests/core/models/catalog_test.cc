#include "core/models/catalog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "core/multibody/body_dynamics.h"
#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

BodyRequest Planar() {
  BodyRequest request;
  request.model = "planar";
  return request;
}

TEST(CatalogTest, EveryEntryBuildsAsListed) {
  std::set<std::string> names;
  for (const CatalogEntry& entry : ListCatalog()) {
    EXPECT_TRUE(names.insert(entry.name).second);
    EXPECT_FALSE(entry.description.empty());
    for (const Sex sex : {Sex::kFemale, Sex::kMale}) {
      BodyRequest request;
      request.model = entry.name;
      request.sex = sex;
      const Result<Scene> scene = BuildScene(request);
      ASSERT_TRUE(scene.ok()) << entry.name;
      EXPECT_EQ(scene.value().name, entry.name);
      EXPECT_EQ(scene.value().selection.model, entry.name);
      EXPECT_EQ(scene.value().model.size(), entry.degrees_of_freedom);
      EXPECT_EQ(scene.value().model.actuated().size(), static_cast<size_t>(entry.actuated_joints));
      ASSERT_EQ(scene.value().contacts.size(), entry.contacts.size());
      for (const std::string& contact : entry.contacts) EXPECT_GE(scene.value().FindContact(contact), 0);
    }
  }
  EXPECT_EQ(names.count("planar"), 1u);
}

// The tree is one that dynamics can work with, and left and right are the same: at a mirrored posture the mass matrix
// has its rows and columns exchanged.
TEST(CatalogTest, MassMatrixIsThatOfInverseDynamicsAndMirrors) {
  for (const CatalogEntry& entry : ListCatalog()) {
    BodyRequest request;
    request.model = entry.name;
    const Result<Scene> scene = BuildScene(request);
    ASSERT_TRUE(scene.ok());
    const Model& model = scene.value().model;
    const BodyDynamics dynamics(model);
    const int n = model.size();
    const auto mass_matrix = [&](const VectorX& q) {
      BodyDynamics::State state;
      BodyDynamics::Workspace workspace;
      MatrixX mass;
      dynamics.ComputeState(q, VectorX::Zero(n), &state);
      dynamics.MassMatrix(state, &workspace, &mass);
      for (int i = 0; i < n; ++i) {
        VectorX column;
        dynamics.InverseDynamics(state, VectorX::Unit(n, i), Vector3::Zero(), &workspace, &column);
        EXPECT_TRUE(MatrixNear(mass.col(i), column, 1e-12)) << entry.name << " " << i;  // rounding of 75 kg m²
      }
      return mass;
    };
    const VectorX q = SeededRandom(17).VectorOf(n, -0.6, 0.6);
    VectorX mirrored(n);
    MatrixX exchange = MatrixX::Zero(n, n);
    for (int i = 0; i < n; ++i) {
      exchange(i, model.joint(i).mirror_joint) = model.joint(i).mirror_sign;
    }
    mirrored = exchange * q;
    const MatrixX mass = mass_matrix(q);
    EXPECT_EQ(mass.llt().info(), Eigen::Success);
    EXPECT_TRUE(MatrixNear(mass_matrix(mirrored), exchange * mass * exchange.transpose(), 1e-12));
    // A ball looks the same from both sides.
    EXPECT_TRUE(entry.name == "ball" || (mass_matrix(mirrored) - mass).norm() > 0.1) << entry.name;
  }
}

TEST(CatalogTest, StandingStraightIsWithinEveryLimit) {
  for (const CatalogEntry& entry : ListCatalog()) {
    BodyRequest request;
    request.model = entry.name;
    const Result<Scene> scene = BuildScene(request);
    ASSERT_TRUE(scene.ok());
    for (const Joint& joint : scene.value().model.joints()) {
      EXPECT_LE(joint.position_min, 0) << joint.name;
      EXPECT_GE(joint.position_max, 0) << joint.name;
      EXPECT_EQ(joint.actuated, joint.effort_max > 0) << joint.name;
    }
  }
}

TEST(CatalogTest, PlanarHumanIsListedWithItsContacts) {
  const CatalogEntry entry = ListCatalog().front();
  EXPECT_EQ(entry.name, "planar");
  EXPECT_EQ(entry.degrees_of_freedom, 9);
  EXPECT_EQ(entry.actuated_joints, 6);
  EXPECT_THAT(entry.contacts, ElementsAre("left_foot", "right_foot"));
}

// It has the arms that "planar" lacks, and nothing that leaves the plane.
TEST(CatalogTest, PlanarArmsSwingInThePlane) {
  BodyRequest request;
  request.model = "planar_arms";
  const Result<Scene> scene = BuildScene(request);
  ASSERT_TRUE(scene.ok());
  const Model& model = scene.value().model;
  EXPECT_EQ(model.size(), 13);
  EXPECT_EQ(model.actuated().size(), 10u);
  for (const char* name : {"shoulder_l", "shoulder_r", "elbow_l", "elbow_r"}) {
    EXPECT_GE(model.Find(name), 0) << name;
  }
  EXPECT_EQ(model.Find("trunk_flexion"), -1);
  for (const Joint& joint : model.joints()) {
    EXPECT_EQ(joint.axis.y() == 0, joint.type == JointType::kPrismatic) << joint.name;
  }
  EXPECT_NEAR(model.total_mass(), 75, 1e-9);
}

TEST(CatalogTest, DefaultsDependOnSex) {
  BodyRequest request = Planar();
  const Result<Scene> male = BuildScene(request);
  ASSERT_TRUE(male.ok());
  EXPECT_EQ(male.value().selection.stature, 1.774);
  EXPECT_EQ(male.value().selection.mass, 75);
  request.sex = Sex::kFemale;
  const Result<Scene> female = BuildScene(request);
  ASSERT_TRUE(female.ok());
  EXPECT_EQ(female.value().selection.sex, Sex::kFemale);
  EXPECT_EQ(female.value().selection.stature, 1.610);
  EXPECT_EQ(female.value().selection.mass, 62);
}

TEST(CatalogTest, LimitsAreInclusive) {
  for (const auto& [stature, mass] : {std::pair{1.0, 20.0}, {2.3, 250.0}}) {
    BodyRequest request = Planar();
    request.stature = stature;
    request.mass = mass;
    EXPECT_TRUE(BuildScene(request).ok());
  }
}

TEST(CatalogTest, RefusesAnUnknownModelAndListsTheKnownOnes) {
  for (const char* name : {"", "biped", "planar ", "Planar"}) {
    BodyRequest request = Planar();
    request.model = name;
    const Result<Scene> scene = BuildScene(request);
    ASSERT_FALSE(scene.ok()) << name;
    ASSERT_EQ(scene.violations().size(), 1u);
    EXPECT_EQ(scene.violations()[0].field, "name");
    EXPECT_THAT(scene.violations()[0].message, HasSubstr("\"planar\""));
  }
}

TEST(CatalogTest, RefusesBodiesOutOfRangeWithValueAndLimits) {
  BodyRequest request;
  request.model = "biped";
  request.stature = 2.31;
  request.mass = 19.9;
  const Result<Scene> scene = BuildScene(request);
  ASSERT_FALSE(scene.ok());
  ASSERT_EQ(scene.violations().size(), 3u);
  EXPECT_EQ(scene.violations()[1].field, "stature_m");
  EXPECT_THAT(scene.violations()[1].message, AllOf(HasSubstr("2.31 m"), HasSubstr("between 1 and 2.3 m")));
  EXPECT_EQ(scene.violations()[2].field, "body_mass_kg");
  EXPECT_THAT(scene.violations()[2].message, AllOf(HasSubstr("19.9 kg"), HasSubstr("between 20 and 250 kg")));
}

TEST(CatalogTest, RefusesNumbersThatAreNotFinite) {
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity}) {
    BodyRequest request = Planar();
    request.stature = value;
    EXPECT_FALSE(BuildScene(request).ok());
    request = Planar();
    request.mass = value;
    EXPECT_FALSE(BuildScene(request).ok());
  }
}

}  // namespace
}  // namespace rollgait
