// The exported MJCF in MuJoCo: its inverse dynamics gives our torques.
#include "client/formats/mjcf.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "client/report/kinematics.h"
#include "tests/formats/mujoco_model.h"
#include "tests/formats/solved_gaits.h"

namespace rollgait::client {
namespace {

constexpr double kTorqueTolerance = 1e-8;  // N m or N

class MjcfTest : public testing::TestWithParam<std::string> {
 protected:
  v1::Solve solve_ = ReadGait(GetParam());
  const v1::Model& ours_ = solve_.result().model();
  MujocoModel mujoco_{WriteScratch(GetParam() + ".xml", ToMjcf(ours_, GroundOf(solve_)))};
};

INSTANTIATE_TEST_SUITE_P(Motions, MjcfTest, testing::ValuesIn(kMotions));

TEST_P(MjcfTest, CoordinatesAreThoseOfTheService) {
  ASSERT_EQ(mujoco_.model().nq, ours_.joints_size());
  ASSERT_EQ(mujoco_.model().nv, ours_.joints_size());
  double mass = 0;
  for (int b = 0; b < mujoco_.model().nbody; ++b) mass += mujoco_.model().body_mass[b];
  EXPECT_NEAR(mass, ours_.total_mass_kg(), 1e-12 * mass);
  int actuators = 0;
  for (int i = 0; i < ours_.joints_size(); ++i) {
    const v1::Joint& joint = ours_.joints(i);
    EXPECT_EQ(mujoco_.Dof(joint.name()), i);
    const int id = mujoco_.Find(mjOBJ_JOINT, joint.name());
    EXPECT_EQ(mujoco_.model().jnt_limited[id] != 0, std::isfinite(joint.position_max())) << joint.name();
    if (!joint.actuated()) continue;
    ++actuators;
    const int motor = mujoco_.Find(mjOBJ_ACTUATOR, joint.name());
    const bool strong = std::isinf(joint.effort_max());
    EXPECT_EQ(mujoco_.model().actuator_ctrllimited[motor] == 0, strong);
    EXPECT_EQ(mujoco_.model().actuator_ctrlrange[2 * motor + 1], strong ? 0 : joint.effort_max());
    EXPECT_EQ(mujoco_.model().actuator_trnid[2 * motor], id);
  }
  EXPECT_EQ(mujoco_.model().nu, actuators);
}

// At every collocation point: joint torques, and zero for the floating base, which nothing but the ground holds.
TEST_P(MjcfTest, InverseDynamicsGivesTheTorques) {
  double largest = 0, largest_base = 0, scale = 0;
  const std::vector<StagePoint> points = StagePoints(solve_);
  ASSERT_GE(points.size(), 30u);
  for (const StagePoint& point : points) {
    mujoco_.Set(point.position, point.velocity, point.acceleration);
    Eigen::VectorXd torque = mujoco_.InverseDynamics();
    for (int c = 0; c < ours_.contacts_size(); ++c) {
      const int geom = mujoco_.Find(mjOBJ_GEOM, ours_.contacts(c).name());
      torque -= mujoco_.Generalized(point.force[c], mujoco_.LowestPoint(geom), mujoco_.model().geom_bodyid[geom]);
    }
    for (int i = 0; i < ours_.joints_size(); ++i) {
      double& worst = ours_.joints(i).actuated() ? largest : largest_base;
      worst = std::max(worst, std::abs(torque(i) - point.effort(i)));
      EXPECT_NEAR(torque(i), point.effort(i), kTorqueTolerance) << ours_.joints(i).name() << " at " << point.time_s;
    }
    scale = std::max(scale, point.effort.cwiseAbs().maxCoeff());
  }
  EXPECT_GT(scale, LeastEffort(GetParam()));
  std::printf(
      "%s: %zu instants, mj_inverse minus ours at most %.2g N m (joints, of up to %.3g), %.2g N m or N (base)\n",
      GetParam().c_str(), points.size(), largest, scale, largest_base);
}

TEST_P(MjcfTest, PlacesLinksAndSurfaces) {
  const std::vector<StagePoint> points = StagePoints(solve_);
  for (size_t k = 0; k < points.size(); k += 7) {
    const Eigen::VectorXd& q = points[k].position;
    mujoco_.Set(q, points[k].velocity, points[k].acceleration);
    const std::vector<Pose> poses = LinkPoses(ours_, std::vector<double>(q.begin(), q.end()));
    for (int i = 0; i < ours_.joints_size(); ++i) {
      if (!(ours_.joints(i).mass_kg() > 0)) continue;
      const int body = mujoco_.Find(mjOBJ_BODY, ours_.joints(i).link_name());
      EXPECT_LT((mujoco_.BodyPosition(body) - poses[i].position).norm(), 1e-12) << ours_.joints(i).link_name();
      EXPECT_LT((mujoco_.BodyAxes(body) - poses[i].rotation).norm(), 1e-12) << ours_.joints(i).link_name();
    }
    for (const v1::ContactSurface& contact : ours_.contacts()) {
      const Eigen::Vector3d lowest = mujoco_.LowestPoint(mujoco_.Find(mjOBJ_GEOM, contact.name()));
      EXPECT_LT((lowest - LowestPoint(contact, poses)).norm(), 1e-12) << contact.name();
    }
  }
}

// The simulator's own contact finds the ground where the optimiser put the feet.
TEST_P(MjcfTest, FeetMeetTheGround) {
  mujoco_.model().opt.disableflags = 0;
  const StagePoint point = StagePoints(solve_).front();
  mujoco_.Set(point.position, point.velocity, point.acceleration);
  int touching = 0;
  for (int c = 0; c < ours_.contacts_size(); ++c) {
    const double height = mujoco_.LowestPoint(mujoco_.Find(mjOBJ_GEOM, ours_.contacts(c).name())).z();
    if (point.force[c].z() > 1) {
      EXPECT_NEAR(height, 0, 2e-3) << ours_.contacts(c).name();
    }
    touching += height < 0;
  }
  EXPECT_EQ(mujoco_.data().ncon, touching);
  for (int k = 0; k < mujoco_.data().ncon; ++k) {
    EXPECT_EQ(mujoco_.data().contact[k].friction[0], GroundOf(solve_).friction);
    EXPECT_NEAR(mujoco_.data().contact[k].frame[2], 1, 1e-9);
  }
}

}  // namespace
}  // namespace rollgait::client
