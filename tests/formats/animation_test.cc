// BVH and glTF in Assimp, the import library of many viewers.
#include <assimp/anim.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <cstdio>

#include "client/formats/bvh.h"
#include "client/formats/exported_stride.h"
#include "client/formats/gltf.h"
#include "client/formats/ground.h"
#include "client/formats/link_shapes.h"
#include "client/report/kinematics.h"
#include "tests/formats/solved_gaits.h"

namespace rollgait::client {
namespace {

// Assimp computes in single precision.
constexpr double kPlace_m = 2e-6, kTurn = 2e-6;

class Animation {
 public:
  Animation(const std::string& name, const std::string& content) {
    scene_ = importer_.ReadFile(WriteScratch(name, content), 0);
    if (scene_ == nullptr) throw std::runtime_error(importer_.GetErrorString());
    if (scene_->mNumAnimations != 1) throw std::runtime_error("not one animation");
  }
  const aiScene& scene() const { return *scene_; }
  const aiAnimation& animation() const { return *scene_->mAnimations[0]; }

  // Of a node, at key `k` of the animation.
  Eigen::Affine3d Place(const std::string& name, unsigned k) const {
    const aiNode* const node = scene_->mRootNode->FindNode(name.c_str());
    if (node == nullptr) throw std::runtime_error("no node " + name);
    return Place(node, k);
  }

 private:
  Eigen::Affine3d Place(const aiNode* node, unsigned k) const {
    if (node == nullptr) return Eigen::Affine3d::Identity();
    return Place(node->mParent, k) * Local(*node, k);
  }
  Eigen::Affine3d Local(const aiNode& node, unsigned k) const {
    aiMatrix4x4 matrix = node.mTransformation;
    for (unsigned c = 0; c < animation().mNumChannels; ++c) {
      const aiNodeAnim& channel = *animation().mChannels[c];
      if (channel.mNodeName != node.mName) continue;
      const auto key = [k](const auto* keys, unsigned count) { return keys[count == 1 ? 0 : k].mValue; };
      matrix = aiMatrix4x4(key(channel.mScalingKeys, channel.mNumScalingKeys),
                           key(channel.mRotationKeys, channel.mNumRotationKeys),
                           key(channel.mPositionKeys, channel.mNumPositionKeys));
    }
    Eigen::Affine3d place;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 4; ++j) place(i, j) = matrix[i][j];
    }
    return place;
  }

  Assimp::Importer importer_;
  const aiScene* scene_;
};

class AnimationTest : public testing::TestWithParam<std::string> {
 protected:
  // Every body of ours where the animation has it, at every tenth key. `axes`: the service's -> the file's.
  void CheckBodies(const Animation& animation, const Eigen::Matrix3d& axes, double unit) const {
    const std::vector<Pose> rest = LinkPoses(ours_, std::vector<double>(ours_.joints_size(), 0.0));
    double moved = 0, worst = 0;
    for (unsigned k = 0; k < stride_.samples.size(); k += 10) {
      const std::vector<Pose> poses = LinkPoses(ours_, stride_.samples[k].instant.position);
      for (int i = 0; i < ours_.joints_size(); ++i) {
        if (!(ours_.joints(i).mass_kg() > 0)) continue;
        const std::string& name = ours_.joints(i).link_name();
        const Eigen::Affine3d place = animation.Place(name, k);
        const Eigen::Vector3d position = axes * poses[i].position;
        const Eigen::Matrix3d turned = axes * poses[i].rotation * rest[i].rotation.transpose() * axes.transpose();
        worst = std::max(worst, (place.translation() / unit - position).norm());
        EXPECT_LT((place.translation() / unit - position).norm(), kPlace_m) << name << " at key " << k;
        EXPECT_LT((place.linear() - turned).norm(), kTurn) << name << " at key " << k;
        moved = std::max(moved, (turned - Eigen::Matrix3d::Identity()).norm());
      }
    }
    EXPECT_GT(moved, 0.5);
    std::printf("%s: bodies at most %.2g m from ours\n", GetParam().c_str(), worst);
  }

  v1::Solve solve_ = ReadGait(GetParam());
  const v1::Model& ours_ = solve_.result().model();
  const Stride stride_ = ExportedStride(solve_);
};

INSTANTIATE_TEST_SUITE_P(Motions, AnimationTest, testing::ValuesIn(kMotions));

TEST_P(AnimationTest, BvhMovesTheBodies) {
  const Animation bvh(GetParam() + ".bvh", ToBvh(solve_));
  Eigen::Matrix3d axes;  // X forward, Y up, Z right
  axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  CheckBodies(bvh, axes, 100);
  const aiAnimation& animation = bvh.animation();
  EXPECT_EQ(animation.mChannels[0]->mNumRotationKeys, stride_.samples.size());
  const double last = animation.mChannels[0]->mRotationKeys[stride_.samples.size() - 1].mTime;
  EXPECT_NEAR(last / animation.mTicksPerSecond, stride_.duration_s, 1e-6);
}

TEST_P(AnimationTest, GltfMovesTheBodiesOnTheSlope) {
  for (const bool binary : {false, true}) {
    const Animation gltf(GetParam() + (binary ? ".glb" : ".gltf"), binary ? ToGlb(solve_) : ToGltf(solve_));
    const Eigen::Matrix3d slope = gltf.Place("ground", 0).linear();
    Eigen::Matrix3d axes;  // X left, Y up, Z forward
    axes << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    // Gravity points down in the scene.
    const Eigen::Vector3d gravity = slope * axes * GroundOf(solve_).Gravity().normalized();
    EXPECT_LT((gravity - Eigen::Vector3d(0, -1, 0)).norm(), kTurn);
    const Eigen::Vector3d uphill = slope * axes * Eigen::Vector3d::UnitX();
    EXPECT_NEAR(uphill.y(), std::sin(solve_.spec().slope_rad()), kTurn);
    const aiAnimation& animation = gltf.animation();
    ASSERT_EQ(animation.mChannels[0]->mNumRotationKeys, stride_.samples.size());
    for (unsigned k = 0; k < stride_.samples.size(); k += 10) {
      EXPECT_NEAR(animation.mChannels[0]->mRotationKeys[k].mTime / animation.mTicksPerSecond, stride_.samples[k].time_s,
                  1e-6);
      // The feet where the ground is: the lowest point of each ellipsoid, by the matrix that its unit sphere gets.
      const std::vector<Pose> poses = LinkPoses(ours_, stride_.samples[k].instant.position);
      for (const v1::ContactSurface& contact : ours_.contacts()) {
        const Eigen::Matrix4d place = (Eigen::Affine3d(slope.transpose()) * gltf.Place(contact.name(), k)).matrix();
        const double lowest = place(1, 3) - place.block<1, 3>(1, 0).norm();
        EXPECT_NEAR(lowest, LowestPoint(contact, poses).z(), kPlace_m) << contact.name();
      }
    }
    for (const LinkShape& shape : LinkShapes(ours_)) {
      const Eigen::Vector3d sizes = gltf.Place(shape.name, 0).linear().colwise().norm();
      EXPECT_LT((sizes - axes * shape.semi_axes).norm(), kPlace_m) << shape.name;
    }
  }
}

// Bodies below the node "ground", without the slope.
TEST_P(AnimationTest, GltfMovesTheBodies) {
  solve_.mutable_spec()->set_slope_rad(0);
  Eigen::Matrix3d axes;
  axes << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  CheckBodies(Animation(GetParam() + "_level.gltf", ToGltf(solve_)), axes, 1);
  CheckBodies(Animation(GetParam() + "_level.glb", ToGlb(solve_)), axes, 1);
}

TEST_P(AnimationTest, SphereOfTheGltfIsOne) {
  const Animation gltf(GetParam() + ".gltf", ToGltf(solve_));
  int spheres = 0;
  for (unsigned m = 0; m < gltf.scene().mNumMeshes; ++m) {
    const aiMesh& mesh = *gltf.scene().mMeshes[m];
    if (mesh.mNumVertices < 100) continue;
    ++spheres;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      EXPECT_NEAR(mesh.mVertices[i].Length(), 1, 1e-6);
      EXPECT_LT((mesh.mVertices[i] - mesh.mNormals[i]).Length(), 1e-6);
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      ASSERT_EQ(mesh.mFaces[f].mNumIndices, 3u);
      const aiVector3D a = mesh.mVertices[mesh.mFaces[f].mIndices[0]], b = mesh.mVertices[mesh.mFaces[f].mIndices[1]],
                       c = mesh.mVertices[mesh.mFaces[f].mIndices[2]];
      EXPECT_GT(((b - a) ^ (c - a)) * a, -1e-6) << "a triangle looks inwards";
    }
  }
  EXPECT_EQ(spheres, GetParam() == "ball" ? 1 : 2);
}

}  // namespace
}  // namespace rollgait::client
