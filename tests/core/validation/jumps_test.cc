#include "core/validation/jumps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace rollgait {
namespace {

constexpr double kMass = 2, kInertia = 0.03, kRadius = 0.2;

// A ball in space that hops and lands with sideways velocity, which the mirror image of a half cycle turns about.
// Joints: x, y, z, roll, pitch.
class Hop : public ::testing::Test {
 protected:
  Hop() {
    std::vector<Joint> joints(5);
    const char* names[] = {"base_x", "base_y", "base_z", "base_roll", "base_pitch"};
    const Vector3 axes[] = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ(), Vector3::UnitX(), Vector3::UnitY()};
    for (int i = 0; i < 5; ++i) {
      joints[i].name = names[i];
      joints[i].link = std::string(names[i]) + "_link";
      joints[i].type = i < 3 ? JointType::kPrismatic : JointType::kRevolute;
      joints[i].axis = axes[i];
      joints[i].parent = i - 1;
      joints[i].mirror_sign = i == 1 || i == 3 ? -1 : 1;
    }
    joints[4].mass = kMass;
    joints[4].inertia = kInertia * Matrix3::Identity();
    ContactSurface ball;
    ball.name = "ball";
    ball.joint = 4;
    ball.surface = Sphere(kRadius);
    ContactSurface other = ball;
    other.name = "other";
    other.mirror_contact = 1;
    scene_.emplace(Scene{.name = "hop",
                         .description = "",
                         .selection = {},
                         .model = Model::Create(joints).value(),
                         .contacts = {ball, other},
                         .leg_length = 1,
                         .sources = {}});
    for (int p = 0; p < 2; ++p) {
      TrajectoryPhase phase;
      phase.node_times = {p * 0.5, p * 0.5 + 0.5};
      phase.node_positions.setZero(5, 2);
      phase.node_positions.row(2).setConstant(kRadius);
      phase.node_velocities.setZero(5, 2);
      trajectory_.phases.push_back(phase);
    }
    trajectory_.phases[0].contacts = {0};
    trajectory_.phases[1].node_velocities.col(1) = before_;
    Land(Mirrored(before_));
  }

  static VectorX Mirrored(VectorX v) {
    v[1] = -v[1];
    v[3] = -v[3];
    return v;
  }
  // Makes the first phase start with the plastic impact of the velocities v: angular momentum about the contact is
  // kept.
  void Land(const VectorX& v) {
    const double about = kInertia + kMass * kRadius * kRadius;
    VectorX after(5);
    after[4] = (kInertia * v[4] + kMass * kRadius * v[0]) / about;
    after[3] = (kInertia * v[3] - kMass * kRadius * v[1]) / about;
    after.head<3>() << kRadius * after[4], -kRadius * after[3], 0;
    trajectory_.phases[0].node_velocities.col(0) = after;
    trajectory_.phases[0].impulses = kMass * (after - v).head<3>();
  }
  JumpErrors Judge(double friction = kInfinity) {
    log_ = FindingLog(2);
    impulses_ = ForceExtremes(0.1 * kMass * 9.81);
    return MeasureJumps(*scene_, BodyDynamics(scene_->model), trajectory_, friction, &impulses_, &log_);
  }
  double Approach() {
    log_ = FindingLog(2);
    return MeasureApproach(*scene_, BodyDynamics(scene_->model), trajectory_, &log_);
  }

  const VectorX before_ = (VectorX(5) << 1.2, 0.4, -0.9, 2, -1).finished();
  std::optional<Scene> scene_;
  Trajectory trajectory_;
  FindingLog log_{2};
  ForceExtremes impulses_{1};
};

TEST_F(Hop, AJumpFollowsTheMirroredVelocity) {
  EXPECT_EQ(VelocityBefore(scene_->model, trajectory_, 0), Mirrored(before_));
  const JumpErrors errors = Judge();
  EXPECT_LT(errors.velocity, 1e-14);
  EXPECT_LT(errors.impulse, 1e-14);
  EXPECT_GT(errors.loss, 0.5 * kMass * 0.9 * 0.9);
  EXPECT_LT(log_[Criterion::kVelocityDefect].value, 1e-14);
  EXPECT_LT(log_[Criterion::kMomentum].value, 1e-14);
  EXPECT_EQ(log_[Criterion::kPull].value, 0);
  // Without the mirror the same nodes would be wrong by twice the sideways velocity, and more in the roll.
  trajectory_.cycle = Cycle::kFull;
  EXPECT_GT(Judge().velocity, 0.1);
  Land(before_);
  EXPECT_LT(Judge().velocity, 1e-14);
}

TEST_F(Hop, VelocityAndImpulseErrorsAtTheirSize) {
  trajectory_.phases[0].node_velocities(3, 0) += 0.25;
  EXPECT_NEAR(Judge().velocity, 0.25, 1e-14);
  EXPECT_NEAR(log_[Criterion::kVelocityDefect].value, 0.25, 1e-14);
  EXPECT_EQ(log_[Criterion::kVelocityDefect].where, "touch-down base_roll");
  EXPECT_EQ(log_[Criterion::kVelocityDefect].time, 0);
  Land(Mirrored(before_));
  trajectory_.phases[0].impulses[1] += 0.06;
  EXPECT_NEAR(Judge().impulse, 0.06, 1e-14);
  EXPECT_NEAR(log_[Criterion::kMomentum].value, 0.06 / kMass, 1e-14);
  EXPECT_EQ(log_[Criterion::kMomentum].where, "touch-down");
}

TEST_F(Hop, PullAndFrictionOfImpulses) {
  const double normal = kMass * 0.9;
  trajectory_.phases[0].impulses << 0.3 * normal, 0.4 * normal, normal;
  Judge(0.4);
  EXPECT_NEAR(log_[Criterion::kFriction].value, 0.25, 1e-14);
  EXPECT_EQ(log_[Criterion::kFriction].where, "touch-down ball");
  EXPECT_NEAR(impulses_.max_friction_ratio(), 0.5, 1e-14);
  Judge(0.5 + 1e-12);
  EXPECT_EQ(log_[Criterion::kFriction].value, 0);
  // A pull of 0.03 weight-seconds.
  trajectory_.phases[0].impulses << 0, 0, -0.03 * 0.1 * kMass * 9.81;
  Judge();
  EXPECT_NEAR(log_[Criterion::kPull].value, 0.03, 1e-14);
  EXPECT_EQ(log_[Criterion::kPull].where, "touch-down ball");
  EXPECT_LT(impulses_.min_normal(), 0);
}

// Two contacts of one body that push against each other with an impulse that changes nothing.
TEST_F(Hop, AnInternalImpulseIsNoFriction) {
  scene_->contacts[1].p_LE = Vector3(0.1, 0, 0);
  trajectory_.phases[0].contacts = {0, 1};
  trajectory_.phases[0].impulses = (VectorX(6) << 5, 0, 1, -4.9, 0, 1).finished();
  Judge(0.1);
  EXPECT_NEAR(impulses_.max_friction_ratio(), 0.05, 1e-12);
  EXPECT_EQ(log_[Criterion::kFriction].value, 0);
  Judge(0.04);
  EXPECT_NEAR(log_[Criterion::kFriction].value, 0.25, 1e-12);
}

TEST_F(Hop, TouchDowns) {
  EXPECT_EQ(TouchDowns(*scene_, trajectory_, 0), std::vector<int>{0});
  EXPECT_TRUE(TouchDowns(*scene_, trajectory_, 1).empty());
  // The last phase stands on the mirror image of what the first one stands on.
  scene_->contacts[0].mirror_contact = 1;
  scene_->contacts[1].mirror_contact = 0;
  trajectory_.phases[1].contacts = {1};
  EXPECT_TRUE(TouchDowns(*scene_, trajectory_, 0).empty());
  EXPECT_EQ(TouchDowns(*scene_, trajectory_, 1), std::vector<int>{1});
  trajectory_.cycle = Cycle::kFull;
  EXPECT_EQ(TouchDowns(*scene_, trajectory_, 0), std::vector<int>{0});
  trajectory_.cycle = Cycle::kOnce;
  EXPECT_TRUE(TouchDowns(*scene_, trajectory_, 0).empty());
  EXPECT_EQ(TouchDowns(*scene_, trajectory_, 1), std::vector<int>{1});
}

TEST_F(Hop, AFootThatIsHitWhileItRises) {
  EXPECT_EQ(Approach(), 0);
  trajectory_.phases[1].node_velocities(2, 1) = 0.07;
  EXPECT_NEAR(Approach(), 0.07, 1e-15);
  EXPECT_NEAR(log_[Criterion::kApproach].value, 0.07, 1e-15);
  EXPECT_EQ(log_[Criterion::kApproach].where, "touch-down ball");
  EXPECT_EQ(log_[Criterion::kApproach].phase, 0);
  // A smooth touch-down is judged, too.
  trajectory_.phases[0].impulses.resize(0);
  EXPECT_NEAR(Approach(), 0.07, 1e-15);
  // A motion that happens once begins as it is.
  trajectory_.cycle = Cycle::kOnce;
  EXPECT_EQ(Approach(), 0);
}

TEST_F(Hop, TheMirrorTurnsTheApproach) {
  // Turned by the roll, a point beside the middle rises or falls: +0.1 m to the side, roll rate 2 rad/s, mirrored −2.
  scene_->contacts[0].p_LE = Vector3(0, -0.1, 0);
  trajectory_.phases[1].node_velocities.col(1) << 0, 0, 0, 2, 0;
  EXPECT_NEAR(Approach(), 0.2, 1e-15);
  trajectory_.cycle = Cycle::kFull;
  EXPECT_EQ(Approach(), 0);
}

TEST_F(Hop, BetweenPhasesNothingIsMirrored) {
  trajectory_.phases[1].contacts = {1};
  trajectory_.phases[0].contacts.clear();
  trajectory_.phases[0].impulses.resize(0);
  trajectory_.phases[0].node_velocities(2, 1) = 0.03;
  EXPECT_NEAR(Approach(), 0.03, 1e-15);
  EXPECT_EQ(log_[Criterion::kApproach].where, "touch-down other");
  EXPECT_EQ(log_[Criterion::kApproach].phase, 1);
  EXPECT_EQ(log_[Criterion::kApproach].time, 0.5);
  trajectory_.phases[0].node_velocities(2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Approach(), kInfinity);
}

}  // namespace
}  // namespace rollgait
