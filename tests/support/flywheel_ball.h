#ifndef ROLLGAIT_TESTS_SUPPORT_FLYWHEEL_BALL_H_
#define ROLLGAIT_TESTS_SUPPORT_FLYWHEEL_BALL_H_

#include <cmath>
#include <utility>
#include <vector>

#include "core/models/scene.h"
#include "core/trajectory/trajectory.h"

namespace rollgait {

// A ball that rolls in the plane and is driven by a flywheel at its centre, solved in closed form. With the torque
// τ(t) = τ₀ + τ₁ t every acceleration is linear and every position cubic in t, so the trajectory is exact in every
// scheme. Joints: base_x, base_z, base_pitch, flywheel (actuated). Contacts: "tread" (the ball, radius r) and "hub", a
// smaller sphere inside it that stays kHubClearance over the ground.
struct FlywheelBall {
  static constexpr double kRadius = 0.4, kBallMass = 3, kBallInertia = 0.2, kWheelMass = 2, kWheelInertia = 0.05;
  static constexpr double kMass = kBallMass + kWheelMass;
  static constexpr double kHubClearance = 0.05;
  static constexpr double kDuration = 1.2;

  Vector3 gravity{0, 0, -9.81};
  double torque = 0, torque_rate = 0;  // N m, N m/s
  double speed = 0;                    // m/s at the start

  // Without slope: τ antisymmetric about mid-time and the speed such that the end state is the start state.
  static FlywheelBall Periodic() {
    FlywheelBall ball;
    ball.torque = 3;
    ball.torque_rate = -2 * ball.torque / kDuration;
    ball.speed = kRadius * ball.torque / Inertia() * kDuration / 6;
    return ball;
  }

  static double Inertia() { return kBallInertia + kMass * kRadius * kRadius; }

  double Torque(double t) const { return torque + torque_rate * t; }
  Eigen::Vector4d Acceleration(double t) const {
    const double pitch = (kMass * gravity.x() * kRadius - Torque(t)) / Inertia();
    return {kRadius * pitch, 0, pitch, Torque(t) / kWheelInertia - pitch};
  }
  Eigen::Vector4d Velocity(double t) const {
    const Eigen::Vector4d start(speed, 0, speed / kRadius, FlywheelStart());
    return start + t * Acceleration(t / 2);  // exact for a linear acceleration
  }
  Eigen::Vector4d Position(double t) const {
    return Eigen::Vector4d(0, kRadius, 0, 0) + t / 6 * (Velocity(0) + 4 * Velocity(t / 2) + Velocity(t));  // Simpson
  }
  Vector3 Force(double t) const { return {kMass * (Acceleration(t)[0] - gravity.x()), 0, -kMass * gravity.z()}; }
  // The flywheel starts such that a periodic ball's flywheel is periodic, too: ∫∫ q̈ = −q̇(0) T.
  double FlywheelStart() const { return -kDuration / 6 * (2 * Acceleration(0)[3] + Acceleration(kDuration)[3]); }

  static Scene MakeScene() {
    std::vector<Joint> joints(4);
    const char* names[] = {"base_x", "base_z", "base_pitch", "flywheel"};
    const Vector3 axes[] = {Vector3::UnitX(), Vector3::UnitZ(), Vector3::UnitY(), Vector3::UnitY()};
    for (int i = 0; i < 4; ++i) {
      joints[i].name = names[i];
      joints[i].link = std::string(names[i]) + "_link";
      joints[i].type = i < 2 ? JointType::kPrismatic : JointType::kRevolute;
      joints[i].axis = axes[i];
      joints[i].parent = i - 1;
    }
    joints[0].role = JointRole::kBaseForward;
    joints[1].role = JointRole::kBaseVertical;
    joints[2].mass = kBallMass;
    joints[2].inertia = kBallInertia * Matrix3::Identity();
    joints[3].mass = kWheelMass;
    joints[3].inertia = kWheelInertia * Matrix3::Identity();
    joints[3].actuated = true;
    joints[3].effort_min = -100;
    joints[3].effort_max = 100;
    ContactSurface tread;
    tread.name = "tread";
    tread.joint = 2;
    tread.surface = Ellipsoid(Vector3::Constant(kRadius));
    tread.directions = {0, 2};
    ContactSurface hub = tread;
    hub.name = "hub";
    hub.surface = Ellipsoid(Vector3::Constant(kRadius - kHubClearance));
    hub.mirror_contact = 1;
    return Scene{.name = "flywheel_ball",
                 .description = "Ball with a flywheel",
                 .selection = {},
                 .model = Model::Create(std::move(joints)).value(),
                 .contacts = {tread, hub},
                 .leg_length = kRadius,
                 .sources = {}};
  }

  // The exact motion on two phases of four unequal intervals each.
  Trajectory MakeTrajectory(Scheme scheme) const {
    Trajectory trajectory;
    trajectory.scheme = scheme;
    trajectory.cycle = Cycle::kFull;
    trajectory.duration = kDuration;
    trajectory.displacement = Position(kDuration)[0];
    trajectory.point_fractions = TraitsOf(scheme).points;
    const int s = static_cast<int>(trajectory.point_fractions.size());
    trajectory.points_per_interval = s;
    for (int p = 0; p < 2; ++p) {
      TrajectoryPhase phase;
      phase.contacts = {0};
      phase.start = p * kDuration / 2;
      phase.duration = kDuration / 2;
      for (double fraction : {0.0, 0.2, 0.5, 0.7, 1.0}) {
        phase.node_times.push_back(phase.start + fraction * phase.duration);
      }
      phase.node_positions.resize(4, 5);
      phase.node_velocities.resize(4, 5);
      phase.point_positions.resize(4, 4 * s);
      phase.point_velocities.resize(4, 4 * s);
      phase.point_accelerations.resize(4, 4 * s);
      phase.point_efforts.resize(1, 4 * s);
      phase.point_forces.resize(3, 4 * s);
      for (int k = 0; k < 5; ++k) {
        phase.node_positions.col(k) = Position(phase.node_times[k]);
        phase.node_velocities.col(k) = Velocity(phase.node_times[k]);
      }
      for (int k = 0; k < 4 * s; ++k) {
        const double start = phase.node_times[k / s], end = phase.node_times[k / s + 1];
        const double t = start + trajectory.point_fractions[k % s] * (end - start);
        phase.point_times.push_back(t);
        phase.point_positions.col(k) = Position(t);
        phase.point_velocities.col(k) = Velocity(t);
        phase.point_accelerations.col(k) = Acceleration(t);
        phase.point_efforts(0, k) = Torque(t);
        phase.point_forces.col(k) = Force(t);
      }
      trajectory.phases.push_back(std::move(phase));
    }
    return trajectory;
  }
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_FLYWHEEL_BALL_H_
