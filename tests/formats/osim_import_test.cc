// OpenSim models that the client has exported, read back: the same bodies, and the same equations of motion.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "client/formats/opensim_coordinates.h"
#include "client/formats/osim.h"
#include "client/formats/urdf_side.h"
#include "client/import/side_file.h"
#include "client/import/tree_file.h"
#include "client/import/tree_model.h"
#include "core/models/catalog.h"
#include "core/multibody/tree_dynamics.h"
#include "server/convert/gait_request_convert.h"
#include "server/convert/model_convert.h"
#include "server/convert/own_model_convert.h"

namespace rollgait::client {
namespace {

struct Walker {
  const char* name;
  v1::ModelSelection selection;
};

std::vector<Walker> OpensimWalkers() {
  std::vector<Walker> walkers(4);
  const char* const names[] = {"planar", "human", "toes", "sprung"};
  for (size_t i = 0; i < walkers.size(); ++i) {
    walkers[i].name = names[i];
    walkers[i].selection.set_name(i == 0 ? "planar" : "human29");
  }
  walkers[2].selection.set_toes(true);
  v1::ModelSelection::JointSpring& spring = (*walkers[3].selection.mutable_joint_springs())["ankle_l"];
  spring.set_stiffness_n_m_rad(340);
  spring.set_rest_rad(0.1);
  spring.set_damping_n_m_s_rad(2.5);
  (*walkers[3].selection.mutable_locked_joints_rad())["hip_rotation_l"] = 0.2;
  (*walkers[3].selection.mutable_locked_joints_rad())["trunk_bending"] = 0.1;
  return walkers;
}

class OsimImportTest : public testing::TestWithParam<Walker> {};
INSTANTIATE_TEST_SUITE_P(Walkers, OsimImportTest, testing::ValuesIn(OpensimWalkers()),
                         [](const auto& walker) { return std::string(walker.param.name); });

TEST_P(OsimImportTest, WhatIsExportedMovesAsTheModel) {
  const Result<BodyRequest> request = server::DecodeBody(GetParam().selection);
  ASSERT_TRUE(request.ok());
  const Result<Scene> scene = BuildScene(request.value());
  ASSERT_TRUE(scene.ok());
  const v1::Model ours = server::EncodeModel(scene.value(), 9.81);
  const LinkTree tree = ReadLinkTreeText("ours.osim", ToOsim(ours, {}));
  v1::ModelSideFile side;
  side.set_mirror(v1::ModelSideFile::MIRROR_NONE);
  side.set_base(tree.base_in_plane ? v1::ModelSideFile::BASE_PLANE : v1::ModelSideFile::BASE_SPACE);
  EXPECT_EQ(tree.base_in_plane, std::string(GetParam().name) == "planar");
  const v1::Model back = ModelOfTree(tree, "ours.json", side).model;
  ASSERT_EQ(back.joints_size(), ours.joints_size());
  // By coordinate: where each joint of the model is in what was read, and with which sign.
  const std::vector<OpensimCoordinate> coordinates = OpensimCoordinates(ours);
  std::vector<int> index;
  std::vector<double> sign;
  for (int i = 0; i < ours.joints_size(); ++i) {
    const v1::Joint& joint = ours.joints(i);
    const bool base = IsBaseRole(joint.role());
    int found = -1;
    for (int k = 0; k < back.joints_size(); ++k) {
      if (back.joints(k).name() == (base ? joint.name() : coordinates[static_cast<size_t>(i)].name)) found = k;
    }
    ASSERT_GE(found, 0) << joint.name();
    index.push_back(found);
    sign.push_back(base ? 1 : coordinates[static_cast<size_t>(i)].sign);
    if (base) continue;
    const v1::Joint& read = back.joints(found);
    EXPECT_EQ(sign.back() > 0 ? read.position_min() : -read.position_max(), joint.position_min()) << joint.name();
    EXPECT_EQ(sign.back() > 0 ? read.effort_max() : -read.effort_min(), joint.effort_max()) << joint.name();
    EXPECT_EQ(read.stiffness(), joint.stiffness()) << joint.name();
    EXPECT_EQ(sign.back() * read.rest_position(), joint.rest_position()) << joint.name();
    EXPECT_EQ(read.damping(), joint.damping()) << joint.name();
  }
  Violations violations;
  const auto own = server::DecodeOwnModel("model.own.", back, &violations);
  ASSERT_TRUE(violations.empty());
  const Result<Model> created = Model::Create(own->joints);
  ASSERT_TRUE(created.ok());
  TreeDynamics expected(scene.value().model), found(created.value());
  const int n = expected.size();
  std::mt19937 random(13);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Vector3 gravity(1, 0, -9.7);
  double largest = 0, scale = 0;
  for (int trial = 0; trial < 20; ++trial) {
    VectorX q(n), v(n), a(n), tau(n), tau_back(n), q_back(n), v_back(n), a_back(n);
    for (int i = 0; i < n; ++i) {
      q(i) = uniform(random);
      v(i) = 5 * uniform(random);
      a(i) = 50 * uniform(random);
      const int k = index[static_cast<size_t>(i)];
      const double s = sign[static_cast<size_t>(i)];
      q_back(k) = s * q(i);
      v_back(k) = s * v(i);
      a_back(k) = s * a(i);
    }
    expected.Update(q.data(), v.data(), a.data(), gravity);
    expected.InverseDynamics(tau.data());
    found.Update(q_back.data(), v_back.data(), a_back.data(), gravity);
    found.InverseDynamics(tau_back.data());
    for (int i = 0; i < n; ++i) {
      largest =
          std::max(largest, std::abs(tau(i) - sign[static_cast<size_t>(i)] * tau_back(index[static_cast<size_t>(i)])));
    }
    scale = std::max(scale, tau.cwiseAbs().maxCoeff());
  }
  EXPECT_LT(largest, 1e-12 * scale);
  EXPECT_GT(scale, 10);
  std::printf("%s: %d joints, efforts differ by up to %.2g of %.3g N m or N\n", GetParam().name, n, largest, scale);
}

}  // namespace
}  // namespace rollgait::client
