#include "client/formats/gltf.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "client/base64.h"
#include "client/formats/exported_stride.h"
#include "client/formats/gltf_buffer.h"
#include "client/formats/ground.h"
#include "client/formats/link_shapes.h"
#include "client/formats/skeleton_motion.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

using nlohmann::json;

// (X, Y, Z) = (y, z, x) of the service.
Eigen::Vector3d ToGltfAxes(const Eigen::Vector3d& v) { return {v.y(), v.z(), v.x()}; }

// (x, y, z, w) of a rotation between two frames whose axes are both renamed so.
Eigen::Vector4d ToGltfQuaternion(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  Eigen::Vector4d renamed;
  renamed << ToGltfAxes(q.vec()), q.w();
  return renamed.normalized();
}

template <typename Vector>
json List(const Vector& vector) {
  return std::vector<double>(vector.begin(), vector.end());
}

// A sphere of radius 1, in rings from pole to pole; the normals are the positions.
json UnitSphere(GltfBuffer& buffer) {
  constexpr int kRings = 12, kSectors = 20;
  std::vector<double> positions;
  std::vector<int> corners;
  for (int i = 0; i <= kRings; ++i) {
    const double polar = kPi * i / kRings;
    for (int j = 0; j <= kSectors; ++j) {
      const double around = 2 * kPi * j / kSectors;
      for (const double value :
           {std::sin(polar) * std::sin(around), std::cos(polar), std::sin(polar) * std::cos(around)}) {
        positions.push_back(value);
      }
      if (i == kRings || j == kSectors) continue;
      const int corner = i * (kSectors + 1) + j;
      for (const int k : {0, kSectors + 1, 1, 1, kSectors + 1, kSectors + 2}) corners.push_back(corner + k);
    }
  }
  const int vertices = buffer.AddFloats(positions, 3, true);
  return {{"attributes", {{"POSITION", vertices}, {"NORMAL", vertices}}}, {"indices", buffer.AddIndices(corners)}};
}

// A square of the ground, x from −1 m to `length` + 1 m of the service.
json GroundSquare(double length, GltfBuffer& buffer) {
  std::vector<double> positions, normals;
  for (const double x : {-1.0, length + 1}) {
    for (const double y : {-0.6, 0.6}) {
      const Eigen::Vector3d corner = ToGltfAxes({x, y, 0});
      positions.insert(positions.end(), corner.begin(), corner.end());
      normals.insert(normals.end(), {0, 1, 0});
    }
  }
  return {{"attributes",
           {{"POSITION", buffer.AddFloats(positions, 3, true)}, {"NORMAL", buffer.AddFloats(normals, 3, true)}}},
          {"indices", buffer.AddIndices({0, 2, 1, 1, 2, 3})}};
}

json Material(const std::string& name, const std::vector<double>& color) {
  return {{"name", name},
          {"doubleSided", true},
          {"pbrMetallicRoughness", {{"baseColorFactor", color}, {"metallicFactor", 0}, {"roughnessFactor", 0.8}}}};
}

class Scene {
 public:
  explicit Scene(const v1::Solve& solve)
      : model_(solve.result().model()),
        ground_(GroundOf(solve)),
        stride_(ExportedStride(solve)),
        bones_(SkeletonMotion(model_, stride_)) {
    const Eigen::Matrix3d slope = Eigen::AngleAxisd(-ground_.slope_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
    nodes_.push_back({{"name", "ground"}, {"rotation", List(ToGltfQuaternion(slope))}, {"children", json::array()}});
    AddMeshes();
    for (size_t b = 0; b < bones_.size(); ++b) AddBone(static_cast<int>(b));
    AddShapes();
    document_ = {{"asset", {{"version", "2.0"}, {"generator", "Rollgait"}, {"copyright", DescribeStride(solve)}}},
                 {"scene", 0},
                 {"scenes", {{{"name", "walk"}, {"nodes", {0}}}}},
                 {"nodes", nodes_},
                 {"meshes", meshes_},
                 {"materials",
                  {Material("body", {0.62, 0.68, 0.78, 1}), Material("foot", {0.86, 0.52, 0.25, 1}),
                   Material("ground", {0.8, 0.8, 0.78, 1})}},
                 {"animations", {{{"name", "walk"}, {"channels", channels_}, {"samplers", samplers_}}}},
                 {"bufferViews", buffer_.views()},
                 {"accessors", buffer_.accessors()},
                 {"buffers", {{{"byteLength", buffer_.bytes().size()}}}}};
  }

  json& document() { return document_; }
  const std::string& bytes() const { return buffer_.bytes(); }

 private:
  void AddMeshes() {
    json sphere = UnitSphere(buffer_);
    for (const int material : {0, 1}) {
      sphere["material"] = material;
      meshes_.push_back({{"name", material == 0 ? "body" : "foot"}, {"primitives", {sphere}}});
    }
    json square = GroundSquare(stride_.displacement_m, buffer_);
    square["material"] = 2;
    meshes_.push_back({{"name", "ground"}, {"primitives", {square}}});
    AddChild(0, {{"name", "ground_square"}, {"mesh", 2}});
    std::vector<double> times;
    for (const StrideSample& sample : stride_.samples) times.push_back(sample.time_s);
    times_ = buffer_.AddFloats(times, 1);
  }

  int AddChild(int parent, json node) {
    nodes_.push_back(std::move(node));
    nodes_[parent]["children"].push_back(nodes_.size() - 1);
    return static_cast<int>(nodes_.size()) - 1;
  }

  // A node of a body has the axes of the world at rest, not of the link.
  void AddBone(int index) {
    const Bone& bone = bones_[index];
    const int node = AddChild(bone.parent < 0 ? 0 : node_of_bone_[bone.parent],
                              {{"name", bone.name}, {"translation", List(ToGltfAxes(bone.states[0].position))}});
    node_of_bone_.push_back(node);
    std::vector<double> rotations, positions;
    Eigen::Vector4d before = Eigen::Vector4d::UnitW();
    for (const BoneState& state : bone.states) {
      Eigen::Vector4d q = ToGltfQuaternion(state.turned);
      if (q.dot(before) < 0) q = -q;
      before = q;
      rotations.insert(rotations.end(), q.begin(), q.end());
      const Eigen::Vector3d position = ToGltfAxes(state.position);
      positions.insert(positions.end(), position.begin(), position.end());
    }
    nodes_[node]["rotation"] = std::vector<double>(rotations.begin(), rotations.begin() + 4);
    Animate(node, "rotation", buffer_.AddFloats(rotations, 4));
    if (bone.parent < 0) Animate(node, "translation", buffer_.AddFloats(positions, 3));
  }

  void Animate(int node, const std::string& path, int output) {
    channels_.push_back({{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", times_}, {"output", output}, {"interpolation", "LINEAR"}});
  }

  void AddShapes() {
    for (const LinkShape& shape : LinkShapes(model_)) {
      for (size_t b = 0; b < bones_.size(); ++b) {
        const Bone& bone = bones_[b];
        if (bone.joint != shape.joint) continue;
        AddChild(node_of_bone_[b], {{"name", shape.name},
                                    {"mesh", shape.kind == LinkShape::Kind::kContact ? 1 : 0},
                                    {"translation", List(ToGltfAxes(bone.rest * shape.center))},
                                    {"rotation", List(ToGltfQuaternion(bone.rest * shape.rotation))},
                                    {"scale", List(ToGltfAxes(shape.semi_axes))}});
      }
    }
  }

  const v1::Model& model_;
  const Ground ground_;
  const Stride stride_;
  const std::vector<Bone> bones_;
  GltfBuffer buffer_;
  std::vector<int> node_of_bone_;
  int times_ = 0;
  json nodes_ = json::array(), meshes_ = json::array(), channels_ = json::array(), samplers_ = json::array();
  json document_;
};

}  // namespace

std::string ToGltf(const v1::Solve& solve) {
  Scene scene(solve);
  scene.document()["buffers"][0]["uri"] = "data:application/octet-stream;base64," + Base64(scene.bytes());
  return scene.document().dump(1) + "\n";
}

std::string ToGlb(const v1::Solve& solve) {
  Scene scene(solve);
  std::string text = scene.document().dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto chunk = [](const std::string& content, const std::string& type) {
    return LittleEndian(static_cast<uint32_t>(content.size())) + type + content;
  };
  const std::string chunks = chunk(text, "JSON") + chunk(scene.bytes(), std::string("BIN\0", 4));
  return "glTF" + LittleEndian(2) + LittleEndian(static_cast<uint32_t>(12 + chunks.size())) + chunks;
}

}  // namespace rollgait::client
