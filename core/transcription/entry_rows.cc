#include "core/transcription/entry_rows.h"

#include <algorithm>

namespace rollgait {
namespace {

// Each pair once, as AddHessian delivers it: in the upper triangle.
Entries UpperTriangle(Entries pairs) {
  for (auto& [a, b] : pairs) {
    if (a > b) std::swap(a, b);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

EntryRows::EntryRows(const OptimalControlProblem& problem, const DecisionLayout& layout, PointWorkspace* workspace)
    : layout_(layout), workspace_(workspace), n_(problem.model.size()) {
  int most = 0;
  for (int p = 0; p < layout.phases(); ++p) {
    for (auto& constraint : problem.EntryConstraints(p)) {
      Entry entry;
      entry.node = layout.node(layout.first_interval(p));
      entry.phase = p;
      entry.jacobian = constraint->JacobianPattern();
      entry.hessian = UpperTriangle(constraint->HessianPattern());
      size_ += constraint->rows();
      most = std::max(most, constraint->rows());
      entry.constraint = std::move(constraint);
      entries_.push_back(std::move(entry));
    }
  }
  z_ = VectorX::Zero(3 * n_);
  lambda_ = VectorX::Zero(most);
  jacobian_ = MatrixX::Zero(most, 3 * n_);
  hessian_ = MatrixX::Zero(3 * n_, 3 * n_);
  context_ = {z_.data(), &workspace->tree, &workspace->contacts, &workspace->dual_contacts};
}

void EntryRows::Bounds(double* lower, double* upper) const {
  for (const Entry& entry : entries_) {
    entry.constraint->Bounds(0, lower, upper);
    for (int r = 0; r < entry.constraint->rows(); ++r) {
      *lower++ /= entry.constraint->Size(r);
      *upper++ /= entry.constraint->Size(r);
    }
  }
}

void EntryRows::AddPatterns(int first_row, SparsityPattern* jacobian, SparsityPattern* hessian) const {
  for (const Entry& entry : entries_) {
    for (const auto& [r, c] : entry.jacobian) jacobian->Add(first_row + r, entry.node + c);
    for (const auto& [a, b] : entry.hessian) hessian->Add(entry.node + b, entry.node + a);
    first_row += entry.constraint->rows();
  }
}

void EntryRows::Load(const double* x, int node, bool second) {
  z_.head(2 * n_) = Eigen::Map<const VectorX>(x + node, 2 * n_);
  workspace_->tree.UpdateKinematics(z_.data(), z_.data() + n_);
  for (auto& contact : workspace_->contacts) {
    contact.Update(workspace_->tree);
    if (second) contact.UpdateSecond();
  }
}

void EntryRows::Values(const double* x, double* g) {
  for (const Entry& entry : entries_) {
    Load(x, entry.node, false);
    entry.constraint->Value(context_, g);
    for (int r = 0; r < entry.constraint->rows(); ++r) *g++ /= entry.constraint->Size(r);
  }
}

double* EntryRows::Jacobian(const double* x, double* values) {
  for (const Entry& entry : entries_) {
    Load(x, entry.node, false);
    entry.constraint->Jacobian(context_, jacobian_.topRows(entry.constraint->rows()));
    for (const auto& [r, c] : entry.jacobian) *values++ = jacobian_(r, c) / entry.constraint->Size(r);
  }
  return values;
}

double* EntryRows::Hessian(const double* x, const double* lambda, double* values) {
  for (const Entry& entry : entries_) {
    Load(x, entry.node, true);
    for (int r = 0; r < entry.constraint->rows(); ++r) lambda_(r) = *lambda++ / entry.constraint->Size(r);
    hessian_.topLeftCorner(2 * n_, 2 * n_).setZero();
    entry.constraint->AddHessian(context_, lambda_.data(), hessian_);
    for (const auto& [a, b] : entry.hessian) *values++ = hessian_(a, b);
  }
  return values;
}

RowInfo EntryRows::Describe(const double* x, int row) const {
  for (const Entry& entry : entries_) {
    const PointConstraint& constraint = *entry.constraint;
    if (row < constraint.rows()) {
      double time = 0;
      for (int p = 0; p < entry.phase; ++p) time += x[layout_.duration(p)];
      return {constraint.Name(row), constraint.Unit(row), constraint.Size(row), entry.phase, time};
    }
    row -= constraint.rows();
  }
  ROLLGAIT_CHECK(false);
}

}  // namespace rollgait
