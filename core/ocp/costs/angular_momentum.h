#ifndef ROLLGAIT_CORE_OCP_COSTS_ANGULAR_MOMENTUM_H_
#define ROLLGAIT_CORE_OCP_COSTS_ANGULAR_MOMENTUM_H_

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/multibody/tree_dynamics.h"
#include "core/ocp/cost_context.h"
#include "core/ocp/cost_description.h"

namespace rollgait {

// |L|², N² m² s², of the angular momentum L of the whole tree about its centre of mass c.
//
// Between the world and the tree stand six joints without mass, three revolute ones about the axes of the world and
// three prismatic ones along them, held at zero. Their rows of M(q) v are the angular momentum H about the origin of
// the world and the momentum p, the prismatic rows of M itself are m ∂c/∂q, and  L = H − c × p.  Derivatives of M(q) v
// are those of an impact (TreeDynamics::UpdateImpact), and m ∂²c/∂q² is among them. Each point costs the evaluation of
// a second tree. Values are in a test beside those of BodyDynamics. Evaluations allocate nothing.
class SquaredAngularMomentumCost : public PointCost {
 public:
  SquaredAngularMomentumCost(const Model& model, const PointLayout& layout, double typical)
      : layout_(layout), typical_(typical), model_(WithWorldJoints(model)), tree_(model_) {
    const int size = model_.size();
    q_ = change_ = lambda_ = VectorX::Zero(size);
    dq_ = dv_ = da_ = h_qq_ = h_qa_ = h_center_ = unused_ = MatrixX::Zero(size, size);
    by_q_ = by_v_ = MatrixX::Zero(3, layout.n);
  }
  double Typical() const override { return typical_; }
  Entries HessianPattern() const override {
    Entries entries;
    for (int j = 0; j < 2 * layout_.n; ++j) {  // q and v follow each other
      for (int i = 0; i <= j; ++i) entries.emplace_back(i, j);
    }
    return entries;
  }
  double Value(const PointContext& at) override {
    Update(at);
    return momentum_.squaredNorm();
  }
  void AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) override {
    Differentiate(at);
    for (int k = 0; k < layout_.n; ++k) {
      gradient(layout_.q() + k) += 2 * weight * momentum_.dot(by_q_.col(k));
      gradient(layout_.v() + k) += 2 * weight * momentum_.dot(by_v_.col(k));
    }
  }
  void AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) override {
    Differentiate(at);
    // λᵀL with λ = L held: λᵀH − (λ × c)ᵀp, whose other factor is held in turn, and −(p × λ)ᵀc.
    for (MatrixX* sum : {&h_qq_, &h_qa_, &h_center_, &unused_}) sum->setZero();
    Contract(momentum_, -momentum_.cross(center_), &h_qq_, &h_qa_);
    const Vector3 arm = linear_.cross(momentum_);
    Contract(Vector3::Zero(), -arm / mass_, &unused_, &h_center_);
    for (int k = 0; k < layout_.n; ++k) {
      // ∂p/∂q_k × λ and ∂p/∂v_k × λ.
      const Vector3 arm_by_q = Linear(dq_, k).cross(momentum_), arm_by_v = Linear(da_, k).cross(momentum_);
      const Vector3 center_k = Linear(da_, k) / mass_;
      for (int l = 0; l < layout_.n; ++l) {
        const Vector3 center_l = Linear(da_, l) / mass_;
        const double qq = h_qq_(kWorld + l, kWorld + k) + h_center_(kWorld + l, kWorld + k) - center_l.dot(arm_by_q) -
                          center_k.dot(Linear(dq_, l).cross(momentum_));
        const double qv = h_qa_(kWorld + l, kWorld + k) - center_l.dot(arm_by_v);
        hessian(layout_.q() + l, layout_.q() + k) += 2 * weight * (qq + by_q_.col(l).dot(by_q_.col(k)));
        hessian(layout_.q() + l, layout_.v() + k) += 2 * weight * (qv + by_q_.col(l).dot(by_v_.col(k)));
        hessian(layout_.v() + l, layout_.v() + k) += 2 * weight * by_v_.col(l).dot(by_v_.col(k));
      }
    }
  }

 private:
  static constexpr int kWorld = 6;  // joints before those of the tree: three that turn, three that slide

  static Model WithWorldJoints(const Model& model) {
    std::vector<Joint> joints(kWorld);
    for (int i = 0; i < kWorld; ++i) {
      joints[i].name = joints[i].link = "world " + std::to_string(i);
      joints[i].type = i < 3 ? JointType::kRevolute : JointType::kPrismatic;
      joints[i].parent = i - 1;
      joints[i].axis = Vector3::Unit(i % 3);
    }
    for (Joint joint : model.joints()) {
      joint.parent += kWorld;  // the world's, -1, becomes the last of those
      joint.mirror_joint += kWorld;
      joints.push_back(std::move(joint));
    }
    return Model::Create(std::move(joints)).value();
  }
  Vector3 Angular(const MatrixX& rows, int k) const { return rows.col(kWorld + k).head<3>(); }
  Vector3 Linear(const MatrixX& rows, int k) const { return rows.col(kWorld + k).segment<3>(3); }

  void Update(const PointContext& at) {
    q_.tail(layout_.n) = Eigen::Map<const VectorX>(at.z + layout_.q(), layout_.n);
    change_.tail(layout_.n) = Eigen::Map<const VectorX>(at.z + layout_.v(), layout_.n);
    tree_.UpdateImpact(q_.data(), change_.data());
    tree_.InverseDynamics(lambda_.data());
    linear_ = lambda_.segment<3>(3);
    center_.setZero();
    for (int i = kWorld; i < model_.size(); ++i) {
      const Joint& joint = model_.joint(i);
      center_ += joint.mass / mass_ * (tree_.origin(i) + tree_.rotation(i) * joint.center_of_mass);
    }
    momentum_ = lambda_.head<3>() - center_.cross(linear_);
  }
  void Differentiate(const PointContext& at) {
    Update(at);
    tree_.FirstDerivatives(dq_, dv_, da_);
    for (int k = 0; k < layout_.n; ++k) {
      by_q_.col(k) = Angular(dq_, k) - Vector3(Linear(da_, k) / mass_).cross(linear_) - center_.cross(Linear(dq_, k));
      by_v_.col(k) = Angular(da_, k) - center_.cross(Linear(da_, k));
    }
  }
  // Adds the second derivatives by (q, q) and (q, v) of  angularᵀ H + linearᵀ p.
  void Contract(const Vector3& angular, const Vector3& linear, MatrixX* by_qq, MatrixX* by_qv) {
    lambda_.setZero();
    lambda_.head<3>() = angular;
    lambda_.segment<3>(3) = linear;
    tree_.AddContractedHessian(lambda_.data(), *by_qq, unused_, *by_qv, unused_);
  }

  PointLayout layout_;
  double typical_;
  Model model_;
  TreeDynamics tree_;
  double mass_ = model_.total_mass();
  Vector3 momentum_, linear_, center_;  // L, p, c
  VectorX q_, change_, lambda_;
  MatrixX dq_, dv_, da_, h_qq_, h_qa_, h_center_, unused_;
  MatrixX by_q_, by_v_;  // ∂L/∂q, ∂L/∂v
};

namespace cost {

struct SquaredAngularMomentum {};

inline CostIntegral Make(const SquaredAngularMomentum&, const CostContext& context) {
  // People turn about their centre of mass with 0.03 s of the torque of a joint.
  return std::make_unique<SquaredAngularMomentumCost>(context.problem.model, context.layout,
                                                      std::pow(0.03 * context.problem.effort_size(), 2));
}

}  // namespace cost
}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_COSTS_ANGULAR_MOMENTUM_H_
