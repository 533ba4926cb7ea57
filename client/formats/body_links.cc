#include "client/formats/body_links.h"

#include <string>

#include "client/failure.h"
#include "client/joint_kinds.h"

namespace rollgait::client {
namespace {

[[noreturn]] void Refuse(int joint, const std::string& what) {
  throw Failure(ExitCode::kUsage, "model.joints[" + std::to_string(joint) + "]" + what);
}

}  // namespace

std::vector<BodyLink> BodyLinks(const v1::Model& model) {
  std::vector<int> children(model.joints_size(), 0);
  for (int i = 0; i < model.joints_size(); ++i) {
    const v1::Joint& joint = model.joints(i);
    RequireTurnOrSlide(joint, i);
    if (joint.parent() < -1 || joint.parent() >= i) {
      Refuse(i, ".parent is " + std::to_string(joint.parent()) + ", must be in [-1, " + std::to_string(i - 1) +
                    "]: parents come first");
    }
    if (joint.parent() >= 0) ++children[joint.parent()];
  }
  std::vector<BodyLink> bodies;
  std::vector<int> body_of_link(model.joints_size(), -1);
  for (int i = 0; i < model.joints_size(); ++i) {
    if (!(model.joints(i).mass_kg() > 0)) {
      if (children[i] != 1) {
        Refuse(i, ".mass_kg is 0, but " + std::to_string(children[i]) +
                      " joints hang on the link; this format needs exactly one, or a mass > 0");
      }
      continue;
    }
    BodyLink body{{i}, -1};
    int carrier = model.joints(i).parent();
    for (; carrier >= 0 && body_of_link[carrier] < 0; carrier = model.joints(carrier).parent()) {
      body.joints.insert(body.joints.begin(), carrier);
    }
    if (carrier >= 0) body.parent = body_of_link[carrier];
    body_of_link[i] = static_cast<int>(bodies.size());
    bodies.push_back(std::move(body));
  }
  return bodies;
}

std::vector<int> BodyOfJoint(const v1::Model& model, const std::vector<BodyLink>& bodies) {
  std::vector<int> body_of_joint(model.joints_size(), -1);
  for (size_t b = 0; b < bodies.size(); ++b) {
    for (const int joint : bodies[b].joints) body_of_joint[joint] = static_cast<int>(b);
  }
  return body_of_joint;
}

Pose Relative(const Pose& a, const Pose& b) {
  return {a.rotation.transpose() * b.rotation, a.rotation.transpose() * (b.position - a.position)};
}

LinkMass MassOf(const v1::Joint& joint) {
  if (joint.inertia_kg_m2_size() != 6) {
    throw Failure(ExitCode::kUsage, "joint " + joint.name() + ": inertia_kg_m2 has " +
                                        std::to_string(joint.inertia_kg_m2_size()) + " values, must have 6");
  }
  const auto& entry = joint.inertia_kg_m2();
  Eigen::Matrix3d inertia;
  inertia << entry[0], entry[3], entry[4], entry[3], entry[1], entry[5], entry[4], entry[5], entry[2];
  return {joint.mass_kg(), ToVector(joint.center_of_mass_m()), inertia};
}

}  // namespace rollgait::client
