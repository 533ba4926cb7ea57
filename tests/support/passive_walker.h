#ifndef ROLLGAIT_TESTS_SUPPORT_PASSIVE_WALKER_H_
#define ROLLGAIT_TESTS_SUPPORT_PASSIVE_WALKER_H_

#include <algorithm>
#include <cmath>

#include "core/simulation/scene.h"

namespace rollgait {

// Two rigid legs with a point mass at the hip that walk down a slope in the plane x, z. World x along the slope in the
// direction of walking, z its normal. Leg angles turn x towards z, 0 is a leg along −z.
struct PassiveWalker {
  double hip_mass = 1, leg_mass = 0.5, leg_inertia = 0.02;  // kg, kg m² about the leg's centre of mass
  double hip_to_com = 0.5, hip_to_foot = 1;                 // m, along the leg
  double foot_fore_aft = 0.2, foot_along_leg = 0.1;         // m, semi-axes of the foot's ellipse; 0: a point
  double foot_offset = 0;                                   // m, centre of the foot in front of the leg's axis
  double gravity = 1, slope = 0.01;                         // m/s², rad
  double stance = 0, stance_rate = 0, swing = 0, swing_rate = 0;
};

// A point foot is a ball this much smaller than the leg.
inline constexpr double kPointFoot = 1e-15;

// Standing on foot_1, foot_2 swinging; foot_2 strikes when leg_1 has passed the normal and leg_2 is in front of it, and
// the other way round: feet that scuff in mid-swing are let through.
inline SimulationScene SceneOf(const PassiveWalker& walker) {
  std::vector<Joint> joints(4);
  joints[0].name = "base_x", joints[0].type = JointType::kPrismatic, joints[0].axis = Vector3::UnitX();
  joints[1].name = "base_z", joints[1].type = JointType::kPrismatic, joints[1].axis = Vector3::UnitZ();
  joints[1].parent = 0;
  joints[1].mass = walker.hip_mass;
  for (int leg = 2; leg < 4; ++leg) {
    Joint& joint = joints[static_cast<size_t>(leg)];
    joint.name = leg == 2 ? "leg_1" : "leg_2";
    joint.axis = -Vector3::UnitY();
    joint.parent = 1;
    joint.mass = walker.leg_mass;
    joint.center_of_mass = Vector3(0, 0, -walker.hip_to_com);
    joint.inertia = Vector3(walker.leg_inertia, walker.leg_inertia, 0).asDiagonal();
    joint.mirror_joint = 5 - leg;
  }
  SimulationScene scene{"walker", Model::Create(joints).value(), {}, {}, {}, {}, {}, {}, {}, 0, {}};
  scene.efforts.resize(4);
  scene.ground = {GroundMotion{}};
  for (int foot = 0; foot < 2; ++foot) {
    SceneContact contact;
    contact.contact.name = foot == 0 ? "foot_1" : "foot_2";
    contact.contact.link = 2 + foot;
    const bool point = walker.foot_fore_aft == 0;
    const double a = walker.foot_fore_aft, c = walker.foot_along_leg;
    contact.contact.surface.surface =
        point ? Surface(Sphere(kPointFoot * walker.hip_to_foot)) : Surface(Ellipsoid(Vector3(a, a, c)));
    contact.contact.surface.p_BE = Vector3(walker.foot_offset, 0, -walker.hip_to_foot);
    contact.contact.grip = Grip::kRollingAlong;
    contact.active = foot == 0;
    contact.mirror = 1 - foot;
    contact.gates = {Gate{3 - foot, -M_PI / 2, 0}, Gate{2 + foot, 0, M_PI / 2}};
    scene.contacts.push_back(contact);
  }
  scene.gravity = walker.gravity * Vector3(std::sin(walker.slope), 0, -std::cos(walker.slope));
  scene.q.resize(4), scene.v.resize(4);
  scene.q << 0, walker.hip_to_foot * std::cos(walker.stance), walker.stance, walker.swing;
  scene.v << 0, 0, walker.stance_rate, walker.swing_rate;
  scene.adjusted_joints = {0, 1};
  scene.options.duration = 20 * std::sqrt(walker.hip_to_foot / walker.gravity);
  scene.options.output_step = scene.options.duration;
  scene.options.tolerance = 1e-13;
  return scene;
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_PASSIVE_WALKER_H_
