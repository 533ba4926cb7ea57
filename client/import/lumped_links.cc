#include "client/import/lumped_links.h"

#include <Eigen/Eigenvalues>

namespace rollgait::client {

Pose Compose(const Pose& a, const Pose& b) { return {a.rotation * b.rotation, a.position + a.rotation * b.position}; }

Pose MotionOf(const UrdfJoint& joint, double position) {
  Pose pose{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
  if (position == 0) return pose;
  if (joint.type == UrdfJoint::Type::kPrismatic) {
    pose.position = position * joint.axis;
  } else if (joint.type == UrdfJoint::Type::kRevolute || joint.type == UrdfJoint::Type::kContinuous) {
    pose.rotation = Eigen::AngleAxisd(position, joint.axis).toRotationMatrix();
  }
  return pose;
}

UrdfMass Placed(const UrdfMass& mass, const Pose& place) {
  return {mass.mass, place.position + place.rotation * mass.center,
          place.rotation * mass.inertia * place.rotation.transpose()};
}

UrdfMass Lump(const std::vector<UrdfMass>& masses) {
  UrdfMass sum;
  int heavy = 0;
  for (const UrdfMass& part : masses) {
    if (!(part.mass > 0)) continue;
    ++heavy;
    sum.mass += part.mass;
    sum.center += part.mass * part.center;
  }
  if (heavy == 0) return sum;
  sum.center /= sum.mass;
  for (const UrdfMass& part : masses) {
    if (!(part.mass > 0)) continue;
    if (heavy == 1) return part;
    const Eigen::Vector3d r = part.center - sum.center;
    sum.inertia += part.inertia + part.mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  return sum;
}

Eigen::Vector3d PrincipalMoments(const UrdfMass& mass) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(mass.inertia, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace rollgait::client
