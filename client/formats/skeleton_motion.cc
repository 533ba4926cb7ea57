#include "client/formats/skeleton_motion.h"

#include "client/failure.h"
#include "client/formats/body_links.h"
#include "client/joint_kinds.h"

namespace rollgait::client {
namespace {

void RequireSkeleton(const v1::Model& model, const std::vector<BodyLink>& bodies) {
  for (size_t b = 0; b < bodies.size(); ++b) {
    const std::string& name = model.joints(bodies[b].link()).link_name();
    if ((bodies[b].parent < 0) != (b == 0)) {
      throw Failure(ExitCode::kUsage, "link " + name + ": this format has one root, the first body");
    }
    for (const int joint : bodies[b].joints) {
      if (b > 0 && IsSlide(model.joints(joint))) {
        throw Failure(ExitCode::kUsage,
                      "joint " + model.joints(joint).name() + ": this format has no joint that slides on a body");
      }
    }
  }
}

}  // namespace

std::vector<Bone> SkeletonMotion(const v1::Model& model, const Stride& stride) {
  const std::vector<BodyLink> bodies = BodyLinks(model);
  RequireSkeleton(model, bodies);
  const std::vector<Pose> rest = LinkPoses(model, std::vector<double>(model.joints_size(), 0.0));
  std::vector<Bone> bones;
  for (const BodyLink& body : bodies) {
    const Eigen::Vector3d carrier =
        body.parent < 0 ? Eigen::Vector3d::Zero() : rest[bodies[body.parent].link()].position;
    bones.push_back({model.joints(body.link()).link_name(),
                     body.parent,
                     body.link(),
                     rest[body.link()].position - carrier,
                     rest[body.link()].rotation,
                     {}});
  }
  for (const StrideSample& sample : stride.samples) {
    const std::vector<Pose> poses = LinkPoses(model, sample.instant.position);
    const auto turned = [&poses](const Bone& bone) -> Eigen::Matrix3d {
      return poses[bone.joint].rotation * bone.rest.transpose();
    };
    for (Bone& bone : bones) {
      if (bone.parent < 0) {
        bone.states.push_back({turned(bone), poses[bone.joint].position});
      } else {
        bone.states.push_back({turned(bones[bone.parent]).transpose() * turned(bone), bone.offset});
      }
    }
  }
  return bones;
}

}  // namespace rollgait::client
