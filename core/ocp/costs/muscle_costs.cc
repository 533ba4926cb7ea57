#include "core/ocp/costs/muscle_costs.h"

#include <cmath>

#include "core/base/check.h"

namespace rollgait {
namespace {

// What muscles of people who walk exert, as a fraction of their strength, and as many joints of a large body that do
// so.
constexpr double kTypicalActivity = 0.2;
constexpr double kBusyJoints = 4;

double MeanWeight(const std::vector<MuscledJoint>& joints) {
  double sum = 0;
  for (const MuscledJoint& joint : joints) sum += joint.weight;
  return sum / static_cast<double>(joints.size());
}

// Torque of the muscles m(τ, q) = τ − p(q).
struct MuscleTorque {
  double value, by_q, by_qq;
};

MuscleTorque TorqueOf(const MuscledJoint& joint, double effort, double position) {
  const ExponentialSpring::Jet passive = joint.passive.At(position);
  return {effort - passive.value, -passive.first, -passive.second};
}

}  // namespace

MuscleEffortCost::MuscleEffortCost(std::vector<MuscledJoint> joints, double exponent, const PointLayout& layout)
    : joints_(std::move(joints)), exponent_(exponent), layout_(layout) {
  ROLLGAIT_CHECK(exponent >= 2);
  ROLLGAIT_CHECK(static_cast<int>(joints_.size()) == layout.efforts);
}
double MuscleEffortCost::Typical() const {
  return kBusyJoints * MeanWeight(joints_) * std::pow(kTypicalActivity, exponent_);
}
Entries MuscleEffortCost::HessianPattern() const {
  Entries entries;
  for (int j = 0; j < layout_.efforts; ++j) {
    const int tau = layout_.tau() + j, q = layout_.q() + joints_[j].coordinate;
    entries.emplace_back(tau, tau);
    entries.emplace_back(q, tau);
    entries.emplace_back(q, q);
  }
  return entries;
}
double MuscleEffortCost::Value(const PointContext& at) {
  double sum = 0;
  for (int j = 0; j < layout_.efforts; ++j) {
    const MuscledJoint& joint = joints_[j];
    const double m = TorqueOf(joint, at.z[layout_.tau() + j], at.z[layout_.q() + joint.coordinate]).value;
    sum += joint.weight * std::pow(std::abs(m) / joint.strength, exponent_);
  }
  return sum;
}
void MuscleEffortCost::AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) {
  for (int j = 0; j < layout_.efforts; ++j) {
    const MuscledJoint& joint = joints_[j];
    const int tau = layout_.tau() + j, q = layout_.q() + joint.coordinate;
    const MuscleTorque m = TorqueOf(joint, at.z[tau], at.z[q]);
    const double slope = weight * joint.weight * exponent_ / joint.strength *
                         std::copysign(std::pow(std::abs(m.value) / joint.strength, exponent_ - 1), m.value);
    gradient(tau) += slope;
    gradient(q) += slope * m.by_q;
  }
}
void MuscleEffortCost::AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) {
  for (int j = 0; j < layout_.efforts; ++j) {
    const MuscledJoint& joint = joints_[j];
    const int tau = layout_.tau() + j, q = layout_.q() + joint.coordinate;
    const MuscleTorque m = TorqueOf(joint, at.z[tau], at.z[q]);
    const double size = std::abs(m.value) / joint.strength, factor = weight * joint.weight * exponent_ / joint.strength;
    const double slope = factor * std::copysign(std::pow(size, exponent_ - 1), m.value);
    const double curvature = factor * (exponent_ - 1) / joint.strength * std::pow(size, exponent_ - 2);
    hessian(tau, tau) += curvature;
    hessian(q, tau) += curvature * m.by_q;
    hessian(q, q) += curvature * m.by_q * m.by_q + slope * m.by_qq;
  }
}

MuscleWorkCost::MuscleWorkCost(std::vector<MuscledJoint> joints, double positive_efficiency, double negative_efficiency,
                               double smoothing, const PointLayout& layout, double typical)
    : joints_(std::move(joints)),
      price_(1 / positive_efficiency, 1 / negative_efficiency, smoothing),
      layout_(layout),
      typical_(typical) {
  ROLLGAIT_CHECK(static_cast<int>(joints_.size()) == layout.efforts);
}
Entries MuscleWorkCost::HessianPattern() const {
  Entries entries;
  for (int j = 0; j < layout_.efforts; ++j) {
    const int tau = layout_.tau() + j, q = layout_.q() + joints_[j].coordinate, v = layout_.v() + joints_[j].coordinate;
    for (int first : {q, v, tau}) {
      for (int second : {q, v, tau}) {
        if (first <= second) entries.emplace_back(first, second);
      }
    }
  }
  return entries;
}
double MuscleWorkCost::Power(int joint, const PointContext& at) const {
  const int coordinate = joints_[joint].coordinate;
  const double m = TorqueOf(joints_[joint], at.z[layout_.tau() + joint], at.z[layout_.q() + coordinate]).value;
  return m * at.z[layout_.v() + coordinate];
}
double MuscleWorkCost::Value(const PointContext& at) {
  double sum = 0;
  for (int j = 0; j < layout_.efforts; ++j) sum += joints_[j].weight * price_.At(Power(j, at)).value;
  return sum;
}
double MuscleWorkCost::Unsmoothed(const PointContext& at) {
  double sum = 0;
  for (int j = 0; j < layout_.efforts; ++j) sum += joints_[j].weight * price_.Unsmoothed(Power(j, at));
  return sum;
}
void MuscleWorkCost::AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) {
  for (int j = 0; j < layout_.efforts; ++j) {
    const MuscledJoint& joint = joints_[j];
    const int tau = layout_.tau() + j, q = layout_.q() + joint.coordinate, v = layout_.v() + joint.coordinate;
    const MuscleTorque m = TorqueOf(joint, at.z[tau], at.z[q]);
    const double slope = weight * joint.weight * price_.At(m.value * at.z[v]).first;
    gradient(tau) += slope * at.z[v];
    gradient(q) += slope * at.z[v] * m.by_q;
    gradient(v) += slope * m.value;
  }
}
void MuscleWorkCost::AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) {
  for (int j = 0; j < layout_.efforts; ++j) {
    const MuscledJoint& joint = joints_[j];
    const int tau = layout_.tau() + j, q = layout_.q() + joint.coordinate, v = layout_.v() + joint.coordinate;
    const MuscleTorque m = TorqueOf(joint, at.z[tau], at.z[q]);
    const double rate = at.z[v];
    const PowerPrice::Jet price = price_.At(m.value * rate);
    const double slope = weight * joint.weight * price.first, curvature = weight * joint.weight * price.second;
    const double by_q = m.by_q * rate;  // ∂P/∂q; ∂P/∂τ = v, ∂P/∂v = m
    hessian(tau, tau) += curvature * rate * rate;
    hessian(v, v) += curvature * m.value * m.value;
    hessian(v, tau) += curvature * m.value * rate + slope;
    hessian(q, q) += curvature * by_q * by_q + slope * m.by_qq * rate;
    hessian(q, tau) += curvature * by_q * rate;
    hessian(q, v) += curvature * by_q * m.value + slope * m.by_q;
  }
}

PassiveLoadCost::PassiveLoadCost(std::vector<MuscledJoint> joints, const PointLayout& layout)
    : joints_(std::move(joints)), layout_(layout) {}
double PassiveLoadCost::Typical() const { return MeanWeight(joints_) * kTypicalActivity * kTypicalActivity; }
Entries PassiveLoadCost::HessianPattern() const {
  Entries entries;
  for (const MuscledJoint& joint : joints_) {
    entries.emplace_back(layout_.q() + joint.coordinate, layout_.q() + joint.coordinate);
  }
  return entries;
}
double PassiveLoadCost::Value(const PointContext& at) {
  double sum = 0;
  for (const MuscledJoint& joint : joints_) {
    const double load = joint.passive.At(at.z[layout_.q() + joint.coordinate]).value / joint.strength;
    sum += joint.weight * load * load;
  }
  return sum;
}
void PassiveLoadCost::AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) {
  for (const MuscledJoint& joint : joints_) {
    const int q = layout_.q() + joint.coordinate;
    const ExponentialSpring::Jet p = joint.passive.At(at.z[q]);
    gradient(q) += 2 * weight * joint.weight * p.value * p.first / (joint.strength * joint.strength);
  }
}
void PassiveLoadCost::AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) {
  for (const MuscledJoint& joint : joints_) {
    const int q = layout_.q() + joint.coordinate;
    const ExponentialSpring::Jet p = joint.passive.At(at.z[q]);
    hessian(q, q) +=
        2 * weight * joint.weight * (p.first * p.first + p.value * p.second) / (joint.strength * joint.strength);
  }
}

SquaredAccelerationCost::SquaredAccelerationCost(VectorX weights, const PointLayout& layout)
    : weights_(std::move(weights)), layout_(layout) {
  ROLLGAIT_CHECK(weights_.size() == layout.n);
}
double SquaredAccelerationCost::Typical() const {
  // A leg that swings reaches 30 rad/s².
  return 1000 * kBusyJoints * weights_.mean();
}
Entries SquaredAccelerationCost::HessianPattern() const {
  Entries entries;
  for (int j = 0; j < layout_.n; ++j) {
    if (weights_(j) > 0) entries.emplace_back(layout_.a() + j, layout_.a() + j);
  }
  return entries;
}
double SquaredAccelerationCost::Value(const PointContext& at) {
  return Eigen::Map<const VectorX>(at.z + layout_.a(), layout_.n).cwiseAbs2().dot(weights_);
}
void SquaredAccelerationCost::AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) {
  for (int j = 0; j < layout_.n; ++j) gradient(layout_.a() + j) += 2 * weight * weights_(j) * at.z[layout_.a() + j];
}
void SquaredAccelerationCost::AddHessian(const PointContext&, double weight, Eigen::Ref<MatrixX> hessian) {
  for (int j = 0; j < layout_.n; ++j) hessian(layout_.a() + j, layout_.a() + j) += 2 * weight * weights_(j);
}

namespace cost {

CostIntegral Make(const MuscleEffort& term, const CostContext& context) {
  return std::make_unique<MuscleEffortCost>(context.muscles(term.joint_weights), term.exponent.value(), context.layout);
}

CostIntegral Make(const MuscleWork& term, const CostContext& context) {
  return std::make_unique<MuscleWorkCost>(context.muscles(term.joint_weights), term.positive_efficiency.value(),
                                          term.negative_efficiency.value(), term.smoothing.value(), context.layout,
                                          context.TypicalPower());
}

CostIntegral Make(const PassiveLoad& term, const CostContext& context) {
  return std::make_unique<PassiveLoadCost>(context.muscles(term.joint_weights), context.layout);
}

CostIntegral Make(const SquaredAcceleration& term, const CostContext& context) {
  return std::make_unique<SquaredAccelerationCost>(context.WeightsOfAll(term.joint_weights), context.layout);
}

}  // namespace cost
}  // namespace rollgait
