#include "client/formats/custom_joint.h"

#include <Eigen/Geometry>

#include "client/failure.h"
#include "client/joint_kinds.h"

namespace rollgait::client {
namespace {

constexpr double kOnePoint_m = 1e-12;

// Adds fixed axes until there are three, each perpendicular to those before it.
void Complete(std::vector<TransformAxis>& axes) {
  for (const int k : {0, 2, 1}) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(k);
    if (axes.size() >= 3) return;
    Eigen::Vector3d rest = unit;
    if (axes.size() == 1) rest -= rest.dot(axes[0].axis) * axes[0].axis;
    if (axes.size() == 2) {
      const Eigen::Vector3d normal = axes[0].axis.cross(axes[1].axis);
      rest = rest.dot(normal) * normal;
    }
    if (rest.norm() > 1e-3) axes.push_back({rest.normalized()});
  }
}

[[noreturn]] void Refuse(const v1::Joint& joint, const std::string& what) {
  throw Failure(ExitCode::kUsage, "joint " + joint.name() + ": " + what +
                                      "; a body of OpenSim moves by at most three translations, then three rotations "
                                      "about one point");
}

}  // namespace

CustomJoint ToCustomJoint(const v1::Model& model, const BodyLink& body) {
  CustomJoint custom;
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();  // the joint's frame at zero -> parent frame
  for (const int index : body.joints) {
    const v1::Joint& joint = model.joints(index);
    const Pose frame{ToRotation(joint.orientation()), ToVector(joint.origin_m())};
    if (index == body.joints.front()) {
      custom.parent_frame = frame;
    } else {
      if (frame.position.norm() > kOnePoint_m) Refuse(joint, "its origin is not that of the joint before it");
      turned = turned * frame.rotation;
    }
    const bool slides = IsSlide(joint);
    if (slides && !custom.rotations.empty()) Refuse(joint, "it slides after a rotation");
    std::vector<TransformAxis>& axes = slides ? custom.translations : custom.rotations;
    if (axes.size() == 3) Refuse(joint, "it is the fourth of its kind");
    axes.push_back({turned * ToVector(joint.axis()), index});
  }
  custom.child_frame = turned.transpose();
  Complete(custom.rotations);
  Complete(custom.translations);
  return custom;
}

}  // namespace rollgait::client
