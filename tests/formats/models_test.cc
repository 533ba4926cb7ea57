// Every kind of model that the service has: the core's inverse dynamics against that of MuJoCo on the exported MJCF.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "client/formats/mjcf.h"
#include "core/models/catalog.h"
#include "core/multibody/tree_dynamics.h"
#include "server/convert/gait_request_convert.h"
#include "server/convert/model_convert.h"
#include "tests/formats/mujoco_model.h"
#include "tests/formats/solved_gaits.h"

namespace rollgait::client {
namespace {

struct Kind {
  std::string name;
  v1::ModelSelection selection;
};

std::vector<Kind> Kinds() {
  std::vector<Kind> kinds;
  const auto add = [&kinds](const std::string& name, const std::string& model) -> v1::ModelSelection& {
    kinds.push_back({name, {}});
    kinds.back().selection.set_name(model);
    return kinds.back().selection;
  };
  add("planar", "planar");
  add("human", "human29");
  add("heels", "human29").set_feet(v1::ModelSelection::FEET_TWO_ELLIPSOIDS);
  add("toes", "human29").set_toes(true);
  add("sagittal", "human29").set_sagittal(true);
  v1::ModelSelection& reduced = add("reduced", "human29");
  reduced.set_sex(v1::ModelSelection::SEX_FEMALE);
  reduced.set_stature_m(1.5);
  reduced.set_drop_arms(true);
  reduced.set_rigid_trunk(true);
  v1::ModelSelection& locked = add("locked", "human29");
  locked.set_toes(true);
  for (const auto& [joint, angle] : {std::pair("hip_l", 0.3),
                                     {"hip_adduction_r", -0.1},
                                     {"shoulder_rotation_l", 0.2},
                                     {"ankle_r", 0.1},
                                     {"trunk_bending", 0.15}}) {
    (*locked.mutable_locked_joints_rad())[joint] = angle;
  }
  v1::ModelSelection& sprung = add("sprung", "human29");
  for (const char* const joint : {"ankle_l", "hip_adduction_r"}) {
    v1::ModelSelection::JointSpring& spring = (*sprung.mutable_joint_springs())[joint];
    spring.set_stiffness_n_m_rad(340);
    spring.set_rest_rad(0.1);
    spring.set_damping_n_m_s_rad(20);
  }
  (*sprung.mutable_joint_strengths())["ankle_l"] = 0;
  v1::ModelSelection::Load& load = *sprung.add_loads();
  load.set_segment("hand_l");
  load.set_mass_kg(10);
  add("ball", "ball");
  return kinds;
}

class ModelsTest : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, ModelsTest, testing::ValuesIn(Kinds()),
                         [](const auto& kind) { return kind.param.name; });

TEST_P(ModelsTest, InverseDynamicsOfMujocoIsTheCores) {
  const Result<BodyRequest> request = server::DecodeBody(GetParam().selection);
  ASSERT_TRUE(request.ok());
  const Result<Scene> scene = BuildScene(request.value());
  ASSERT_TRUE(scene.ok());
  const v1::Model exported = server::EncodeModel(scene.value(), 9.81);
  const Ground ground{.slope_rad = 0.2};
  MujocoModel mujoco(WriteScratch("kind_" + GetParam().name + ".xml", ToMjcf(exported, ground)));
  TreeDynamics core(scene.value().model);
  const int n = core.size();
  ASSERT_EQ(mujoco.model().nv, n);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double largest = 0, scale = 0;
  for (int trial = 0; trial < 50; ++trial) {
    VectorX q(n), v(n), a(n), expected(n);
    for (int i = 0; i < n; ++i) {
      q(i) = uniform(random);
      v(i) = 5 * uniform(random);
      a(i) = 50 * uniform(random);
    }
    core.Update(q.data(), v.data(), a.data(), ground.Gravity());
    core.InverseDynamics(expected.data());
    mujoco.Set(q, v, a);
    const VectorX found = mujoco.InverseDynamics();
    largest = std::max(largest, (found - expected).cwiseAbs().maxCoeff());
    scale = std::max(scale, expected.cwiseAbs().maxCoeff());
  }
  EXPECT_LT(largest, 1e-12 * scale);
  EXPECT_GT(scale, 1);
  std::printf("%s: %d joints, 50 random states, differences up to %.2g of up to %.3g N m or N\n",
              GetParam().name.c_str(), n, largest, scale);
}

}  // namespace
}  // namespace rollgait::client
