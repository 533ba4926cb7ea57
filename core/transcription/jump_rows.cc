#include "core/transcription/jump_rows.h"

#include <algorithm>
#include <set>

#include "core/base/check.h"

namespace rollgait {

JumpRows::JumpRows(const OptimalControlProblem& problem, const DecisionLayout& layout, PointWorkspace* workspace)
    : layout_(layout), workspace_(workspace), n_(problem.model.size()) {
  int most = 0;
  for (int p = 0; p < layout.phases(); ++p) {
    if (!layout.jumps(p)) continue;
    Jump jump;
    jump.phase = p;
    jump.constraints = problem.JumpConstraints(p);
    for (const auto& constraint : jump.constraints) jump.rows += constraint->rows();
    jump.row_factor.resize(jump.rows);
    int row = 0;
    for (const auto& constraint : jump.constraints) {
      for (int r = 0; r < constraint->rows(); ++r) jump.row_factor(row++) = 1 / constraint->Size(r);
    }
    const int size = problem.JumpLayout(p).size();
    jump.z = VectorX::Zero(size);
    jump.dense_jacobian = MatrixX::Zero(jump.rows, size);
    jump.dense_hessian = MatrixX::Zero(size, size);
    Link(problem, &jump);
    AddEntries(&jump);
    size_ += jump.rows;
    most = std::max(most, jump.rows);
    jumps_.push_back(std::move(jump));
  }
  lambda_ = VectorX::Zero(most);
  momentum_ = VectorX::Zero(n_);
  context_ = {nullptr, &workspace->tree, &workspace->contacts, &workspace->dual_contacts};
}

void JumpRows::Link(const OptimalControlProblem& problem, Jump* jump) const {
  const PointLayout z = problem.JumpLayout(jump->phase);
  const int first = layout_.first_interval(jump->phase), node = layout_.node(first);
  const bool wraps = jump->phase == 0;
  const int before = layout_.end_node(wraps ? layout_.intervals() - 1 : first - 1) + n_;
  jump->behind.resize(static_cast<size_t>(z.size()));
  for (int j = 0; j < n_; ++j) {
    const Joint& joint = problem.model.joint(j);
    const bool mirrors = wraps && problem.mirrored;
    const int source = mirrors && joint.mirror_joint >= 0 ? joint.mirror_joint : j;
    const double sign = mirrors ? joint.mirror_sign : 1;
    jump->behind[z.q() + j] = {{node + j, 1}};
    jump->behind[z.a() + j] = {{node + n_ + j, 1}, {before + source, -sign}};
  }
  for (int i = 0; i < z.forces; ++i) {
    jump->behind[z.force() + i] = {{layout_.impulse(jump->phase) + i, problem.impulse_size()}};
  }
}

void JumpRows::AddEntries(Jump* jump) const {
  int first_row = 0;
  std::set<std::pair<int, int>> pairs;
  for (const auto& constraint : jump->constraints) {
    for (const auto& [row, column] : constraint->JacobianPattern()) {
      for (const Share& share : jump->behind[column]) {
        jump->jacobian.push_back({first_row + row, column, share.unknown, share.factor});
      }
    }
    for (const auto& [a, b] : constraint->HessianPattern()) pairs.emplace(std::min(a, b), std::max(a, b));
    first_row += constraint->rows();
  }
  for (const auto& [a, b] : pairs) {
    if (jump->behind[a].empty() || jump->behind[b].empty()) continue;
    // A position, or an impulse: no unknown is behind both unless they are the same.
    ROLLGAIT_CHECK(a < n_ || a >= 3 * n_);
    for (const Share& one : jump->behind[a]) {
      for (const Share& other : jump->behind[b]) {
        jump->hessian.push_back({a, b, std::max(one.unknown, other.unknown), std::min(one.unknown, other.unknown),
                                 one.factor * other.factor});
      }
    }
  }
}

void JumpRows::Bounds(double* lower, double* upper) const {
  for (const Jump& jump : jumps_) {
    int row = 0;
    for (const auto& constraint : jump.constraints) {
      constraint->Bounds(0, lower, upper);
      for (int r = 0; r < constraint->rows(); ++r, ++row) {
        *lower++ *= jump.row_factor(row);
        *upper++ *= jump.row_factor(row);
      }
    }
  }
}

void JumpRows::AddPatterns(int first_row, SparsityPattern* jacobian, SparsityPattern* hessian) const {
  for (const Jump& jump : jumps_) {
    for (const JacobianEntry& e : jump.jacobian) jacobian->Add(first_row + e.row, e.unknown);
    for (const HessianEntry& e : jump.hessian) hessian->Add(e.greater, e.lesser);
    first_row += jump.rows;
  }
}

// Inverse dynamics of the impact are M(q) (v⁺ − v⁻).
void JumpRows::Load(const double* x, Jump* jump, bool second) {
  for (int i = 0; i < jump->z.size(); ++i) {
    double sum = 0;
    for (const Share& share : jump->behind[i]) sum += share.factor * x[share.unknown];
    jump->z(i) = sum;
  }
  const double* z = jump->z.data();
  context_.z = z;
  workspace_->tree.UpdateImpact(z, z + 2 * n_);
  for (auto& contact : workspace_->contacts) {
    contact.Update(workspace_->tree);
    if (second) contact.UpdateSecond();
  }
}

void JumpRows::Values(const double* x, double* g) {
  for (Jump& jump : jumps_) {
    Load(x, &jump, false);
    int row = 0;
    for (const auto& constraint : jump.constraints) {
      constraint->Value(context_, g + row);
      row += constraint->rows();
    }
    for (int r = 0; r < jump.rows; ++r) *g++ *= jump.row_factor(r);
  }
}

double* JumpRows::Jacobian(const double* x, double* values) {
  for (Jump& jump : jumps_) {
    Load(x, &jump, false);
    int row = 0;
    for (const auto& constraint : jump.constraints) {
      constraint->Jacobian(context_, jump.dense_jacobian.middleRows(row, constraint->rows()));
      row += constraint->rows();
    }
    for (const JacobianEntry& e : jump.jacobian) {
      *values++ = jump.dense_jacobian(e.row, e.column) * e.factor * jump.row_factor(e.row);
    }
  }
  return values;
}

double* JumpRows::Hessian(const double* x, const double* lambda, double* values) {
  for (Jump& jump : jumps_) {
    Load(x, &jump, true);
    for (int r = 0; r < jump.rows; ++r) lambda_(r) = *lambda++ * jump.row_factor(r);
    jump.dense_hessian.setZero();
    int row = 0;
    for (const auto& constraint : jump.constraints) {
      constraint->AddHessian(context_, lambda_.data() + row, jump.dense_hessian);
      row += constraint->rows();
    }
    for (const HessianEntry& e : jump.hessian) *values++ = jump.dense_hessian(e.row, e.column) * e.factor;
  }
  return values;
}

RowInfo JumpRows::Describe(const double* x, int row) const {
  for (const Jump& jump : jumps_) {
    for (const auto& constraint : jump.constraints) {
      if (row < constraint->rows()) {
        double time = 0;
        for (int p = 0; p < jump.phase; ++p) time += x[layout_.duration(p)];
        return {"impact, " + constraint->Name(row), constraint->Unit(row) + " s", constraint->Size(row), jump.phase,
                time};
      }
      row -= constraint->rows();
    }
  }
  ROLLGAIT_CHECK(false);
}

double JumpRows::EnergyLoss(const double* x, int phase) {
  for (Jump& jump : jumps_) {
    if (jump.phase != phase) continue;
    Load(x, &jump, false);
    workspace_->tree.InverseDynamics(momentum_.data());
    const Eigen::Map<const VectorX> after(x + layout_.node(layout_.first_interval(phase)) + n_, n_);
    const auto change = jump.z.segment(2 * n_, n_);
    return 0.5 * change.dot(momentum_) - after.dot(momentum_);
  }
  ROLLGAIT_CHECK(false);
}

}  // namespace rollgait
