#include "client/import/mirror_images.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "client/failure.h"
#include "client/formats/body_links.h"
#include "client/import/mirror_names.h"
#include "client/joint_kinds.h"
#include "client/report/kinematics.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

template <typename Parts>
std::map<std::string, int> IndexByName(const Parts& parts) {
  std::map<std::string, int> index;
  for (int i = 0; i < parts.size(); ++i) index.emplace(parts[i].name(), i);
  return index;
}

// The given mirror image or, where there is none, the part whose name has the sides exchanged, or `otherwise`.
std::string ImageName(const std::string& field, const std::string& given, const std::string& name,
                      const std::map<std::string, int>& known, const std::string& otherwise) {
  if (given.empty()) {
    const std::string other = MirrorNameOf(name).other;
    return known.count(other) != 0 ? other : otherwise;
  }
  if (known.count(given) == 0) {
    throw Failure(ExitCode::kUsage, field + " of \"" + name + "\" is \"" + given.substr(0, 64) +
                                        "\", which is no such part of the model (a locked joint is none)");
  }
  return given;
}

// The joint on the other side of the plane of x and z that is where the mirror image of joint `i` would be, hangs on
// the image of its parent, moves along or about the mirrored axis and carries as much; `i` itself if there is none or
// more than one. For joints whose names tell no side; images of parents are known.
int ImageByPlace(const v1::Model& model, const std::vector<Pose>& poses, int i) {
  constexpr double kPlace = 1e-3, kAxis = 1e-3, kMass = 0.01;  // m, rad, as a share: rounded drawings
  const Eigen::Vector3d mirror(1, -1, 1);
  const auto place = [&](int k) -> const Eigen::Vector3d& { return poses[static_cast<size_t>(k)].position; };
  const auto axis = [&](int k) {
    return Eigen::Vector3d(poses[static_cast<size_t>(k)].rotation * ToVector(model.joints(k).axis()));
  };
  const v1::Joint& joint = model.joints(i);
  if (joint.parent() < 0 || std::abs(place(i).y()) < kPlace) return i;
  int image = i;
  for (int k = 0; k < model.joints_size(); ++k) {
    const v1::Joint& other = model.joints(k);
    const int parent = joint.parent() < i ? model.joints(joint.parent()).mirror_joint() : -1;
    if (k == i || other.type() != joint.type() || other.parent() != parent) continue;
    if (MirrorNameOf(other.name()).side != v1::BODY_SIDE_UNSPECIFIED) continue;
    if ((place(k) - mirror.cwiseProduct(place(i))).norm() > kPlace) continue;
    if (std::abs(axis(k).dot(mirror.cwiseProduct(axis(i)))) < 1 - kAxis) continue;
    if (std::abs(other.mass_kg() - joint.mass_kg()) > kMass * joint.mass_kg()) continue;
    if (image != i) return i;
    image = k;
  }
  return image;
}

}  // namespace

double MirrorSign(const v1::Model& model, int joint, int image) {
  const std::vector<Pose> poses = LinkPoses(model, std::vector<double>(static_cast<size_t>(model.joints_size()), 0.0));
  const auto axis = [&](int i) {
    return Eigen::Vector3d(poses[static_cast<size_t>(i)].rotation * ToVector(model.joints(i).axis()));
  };
  Eigen::Vector3d mirrored = axis(image).cwiseProduct(Eigen::Vector3d(1, -1, 1));
  // The axis of a turn is a pseudovector.
  if (Turns(model.joints(joint))) mirrored = -mirrored;
  return axis(joint).dot(mirrored) < 0 ? -1 : 1;
}

std::vector<std::string> SetMirrorImages(const std::string& side_path, const v1::ModelSideFile& side,
                                         v1::Model* model) {
  const bool none = side.mirror() == v1::ModelSideFile::MIRROR_NONE;
  std::map<std::string, const v1::SideJoint*> given;
  for (const v1::SideJoint& joint : side.joints()) given.emplace(joint.name(), &joint);
  const auto joints = IndexByName(model->joints());
  const std::vector<Pose> poses =
      LinkPoses(*model, std::vector<double>(static_cast<size_t>(model->joints_size()), 0.0));
  std::string proposed;
  for (int i = 0; i < model->joints_size(); ++i) {
    v1::Joint& joint = *model->mutable_joints(i);
    joint.set_mirror_joint(i);
    joint.set_mirror_sign(1);
    if (none) continue;
    const auto found = given.find(joint.name());
    const v1::SideJoint unsaid;
    const v1::SideJoint& said = found == given.end() ? unsaid : *found->second;
    int image =
        joints.at(ImageName(side_path + ": mirrorJoint", said.mirror_joint(), joint.name(), joints, joint.name()));
    const bool is_named = !said.mirror_joint().empty() || MirrorNameOf(joint.name()).side != v1::BODY_SIDE_UNSPECIFIED;
    if (!is_named) image = ImageByPlace(*model, poses, i);
    joint.set_mirror_joint(image);
    joint.set_mirror_sign(said.mirror_sign() != 0 ? said.mirror_sign() : MirrorSign(*model, i, image));
    const bool is_base = joint.role() >= v1::Joint::ROLE_BASE_FORWARD && joint.role() <= v1::Joint::ROLE_BASE_PITCH;
    if (is_base || image < i || (!said.mirror_joint().empty() && said.mirror_sign() != 0)) continue;
    proposed += (proposed.empty() ? "" : "; ") + joint.name() +
                (image == i ? std::string(" itself") : " and " + model->joints(image).name()) +
                (joint.mirror_sign() < 0 ? " with opposite signs" : " with the same sign");
  }
  // Where left and right differ, contacts and bodies have the images that are named, and no others.
  const auto set = [&](auto* parts, const char* field, auto get, auto assign, bool itself) {
    const auto known = IndexByName(*parts);
    for (auto& part : *parts) {
      const std::string said = get(part);
      if (none && said.empty()) continue;
      assign(&part, ImageName(side_path + ": " + field, said, part.name(), known, itself ? part.name() : ""));
    }
  };
  set(
      model->mutable_contacts(), "mirrorContact", [](const auto& part) { return part.mirror_contact(); },
      [](auto* part, const std::string& name) { part->set_mirror_contact(name); }, false);
  set(
      model->mutable_bodies(), "mirrorBody", [](const auto& part) { return part.mirror_body(); },
      [](auto* part, const std::string& name) { part->set_mirror_body(name); }, true);
  if (none) return {"no mirror images: left and right differ, the body walks in full cycles (--cycle full)"};
  if (proposed.empty()) return {};
  return {"mirror images proposed from names, places and axes: " + proposed};
}

std::string MirrorDifference(const v1::Model& model) {
  constexpr double kTolerance = 1e-6;
  const std::vector<Pose> poses = LinkPoses(model, std::vector<double>(static_cast<size_t>(model.joints_size()), 0.0));
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, -1, 1).asDiagonal();
  for (int i = 0; i < model.joints_size(); ++i) {
    const int j = model.joints(i).mirror_joint();
    const LinkMass ours = MassOf(model.joints(i)), image = MassOf(model.joints(j));
    const Pose &place = poses[static_cast<size_t>(i)], &other = poses[static_cast<size_t>(j)];
    const std::string who = "\"" + model.joints(i).link_name() + "\" and \"" + model.joints(j).link_name() + "\"";
    const auto same_place = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return (a - mirror * b).norm() <= kTolerance * std::max(1.0, a.norm());
    };
    if (std::abs(ours.mass - image.mass) > kTolerance * ours.mass) {
      return "masses of " + who + ", " + FormatNumber(ours.mass, 8) + " and " + FormatNumber(image.mass, 8) + " kg";
    }
    if (!same_place(place.position, other.position)) return "origins of the joints of " + who;
    if (!same_place(place.position + place.rotation * ours.center_of_mass,
                    other.position + other.rotation * image.center_of_mass)) {
      return "centres of mass of " + who;
    }
    const Eigen::Matrix3d inertia = place.rotation * ours.inertia * place.rotation.transpose();
    const Eigen::Matrix3d reflected = mirror * other.rotation * image.inertia * other.rotation.transpose() * mirror;
    if ((inertia - reflected).norm() > kTolerance * inertia.norm()) return "inertias of " + who;
    const v1::Joint &joint = model.joints(i), &twin = model.joints(j);
    const bool same = joint.mirror_sign() > 0;
    if (joint.position_min() != (same ? twin.position_min() : -twin.position_max()) ||
        joint.position_max() != (same ? twin.position_max() : -twin.position_min())) {
      return "ranges of joints \"" + joint.name() + "\" and \"" + twin.name() + "\"";
    }
    if (joint.effort_max() != (same ? twin.effort_max() : -twin.effort_min()) ||
        joint.velocity_max() != twin.velocity_max()) {
      return "limits of joints \"" + joint.name() + "\" and \"" + twin.name() + "\"";
    }
  }
  return {};
}

}  // namespace rollgait::client
