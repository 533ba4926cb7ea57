// The distance of two limbs as a row: derivatives against differences and against the chain rule over poses, the joints
// it depends on, symmetry, and no allocation.
#include "core/ocp/constraints/separation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/contact/pair_derivatives.h"
#include "core/models/catalog.h"
#include "core/multibody/body_dynamics.h"
#include "core/ocp/constraints/contact_point.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/seeded_random.h"

namespace rollgait {
namespace {

Scene ToedHuman() {
  BodyRequest request;
  request.model = "human29";
  request.toes = true;
  return BuildScene(request).value();
}

class SeparationTest : public ::testing::Test {
 protected:
  SeparationTest() { layout_.n = scene_.model.size(); }

  SeparationConstraint Row(int pair, double clearance = 1e-3) const {
    const BodyPair& bodies = scene_.pairs[pair];
    return SeparationConstraint(scene_.model, scene_.bodies[bodies.first], scene_.bodies[bodies.second], layout_,
                                clearance);
  }
  int FindPair(const std::string& name) const {
    for (size_t p = 0; p < scene_.pairs.size(); ++p) {
      if (scene_.PairName(static_cast<int>(p)) == name) return static_cast<int>(p);
    }
    ADD_FAILURE() << name;
    return 0;
  }
  PointContext At(const VectorX& q) {
    tree_.UpdateKinematics(q.data(), zero_.data());
    return {q.data(), &tree_, nullptr, nullptr};
  }
  double Value(SeparationConstraint& row, const VectorX& q) {
    double g;
    row.Value(At(q), &g);
    return g;
  }
  VectorX Gradient(SeparationConstraint& row, const VectorX& q) {
    MatrixX jacobian = MatrixX::Zero(1, layout_.n);
    row.Jacobian(At(q), jacobian);
    return jacobian.transpose();
  }
  MatrixX Hessian(SeparationConstraint& row, const VectorX& q) {
    MatrixX hessian = MatrixX::Zero(layout_.n, layout_.n);
    const double lambda = 1;
    row.AddHessian(At(q), &lambda, hessian);
    return hessian;
  }

  void CheckDerivatives(SeparationConstraint& row, const VectorX& q) {
    const VectorX gradient = Gradient(row, q);
    const MatrixX hessian = Hessian(row, q);
    EXPECT_GT(gradient.norm(), 0.01);
    EXPECT_GT(hessian.norm(), 0.01);
    EXPECT_EQ(hessian, MatrixX(hessian.transpose()));
    const double step = 2e-5;
    for (int i = 0; i < layout_.n; ++i) {
      VectorX up = q, down = q;
      up(i) += step;
      down(i) -= step;
      // Rounding of Newton's normal, 1e-15 / step, and step² times third derivatives, which grow as curvatures divided
      // by distances do: up to 1e3 in these configurations.
      EXPECT_NEAR(gradient(i), (Value(row, up) - Value(row, down)) / (2 * step), 1e-7) << row.Name(0) << " by " << i;
      const VectorX column = (Gradient(row, up) - Gradient(row, down)) / (2 * step);
      EXPECT_LT((hessian.col(i) - column).cwiseAbs().maxCoeff(), 1e-6 * (1 + column.norm()))
          << row.Name(0) << " by " << i;
    }
    CheckPatterns(row, gradient, hessian);
  }
  static void CheckPatterns(const SeparationConstraint& row, const VectorX& gradient, const MatrixX& hessian) {
    const Entries first = row.JacobianPattern(), second = row.HessianPattern();
    const std::set<std::pair<int, int>> columns(first.begin(), first.end()), pairs(second.begin(), second.end());
    EXPECT_EQ(columns.size(), first.size());
    for (int i = 0; i < gradient.size(); ++i) {
      EXPECT_TRUE(gradient(i) == 0 || columns.count({0, i}) == 1) << i;
      for (int k = 0; k < gradient.size(); ++k) EXPECT_TRUE(hessian(i, k) == 0 || pairs.count({i, k}) == 1);
    }
  }

  const Scene scene_ = ToedHuman();
  PointLayout layout_;
  TreeDynamics tree_{scene_.model};
  const VectorX zero_ = VectorX::Zero(scene_.model.size());
};

TEST_F(SeparationTest, DerivativesOfEveryPairApartAndOverlapping) {
  SeededRandom random(5);
  int apart = 0, overlapping = 0;
  for (int pair = 0; pair < static_cast<int>(scene_.pairs.size()); ++pair) {
    SeparationConstraint row = Row(pair);
    for (int i = 0; i < 3; ++i) {
      const VectorX q = random.VectorOf(layout_.n, -0.4, 0.4);
      CheckDerivatives(row, q);
      (Value(row, q) > 0 ? apart : overlapping)++;
    }
  }
  // Legs turned towards each other: the first three draws of each pair that overlap by 2 mm to 40 mm.
  for (const char* name : {"left_shank / right_shank", "left_shank / right_heel", "left_thigh / right_shank"}) {
    SeparationConstraint row = Row(FindPair(name));
    for (int draw = 0, found = 0; draw < 2000 && found < 3; ++draw) {
      VectorX q = random.VectorOf(layout_.n, -0.3, 0.3);
      for (const char* joint : {"hip_adduction_l", "hip_adduction_r", "hip_r", "knee_r"}) {
        q(scene_.model.Find(joint)) = random.Uniform(0, 0.6);
      }
      const double distance = Value(row, q);
      if (distance > -0.002 || distance < -0.04) continue;
      CheckDerivatives(row, q);
      ++found;
      ++overlapping;
    }
  }
  EXPECT_GT(apart, 40);
  EXPECT_GE(overlapping, 9);
}

// d by the poses of the two frames (ComputeSurfacePairDerivatives), and the poses by the joints.
TEST_F(SeparationTest, SecondDerivativesAreThoseOfTheChainRule) {
  SeededRandom random(7);
  const int n = layout_.n;
  for (const char* name : {"left_shank / right_instep", "left_thigh / right_thigh", "left_thigh / left_forearm"}) {
    const BodyPair& pair = scene_.pairs[FindPair(name)];
    const BodySurface bodies[] = {scene_.bodies[pair.first], scene_.bodies[pair.second]};
    SeparationConstraint row = Row(FindPair(name));
    const VectorX q = random.VectorOf(n, -0.3, 0.3);
    const MatrixX hessian = Hessian(row, q);
    FrameMotion frames[2];
    MatrixX columns = MatrixX::Zero(12, n);              // ∂ζ/∂q
    std::vector<MatrixX> bend(12, MatrixX::Zero(n, n));  // ∂²ζ/∂q²
    for (int b = 0; b < 2; ++b) {
      frames[b].R_WB = tree_.rotation(bodies[b].joint);
      frames[b].p_WB = tree_.origin(bodies[b].joint);
      for (int k = bodies[b].joint; k >= 0; k = scene_.model.parent(k)) {
        const Vector3 w_k = tree_.axis(k).head<3>(), v_k = tree_.axis(k).tail<3>() + w_k.cross(frames[b].p_WB);
        columns.block<3, 1>(6 * b, k) = v_k;
        columns.block<3, 1>(6 * b + 3, k) = w_k;
        for (int m = k; m >= 0; m = scene_.model.parent(m)) {
          const Vector3 w_m = tree_.axis(m).head<3>();
          const Vector3 moved = w_m.cross(v_k), turned = 0.5 * w_m.cross(w_k);
          for (int i = 0; i < 3; ++i) {
            bend[6 * b + i](m, k) = bend[6 * b + i](k, m) = moved(i);
            bend[6 * b + 3 + i](m, k) = bend[6 * b + 3 + i](k, m) = turned(i);
          }
        }
      }
    }
    const Separation separation =
        FindSeparation(Pose(bodies[0].placed, frames[0]), Pose(bodies[1].placed, frames[1]), nullptr);
    ASSERT_EQ(separation.state, Separation::State::kSeparated);
    const PairDerivatives by_pose =
        ComputeSurfacePairDerivatives(bodies[0].placed, frames[0], bodies[1].placed, frames[1], separation, 2);
    MatrixX chain = columns.transpose() * by_pose.gap_second * columns;
    for (int i = 0; i < 12; ++i) chain += by_pose.gap(i) * bend[i];
    // Above the hips the two paths are one, and everything cancels. Rounding of sums of terms up to 1e2.
    EXPECT_LT((chain - hessian).cwiseAbs().maxCoeff(), 1e-11 * (1 + hessian.norm())) << name;
    EXPECT_LT((by_pose.gap * columns - Gradient(row, q).transpose()).cwiseAbs().maxCoeff(), 1e-13) << name;
  }
}

TEST_F(SeparationTest, ValueIsThatOfLinksPosedByOtherDynamics) {
  SeededRandom random(11);
  const BodyDynamics dynamics(scene_.model);
  BodyDynamics::State state;
  for (int pair = 0; pair < static_cast<int>(scene_.pairs.size()); ++pair) {
    SeparationConstraint row = Row(pair);
    const VectorX q = random.VectorOf(layout_.n, -0.3, 0.3);
    dynamics.ComputeState(q, zero_, &state);
    PosedSurface posed[2];
    for (int b = 0; b < 2; ++b) {
      const BodySurface& body = scene_.bodies[b == 0 ? scene_.pairs[pair].first : scene_.pairs[pair].second];
      const BodyDynamics::Link& link = state[body.joint];
      posed[b] = {&body.placed.surface, link.R_WL * body.placed.R_BE, link.p_WL + link.R_WL * body.placed.p_BE};
    }
    const Separation separation = FindSeparation(posed[0], posed[1], nullptr);
    if (separation.state != Separation::State::kSeparated) continue;
    EXPECT_NEAR(Value(row, q), separation.distance, 1e-14) << row.Name(0);
  }
}

// The same configuration gives the same value, whatever was evaluated before; and mirrored configurations mirrored
// pairs.
TEST_F(SeparationTest, NoHistoryAndSymmetric) {
  SeededRandom random(13);
  for (int pair = 0; pair < static_cast<int>(scene_.pairs.size()); ++pair) {
    SeparationConstraint row = Row(pair), image = Row(scene_.pairs[pair].mirror_pair);
    const VectorX q = random.VectorOf(layout_.n, -0.4, 0.4), other = random.VectorOf(layout_.n, -0.4, 0.4);
    VectorX mirrored(layout_.n);
    for (int j = 0; j < layout_.n; ++j) {
      mirrored(j) = scene_.model.joint(j).mirror_sign * q(scene_.model.joint(j).mirror_joint);
    }
    const double before = Value(row, q);
    Value(row, other);
    EXPECT_EQ(Value(row, q), before);
    EXPECT_NEAR(Value(image, mirrored), before, 1e-13) << row.Name(0);
  }
}

// Only what is between the two bodies moves them: the joints of the legs below the pelvis.
TEST_F(SeparationTest, DependsOnTheJointsBetweenTheBodies) {
  SeparationConstraint row = Row(FindPair("left_shank / right_heel"));
  std::set<std::string> names;
  for (const auto& [r, column] : row.JacobianPattern()) names.insert(scene_.model.joint(column).name);
  EXPECT_EQ(names,
            (std::set<std::string>{"hip_l", "hip_adduction_l", "hip_rotation_l", "knee_l", "hip_r", "hip_adduction_r",
                                   "hip_rotation_r", "knee_r", "ankle_r", "ankle_inversion_r"}));
  EXPECT_EQ(Row(FindPair("left_forearm / right_forearm")).JacobianPattern().size(), 8u);
  EXPECT_EQ(Row(FindPair("left_thigh / left_forearm")).JacobianPattern().size(), 3u + 3u + 4u);
}

// Parallel shanks: the surfaces are nearly parallel along both axes, and the distance is that of two circles.
TEST_F(SeparationTest, ParallelEllipsoids) {
  SeparationConstraint row = Row(FindPair("left_shank / right_shank"));
  const BodySurface& shank = scene_.bodies[scene_.pairs[FindPair("left_shank / right_shank")].first];
  const double hips = 2 * scene_.model.joint(scene_.model.Find("hip_l")).p_PJ.y();
  const double radius = shank.placed.surface.ellipsoid()->semi_axes().y();
  EXPECT_NEAR(Value(row, zero_), hips - 2 * radius, 1e-14);
  CheckDerivatives(row, zero_);
  double lower, upper;
  row.Bounds(1, &lower, &upper);
  EXPECT_EQ(lower, 1e-3);
  EXPECT_EQ(upper, kInfinity);
}

// The gap of a swinging surface is free at the end of its phase; two bodies never are.
TEST_F(SeparationTest, HoldsAtTheEndOfAPhase) {
  EXPECT_FALSE(Row(0).FreeAtEndOfPhase());
  using Gap = GapConstraint;
  EXPECT_TRUE(Gap(scene_.model, scene_.contacts, 0, layout_, Gap::Kind::kClearance, 0.01).FreeAtEndOfPhase());
  EXPECT_FALSE(Gap(scene_.model, scene_.contacts, 0, layout_, Gap::Kind::kTouching, 0).FreeAtEndOfPhase());
}

TEST_F(SeparationTest, EvaluationDoesNotAllocate) {
  SeededRandom random(17);
  SeparationConstraint row = Row(FindPair("left_shank / right_shank"));
  VectorX q = random.VectorOf(layout_.n, -0.1, 0.1);
  MatrixX jacobian = MatrixX::Zero(1, layout_.n), hessian = MatrixX::Zero(layout_.n, layout_.n);
  const double lambda = 2;
  double sum = 0;
  int overlapping = 0;
  const long before = Allocations();
  for (const double adduction : {0.0, 0.15, 0.2}) {
    q(scene_.model.Find("hip_adduction_l")) = q(scene_.model.Find("hip_adduction_r")) = adduction;
    const PointContext at = At(q);
    double g;
    row.Value(at, &g);
    row.Jacobian(at, jacobian);
    row.AddHessian(at, &lambda, hessian);
    overlapping += g < 0 ? 1 : 0;
    sum += g;
  }
  EXPECT_EQ(Allocations() - before, 0);
  EXPECT_TRUE(std::isfinite(sum));
  EXPECT_GE(overlapping, 1);
  EXPECT_LT(overlapping, 3);
}

}  // namespace
}  // namespace rollgait
