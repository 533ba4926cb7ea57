#include "client/report/rolling_path.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "client/failure.h"
#include "client/report/kinematics.h"

namespace rollgait::client {
namespace {

constexpr double kRadius = 0.2, kDuration = 1.5, kRate = 0.4, kCouple = 3;  // m, s, rad/s², N m
const char* const kNames[] = {"base_x", "base_y", "base_z", "roll_1", "roll_2", "roll_3"};

void SetVector(const Eigen::Vector3d& value, v1::Vector3* vector) {
  vector->set_x(value.x());
  vector->set_y(value.y());
  vector->set_z(value.z());
}

v1::Model Ball() {
  v1::Model model;
  model.mutable_summary()->set_name("ball");
  for (int i = 0; i < 6; ++i) {
    v1::Joint& joint = *model.add_joints();
    joint.set_name(kNames[i]);
    joint.set_type(i < 3 ? v1::Joint::TYPE_PRISMATIC : v1::Joint::TYPE_REVOLUTE);
    joint.set_parent(i - 1);
    joint.mutable_orientation()->set_w(1);
    SetVector(Eigen::Vector3d::Unit(i % 3), joint.mutable_axis());
    joint.set_actuated(i >= 3);
  }
  v1::ContactSurface& surface = *model.add_contacts();
  surface.set_name("surface");
  surface.set_joint(5);
  SetVector(Eigen::Vector3d::Constant(kRadius), surface.mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m());
  return model;
}

void Fill(v1::Matrix* matrix, const std::vector<std::vector<double>>& rows) {
  matrix->set_rows(static_cast<int>(rows.size()));
  matrix->set_columns(static_cast<int>(rows[0].size()));
  for (const auto& row : rows) matrix->mutable_values()->Add(row.begin(), row.end());
}

// Rolls along x from rest at a constant rate of turning.
v1::Trajectory Roll() {
  v1::Trajectory trajectory;
  for (int i = 0; i < 6; ++i) trajectory.add_joint_names(kNames[i]);
  for (int i = 3; i < 6; ++i) trajectory.add_actuated_joint_names(kNames[i]);
  trajectory.set_points_per_interval(2);
  trajectory.set_cycle(v1::CYCLE_ONCE);
  trajectory.set_duration_s(kDuration);
  v1::TrajectoryPhase& phase = *trajectory.add_phases();
  phase.add_contacts("surface");
  phase.set_duration_s(kDuration);
  const double turn = kRate * kDuration * kDuration / 2, x = kRadius * turn, rate = kRate * kDuration;
  for (const double time : {0.0, kDuration}) phase.add_node_times_s(time);
  for (const double time : {kDuration / 3, kDuration}) phase.add_point_times_s(time);
  const std::vector<double> acceleration = {kRadius * kRate, 0, 0, 0, kRate, 0};
  Fill(phase.mutable_node_positions(), {{0, 1, kRadius, 0, 0, 0}, {x, 1, kRadius, 0, turn, 0}});
  Fill(phase.mutable_node_velocities(), {{0, 0, 0, 0, 0, 0}, {kRadius * rate, 0, 0, 0, rate, 0}});
  Fill(phase.mutable_point_accelerations(), {acceleration, acceleration});
  Fill(phase.mutable_point_efforts(), {{0, kCouple, 0}, {0, kCouple, 0}});
  Fill(phase.mutable_point_forces(), {{0, 0, 1}, {0, 0, 1}});
  return trajectory;
}

TEST(RollingPathTest, FollowsABallThatRollsEvenly) {
  const RollingPath path = BuildRollingPath(Roll(), Ball());
  EXPECT_EQ(path.duration_s, kDuration);
  ASSERT_GE(path.samples.size(), 100u);
  for (size_t k = 0; k < path.samples.size(); ++k) {
    const double time = kDuration * static_cast<double>(k) / static_cast<double>(path.samples.size() - 1);
    const RollingPath::Sample& at = path.samples[k];
    EXPECT_NEAR(at.center_x_m, kRadius * kRate * time * time / 2, 1e-14);
    EXPECT_NEAR(at.contact_x_m, at.center_x_m, 1e-14);
    EXPECT_NEAR(at.contact_y_m, 1, 1e-14);
    EXPECT_NEAR(at.couple_n_m, kCouple, 1e-12);
  }
}

TEST(RollingPathTest, RefusesAnotherModel) {
  v1::Model model = Ball();
  model.mutable_joints(3)->set_actuated(false);
  EXPECT_THROW(BuildRollingPath(Roll(), model), Failure);
}

// Against the lowest of many points of a tilted ellipsoid.
TEST(LowestPointTest, IsTheLowestPoint) {
  v1::Model model = Ball();
  const Eigen::Vector3d axes(0.3, 0.2, 0.1);
  SetVector(axes, model.mutable_contacts(0)->mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m());
  const std::vector<Pose> poses = LinkPoses(model, {0.1, 0.2, 0.3, 0.7, -0.5, 1.1});
  const Eigen::Vector3d lowest = LowestPoint(model.contacts(0), poses);
  double least = 1e9;
  Eigen::Vector3d found = Eigen::Vector3d::Zero();
  for (int i = 0; i <= 400; ++i) {
    for (int j = 0; j < 800; ++j) {
      const double polar = M_PI * i / 400, around = M_PI * j / 400;
      const Eigen::Vector3d unit(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
                                 std::cos(polar));
      const Eigen::Vector3d point = poses.back().position + poses.back().rotation * axes.cwiseProduct(unit);
      if (point.z() >= least) continue;
      least = point.z();
      found = point;
    }
  }
  EXPECT_NEAR(lowest.z(), least, 2e-5);  // a grid of 0.008 rad
  EXPECT_LT((lowest - found).norm(), 4e-3);
}

}  // namespace
}  // namespace rollgait::client
