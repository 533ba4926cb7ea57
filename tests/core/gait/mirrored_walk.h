#ifndef ROLLGAIT_TESTS_CORE_GAIT_MIRRORED_WALK_H_
#define ROLLGAIT_TESTS_CORE_GAIT_MIRRORED_WALK_H_

#include <algorithm>
#include <vector>

#include "core/gait/gait_spec.h"

namespace rollgait {

// What a mirror in the plane y = 0 shows of a full cycle of four phases, begun half a cycle later, so that its first
// step is made with the same foot as the spec's. `spec` is the request of the mirrored body; which joints are
// images of each other the body knows that its sides differ from (GaitSpec::symmetric). Planar models.
inline Trajectory MirroredWalk(const Trajectory& walk, const GaitSpec& spec) {
  const Model& model = spec.symmetric->scene.model;
  Trajectory image = walk;
  const double later = walk.phases[2].start;
  const int forward = model.Find(JointRole::kBaseForward);
  const double further = walk.phases[2].node_positions(forward, 0);
  for (size_t p = 0; p < 4; ++p) {
    TrajectoryPhase& to = image.phases[p];
    to = walk.phases[(p + 2) % 4];
    const double time = (p < 2 ? 0 : walk.duration) - later, distance = (p < 2 ? 0 : walk.displacement) - further;
    to.start += time;
    for (double& t : to.node_times) t += time;
    for (double& t : to.point_times) t += time;
    for (MatrixX* of_joints : {&to.node_positions, &to.node_velocities, &to.point_positions, &to.point_velocities,
                               &to.point_accelerations}) {
      const MatrixX from = *of_joints;
      for (int j = 0; j < model.size(); ++j) {
        of_joints->row(j) = model.joint(j).mirror_sign * from.row(model.joint(j).mirror_joint);
      }
    }
    to.node_positions.row(forward).array() += distance;
    to.point_positions.row(forward).array() += distance;
    const MatrixX efforts = to.point_efforts, forces = to.point_forces;
    const std::vector<int>& actuated = model.actuated();
    for (size_t a = 0; a < actuated.size(); ++a) {
      const Joint& joint = model.joint(actuated[a]);
      const auto other = std::find(actuated.begin(), actuated.end(), joint.mirror_joint) - actuated.begin();
      to.point_efforts.row(static_cast<int>(a)) = joint.mirror_sign * efforts.row(static_cast<int>(other));
    }
    const std::vector<int> contacts = to.contacts;
    to.contacts = spec.phases[p].contacts;
    for (size_t c = 0; c < to.contacts.size(); ++c) {
      const int mirrored = spec.scene.contacts[static_cast<size_t>(to.contacts[c])].mirror_contact;
      const auto other = std::find(contacts.begin(), contacts.end(), mirrored) - contacts.begin();
      for (int axis = 0; axis < 3; ++axis) {
        to.point_forces.row(static_cast<int>(3 * c) + axis) =
            (axis == 1 ? -1 : 1) * forces.row(static_cast<int>(3 * other) + axis);
      }
    }
  }
  return image;
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_CORE_GAIT_MIRRORED_WALK_H_
