#include "core/ocp/constraints/separation.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/base/check.h"

namespace rollgait {
namespace {

std::vector<int> PathOf(const Model& model, int joint) {
  std::vector<int> path;
  for (int j = joint; j >= 0; j = model.parent(j)) path.push_back(j);
  std::reverse(path.begin(), path.end());
  return path;
}

FrameMotion LinkPose(const TreeDynamics& tree, int joint) {
  FrameMotion frame;
  frame.R_WB = tree.rotation(joint);
  frame.p_WB = tree.origin(joint);
  return frame;
}

// Velocity of the link's origin when a joint with this axis moves at unit rate.
Vector3 OriginVelocity(const Vector6& axis, const FrameMotion& frame) {
  return axis.tail<3>() + axis.head<3>().cross(frame.p_WB);
}

}  // namespace

SeparationConstraint::SeparationConstraint(const Model& model, const BodySurface& first, const BodySurface& second,
                                           const PointLayout& layout, double clearance)
    : first_(first), second_(second), layout_(layout), clearance_(clearance) {
  ROLLGAIT_CHECK(first.joint != second.joint);
  const std::vector<int> one = PathOf(model, first.joint), two = PathOf(model, second.joint);
  size_t common = 0;
  while (common < std::min(one.size(), two.size()) && one[common] == two[common]) ++common;
  for (size_t k = common; k < one.size(); ++k) movers_.push_back({one[k], false});
  for (size_t k = common; k < two.size(); ++k) movers_.push_back({two[k], true});
  expanded_at_.resize(layout.n);
  changes_.resize(movers_.size());
}

void SeparationConstraint::Bounds(double, double* lower, double* upper) const {
  *lower = clearance_;
  *upper = kInfinity;
}

Entries SeparationConstraint::JacobianPattern() const {
  Entries entries;
  for (const Mover& mover : movers_) entries.emplace_back(0, layout_.q() + mover.joint);
  return entries;
}

Entries SeparationConstraint::HessianPattern() const {
  Entries entries;
  for (const Mover& a : movers_) {
    for (const Mover& b : movers_) entries.emplace_back(layout_.q() + a.joint, layout_.q() + b.joint);
  }
  return entries;
}

Separation SeparationConstraint::Measure(const TreeDynamics& tree) {
  frame_1_ = LinkPose(tree, first_.joint);
  frame_2_ = LinkPose(tree, second_.joint);
  const PosedSurface body_1 = Pose(first_.placed, frame_1_), body_2 = Pose(second_.placed, frame_2_);
  // With a start, an overlap is followed from there alone and not from the twelve axes as well.
  Vector3 start = body_2.p_WE - body_1.p_WE;
  if (start.isZero(0)) start = Vector3::UnitZ();
  return FindSeparation(body_1, body_2, &start);
}

void SeparationConstraint::Expand(const PointContext& at) {
  const Eigen::Map<const VectorX> q(at.z + layout_.q(), layout_.n);
  if (expansion_ && q == expanded_at_) return;
  expanded_at_ = q;
  separation_ = Measure(*at.tree);
  expansion_.emplace(first_.placed, frame_1_, second_.placed, frame_2_, separation_, 2);
  for (size_t k = 0; k < movers_.size(); ++k) {
    const Vector6& axis = at.tree->axis(movers_[k].joint);
    Vector12 twist = Vector12::Zero();
    const int body = movers_[k].moves_second ? 6 : 0;
    twist.segment<3>(body) = OriginVelocity(axis, movers_[k].moves_second ? frame_2_ : frame_1_);
    twist.segment<3>(body + 3) = axis.head<3>();
    expansion_->First(twist, &changes_[k]);
  }
}

void SeparationConstraint::Value(const PointContext& at, double* g) { *g = Measure(*at.tree).distance; }

void SeparationConstraint::Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) {
  Expand(at);
  for (size_t k = 0; k < movers_.size(); ++k) jacobian(0, layout_.q() + movers_[k].joint) = changes_[k].gap;
}

void SeparationConstraint::AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) {
  Expand(at);
  for (size_t k = 0; k < movers_.size(); ++k) {
    for (size_t m = 0; m <= k; ++m) {
      double second = expansion_->Second(changes_[m], changes_[k]).gap;
      if (movers_[m].moves_second == movers_[k].moves_second) {
        // Joint m carries joint k: the twist of k turns with m. The distance changes by the velocity of the contact
        // point along ν, away from it for the first body.
        const bool of_second = movers_[k].moves_second;
        const Vector3 omega = at.tree->axis(movers_[m].joint).head<3>();
        const Variation<double>& carried = of_second ? changes_[k].two : changes_[k].one;
        const Vector3 turned = 0.5 * omega.cross(carried.omega);
        const Vector3 lever = of_second ? frame_2_.R_WB * second_.placed.p_BE + separation_.r_2
                                        : frame_1_.R_WB * first_.placed.p_BE + separation_.r_1;
        second += (of_second ? 1 : -1) * separation_.nu.dot(omega.cross(carried.v) + turned.cross(lever));
      }
      const int row = layout_.q() + movers_[m].joint, column = layout_.q() + movers_[k].joint;
      hessian(row, column) += *lambda * second;
      if (m != k) hessian(column, row) += *lambda * second;
    }
  }
}

}  // namespace rollgait
