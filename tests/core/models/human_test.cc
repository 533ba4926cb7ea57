#include "core/models/human.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "core/models/catalog.h"
#include "core/multibody/body_dynamics.h"
#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

constexpr double kDegree = std::numbers::pi / 180;

BodyRequest Request(Sex sex = Sex::kMale) {
  BodyRequest request;
  request.model = "human29";
  request.sex = sex;
  return request;
}

BodyDynamics::State StateAt(const Model& model, const VectorX& q) {
  BodyDynamics::State state;
  BodyDynamics(model).ComputeState(q, VectorX::Zero(model.size()), &state);
  return state;
}

TEST(HumanTest, HasTwentyNineDegreesOfFreedomWithAndThirtyOneWithToes) {
  BodyRequest request = Request();
  const Scene scene = BuildScene(request).value();
  EXPECT_EQ(scene.model.size(), 29);
  EXPECT_EQ(scene.model.actuated().size(), 23u);
  EXPECT_TRUE(scene.symmetric);
  request.toes = true;
  const Scene toes = BuildScene(request).value();
  EXPECT_EQ(toes.model.size(), 31);
  EXPECT_EQ(toes.model.actuated().size(), 25u);
  std::vector<std::string> names;
  for (const ContactSurface& contact : toes.contacts) names.push_back(contact.name);
  EXPECT_THAT(names, ElementsAre("left_heel", "left_forefoot", "right_heel", "right_forefoot"));
  for (int c = 0; c < 4; ++c) {
    EXPECT_EQ(toes.contacts[c].mirror_contact, (c + 2) % 4);
    EXPECT_EQ(toes.model.joint(toes.contacts[c].joint).name.substr(0, 3), c % 2 == 0 ? "ank" : "toe");
  }
}

// Sex, stature and mass in every corner of the ranges build physical trees of the right mass that stand on their soles.
TEST(HumanTest, EveryBodyStandsOnItsSoles) {
  for (const Sex sex : {Sex::kFemale, Sex::kMale}) {
    for (const double stature : {1.0, 1.7, 2.3}) {
      for (const double mass : {20.0, 250.0}) {
        for (const bool toes : {false, true}) {
          BodyRequest request = Request(sex);
          request.stature = stature;
          request.mass = mass;
          request.toes = toes;
          const Result<Scene> built = BuildScene(request);
          ASSERT_TRUE(built.ok());
          const Scene& scene = built.value();
          EXPECT_NEAR(scene.model.total_mass(), mass, 1e-12 * mass);
          const BodyDynamics::State state = StateAt(scene.model, VectorX::Zero(scene.model.size()));
          for (const ContactSurface& contact : scene.contacts) {
            const BodyDynamics::Link& link = state[contact.joint];
            EXPECT_TRUE(link.R_WL.isIdentity(0));
            const double lowest = (link.p_WL + contact.p_LE).z() - contact.surface.Support(-Vector3::UnitZ());
            EXPECT_NEAR(lowest, -scene.leg_length, 1e-12);
          }
          const int neck = scene.model.Find("trunk_rotation");
          EXPECT_GT(state[neck].p_WL.z(), 0);
        }
      }
    }
  }
}

// Which way each joint moves what it carries.
TEST(HumanTest, SignsAreThoseOfTheHeader) {
  const Scene scene = BuildScene(Request()).value();
  const Model& model = scene.model;
  const auto moved = [&](const char* joint, const char* link, const Vector3& point) {
    VectorX q = VectorX::Zero(model.size());
    const auto at = [&] {
      const BodyDynamics::Link link_at = StateAt(model, q)[model.Find(link)];
      return Vector3(link_at.p_WL + link_at.R_WL * point);
    };
    const Vector3 before = at();
    q(model.Find(joint)) = 0.3;
    return Vector3(at() - before);
  };
  const Vector3 down(0, 0, -0.3), up(0, 0, 0.3), ahead(0.2, 0, 0);
  for (const std::string side : {"_l", "_r"}) {
    const double outward = side == "_l" ? 1 : -1;
    const auto named = [&](const char* joint) { return std::string(joint) + side; };
    const auto of = [&](const char* joint, const char* link, const Vector3& point) {
      return moved(named(joint).c_str(), named(link).c_str(), point);
    };
    EXPECT_GT(of("hip", "knee", down).x(), 0.05);
    EXPECT_LT(of("hip_adduction", "knee", down).y() * outward, -0.05);
    EXPECT_LT(of("hip_rotation", "ankle_inversion", ahead).y() * outward, -0.05);
    EXPECT_LT(of("knee", "ankle_inversion", Vector3::Zero()).x(), -0.05);
    EXPECT_GT(of("ankle", "ankle_inversion", ahead).z(), 0.05);
    EXPECT_GT(of("ankle_inversion", "ankle_inversion", Vector3(0, -outward * 0.1, 0)).z(), 0.02);  // inner edge up
    EXPECT_GT(of("shoulder", "elbow", down).x(), 0.05);
    EXPECT_LT(of("shoulder_adduction", "elbow", down).y() * outward, -0.05);
    EXPECT_LT(of("shoulder_rotation", "elbow", ahead).y() * outward, -0.05);
    EXPECT_GT(of("elbow", "elbow", down).x(), 0.05);
  }
  EXPECT_GT(moved("base_yaw", "base_pitch", ahead).y(), 0.05);
  EXPECT_LT(moved("base_roll", "base_pitch", up).y(), -0.05);
  EXPECT_GT(moved("base_pitch", "base_pitch", up).x(), 0.05);
  EXPECT_GT(moved("trunk_flexion", "trunk_rotation", up).x(), 0.05);
  EXPECT_LT(moved("trunk_bending", "trunk_rotation", up).y(), -0.05);
  EXPECT_GT(moved("trunk_rotation", "trunk_rotation", ahead).y(), 0.05);
}

// Mirrored joint values put every link at the mirror image of its partner.
TEST(HumanTest, MirroredPosturesAreMirrorImages) {
  const Scene scene = BuildScene(Request(Sex::kFemale)).value();
  const Model& model = scene.model;
  const Matrix3 mirror = Vector3(1, -1, 1).asDiagonal();
  SeededRandom random(4);
  for (int i = 0; i < 20; ++i) {
    const VectorX q = random.VectorOf(29, -1, 1);
    VectorX image(29);
    for (int j = 0; j < 29; ++j) image(j) = model.joint(j).mirror_sign * q(model.joint(j).mirror_joint);
    const BodyDynamics::State at = StateAt(model, q), mirrored = StateAt(model, image);
    for (int j = 0; j < 29; ++j) {
      const BodyDynamics::Link& partner = mirrored[model.joint(j).mirror_joint];
      EXPECT_TRUE(MatrixNear(partner.p_WL, mirror * at[j].p_WL, 1e-13));
      EXPECT_TRUE(MatrixNear(partner.R_WL, mirror * at[j].R_WL * mirror, 1e-13));
    }
  }
}

// The chart of the pelvis: its angular velocity is a regular image of the three rates, least near the bound of the
// roll, where the smallest singular value of the columns (z, x', y'') is √(1 − sin 60°).
TEST(HumanTest, ChartOfTheBaseIsRegularWithinItsRange) {
  BodyRequest request = Request();
  request.ranges = JointRanges::kAnatomical;
  const Scene scene = BuildScene(request).value();
  const Model& model = scene.model;
  const int yaw = model.Find("base_yaw"), roll = model.Find("base_roll"), pitch = model.Find("base_pitch");
  EXPECT_NEAR(model.joint(roll).position_max, 60 * kDegree, 1e-12);
  EXPECT_EQ(model.joint(roll).position_min, -model.joint(roll).position_max);
  EXPECT_EQ(model.joint(yaw).position_max, kInfinity);
  EXPECT_EQ(model.joint(pitch).position_max, kInfinity);
  SeededRandom random(6);
  double least = 1;
  for (int i = 0; i < 200; ++i) {
    VectorX q = VectorX::Zero(29);
    q(yaw) = random.Uniform(-7, 7);
    q(pitch) = random.Uniform(-7, 7);
    q(roll) = i < 10 ? model.joint(roll).position_max : random.Uniform(-1, 1) * model.joint(roll).position_max;
    const BodyDynamics::State state = StateAt(model, q);
    Matrix3 axes;
    for (int k = 0; k < 3; ++k) {
      const int joint = std::array{yaw, roll, pitch}[k];
      axes.col(k) = state[joint].R_WL * model.joint(joint).axis;
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(axes.transpose() * axes, Eigen::EigenvaluesOnly);
    least = std::min(least, std::sqrt(solver.eigenvalues()(0)));
  }
  EXPECT_NEAR(least, std::sqrt(1 - std::sin(60 * kDegree)), 1e-6);
}

TEST(HumanTest, SwitchesAndLocksReduceTheTree) {
  BodyRequest request = Request();
  request.drop_arms = true;
  EXPECT_EQ(BuildScene(request).value().model.size(), 21);
  request.rigid_trunk = true;
  EXPECT_EQ(BuildScene(request).value().model.size(), 18);
  request.sagittal = true;
  const Scene plane = BuildScene(request).value();
  EXPECT_EQ(plane.model.size(), 9);
  EXPECT_EQ(plane.contacts[0].directions, (std::vector<int>{0, 2}));
  request = Request();
  request.sagittal = true;
  EXPECT_EQ(BuildScene(request).value().model.size(), 3 + 6 + 1 + 4);
  request = Request();
  request.locked_joints = {{"knee_l", 0.2}, {"knee_r", 0.2}};
  EXPECT_EQ(BuildScene(request).value().model.size(), 27);
  EXPECT_TRUE(BuildScene(request).value().symmetric);
  request.locked_joints = {{"knee_l", 0.2}};
  const Scene limping = BuildScene(request).value();
  EXPECT_FALSE(limping.symmetric);
  EXPECT_EQ(limping.model.joint(limping.model.Find("hip_r")).mirror_joint, limping.model.Find("hip_r"));
}

// Ranges of walking lie within the anatomical ones and leave efforts and speeds alone.
TEST(HumanTest, WalkingRangesAreWithinTheAnatomicalOnes) {
  BodyRequest request = Request();
  request.toes = true;
  request.ranges = JointRanges::kAnatomical;
  const Model anatomical = BuildScene(request).value().model;
  request.ranges = JointRanges::kWalking;
  const Model walking = BuildScene(request).value().model;
  int narrower = 0;
  for (int j = 0; j < walking.size(); ++j) {
    const Joint &narrow = walking.joint(j), &wide = anatomical.joint(j);
    EXPECT_GE(narrow.position_min, wide.position_min) << narrow.name;
    EXPECT_LE(narrow.position_max, wide.position_max) << narrow.name;
    EXPECT_EQ(narrow.effort_max, wide.effort_max);
    EXPECT_EQ(narrow.velocity_max, wide.velocity_max);
    narrower += narrow.position_max < wide.position_max;
  }
  EXPECT_EQ(narrower, 3 + 25);  // the turns of the base and every actuated joint
  request.ranges.reset();
  EXPECT_EQ(BuildScene(request).value().selection.ranges, JointRanges::kWalking);
  request.model = "planar";
  EXPECT_EQ(BuildScene(request).value().selection.ranges, JointRanges::kAnatomical);
}

TEST(HumanTest, SegmentLengthsMoveTheJoints) {
  BodyRequest request = Request();
  request.segment_lengths = {{"thigh", 0.45}, {"shank", 0.40}, {"foot", 0.30}};
  const Scene scene = BuildScene(request).value();
  EXPECT_NEAR(scene.leg_length, 0.45 + 0.40 + 0.08, 1e-12);
  EXPECT_NEAR(scene.contacts[0].surface.Support(Vector3::UnitX()), 0.15, 1e-12);
  EXPECT_NEAR(scene.model.joint(scene.model.Find("knee_r")).p_PJ.z(), -0.45, 1e-12);
  const Scene usual = BuildScene(Request()).value();
  const int thigh = scene.model.Find("hip_rotation_l");
  EXPECT_EQ(scene.model.joint(thigh).mass, usual.model.joint(thigh).mass);
  EXPECT_TRUE(MatrixNear(scene.model.joint(thigh).inertia, std::pow(0.45 / 0.432, 2) * usual.model.joint(thigh).inertia,
                         1e-12));
}

TEST(HumanTest, RefusesWhatABodyCannotBe) {
  BodyRequest request = Request();
  request.toes = true;
  request.feet = FootShape::kOneEllipsoid;
  request.drop_arms = true;
  request.segment_lengths = {{"thigh", 2}, {"tail", 1}};
  request.locked_joints = {{"knee_l", -0.1}, {"elbow_r", 0}, {"base_x", 0}, {"nose", 0}};
  const Result<Scene> scene = BuildScene(request);
  ASSERT_FALSE(scene.ok());
  std::map<std::string, std::string> said;
  for (const Violation& violation : scene.violations()) said[violation.field] = violation.message;
  EXPECT_THAT(said["toes"], HasSubstr("feet of two ellipsoids"));
  EXPECT_THAT(said["segment_lengths_m[\"thigh\"]"],
              AllOf(HasSubstr("is 2 m"), HasSubstr("0.3024"), HasSubstr("0.6048")));
  EXPECT_THAT(said["segment_lengths_m[\"tail\"]"], HasSubstr("upper_arm"));
  EXPECT_THAT(said["locked_joints_rad[\"knee_l\"]"], AllOf(HasSubstr("-0.1 rad"), HasSubstr("0 to 1.57")));
  EXPECT_THAT(said["locked_joints_rad[\"elbow_r\"]"], HasSubstr("drop_arms"));
  EXPECT_THAT(said["locked_joints_rad[\"base_x\"]"], HasSubstr("floating base"));
  EXPECT_THAT(said["locked_joints_rad[\"nose\"]"], HasSubstr("no joint"));
  EXPECT_EQ(said.size(), 7u);
}

}  // namespace
}  // namespace rollgait
