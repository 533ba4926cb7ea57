#include "core/models/reduction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/contact/rolling_kinematics.h"
#include "core/models/catalog.h"
#include "tests/support/matrix_near.h"
#include "tests/support/random_tree.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

using ::testing::HasSubstr;
using testing::kGravity;
using testing::RandomTree;

struct Evaluation {
  MatrixX mass;
  VectorX bias;
  BodyDynamics::State state;
};

Evaluation Evaluate(const Model& model, const VectorX& q, const VectorX& v) {
  const BodyDynamics dynamics(model);
  Evaluation at;
  BodyDynamics::Workspace workspace;
  dynamics.ComputeState(q, v, &at.state);
  dynamics.MassMatrix(at.state, &workspace, &at.mass);
  dynamics.BiasForce(at.state, kGravity, &workspace, &at.bias);
  return at;
}

// q (or v) of the full tree: that of the reduced one, and the fixed positions (or rest) elsewhere.
VectorX Expand(const VectorX& reduced, const ModelReduction& reduction, VectorX full) {
  for (size_t k = 0; k < reduction.kept.size(); ++k) full(reduction.kept[k]) = reduced(static_cast<int>(k));
  return full;
}

// The reduced tree has the rows and columns of the full tree that still move, and its links are where they were.
void ExpectReducedIsTheFullTree(const Model& full, const std::map<std::string, double>& locked, int states) {
  const Result<ModelReduction> result = ReduceModel(full, locked);
  ASSERT_TRUE(result.ok());
  const ModelReduction& reduction = result.value();
  const int n = reduction.model.size();
  ASSERT_EQ(n + static_cast<int>(locked.size()), full.size());
  VectorX fixed = VectorX::Zero(full.size());
  for (const auto& [name, position] : locked) fixed(full.Find(name)) = position;
  SeededRandom random(3);
  for (int i = 0; i < states; ++i) {
    const VectorX q = random.VectorOf(n, -1, 1), v = random.VectorOf(n, -3, 3);
    const Evaluation small = Evaluate(reduction.model, q, v);
    const Evaluation large =
        Evaluate(full, Expand(q, reduction, fixed), Expand(v, reduction, VectorX::Zero(full.size())));
    const MatrixX mass = large.mass(reduction.kept, reduction.kept);
    const VectorX bias = large.bias(reduction.kept);
    // Rounding of sums over some thirty bodies.
    EXPECT_TRUE(MatrixNear(small.mass, mass, 1e-13 * (1 + mass.cwiseAbs().maxCoeff())));
    EXPECT_TRUE(MatrixNear(small.bias, bias, 1e-13 * (1 + bias.cwiseAbs().maxCoeff())));
    EXPECT_GT(bias.cwiseAbs().maxCoeff(), 1);
    for (int link = 0; link < full.size(); ++link) {
      const ModelReduction::Place& place = reduction.places[link];
      const Matrix3 R = place.joint < 0 ? Matrix3(Matrix3::Identity()) : small.state[place.joint].R_WL;
      const Vector3 p = place.joint < 0 ? Vector3(Vector3::Zero()) : small.state[place.joint].p_WL;
      EXPECT_TRUE(MatrixNear(R * place.R_KL, large.state[link].R_WL, 1e-13));
      EXPECT_TRUE(MatrixNear(p + R * place.p_KL, large.state[link].p_WL, 1e-13));
    }
  }
}

TEST(ReductionTest, RandomTreesKeepTheirDynamics) {
  for (int n : {4, 9, 20}) {
    std::mt19937 random(n);
    const Model model = RandomTree(random, n);
    ExpectReducedIsTheFullTree(model, {{"joint2", 0.7}}, 3);
    ExpectReducedIsTheFullTree(model, {{"joint1", -0.4}, {"joint3", 0.3}}, 3);
    if (n > 9) ExpectReducedIsTheFullTree(model, {{"joint5", 1}, {"joint6", 0}, {"joint7", -2}, {"joint19", 0.1}}, 3);
  }
}

TEST(ReductionTest, WhatHangsOnAFixedRootStandsInTheWorld) {
  std::mt19937 random(5);
  const Model model = RandomTree(random, 9);
  ExpectReducedIsTheFullTree(model, {{"joint0", 0.6}, {"joint1", 0.2}}, 3);
  const ModelReduction reduction = ReduceModel(model, {{"joint0", 0.6}}).value();
  EXPECT_EQ(reduction.places[0].joint, -1);
  EXPECT_NEAR(reduction.model.total_mass(), model.total_mass() - model.joint(0).mass, 1e-12);
}

TEST(ReductionTest, LockingNothingChangesNothing) {
  std::mt19937 random(5);
  const Model model = RandomTree(random, 9);
  const ModelReduction reduction = ReduceModel(model, {}).value();
  for (int i = 0; i < 9; ++i) {
    EXPECT_EQ(reduction.model.joint(i).p_PJ, model.joint(i).p_PJ);
    EXPECT_EQ(reduction.model.joint(i).parent, model.parent(i));
    EXPECT_TRUE(MatrixNear(reduction.model.joint(i).inertia, model.joint(i).inertia, 1e-15));
  }
  EXPECT_TRUE(reduction.symmetric);
}

TEST(ReductionTest, RefusesWhatIsNotThere) {
  std::mt19937 random(5);
  const Model model = RandomTree(random, 4);
  const auto refused = [&](const std::map<std::string, double>& locked) {
    const Result<ModelReduction> result = ReduceModel(model, locked);
    EXPECT_FALSE(result.ok());
    return result.violations().front();
  };
  EXPECT_EQ(refused({{"knee", 0}}).field, "locked_joints_rad[\"knee\"]");
  EXPECT_THAT(refused({{"joint1", kInfinity}}).message, HasSubstr("finite"));
  EXPECT_THAT(refused({{"joint0", 0}, {"joint1", 0}, {"joint2", 0}, {"joint3", 0}}).message, HasSubstr("every joint"));
}

Scene HumanOf(const BodyRequest& request) { return BuildScene(request).value(); }

BodyRequest Request(const char* model) {
  BodyRequest request;
  request.model = model;
  return request;
}

// The planar human is the human in space, moving in the sagittal plane: mass matrix, bias force and contacts.
TEST(ReductionTest, PlanarHumanIsTheHumanInSpace) {
  for (const Sex sex : {Sex::kFemale, Sex::kMale}) {
    BodyRequest request = Request("human29");
    request.sex = sex;
    const Scene space = HumanOf(request);
    request.model = "planar";
    const Scene plane = HumanOf(request);
    std::vector<int> kept;
    for (const Joint& joint : plane.model.joints()) kept.push_back(space.model.Find(joint.name));
    SeededRandom random(11);
    for (int i = 0; i < 50; ++i) {
      const VectorX q = random.VectorOf(9, -1, 1), v = random.VectorOf(9, -3, 3);
      VectorX q_space = VectorX::Zero(29), v_space = q_space;
      q_space(kept) = q;
      v_space(kept) = v;
      const Evaluation small = Evaluate(plane.model, q, v), large = Evaluate(space.model, q_space, v_space);
      EXPECT_TRUE(MatrixNear(small.mass, large.mass(kept, kept), 1e-12));
      EXPECT_TRUE(MatrixNear(small.bias, large.bias(kept), 1e-11));  // of some 1000 N m
      for (int c = 0; c < 2; ++c) {
        const RollingContact in_plane = ComputeRollingContact(plane.contacts[c], small.state);
        const RollingContact in_space = ComputeRollingContact(space.contacts[c], large.state);
        EXPECT_TRUE(MatrixNear(in_plane.p_WP, in_space.p_WP, 1e-14));
        EXPECT_TRUE(MatrixNear(in_plane.slip, in_space.slip, 1e-13));
        EXPECT_TRUE(MatrixNear(in_plane.point_velocity, in_space.point_velocity, 1e-13));
        EXPECT_TRUE(MatrixNear(in_plane.drift, in_space.drift, 1e-11));
        MatrixX jacobian = MatrixX::Zero(2, 9), jacobian_space = MatrixX::Zero(3, 29);
        RollingJacobian(BodyDynamics(plane.model), plane.contacts[c], small.state, in_plane.p_WP, 0, &jacobian);
        RollingJacobian(BodyDynamics(space.model), space.contacts[c], large.state, in_space.p_WP, 0, &jacobian_space);
        EXPECT_TRUE(MatrixNear(jacobian, MatrixX(jacobian_space(std::vector<int>{0, 2}, kept)), 1e-13));
        EXPECT_NEAR(in_space.p_WP.y(), space.model.joint(space.model.Find(c == 0 ? "hip_l" : "hip_r")).p_PJ.y(), 1e-14);
      }
    }
  }
}

// Bent toes of a body with locked toes, and straight ones that are not there at all.
TEST(ReductionTest, LockedToesAreTheWholeFoot) {
  BodyRequest request = Request("human29");
  request.feet = FootShape::kTwoEllipsoids;
  const Scene whole = HumanOf(request);
  request.toes = true;
  request.locked_joints = {{"toe_l", 0}, {"toe_r", 0}};
  const Scene locked = HumanOf(request);
  ASSERT_EQ(locked.model.size(), 29);
  ASSERT_EQ(locked.contacts.size(), 4u);
  for (int i = 0; i < 29; ++i) {
    const Joint &a = whole.model.joint(i), &b = locked.model.joint(i);
    EXPECT_EQ(a.name, b.name);
    EXPECT_NEAR(a.mass, b.mass, 1e-14);
    EXPECT_TRUE(MatrixNear(a.center_of_mass, b.center_of_mass, 1e-15));
    EXPECT_TRUE(MatrixNear(a.inertia, b.inertia, 1e-15));
  }
  for (int c = 0; c < 4; ++c) {
    EXPECT_EQ(whole.contacts[c].joint, locked.contacts[c].joint);
    EXPECT_TRUE(MatrixNear(whole.contacts[c].p_LE, locked.contacts[c].p_LE, 1e-15));
  }
  request.locked_joints = {{"toe_l", 0.5}, {"toe_r", 0.5}};
  EXPECT_GT(HumanOf(request).contacts[1].p_LE.z(), whole.contacts[1].p_LE.z() + 0.01);
}

}  // namespace
}  // namespace rollgait
