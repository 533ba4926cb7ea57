#include "client/report/sides.h"

#include "client/report/kinematics.h"

namespace rollgait::client {

std::vector<Side> JointSides(const v1::Model& model) {
  const std::vector<Pose> poses = LinkPoses(model, std::vector<double>(model.joints_size(), 0.0));
  std::vector<Side> sides(model.joints_size(), Side::kMiddle);
  for (int i = 0; i < model.joints_size(); ++i) {
    const v1::Joint& joint = model.joints(i);
    const int mirror = joint.mirror_joint();
    if (joint.parent() >= 0 && sides[joint.parent()] != Side::kMiddle) {
      sides[i] = sides[joint.parent()];
    } else if (joint.name().ends_with("_r")) {
      sides[i] = Side::kRight;
    } else if (joint.name().ends_with("_l")) {
      sides[i] = Side::kLeft;
    } else if (mirror != i && mirror >= 0 && mirror < model.joints_size()) {
      const double y = poses[i].position.y() - poses[mirror].position.y();
      sides[i] = y < 0 ? Side::kRight : y > 0 ? Side::kLeft : Side::kMiddle;
    }
  }
  return sides;
}

bool IsOneSided(const v1::Model& model) {
  for (int i = 0; i < model.joints_size(); ++i) {
    const v1::Joint& joint = model.joints(i);
    if (joint.mirror_joint() != i || joint.mirror_sign() < 0) return false;
    for (const v1::JointCoordinate& coordinate : joint.coordinates()) {
      if (coordinate.mirror_sign() < 0) return false;
    }
  }
  return model.joints_size() > 0;
}

std::string WithoutSide(const std::string& name) {
  return name.size() > 2 && (name.ends_with("_r") || name.ends_with("_l")) ? name.substr(0, name.size() - 2) : name;
}

}  // namespace rollgait::client
