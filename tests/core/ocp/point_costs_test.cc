#include "core/ocp/costs/point_costs.h"

#include <gtest/gtest.h>

#include "core/gait/gait_spec.h"
#include "core/multibody/body_dynamics.h"
#include "core/ocp/costs/angular_momentum.h"
#include "tests/support/point_cost_check.h"

namespace rollgait {
namespace {

TEST(SquaredTorqueCost, WeighsSquares) {
  const PointLayout layout = SmallLayout();
  SquaredTorqueCost cost(Eigen::Vector2d(1, 3), layout, 100);
  VectorX z = VectorX::Zero(layout.size());
  z.segment(layout.tau(), 2) << 2, -5;
  EXPECT_DOUBLE_EQ(ValueAt(cost, z), 4 + 75);
  CheckDerivatives(cost, layout);
}

TEST(MechanicalWorkCost, IsTheAbsolutePowerForLargePowers) {
  const PointLayout layout = SmallLayout();
  MechanicalWorkCost cost(0.5, {1, 2}, layout, 1);
  VectorX z = VectorX::Zero(layout.size());
  z.segment(layout.tau(), 2) << 100, -100;
  z.segment(layout.v(), 3) << 7, 2, 3;  // the first coordinate is not actuated
  // √(p² + ε²) − ε = |p| − ε + ε²/(2|p|) …
  EXPECT_NEAR(ValueAt(cost, z), 200 + 300 - 2 * 0.5 + 0.125 / 200 + 0.125 / 300, 1e-6);
  EXPECT_DOUBLE_EQ(cost.Unsmoothed({z.data()}), 200 + 300);
  z.segment(layout.tau(), 2).setZero();
  EXPECT_EQ(ValueAt(cost, z), 0);
  CheckDerivatives(cost, layout);
}

// A tree that moves in space: its four links are light, so that differences stay exact to 1e-7.
Model SpatialTree() {
  std::vector<Joint> joints(4);
  const Vector3 axes[] = {Vector3::UnitX(), Vector3::UnitY(), Vector3(0.6, 0, 0.8), Vector3(0, 0.28, 0.96)};
  for (int i = 0; i < 4; ++i) {
    Joint& joint = joints[static_cast<size_t>(i)];
    joint.name = joint.link = "link " + std::to_string(i);
    joint.type = i == 0 ? JointType::kPrismatic : JointType::kRevolute;
    joint.parent = i == 3 ? 1 : i - 1;
    joint.axis = axes[i];
    joint.p_PJ = Vector3(0.1 * i, 0.2, -0.3);
    joint.mass = 0.1 + 0.1 * i;
    joint.center_of_mass = Vector3(0.1, -0.2 * i, 0.3);
    joint.inertia = Vector3(0.02, 0.03, 0.04).asDiagonal();
    joint.stiffness = joint.damping = 5;  // not of the momentum
  }
  return Model::Create(std::move(joints)).value();
}

// Σ R I Rᵀ ω + m (c_i − c) × (ċ_i − ċ) over the links, of the algorithm that judges.
Vector3 AngularMomentum(const Model& model, const VectorX& q, const VectorX& v) {
  const BodyDynamics dynamics(model);
  BodyDynamics::State state;
  dynamics.ComputeState(q, v, &state);
  const Vector3 center = dynamics.CenterOfMass(state), velocity = dynamics.LinearMomentum(state) / model.total_mass();
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < model.size(); ++i) {
    const BodyDynamics::Link& link = state[static_cast<size_t>(i)];
    const Joint& joint = model.joint(i);
    const Vector3 omega = link.R_WL * link.twist.angular, arm = link.R_WL * joint.center_of_mass;
    const Vector3 of_link = link.R_WL * link.twist.linear + omega.cross(arm);
    sum += link.R_WL * (joint.inertia * link.twist.angular) +
           joint.mass * (link.p_WL + arm - center).cross(of_link - velocity);
  }
  return sum;
}

TEST(SquaredAngularMomentumCost, IsThatOfTheLinksAboutTheCenterOfMass) {
  GaitRequest request;
  request.body.model = "human29";
  for (const Model& model : {SpatialTree(), CheckRequest(request).value().scene.model}) {
    PointLayout layout;
    layout.n = model.size();
    SquaredAngularMomentumCost cost(model, layout, 1);
    const VectorX z = 0.5 * RandomPoint(layout.size());
    const VectorX q = z.head(layout.n), v = z.segment(layout.v(), layout.n);
    const double square = AngularMomentum(model, q, v).squaredNorm();
    EXPECT_GT(square, 0.01);
    EXPECT_NEAR(ValueAt(cost, z), square, 1e-11 * square);
  }
}

TEST(SquaredAngularMomentumCost, DerivativesMeetDifferences) {
  PointLayout layout = SmallLayout();
  layout.n = 4;
  SquaredAngularMomentumCost cost(SpatialTree(), layout, 1);
  CheckDerivatives(cost, layout);
}

TEST(TimeCost, IsOneEverywhere) {
  const PointLayout layout = SmallLayout();
  TimeCost cost;
  EXPECT_EQ(ValueAt(cost, RandomPoint(layout.size())), 1);
  CheckDerivatives(cost, layout);
}

}  // namespace
}  // namespace rollgait
