#include "client/report/kinematics.h"

#include <cmath>

#include "client/failure.h"
#include "client/joint_kinds.h"
#include "client/report/surface_shape.h"

namespace rollgait::client {

Eigen::Matrix3d ToRotation(const v1::Quaternion& q) {
  const Eigen::Quaterniond quaternion(q.w(), q.x(), q.y(), q.z());
  if (quaternion.norm() < 1e-12) return Eigen::Matrix3d::Identity();
  return quaternion.normalized().toRotationMatrix();
}

std::vector<Pose> LinkPoses(const v1::Model& model, const std::vector<double>& positions) {
  if (static_cast<int>(positions.size()) != model.joints_size()) {
    throw Failure(ExitCode::kUsage, "the model has " + std::to_string(model.joints_size()) + " joints, but " +
                                        std::to_string(positions.size()) + " positions are given");
  }
  std::vector<Pose> poses;
  for (int i = 0; i < model.joints_size(); ++i) {
    const v1::Joint& joint = model.joints(i);
    if (joint.parent() < -1 || joint.parent() >= i) {
      throw Failure(ExitCode::kUsage, "model.joints[" + std::to_string(i) + "].parent is " +
                                          std::to_string(joint.parent()) + ", must be in [-1, " +
                                          std::to_string(i - 1) + "]: parents come first");
    }
    const Pose parent =
        joint.parent() < 0 ? Pose{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()} : poses[joint.parent()];
    Pose pose;
    pose.rotation = parent.rotation * ToRotation(joint.orientation());
    pose.position = parent.position + parent.rotation * ToVector(joint.origin_m());
    const Eigen::Vector3d axis = ToVector(joint.axis());
    const double advance = Advance(joint);
    if (advance != 0) pose.position += pose.rotation * axis * (advance * positions[i]);
    if (Turns(joint)) {
      pose.rotation = pose.rotation * Eigen::AngleAxisd(positions[i], axis.normalized()).toRotationMatrix();
    }
    poses.push_back(pose);
  }
  return poses;
}

Eigen::Vector3d LowestPoint(const v1::ContactSurface& contact, const std::vector<Pose>& poses) {
  if (contact.joint() < 0 || contact.joint() >= static_cast<int>(poses.size())) {
    throw Failure(ExitCode::kUsage, "contact " + contact.name() + ": the model has no joint of its index");
  }
  const Pose& link = poses[contact.joint()];
  const Eigen::Matrix3d rotation = link.rotation * ToRotation(contact.orientation());
  const Eigen::Vector3d down = -rotation.row(2).transpose();
  return link.position + link.rotation * ToVector(contact.center_m()) +
         rotation * ShapeOf(contact.surface()).FurthestPoint(down);
}

std::string PositiveDirection(const v1::Model& model, int joint) {
  std::vector<bool> moved(model.joints_size(), false);
  const auto center = [&](double position) {
    std::vector<double> positions(model.joints_size(), 0.0);
    positions[joint] = position;
    const std::vector<Pose> poses = LinkPoses(model, positions);
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    double mass = 0;
    for (int i = joint; i < model.joints_size(); ++i) {
      const v1::Joint& link = model.joints(i);
      moved[i] = i == joint || (link.parent() >= 0 && moved[link.parent()]);
      if (!moved[i]) continue;
      mass += link.mass_kg();
      moment += link.mass_kg() * (poses[i].position + poses[i].rotation * ToVector(link.center_of_mass_m()));
    }
    return mass > 0 ? Eigen::Vector3d(moment / mass) : moment;
  };
  const double step = 1e-4;
  const Eigen::Vector3d rate = (center(step) - center(-step)) / (2 * step);
  int axis = 0;
  if (rate.cwiseAbs().maxCoeff(&axis) < 1e-9) return "";
  static const char* const kWords[3][2] = {{"backward", "forward"}, {"right", "left"}, {"down", "up"}};
  return kWords[axis][rate(axis) > 0 ? 1 : 0];
}

}  // namespace rollgait::client
