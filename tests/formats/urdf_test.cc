// The exported URDF in MuJoCo, and in ROS's own parser.
#include "client/formats/urdf.h"

#include <gtest/gtest.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <cstdio>

#include "client/formats/ground.h"
#include "client/report/kinematics.h"
#include "tests/formats/mujoco_model.h"
#include "tests/formats/solved_gaits.h"

namespace rollgait::client {
namespace {

class UrdfTest : public testing::TestWithParam<std::string> {
 protected:
  v1::Solve solve_ = ReadGait(GetParam());
  const v1::Model& ours_ = solve_.result().model();
  const std::string text_ = ToUrdf(ours_);
};

INSTANTIATE_TEST_SUITE_P(Motions, UrdfTest, testing::ValuesIn(kMotions));

Eigen::Vector3d Vector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

// Where urdfdom's numbers put a link, from the root on.
Eigen::Isometry3d PoseOf(const urdf::ModelInterface& robot, const urdf::Link& link, const v1::Model& ours,
                         const Eigen::VectorXd& q) {
  if (link.parent_joint == nullptr) return Eigen::Isometry3d::Identity();
  const urdf::Joint& joint = *link.parent_joint;
  Eigen::Isometry3d pose = PoseOf(robot, *robot.getLink(joint.parent_link_name), ours, q);
  const urdf::Rotation& r = joint.parent_to_joint_origin_transform.rotation;
  pose.translate(Vector(joint.parent_to_joint_origin_transform.position));
  pose.rotate(Eigen::Quaterniond(r.w, r.x, r.y, r.z));
  int index = 0;
  while (ours.joints(index).name() != joint.name) ++index;
  if (joint.type == urdf::Joint::PRISMATIC) return pose.translate(q(index) * Vector(joint.axis));
  return pose.rotate(Eigen::AngleAxisd(q(index), Vector(joint.axis)));
}

TEST_P(UrdfTest, ParserOfRosFindsTheSameBody) {
  const urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(text_);
  ASSERT_NE(robot, nullptr);
  EXPECT_EQ(robot->getRoot()->name, "world");
  EXPECT_EQ(static_cast<int>(robot->joints_.size()), ours_.joints_size());
  const StagePoint point = StagePoints(solve_)[3];
  const std::vector<Pose> poses = LinkPoses(ours_, std::vector<double>(point.position.begin(), point.position.end()));
  for (int i = 0; i < ours_.joints_size(); ++i) {
    const v1::Joint& ours = ours_.joints(i);
    const urdf::JointConstSharedPtr joint = robot->getJoint(ours.name());
    ASSERT_NE(joint, nullptr) << ours.name();
    const bool bounded = std::isfinite(ours.position_max());
    EXPECT_EQ(joint->type, ours.type() == v1::Joint::TYPE_PRISMATIC ? urdf::Joint::PRISMATIC
                           : bounded                                ? urdf::Joint::REVOLUTE
                                                                    : urdf::Joint::CONTINUOUS);
    if (bounded) {
      EXPECT_EQ(joint->limits->lower, ours.position_min());
      EXPECT_EQ(joint->limits->upper, ours.position_max());
    }
    if (ours.actuated()) {
      EXPECT_EQ(joint->limits->effort, std::min(ours.effort_max(), kUrdfUnlimited)) << ours.name();
      EXPECT_EQ(joint->limits->velocity, std::min(ours.velocity_max(), kUrdfUnlimited)) << ours.name();
    }
    const urdf::LinkConstSharedPtr link = robot->getLink(ours.link_name());
    ASSERT_NE(link, nullptr) << ours.link_name();
    const Eigen::Isometry3d pose = PoseOf(*robot, *link, ours_, point.position);
    EXPECT_LT((pose.translation() - poses[i].position).norm(), 1e-12) << ours.link_name();
    EXPECT_LT((pose.linear() - poses[i].rotation).norm(), 1e-12) << ours.link_name();
    ASSERT_EQ(link->inertial != nullptr, ours.mass_kg() > 0) << ours.link_name();
    if (link->inertial == nullptr) continue;
    EXPECT_EQ(link->inertial->mass, ours.mass_kg());
    EXPECT_EQ(Vector(link->inertial->origin.position), ToVector(ours.center_of_mass_m()));
    const urdf::Inertial& found = *link->inertial;
    EXPECT_EQ((std::vector<double>{found.ixx, found.iyy, found.izz, found.ixy, found.ixz, found.iyz}),
              std::vector<double>(ours.inertia_kg_m2().begin(), ours.inertia_kg_m2().end()));
  }
}

// MuJoCo finds the principal moments of URDF's tensors to about nine digits; the rest of its inverse dynamics is exact.
TEST_P(UrdfTest, InverseDynamicsOfMujocoGivesTheTorques) {
  MujocoModel mujoco(WriteScratch(GetParam() + ".urdf", text_));
  ASSERT_EQ(mujoco.model().nv, ours_.joints_size());
  const Eigen::Vector3d gravity = GroundOf(solve_).Gravity();
  std::copy(gravity.begin(), gravity.end(), mujoco.model().opt.gravity);
  double largest = 0, scale = 0;
  for (const StagePoint& point : StagePoints(solve_)) {
    mujoco.Set(point.position, point.velocity, point.acceleration);
    Eigen::VectorXd torque = mujoco.InverseDynamics();
    const std::vector<Pose> poses = LinkPoses(ours_, std::vector<double>(point.position.begin(), point.position.end()));
    for (int c = 0; c < ours_.contacts_size(); ++c) {
      const int body = mujoco.Find(mjOBJ_BODY, ours_.joints(ours_.contacts(c).joint()).link_name());
      torque -= mujoco.Generalized(point.force[c], LowestPoint(ours_.contacts(c), poses), body);
    }
    for (int i = 0; i < ours_.joints_size(); ++i) {
      const double difference = std::abs(torque(mujoco.Dof(ours_.joints(i).name())) - point.effort(i));
      largest = std::max(largest, difference);
      EXPECT_LT(difference, 2e-6) << ours_.joints(i).name() << " at " << point.time_s;
    }
    scale = std::max(scale, point.effort.cwiseAbs().maxCoeff());
  }
  EXPECT_GT(scale, LeastEffort(GetParam()));
  std::printf("%s: mj_inverse of the URDF minus ours at most %.2g N m, of up to %.3g\n", GetParam().c_str(), largest,
              scale);
}

}  // namespace
}  // namespace rollgait::client
