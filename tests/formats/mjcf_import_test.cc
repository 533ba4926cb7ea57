// Models of MuJoCo: what MuJoCo itself makes of a file has the mass and the inertia matrix of the model that the client
// makes of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <random>

#include "client/formats/mjcf.h"
#include "client/formats/urdf_side.h"
#include "client/import/side_file.h"
#include "client/import/side_proposal.h"
#include "client/import/tree_file.h"
#include "client/import/tree_model.h"
#include "core/models/catalog.h"
#include "core/multibody/tree_dynamics.h"
#include "server/convert/gait_request_convert.h"
#include "server/convert/model_convert.h"
#include "server/convert/own_model_convert.h"
#include "tests/formats/mujoco_model.h"
#include "tests/formats/solved_gaits.h"
#include "tests/support/twisted_body.h"

namespace rollgait::client {
namespace {

// Every joint free to move as the file has it; feet are of no matter to the dynamics.
v1::ModelSideFile BareSide() {
  v1::ModelSideFile side;
  side.set_mirror(v1::ModelSideFile::MIRROR_NONE);
  return side;
}

// Velocities of MuJoCo's free joint, translation in the world and rotation in the body, of those of base_x to
// base_pitch, where the base is turned by yaw, roll and pitch (about z, x and y) from `upright`.
MatrixX OfFreeJoint(double roll, double pitch, const Eigen::Matrix3d& upright) {
  MatrixX map = MatrixX::Zero(6, 6);
  map.topLeftCorner(3, 3).setIdentity();
  const Eigen::Matrix3d x = Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Eigen::Matrix3d y = Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Eigen::Matrix3d to_body = upright.transpose() * y.transpose();
  map.col(3).tail(3) = to_body * x.transpose() * Eigen::Vector3d::UnitZ();
  map.col(4).tail(3) = to_body * Eigen::Vector3d::UnitX();
  map.col(5).tail(3) = to_body * Eigen::Vector3d::UnitY();
  return map;
}

struct Compared {
  double mass = 0;        // kg, of the model
  double difference = 0;  // of inertia matrices, largest entry
  double scale = 0;       // largest entry
};

// MuJoCo's velocities of a ball joint, in the body, of the rates of its turns about y, x and z.
Eigen::Matrix3d OfBall(const Eigen::Vector3d& turns) {
  const Eigen::Matrix3d x = Eigen::AngleAxisd(turns(1), Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Eigen::Matrix3d z = Eigen::AngleAxisd(turns(2), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  Eigen::Matrix3d map;
  map.col(0) = z.transpose() * x.transpose() * Eigen::Vector3d::UnitY();
  map.col(1) = z.transpose() * Eigen::Vector3d::UnitX();
  map.col(2) = Eigen::Vector3d::UnitZ();
  return map;
}

// `fixed`: positions of joints that are no joints of the model; `upright`: of the body on the free joint in the file.
Compared CompareInertia(const std::string& name, const std::string& text, const v1::ModelSideFile& side,
                        const std::map<std::string, double>& fixed, const Eigen::Matrix3d& upright) {
  Compared compared;
  const v1::Model model = ModelOfTree(ReadLinkTreeText(name, text), "side.json", side).model;
  for (const v1::Joint& joint : model.joints()) compared.mass += joint.mass_kg();
  Violations violations;
  const auto own = server::DecodeOwnModel("model.own.", model, &violations);
  EXPECT_TRUE(violations.empty()) << violations.front().field << " " << violations.front().message;
  if (!violations.empty()) return compared;
  const Result<Model> created = Model::Create(own->joints);
  EXPECT_TRUE(created.ok());
  TreeDynamics core(created.value());
  MujocoModel mujoco(WriteScratch(name, text));
  // A model has no inertia of rotors; the importer says so.
  std::fill(mujoco.model().dof_armature, mujoco.model().dof_armature + mujoco.model().nv, 0.0);
  const int n = core.size();
  EXPECT_EQ(mujoco.model().nv, n + static_cast<int>(fixed.size()));
  double mujoco_mass = 0;
  for (int i = 1; i < mujoco.model().nbody; ++i) {
    if (mujoco.model().body_weldid[i] != 0) mujoco_mass += mujoco.model().body_mass[i];
  }
  EXPECT_NEAR(compared.mass, mujoco_mass, 1e-12 * mujoco_mass);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    VectorX q = VectorX::Zero(n), mq = VectorX::Zero(mujoco.model().nq);
    for (int i = 0; i < n; ++i) q(i) = uniform(random);
    for (int i = 0; i < 3; ++i) mq(i) = q(i);
    const Eigen::Quaterniond base = Eigen::AngleAxisd(q(3), Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(q(4), Eigen::Vector3d::UnitX()) *
                                    Eigen::AngleAxisd(q(5), Eigen::Vector3d::UnitY()) * Eigen::Quaterniond(upright);
    mq.segment(3, 4) << base.w(), base.x(), base.y(), base.z();
    MatrixX map = MatrixX::Zero(mujoco.model().nv, n);  // MuJoCo's velocities of the model's
    map.topLeftCorner(6, 6) = OfFreeJoint(q(4), q(5), upright);
    for (int i = 6; i < n; ++i) {
      const std::string& joint = model.joints(i).name();
      const std::string ball = joint.substr(0, joint.size() - std::min<size_t>(2, joint.size()));
      const int id = mj_name2id(&mujoco.model(), mjOBJ_JOINT, ball.c_str());
      if (id >= 0 && mujoco.model().jnt_type[id] == mjJNT_BALL) {
        const Eigen::Quaterniond turned = Eigen::AngleAxisd(q(i), Eigen::Vector3d::UnitY()) *
                                          Eigen::AngleAxisd(q(i + 1), Eigen::Vector3d::UnitX()) *
                                          Eigen::AngleAxisd(q(i + 2), Eigen::Vector3d::UnitZ());
        mq.segment(mujoco.model().jnt_qposadr[id], 4) << turned.w(), turned.x(), turned.y(), turned.z();
        map.block(mujoco.model().jnt_dofadr[id], i, 3, 3) = OfBall(q.segment(i, 3));
        i += 2;
        continue;
      }
      mq(mujoco.Q(joint)) = q(i);
      map(mujoco.Dof(joint), i) = 1;
    }
    for (const auto& [joint, position] : fixed) mq(mujoco.Q(joint)) = position;
    const VectorX zero = VectorX::Zero(mujoco.model().nv);
    mujoco.Set(mq, zero, zero);
    MatrixX found = MatrixX::Zero(mujoco.model().nv, mujoco.model().nv), expected = MatrixX::Zero(n, n);
    mj_fullM(&mujoco.model(), found.data(), mujoco.data().qM);
    core.MassMatrix(q.data(), expected);
    expected.triangularView<Eigen::StrictlyUpper>() = expected.transpose();
    compared.difference =
        std::max(compared.difference, (map.transpose() * found * map - expected).cwiseAbs().maxCoeff());
    compared.scale = std::max(compared.scale, expected.cwiseAbs().maxCoeff());
  }
  std::printf("%s: %.6g kg, %d joints, inertia matrices differ by up to %.2g of %.3g\n", name.c_str(), compared.mass, n,
              compared.difference, compared.scale);
  return compared;
}

void ExpectSameInertia(const std::string& name, const std::string& text, const v1::ModelSideFile& side = BareSide(),
                       const std::map<std::string, double>& fixed = {},
                       const Eigen::Matrix3d& upright = Eigen::Matrix3d::Identity()) {
  const Compared compared = CompareInertia(name, text, side, fixed, upright);
  // MuJoCo finds principal moments to about nine digits of the largest.
  EXPECT_LT(compared.difference, 1e-9 * compared.scale);
  EXPECT_GT(compared.scale, 1);
}

TEST(MjcfImportTest, TheHumanoidOfTestsWeighsAndMovesAlike) {
  ExpectSameInertia("humanoid_of_tests.xml", ReadModelBytes(ROLLGAIT_SOURCE "/tests/data/humanoid.xml"));
}

// Debian's libmujoco-samples, where it is installed.
TEST(MjcfImportTest, TheHumanoidOfMujocoWeighsAndMovesAlike) {
  const std::string path = MUJOCO_HUMANOID;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "libmujoco-samples is not installed: " << path;
  ExpectSameInertia("humanoid.xml", ReadModelBytes(path));
}

// Hips and shoulders of a robot that are balls, with other joints before and behind them and anchors aside.
TEST(MjcfImportTest, BallJointsMoveAlike) {
  const std::string text = R"(<mujoco><worldbody><body name="trunk" pos="0 0 1"><freejoint name="root"/>
    <geom type="box" size="0.1 0.15 0.3" mass="8"/>
    <body name="left" pos="0 0.1 -0.3" euler="10 20 30"><joint name="hip_l" type="ball" pos="0.01 0.02 0.05" limited="true" range="0 100"/>
      <geom type="capsule" fromto="0 0 0 0.05 0 -0.4" size="0.05" mass="3"/>
      <body name="shank_l" pos="0.05 0 -0.4"><joint name="knee_l" axis="0 1 0" limited="true" range="0 120"/><joint name="k" type="ball"/>
        <geom type="box" size="0.04 0.05 0.2" pos="0 0.01 -0.2" mass="1.5"/></body></body>
    <body name="right" pos="0 -0.1 -0.3"><joint name="hip_r" type="ball" stiffness="3" damping="1"/>
      <geom type="capsule" fromto="0 0 0 0.05 0 -0.4" size="0.05" mass="3"/></body>
    </body></worldbody></mujoco>)";
  v1::ModelSideFile side = BareSide();
  for (const char* const joint :
       {"hip_l_y", "hip_l_x", "hip_l_z", "hip_r_y", "hip_r_x", "hip_r_z", "knee_l", "k_y", "k_x", "k_z"}) {
    side.add_joints()->set_name(joint);
    side.mutable_joints(side.joints_size() - 1)->set_actuated(false);
  }
  ExpectSameInertia("balls.xml", text, side);
}

TEST(MjcfImportTest, EveryFormOfOrientationSizeAndUnitIsReadAlike) {
  ExpectSameInertia("twisted.xml", kTwistedBody, BareSide(), {}, TwistedUpright());
}

// Next to -e_z any horizontal axis turns e_z there, and the bodies beyond differ.
TEST(MjcfImportTest, AnAxisThatPointsDownTurnsAsInMujoco) {
  for (const std::string zaxis : {"0 0 -1", "1.2246e-16 0 -2", "3e-6 4e-6 -1", "0.002 0 -3", "0 0 2"}) {
    SCOPED_TRACE(zaxis);
    const std::string text = R"(<mujoco><worldbody><body name="trunk" pos="0 0 1"><freejoint name="root"/>
      <geom type="box" size="0.1 0.15 0.3" mass="8"/>
      <body name="leg" pos="0.02 0.1 -0.3" zaxis=")" +
                             zaxis + R"("><joint name="hip" axis="0 1 0" limited="true" range="-60 60"/>
        <geom type="box" size="0.04 0.05 0.2" pos="0.03 0.01 0.2" mass="3"/></body></body></worldbody></mujoco>)";
    v1::ModelSideFile side = BareSide();
    side.add_joints()->set_name("hip");
    side.mutable_joints(0)->set_actuated(false);
    ExpectSameInertia("down.xml", text, side);
  }
}

TEST(MjcfImportTest, LockedJointsAreFixedWhereTheSideFileSays) {
  v1::ModelSideFile side = BareSide();
  const std::map<std::string, double> fixed = {{"twist", 0.4}, {"slide", 0.1}};
  for (const auto& [joint, position] : fixed) {
    side.add_joints()->set_name(joint);
    side.mutable_joints(side.joints_size() - 1)->set_reference(position);
    side.mutable_joints(side.joints_size() - 1)->set_locked(true);
  }
  ExpectSameInertia("locked.xml", kTwistedBody, side, fixed, TwistedUpright());
}

TEST(MjcfImportTest, WhatIsExportedReadsBackAsTheSameModel) {
  for (const char* const name : {"planar", "human29"}) {
    v1::ModelSelection selection;
    selection.set_name(name);
    const Result<BodyRequest> request = server::DecodeBody(selection);
    ASSERT_TRUE(request.ok());
    const Result<Scene> scene = BuildScene(request.value());
    ASSERT_TRUE(scene.ok());
    const v1::Model ours = server::EncodeModel(scene.value(), 9.81);
    const LinkTree tree = ReadLinkTreeText("ours.xml", ToMjcf(ours, {}));
    const bool planar = std::string(name) == "planar";
    EXPECT_EQ(tree.base_in_plane, planar);
    v1::ModelSideFile side = SideFileOfModel(ours);
    side.set_base(planar ? v1::ModelSideFile::BASE_PLANE : v1::ModelSideFile::BASE_SPACE);
    for (v1::SideJoint& joint : *side.mutable_joints()) {
      if (IsBaseRole(joint.role())) joint.set_role(v1::Joint::ROLE_UNSPECIFIED);
    }
    ASSERT_NO_THROW(CheckSideFile("ours.json", side, tree));
    const v1::Model back = ModelOfTree(tree, "ours.json", side).model;
    ASSERT_EQ(back.joints_size(), ours.joints_size());
    for (int i = 0; i < ours.joints_size(); ++i) {
      const v1::Joint &a = ours.joints(i), &b = back.joints(i);
      SCOPED_TRACE(a.name());
      EXPECT_EQ(a.name(), b.name());
      EXPECT_EQ(a.parent(), b.parent());
      EXPECT_EQ(a.role(), b.role());
      EXPECT_EQ(a.mirror_joint(), b.mirror_joint());
      EXPECT_NEAR(a.mass_kg(), b.mass_kg(), 1e-12);
      EXPECT_LT((ToVector(a.center_of_mass_m()) - ToVector(b.center_of_mass_m())).norm(), 1e-12);
      for (int k = 0; k < 6; ++k) EXPECT_NEAR(a.inertia_kg_m2(k), b.inertia_kg_m2(k), 1e-12);
      if (a.role() >= v1::Joint::ROLE_BASE_FORWARD && a.role() <= v1::Joint::ROLE_BASE_PITCH) continue;
      EXPECT_LT((ToVector(a.origin_m()) - ToVector(b.origin_m())).norm(), 1e-12);
      EXPECT_LT((ToVector(a.axis()) - ToVector(b.axis())).norm(), 1e-12);
      EXPECT_EQ(a.position_min(), b.position_min());
      EXPECT_EQ(a.position_max(), b.position_max());
      EXPECT_EQ(a.effort_min(), b.effort_min());
      EXPECT_EQ(a.effort_max(), b.effort_max());
    }
  }
}

}  // namespace
}  // namespace rollgait::client
