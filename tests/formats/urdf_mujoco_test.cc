// Robots from elsewhere: MuJoCo reads the URDF, and its inverse dynamics are those of the model that the client makes
// of it.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <random>

#include "client/import/side_file.h"
#include "client/import/side_proposal.h"
#include "client/import/tree_file.h"
#include "client/import/tree_model.h"
#include "core/multibody/tree_dynamics.h"
#include "server/convert/own_model_convert.h"
#include "tests/formats/mujoco_model.h"
#include "tests/formats/solved_gaits.h"
#include "tests/support/twisted_robot.h"

namespace rollgait::client {
namespace {

// The robot on a free joint, which MuJoCo needs to be told and the client takes for the base.
std::string Floating(std::string urdf, const std::string& root) {
  const size_t at = urdf.find('>', urdf.find("<robot")) + 1;
  return urdf.insert(
      at,
      "<mujoco><compiler strippath=\"true\"/></mujoco><link name=\"ground\"/><joint name=\"free\" type=\"floating\">"
      "<parent link=\"ground\"/><child link=\"" +
          root + "\"/></joint>");
}

// `fixed`: positions of joints that are no joints of the model; `reference`: where the model counts positions from.
void ExpectSameDynamics(const std::string& name, const std::string& urdf, const v1::ModelSideFile& side,
                        const std::map<std::string, double>& fixed, const std::map<std::string, double>& reference) {
  const LinkTree tree = ReadLinkTreeText(name, urdf);
  const v1::Model model = ModelOfTree(tree, "side.json", side).model;
  Violations violations;
  const auto own = server::DecodeOwnModel("model.own.", model, &violations);
  ASSERT_TRUE(violations.empty());
  const Result<Model> created = Model::Create(own->joints);
  ASSERT_TRUE(created.ok());
  TreeDynamics core(created.value());
  MujocoModel mujoco(WriteScratch(name, urdf));
  const int n = core.size();
  ASSERT_EQ(mujoco.model().nv, n + static_cast<int>(fixed.size()));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Vector3 gravity(0.5, 0.2, -9.7);
  std::copy(gravity.begin(), gravity.end(), mujoco.model().opt.gravity);
  double largest = 0, scale = 0;
  for (int trial = 0; trial < 30; ++trial) {
    VectorX q = VectorX::Zero(n), v = VectorX::Zero(n), a = VectorX::Zero(n), expected(n);
    VectorX mq = VectorX::Zero(mujoco.model().nq), mv = VectorX::Zero(mujoco.model().nv), ma = mv;
    mq(3) = 1;  // the free joint's quaternion: the base is not turned
    for (int i = 0; i < 3; ++i) {
      mq(i) = q(i) = uniform(random);
      mv(i) = v(i) = uniform(random);
      ma(i) = a(i) = 10 * uniform(random);
    }
    for (int i = 6; i < n; ++i) {
      const std::string& joint = model.joints(i).name();
      const int dof = mujoco.Dof(joint);
      q(i) = uniform(random);
      mq(dof + 1) = q(i) + (reference.count(joint) != 0 ? reference.at(joint) : 0.0);
      mv(dof) = v(i) = 5 * uniform(random);
      ma(dof) = a(i) = 50 * uniform(random);
    }
    for (const auto& [joint, position] : fixed) mq(mujoco.Dof(joint) + 1) = position;
    core.Update(q.data(), v.data(), a.data(), gravity);
    core.InverseDynamics(expected.data());
    mujoco.Set(mq, mv, ma);
    const VectorX found = mujoco.InverseDynamics();
    // Base: yaw, roll and pitch about z, x and y.
    const int base[] = {0, 1, 2, 5, 3, 4};
    for (int i = 0; i < n; ++i) {
      const int dof = i < 6 ? base[i] : mujoco.Dof(model.joints(i).name());
      largest = std::max(largest, std::abs(found(dof) - expected(i)));
    }
    scale = std::max(scale, expected.cwiseAbs().maxCoeff());
  }
  // MuJoCo finds principal moments to about nine digits of the largest.
  EXPECT_LT(largest, 1e-9 * scale);
  EXPECT_GT(scale, 10);
  std::printf("%s: %d joints, differences up to %.2g of up to %.3g N m or N\n", name.c_str(), n, largest, scale);
}

TEST(UrdfMujocoTest, TheExampleIsReadAlike) {
  const std::string urdf = Floating(ReadModelBytes(ROLLGAIT_SOURCE "/examples/biped/biped.urdf"), "pelvis");
  ExpectSameDynamics("biped.urdf", urdf, ProposeSideFile(ReadLinkTreeText("biped.urdf", urdf)).side, {}, {});
}

TEST(UrdfMujocoTest, TurnedFramesReferencesAndLocksAreReadAlike) {
  v1::ModelSideFile side;
  side.set_mirror(v1::ModelSideFile::MIRROR_NONE);
  const std::map<std::string, double> reference = {{"hip", 0.3}, {"knee", -0.5}, {"slide", 0.1}, {"twist", 0.4}};
  for (const auto& [joint, position] : reference) {
    side.add_joints()->set_name(joint);
    side.mutable_joints(side.joints_size() - 1)->set_reference(position);
    side.mutable_joints(side.joints_size() - 1)->set_locked(joint == "twist");
  }
  ExpectSameDynamics("twisted.urdf", Floating(kTwistedRobot, "base"), side, {{"twist", 0.4}}, reference);
}

}  // namespace
}  // namespace rollgait::client
