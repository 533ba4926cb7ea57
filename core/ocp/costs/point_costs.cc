#include "core/ocp/costs/point_costs.h"

#include <algorithm>
#include <cmath>

#include "core/ocp/costs/body_torque.h"

namespace rollgait {

SquaredTorqueCost::SquaredTorqueCost(VectorX weights, const PointLayout& layout, double effort_size)
    : weights_(std::move(weights)), layout_(layout), effort_size_(effort_size) {}
double SquaredTorqueCost::Typical() const {
  // A planar walker's six joints have squares of a twentieth of effort_size² each. The more joints there are, the
  // smaller the torques of most: 0.02 effort_size² for all 23 of a human, measured; in between by the square of the
  // number.
  const double n = static_cast<double>(weights_.size());
  return weights_.sum() / n * std::min(n / 20, 10.8 / (n * n)) * effort_size_ * effort_size_;
}
Entries SquaredTorqueCost::HessianPattern() const {
  Entries entries;
  for (int j = 0; j < layout_.efforts; ++j) entries.emplace_back(layout_.tau() + j, layout_.tau() + j);
  return entries;
}
double SquaredTorqueCost::Value(const PointContext& at) {
  double sum = 0;
  for (int j = 0; j < layout_.efforts; ++j) sum += weights_(j) * at.z[layout_.tau() + j] * at.z[layout_.tau() + j];
  return sum;
}
void SquaredTorqueCost::AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) {
  for (int j = 0; j < layout_.efforts; ++j) {
    gradient(layout_.tau() + j) += 2 * weight * weights_(j) * at.z[layout_.tau() + j];
  }
}
void SquaredTorqueCost::AddHessian(const PointContext&, double weight, Eigen::Ref<MatrixX> hessian) {
  for (int j = 0; j < layout_.efforts; ++j) {
    hessian(layout_.tau() + j, layout_.tau() + j) += 2 * weight * weights_(j);
  }
}

MechanicalWorkCost::MechanicalWorkCost(double smoothing, std::vector<int> actuated, const PointLayout& layout,
                                       double typical)
    : price_(1, 1, smoothing), actuated_(std::move(actuated)), layout_(layout), typical_(typical) {}
Entries MechanicalWorkCost::HessianPattern() const {
  Entries entries;
  for (int j = 0; j < layout_.efforts; ++j) {
    const int tau = layout_.tau() + j, v = layout_.v() + actuated_[j];
    entries.emplace_back(tau, tau);
    entries.emplace_back(v, tau);
    entries.emplace_back(v, v);
  }
  return entries;
}
double MechanicalWorkCost::Value(const PointContext& at) {
  double sum = 0;
  for (int j = 0; j < layout_.efforts; ++j) {
    sum += price_.At(at.z[layout_.tau() + j] * at.z[layout_.v() + actuated_[j]]).value;
  }
  return sum;
}
double MechanicalWorkCost::Unsmoothed(const PointContext& at) {
  double sum = 0;
  for (int j = 0; j < layout_.efforts; ++j) {
    sum += price_.Unsmoothed(at.z[layout_.tau() + j] * at.z[layout_.v() + actuated_[j]]);
  }
  return sum;
}
void MechanicalWorkCost::AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) {
  for (int j = 0; j < layout_.efforts; ++j) {
    const int tau = layout_.tau() + j, v = layout_.v() + actuated_[j];
    const double slope = weight * price_.At(at.z[tau] * at.z[v]).first;
    gradient(tau) += slope * at.z[v];
    gradient(v) += slope * at.z[tau];
  }
}
void MechanicalWorkCost::AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) {
  for (int j = 0; j < layout_.efforts; ++j) {
    const int tau = layout_.tau() + j, v = layout_.v() + actuated_[j];
    const PowerPrice::Jet price = price_.At(at.z[tau] * at.z[v]);
    const double slope = weight * price.first, curvature = weight * price.second;
    hessian(tau, tau) += curvature * at.z[v] * at.z[v];
    hessian(v, v) += curvature * at.z[tau] * at.z[tau];
    hessian(v, tau) += curvature * at.z[v] * at.z[tau] + slope;
  }
}

namespace cost {

CostIntegral Make(const SquaredTorque& term, const CostContext& context) {
  const OptimalControlProblem& problem = context.problem;
  if (context.rolling_body) {
    return std::make_unique<BodyTorqueCost>(problem.model.actuated()[1], context.layout,
                                            std::pow(problem.effort_size(), 2));
  }
  return std::make_unique<SquaredTorqueCost>(context.EffortWeights(term.joint_weights), context.layout,
                                             problem.effort_size());
}

CostIntegral Make(const MechanicalWork& term, const CostContext& context) {
  return std::make_unique<MechanicalWorkCost>(term.smoothing.value(), context.problem.model.actuated(), context.layout,
                                              context.TypicalPower());
}

CostIntegral Make(const Time&, const CostContext&) { return std::make_unique<TimeCost>(); }

}  // namespace cost
}  // namespace rollgait
