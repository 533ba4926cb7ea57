#include "client/formats/bvh.h"

#include <array>
#include <cmath>
#include <vector>

#include "client/formats/exact_number.h"
#include "client/formats/exported_stride.h"
#include "client/formats/opensim_coordinates.h"
#include "client/formats/skeleton_motion.h"
#include "client/report/kinematics.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr double kCentimetres = 100;

// R = Rz Rx Ry, degrees in this order.
std::array<double, 3> ZxyAngles(const Eigen::Matrix3d& r) {
  const double across = std::hypot(r(2, 0), r(2, 2));
  const double x = std::atan2(r(2, 1), across);
  const bool locked = across < 1e-12;
  const double z = locked ? std::atan2(r(1, 0), r(0, 0)) : std::atan2(-r(0, 1), r(1, 1));
  const double y = locked ? 0 : std::atan2(-r(2, 0), r(2, 2));
  return {z * 180 / kPi, x * 180 / kPi, y * 180 / kPi};
}

class BvhWriter {
 public:
  BvhWriter(const v1::Model& model, const std::vector<Bone>& bones) : model_(model), bones_(bones) {}

  std::string Hierarchy() {
    text_ = "HIERARCHY\n";
    WriteBone(0, "");
    return text_;
  }
  // Bones in the order of the hierarchy.
  const std::vector<int>& order() const { return order_; }

 private:
  void WriteBone(int index, const std::string& indent) {
    order_.push_back(index);
    const Bone& bone = bones_[index];
    const bool root = bone.parent < 0;
    text_ += indent + (root ? "ROOT " : "JOINT ") + bone.name + "\n" + indent + "{\n";
    const std::string inner = indent + "\t";
    text_ += inner + "OFFSET " + Exact(Eigen::Vector3d(kCentimetres * ToOpensim(bone.offset))) + "\n";
    text_ += inner + (root ? "CHANNELS 6 Xposition Yposition Zposition " : "CHANNELS 3 ") +
             "Zrotation Xrotation Yrotation\n";
    bool leaf = true;
    for (size_t b = 0; b < bones_.size(); ++b) {
      if (bones_[b].parent != index) continue;
      leaf = false;
      WriteBone(static_cast<int>(b), inner);
    }
    // The far end of a uniform rod whose mass centre is the link's.
    if (leaf) {
      const Eigen::Vector3d end = 2 * (bone.rest * ToVector(model_.joints(bone.joint).center_of_mass_m()));
      text_ += inner + "End Site\n" + inner + "{\n" + inner + "\tOFFSET " +
               Exact(Eigen::Vector3d(kCentimetres * ToOpensim(end))) + "\n" + inner + "}\n";
    }
    text_ += indent + "}\n";
  }

  const v1::Model& model_;
  const std::vector<Bone>& bones_;
  std::string text_;
  std::vector<int> order_;
};

}  // namespace

std::string ToBvh(const v1::Solve& solve) {
  const Stride stride = ExportedStride(solve);
  const std::vector<Bone> bones = SkeletonMotion(solve.result().model(), stride);
  BvhWriter writer(solve.result().model(), bones);
  std::string text = writer.Hierarchy();
  const size_t frames = stride.samples.size();
  text += "MOTION\nFrames: " + std::to_string(frames) +
          "\nFrame Time: " + Exact(stride.duration_s / static_cast<double>(frames - 1)) + "\n";
  std::vector<std::array<double, 3>> before(bones.size(), {0, 0, 0});
  for (size_t frame = 0; frame < frames; ++frame) {
    std::string line;
    for (const int b : writer.order()) {
      const BoneState& state = bones[b].states[frame];
      if (bones[b].parent < 0) line += Exact(Eigen::Vector3d(kCentimetres * ToOpensim(state.position))) + " ";
      const std::array<double, 3> angles = ZxyAngles(ToOpensim(state.turned));
      for (int k = 0; k < 3; ++k) {
        // Without jumps of whole turns, which players would interpolate.
        before[b][k] = angles[k] + 360 * std::round((before[b][k] - angles[k]) / 360);
        line += Exact(before[b][k]) + " ";
      }
    }
    line.back() = '\n';
    text += line;
  }
  return text;
}

}  // namespace rollgait::client
