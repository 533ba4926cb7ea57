#include "core/models/planar_human.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <numbers>
#include <utility>
#include <vector>

#include "core/models/segment_table.h"
#include "tests/support/matrix_near.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

struct Pose {
  Matrix3 R_WL;
  Vector3 p_WL;
};

// Forward kinematics from the contract of model.h alone.
std::vector<Pose> Poses(const Model& model, const VectorX& q) {
  std::vector<Pose> poses;
  for (int i = 0; i < model.size(); ++i) {
    const Joint& joint = model.joint(i);
    const Pose parent = joint.parent < 0 ? Pose{Matrix3::Identity(), Vector3::Zero()} : poses[joint.parent];
    Pose pose{parent.R_WL * joint.R_PJ, parent.p_WL + parent.R_WL * joint.p_PJ};
    if (joint.type == JointType::kRevolute) {
      pose.R_WL = pose.R_WL * Eigen::AngleAxisd(q(i), joint.axis).toRotationMatrix();
    } else {
      pose.p_WL += pose.R_WL * joint.axis * q(i);
    }
    poses.push_back(pose);
  }
  return poses;
}

// Height of the lowest point of a contact above z = 0, and where it is.
Vector3 LowestPoint(const Scene& scene, int contact, const std::vector<Pose>& poses) {
  const ContactSurface& foot = scene.contacts[contact];
  const Pose& pose = poses[foot.joint];
  const Matrix3 R_WE = pose.R_WL * foot.R_LE;
  return pose.p_WL + pose.R_WL * foot.p_LE + R_WE * foot.surface.SupportPoint(-R_WE.transpose() * Vector3::UnitZ());
}

std::vector<Scene> Scenes() {
  std::vector<Scene> scenes;
  for (const Sex sex : {Sex::kFemale, Sex::kMale}) {
    for (const auto& [stature, mass] :
         {std::pair{DefaultStature(sex), DefaultMass(sex)}, {1.0, 20.0}, {1.0, 250.0}, {2.3, 20.0}, {2.3, 250.0}}) {
      scenes.push_back(PlanarHuman(sex, stature, mass));
    }
  }
  return scenes;
}

TEST(PlanarHumanTest, HasTheStatedTreeAndTotalMass) {
  const char* names[] = {"base_x", "base_z", "base_pitch", "hip_l", "knee_l", "ankle_l", "hip_r", "knee_r", "ankle_r"};
  const int parents[] = {-1, 0, 1, 2, 3, 4, 2, 6, 7};
  for (const Scene& scene : Scenes()) {
    ASSERT_EQ(scene.model.size(), 9);
    for (int i = 0; i < 9; ++i) {
      EXPECT_EQ(scene.model.joint(i).name, names[i]);
      EXPECT_EQ(scene.model.parent(i), parents[i]);
      EXPECT_EQ(scene.model.joint(i).actuated, i >= 3);
    }
    EXPECT_NEAR(scene.model.total_mass(), scene.selection.mass, 1e-12);
    EXPECT_FALSE(scene.sources.empty());
  }
}

TEST(PlanarHumanTest, LinksAreRigidBodiesWithMassExceptTheSlides) {
  for (const Scene& scene : Scenes()) {
    for (int i = 0; i < scene.model.size(); ++i) {
      const Joint& joint = scene.model.joint(i);
      EXPECT_EQ(joint.mass > 0, i >= 2);
      const Vector3 moments = Eigen::SelfAdjointEigenSolver<Matrix3>(joint.inertia).eigenvalues();
      EXPECT_GE(moments(0) + moments(1), moments(2)) << joint.name;
      EXPECT_EQ(moments(0) > 0, i >= 2) << joint.name;
    }
  }
}

TEST(PlanarHumanTest, LeftMirrorsRight) {
  const Matrix3 mirror = Vector3(1, -1, 1).asDiagonal();
  for (const Scene& scene : Scenes()) {
    for (int i = 0; i < scene.model.size(); ++i) {
      const Joint& joint = scene.model.joint(i);
      const Joint& image = scene.model.joint(joint.mirror_joint);
      EXPECT_EQ(joint.mirror_joint, i < 3 ? i : (i < 6 ? i + 3 : i - 3));
      EXPECT_EQ(joint.mirror_sign, 1);
      EXPECT_EQ(joint.axis, image.axis);
      EXPECT_EQ(joint.p_PJ, mirror * image.p_PJ);
      EXPECT_EQ(joint.position_min, image.position_min);
      EXPECT_EQ(joint.position_max, image.position_max);
      EXPECT_EQ(joint.effort_max, image.effort_max);
      // The trunk is its own image up to the rounding of the sum over its parts.
      EXPECT_TRUE(MatrixNear(joint.center_of_mass, mirror * image.center_of_mass, 1e-15));
      EXPECT_TRUE(MatrixNear(joint.inertia, mirror * image.inertia * mirror, 1e-14 * scene.selection.mass));
    }
    const ContactSurface &left = scene.contacts[0], &right = scene.contacts[1];
    EXPECT_EQ(left.mirror_contact, 1);
    EXPECT_EQ(right.mirror_contact, 0);
    EXPECT_EQ(left.p_LE, mirror * right.p_LE);
    EXPECT_EQ(left.surface.ellipsoid()->semi_axes(), right.surface.ellipsoid()->semi_axes());
  }
}

TEST(PlanarHumanTest, AxesAreClinical) {
  const Scene scene = PlanarHuman(Sex::kMale, 1.774, 75);
  const Model& model = scene.model;
  const auto at = [&](const char* joint, const char* link, double angle) {
    VectorX q = VectorX::Zero(9);
    q(model.Find(joint)) = angle;
    return Poses(model, q)[model.Find(link)];
  };
  const double angle = 0.3;
  EXPECT_GT((at("base_pitch", "base_pitch", angle).R_WL * Vector3::UnitZ()).x(), 0.1);  // leans forward
  EXPECT_GT(at("hip_l", "knee_l", angle).p_WL.x(), 0.1);                                // thigh forward
  EXPECT_LT(at("knee_r", "ankle_r", angle).p_WL.x(), -0.1);                             // heel to the buttock
  EXPECT_GT((at("ankle_l", "ankle_l", angle).R_WL * Vector3::UnitX()).z(), 0.1);        // toes up
  EXPECT_EQ(at("base_x", "base_pitch", angle).p_WL, Vector3(angle, 0, 0));
  EXPECT_EQ(at("base_z", "base_pitch", angle).p_WL, Vector3(0, 0, angle));
}

TEST(PlanarHumanTest, StandsOnItsSolesALegLengthBelowTheHips) {
  for (const Scene& scene : Scenes()) {
    const std::vector<Pose> poses = Poses(scene.model, VectorX::Zero(9));
    for (int contact = 0; contact < 2; ++contact) {
      const Vector3 lowest = LowestPoint(scene, contact, poses);
      EXPECT_NEAR(lowest.z(), -scene.leg_length, 1e-14);
      EXPECT_GT(lowest.x(), 0);
    }
  }
}

TEST(PlanarHumanTest, MovesInTheSagittalPlane) {
  const Scene scene = PlanarHuman(Sex::kFemale, 1.61, 62);
  const std::vector<Pose> straight = Poses(scene.model, VectorX::Zero(9));
  const std::vector<Pose> bent = Poses(scene.model, SeededRandom(9).VectorOf(9, -0.5, 0.5));
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(bent[i].p_WL.y(), straight[i].p_WL.y(), 1e-15);
}

// Numbers of the default male: leg 432 + 433 + 80 mm, foot 271 mm, sole radius 0.3 of the leg.
TEST(PlanarHumanTest, DefaultMaleHasTheStatedFeetAndLimits) {
  const Scene scene = PlanarHuman(Sex::kMale, 1.774, 75);
  EXPECT_NEAR(scene.leg_length, 0.945, 1e-12);
  EXPECT_EQ(scene.FindContact("left_foot"), 0);
  EXPECT_EQ(scene.FindContact("right_foot"), 1);
  EXPECT_EQ(scene.FindContact("hand"), -1);
  const ContactSurface& foot = scene.contacts[0];
  EXPECT_EQ(foot.joint, scene.model.Find("ankle_l"));
  EXPECT_EQ(foot.directions, (std::vector<int>{0, 2}));
  const Vector3 axes = foot.surface.ellipsoid()->semi_axes();
  EXPECT_NEAR(axes.x(), 0.1355, 1e-12);
  EXPECT_NEAR(axes.x() * axes.x() / axes.z(), 0.3 * 0.945, 1e-12);
  EXPECT_NEAR(foot.p_LE.x() - axes.x(), -0.217 * 0.271, 1e-12);  // heel behind the ankle
  const double degree = std::numbers::pi / 180;
  const Joint& hip = scene.model.joint(3);
  EXPECT_NEAR(hip.position_min, -30 * degree, 1e-12);
  EXPECT_NEAR(hip.position_max, 120 * degree, 1e-12);
  EXPECT_NEAR(hip.effort_max, 200, 1e-12);
  EXPECT_EQ(hip.effort_min, -hip.effort_max);
  EXPECT_NEAR(scene.model.joint(5).effort_max, 250, 1e-12);
}

// What Scene::sources says of the posture at zero.
TEST(PlanarHumanTest, TrunkIsBehindTheHipsByWhatTheSourcesState) {
  EXPECT_NEAR(PlanarHuman(Sex::kMale, 1.774, 75).model.joint(2).center_of_mass.x(), -0.063, 5e-4);
  EXPECT_NEAR(PlanarHuman(Sex::kFemale, 1.610, 62).model.joint(2).center_of_mass.x(), -0.058, 5e-4);
}

// Mass and moment of the whole standing body do not depend on how the trunk was lumped.
TEST(PlanarHumanTest, WholeBodyEqualsTheSumOfItsSegments) {
  const SegmentTable table(Sex::kMale, 1.774, 75);
  const Scene scene = PlanarHuman(Sex::kMale, 1.774, 75);
  const std::vector<Pose> poses = Poses(scene.model, VectorX::Zero(9));
  Vector3 moment = Vector3::Zero();
  for (int i = 0; i < 9; ++i) {
    const Joint& joint = scene.model.joint(i);
    moment += joint.mass * (poses[i].p_WL + joint.center_of_mass);
  }
  const double lumbar_x = -0.056, hip_z = 0.945;
  const double cervical_z = hip_z + 0.075 + 0.477, shoulder_z = 0.818 * 1.774;
  struct Part {
    Segment segment;
    BodySide side;
    double x, z;
  };
  const Part parts[] = {
      {Segment::kPelvis, BodySide::kMidline, lumbar_x, hip_z + 0.075},
      {Segment::kTorso, BodySide::kMidline, lumbar_x, cervical_z},
      {Segment::kHeadNeck, BodySide::kMidline, lumbar_x, cervical_z},
      {Segment::kUpperArm, BodySide::kRight, lumbar_x, shoulder_z},
      {Segment::kForearm, BodySide::kRight, lumbar_x, shoulder_z - 0.271},
      {Segment::kHand, BodySide::kRight, lumbar_x, shoulder_z - 0.271 - 0.283},
      {Segment::kThigh, BodySide::kRight, 0, hip_z},
      {Segment::kShank, BodySide::kRight, 0, hip_z - 0.432},
      {Segment::kFoot, BodySide::kRight, 0, hip_z - 0.432 - 0.433},
  };
  double moment_x = 0, moment_z = 0;
  for (const Part& part : parts) {
    const RigidBody body = table.Body(part.segment, part.side);
    const double mass = body.mass * (part.side == BodySide::kMidline ? 1 : 2);
    moment_x += mass * (part.x + body.center_of_mass.x());
    moment_z += mass * (part.z - hip_z + body.center_of_mass.z());
  }
  EXPECT_NEAR(moment.x(), moment_x, 1e-12);
  EXPECT_NEAR(moment.z(), moment_z, 1e-12);
  EXPECT_NEAR(moment.y(), 0, 1e-14);
  // The centre of mass of a standing man is at 0.53 to 0.58 of his stature.
  const double height = (moment.z() / 75 + hip_z) / 1.774;
  EXPECT_GT(height, 0.53);
  EXPECT_LT(height, 0.58);
}

}  // namespace
}  // namespace rollgait
