#include "client/formats/opensim_coordinates.h"

#include <algorithm>

namespace rollgait::client {
namespace {

struct Row {
  const char* joint;  // without "_l", "_r"
  const char* coordinate;
  double sign;
};

// Names and senses of OpenSim's gait2392; of knee (flexion is positive) and arms those of Rajagopal 2016.
constexpr Row kRows[] = {
    {"base_x", "pelvis_tx", 1},
    {"base_y", "pelvis_tz", -1},
    {"base_z", "pelvis_ty", 1},
    {"base_yaw", "pelvis_rotation", 1},
    {"base_roll", "pelvis_list", 1},
    {"base_pitch", "pelvis_tilt", -1},
    {"hip", "hip_flexion", 1},
    {"hip_adduction", "hip_adduction", 1},
    {"hip_rotation", "hip_rotation", 1},
    {"knee", "knee_angle", 1},
    {"ankle", "ankle_angle", 1},
    {"ankle_inversion", "subtalar_angle", 1},
    {"toe", "mtp_angle", 1},
    {"trunk_flexion", "lumbar_extension", -1},
    {"trunk_bending", "lumbar_bending", 1},
    {"trunk_rotation", "lumbar_rotation", 1},
    {"shoulder", "arm_flex", 1},
    {"shoulder_adduction", "arm_add", 1},
    {"shoulder_rotation", "arm_rot", 1},
    {"elbow", "elbow_flex", 1},
};

Eigen::Matrix3d Axes() {
  Eigen::Matrix3d axes;
  axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return axes;
}

}  // namespace

Eigen::Vector3d ToOpensim(const Eigen::Vector3d& v) { return {v.x(), v.z(), -v.y()}; }

Eigen::Matrix3d ToOpensim(const Eigen::Matrix3d& rotation) { return Axes() * rotation * Axes().transpose(); }

std::vector<OpensimCoordinate> OpensimCoordinates(const v1::Model& model) {
  const bool human = std::any_of(model.joints().begin(), model.joints().end(),
                                 [](const v1::Joint& joint) { return joint.link_name() == "pelvis"; });
  std::vector<OpensimCoordinate> coordinates;
  for (const v1::Joint& joint : model.joints()) {
    const std::string& name = joint.name();
    const bool sided = name.ends_with("_l") || name.ends_with("_r");
    const std::string stem = sided ? name.substr(0, name.size() - 2) : name;
    const auto row = std::find_if(std::begin(kRows), std::end(kRows), [&](const Row& r) { return stem == r.joint; });
    if (human && row != std::end(kRows)) {
      coordinates.push_back({row->coordinate + name.substr(stem.size()), row->sign});
    } else {
      coordinates.push_back({name, 1});
    }
  }
  return coordinates;
}

}  // namespace rollgait::client
