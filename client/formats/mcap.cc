#include "client/formats/mcap.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "client/formats/body_links.h"
#include "client/formats/exported_stride.h"
#include "client/formats/ground_reaction.h"
#include "client/formats/link_shapes.h"
#include "client/formats/mcap_log.h"

namespace rollgait::client {
namespace {

using nlohmann::json;

json Vector(const Eigen::Vector3d& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }

json Rotation(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

json Timestamp(double time_s) {
  const int64_t nanoseconds = std::llround(1e9 * time_s);
  return {{"sec", nanoseconds / 1000000000}, {"nsec", nanoseconds % 1000000000}};
}

// JSON schemas.
json Object(const json& properties) { return {{"type", "object"}, {"properties", properties}}; }
json ArrayOf(const json& items) { return {{"type", "array"}, {"items", items}}; }
const json kNumber = {{"type", "number"}}, kText = {{"type", "string"}};

json VectorSchema() { return Object({{"x", kNumber}, {"y", kNumber}, {"z", kNumber}}); }

json JointsSchema() {
  return Object({{"name", ArrayOf(kText)},
                 {"position", ArrayOf(kNumber)},
                 {"velocity", ArrayOf(kNumber)},
                 {"effort", ArrayOf(kNumber)}});
}

json ReactionSchema() {
  return Object({{"feet", ArrayOf(Object({{"name", kText},
                                          {"force", VectorSchema()},
                                          {"center_of_pressure", VectorSchema()},
                                          {"free_moment", kNumber}}))}});
}

json TransformsSchema() {
  return Object({{"transforms", ArrayOf(Object({{"timestamp", Object({{"sec", kNumber}, {"nsec", kNumber}})},
                                                {"parent_frame_id", kText},
                                                {"child_frame_id", kText},
                                                {"translation", VectorSchema()},
                                                {"rotation", Object({{"x", kNumber}})}}))}});
}

json SceneSchema() {
  return Object(
      {{"entities", ArrayOf(Object({{"frame_id", kText}, {"id", kText}, {"spheres", ArrayOf(Object({}))}}))}});
}

// One entity an ellipsoid, fixed to the frame of its link.
json BodyMessage(const v1::Model& model) {
  json entities = json::array();
  for (const LinkShape& shape : LinkShapes(model)) {
    const bool foot = shape.kind == LinkShape::Kind::kContact;
    const json color = {{"r", foot ? 0.86 : 0.62}, {"g", foot ? 0.52 : 0.68}, {"b", foot ? 0.25 : 0.78}, {"a", 1}};
    const json sphere = {{"pose", {{"position", Vector(shape.center)}, {"orientation", Rotation(shape.rotation)}}},
                         {"size", Vector(2 * shape.semi_axes)},
                         {"color", color}};
    entities.push_back({{"timestamp", Timestamp(0)},
                        {"frame_id", model.joints(shape.joint).link_name()},
                        {"id", shape.name},
                        {"lifetime", Timestamp(0)},
                        {"frame_locked", true},
                        {"spheres", json::array({sphere})}});
  }
  return {{"entities", entities}};
}

json JointsMessage(const v1::Model& model, const Instant& instant) {
  json names = json::array();
  for (const v1::Joint& joint : model.joints()) names.push_back(joint.name());
  return {{"name", names}, {"position", instant.position}, {"velocity", instant.velocity}, {"effort", instant.effort}};
}

json TransformsMessage(const v1::Model& model, const std::vector<BodyLink>& bodies, const StrideSample& sample) {
  const std::vector<Pose> poses = LinkPoses(model, sample.instant.position);
  json transforms = json::array();
  for (const BodyLink& body : bodies) {
    transforms.push_back({{"timestamp", Timestamp(sample.time_s)},
                          {"parent_frame_id", "world"},
                          {"child_frame_id", model.joints(body.link()).link_name()},
                          {"translation", Vector(poses[body.link()].position)},
                          {"rotation", Rotation(poses[body.link()].rotation)}});
  }
  return {{"transforms", transforms}};
}

}  // namespace

std::string ToMcap(const v1::Solve& solve) {
  const v1::Model& model = solve.result().model();
  const Stride stride = ExportedStride(solve);
  const std::vector<BodyLink> bodies = BodyLinks(model);
  const std::vector<Plate> plates = FootPlates(solve);
  std::vector<std::vector<Reaction>> reactions;
  for (const Plate& plate : plates) reactions.push_back(Reactions(stride, model, plate));

  McapLog log("rollgait; " + DescribeStride(solve));
  const uint16_t joints = log.AddChannel("/joints", "rollgait.JointStates", JointsSchema());
  const uint16_t ground = log.AddChannel("/ground_reaction", "rollgait.GroundReaction", ReactionSchema());
  const uint16_t frames = log.AddChannel("/tf", "foxglove.FrameTransforms", TransformsSchema());
  const uint16_t body = log.AddChannel("/body", "foxglove.SceneUpdate", SceneSchema());
  log.AddMessage(body, 0, BodyMessage(model));
  for (size_t row = 0; row < stride.samples.size(); ++row) {
    const StrideSample& sample = stride.samples[row];
    json feet = json::array();
    for (size_t p = 0; p < plates.size(); ++p) {
      const Reaction& reaction = reactions[p][row];
      feet.push_back({{"name", plates[p].name},
                      {"force", Vector(reaction.force)},
                      {"center_of_pressure", Vector(reaction.point)},
                      {"free_moment", reaction.couple.z()}});
    }
    log.AddMessage(joints, sample.time_s, JointsMessage(model, sample.instant));
    log.AddMessage(ground, sample.time_s, {{"feet", feet}});
    log.AddMessage(frames, sample.time_s, TransformsMessage(model, bodies, sample));
  }
  return log.Finish();
}

}  // namespace rollgait::client
