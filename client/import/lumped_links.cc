#include "client/import/lumped_links.h"

namespace rollgait::client {

Pose Compose(const Pose& a, const Pose& b) { return {a.rotation * b.rotation, a.position + a.rotation * b.position}; }

Pose MotionOf(const TreeJoint& joint, double position) {
  Pose pose = kNoMotion;
  const double motion = position - joint.zero;
  if (motion == 0) return pose;
  if (joint.type == TreeJoint::Type::kPrismatic) {
    pose.position = motion * joint.axis;
  } else if (joint.Moves()) {
    pose.rotation = Eigen::AngleAxisd(motion, joint.axis).toRotationMatrix();
  }
  return pose;
}

MassProperties Placed(const MassProperties& mass, const Pose& place) {
  return {mass.mass, place.position + place.rotation * mass.center,
          place.rotation * mass.inertia * place.rotation.transpose()};
}

MassProperties Lump(const std::vector<MassProperties>& masses) {
  MassProperties sum;
  int heavy = 0;
  for (const MassProperties& part : masses) {
    if (!(part.mass > 0)) continue;
    ++heavy;
    sum.mass += part.mass;
    sum.center += part.mass * part.center;
  }
  if (heavy == 0) return sum;
  sum.center /= sum.mass;
  for (const MassProperties& part : masses) {
    if (!(part.mass > 0)) continue;
    if (heavy == 1) return part;
    const Eigen::Vector3d r = part.center - sum.center;
    sum.inertia += part.inertia + part.mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  return sum;
}

}  // namespace rollgait::client
