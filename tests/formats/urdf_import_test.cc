// Every kind of model, written as URDF and side file and read back: the same numbers, and the same equations of motion.
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "client/formats/urdf.h"
#include "client/formats/urdf_side.h"
#include "client/import/side_file.h"
#include "client/import/tree_file.h"
#include "client/import/tree_model.h"
#include "core/models/catalog.h"
#include "core/models/own_model.h"
#include "core/multibody/tree_dynamics.h"
#include "server/convert/gait_request_convert.h"
#include "server/convert/model_convert.h"
#include "server/convert/own_model_convert.h"

namespace rollgait::client {
namespace {

v1::ModelSelection Selection(const std::string& model) {
  v1::ModelSelection selection;
  selection.set_name(model);
  return selection;
}

std::vector<v1::ModelSelection> Walkers() {
  std::vector<v1::ModelSelection> walkers = {Selection("planar"), Selection("human29"), Selection("human29"),
                                             Selection("human29"), Selection("human29")};
  walkers[2].set_toes(true);
  walkers[3].set_feet(v1::ModelSelection::FEET_TWO_ELLIPSOIDS);
  walkers[3].set_sex(v1::ModelSelection::SEX_FEMALE);
  // Left and right differ, and links are turned.
  (*walkers[4].mutable_locked_joints_rad())["hip_rotation_l"] = 0.2;
  (*walkers[4].mutable_locked_joints_rad())["trunk_bending"] = 0.1;
  // Springs and dampers, of one side and of both.
  for (v1::ModelSelection* const sprung : {&walkers[4], &walkers[2]}) {
    v1::ModelSelection::JointSpring& spring = (*sprung->mutable_joint_springs())["ankle_l"];
    spring.set_stiffness_n_m_rad(340);
    spring.set_rest_rad(0.1);
    spring.set_damping_n_m_s_rad(2.5);
  }
  (*walkers[2].mutable_joint_springs())["ankle_r"] = walkers[2].joint_springs().at("ankle_l");
  return walkers;
}

class UrdfImportTest : public testing::TestWithParam<int> {
 protected:
  Scene BuildOurs() const {
    const Result<BodyRequest> request = server::DecodeBody(Walkers()[static_cast<size_t>(GetParam())]);
    EXPECT_TRUE(request.ok());
    Result<Scene> scene = BuildScene(request.value());
    EXPECT_TRUE(scene.ok());
    return scene.value();
  }
};
INSTANTIATE_TEST_SUITE_P(Walkers, UrdfImportTest, testing::Range(0, 5));

// Unset quaternions are identities, and what an own model does not have is unset.
v1::Model Canonical(v1::Model model) {
  model.clear_selection();
  model.clear_sources();
  model.clear_stature_m();
  model.clear_gravity_m_s2();
  model.clear_total_mass_kg();
  model.mutable_summary()->clear_degrees_of_freedom();
  model.mutable_summary()->clear_actuated_joints();
  model.mutable_summary()->clear_contact_names();
  const auto unset_identity = [](auto& part) {
    if (part.orientation().w() == 1) part.clear_orientation();
  };
  for (v1::Joint& joint : *model.mutable_joints()) unset_identity(joint);
  for (v1::ContactSurface& contact : *model.mutable_contacts()) unset_identity(contact);
  for (v1::BodySurface& body : *model.mutable_bodies()) unset_identity(body);
  return model;
}

TEST_P(UrdfImportTest, ReadsBackTheSameModel) {
  const Scene scene = BuildOurs();
  const v1::Model ours = server::EncodeModel(scene, 9.81);
  const std::string urdf = ToUrdf(ours);
  const bool sprung = std::any_of(ours.joints().begin(), ours.joints().end(),
                                  [](const v1::Joint& joint) { return joint.stiffness() != 0; });
  EXPECT_EQ(urdf.find("<!-- Spring, which URDF cannot state;") != std::string::npos, sprung);
  EXPECT_EQ(urdf.find("<dynamics damping=\"2.5\"/>") != std::string::npos, sprung);
  const LinkTree tree = ReadLinkTreeText("ours.urdf", urdf);
  const v1::ModelSideFile side = SideFileOfModel(ours);
  ASSERT_NO_THROW(CheckSideFile("ours.json", side, tree));
  const v1::Model back = ModelOfTree(tree, "ours.json", side).model;

  google::protobuf::util::DefaultFieldComparator numbers;
  numbers.set_float_comparison(google::protobuf::util::DefaultFieldComparator::APPROXIMATE);
  numbers.SetDefaultFractionAndMargin(0, 1e-12);
  google::protobuf::util::MessageDifferencer differencer;
  differencer.set_field_comparator(&numbers);
  differencer.set_message_field_comparison(google::protobuf::util::MessageDifferencer::EQUIVALENT);
  std::string report;
  differencer.ReportDifferencesToString(&report);
  EXPECT_TRUE(differencer.Compare(Canonical(ours), Canonical(back))) << report;

  // The server accepts it, and its inverse dynamics and mass matrix are the same.
  Violations violations;
  const Result<Scene> own = OwnScene(*server::DecodeOwnModel("model.own.", back, &violations));
  ASSERT_TRUE(violations.empty());
  ASSERT_TRUE(own.ok()) << own.violations().front().field << " " << own.violations().front().message;
  EXPECT_EQ(own.value().symmetric, scene.symmetric);
  TreeDynamics expected(scene.model), found(own.value().model);
  const int n = expected.size();
  ASSERT_EQ(found.size(), n);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Vector3 gravity(1, 0, -9.7);
  for (int trial = 0; trial < 20; ++trial) {
    VectorX q(n), v(n), a(n), tau(n), tau_back(n);
    for (int i = 0; i < n; ++i) {
      q(i) = uniform(random);
      v(i) = 5 * uniform(random);
      a(i) = 50 * uniform(random);
    }
    MatrixX mass = MatrixX::Zero(n, n), mass_back = MatrixX::Zero(n, n);  // written for joints on one path
    expected.MassMatrix(q.data(), mass);
    found.MassMatrix(q.data(), mass_back);
    EXPECT_LT((mass - mass_back).cwiseAbs().maxCoeff(), 1e-12 * mass.cwiseAbs().maxCoeff());
    expected.Update(q.data(), v.data(), a.data(), gravity);
    expected.InverseDynamics(tau.data());
    found.Update(q.data(), v.data(), a.data(), gravity);
    found.InverseDynamics(tau_back.data());
    EXPECT_LT((tau - tau_back).cwiseAbs().maxCoeff(), 1e-12 * tau.cwiseAbs().maxCoeff());
    EXPECT_GT(tau.cwiseAbs().maxCoeff(), 1);
  }
}

}  // namespace
}  // namespace rollgait::client
