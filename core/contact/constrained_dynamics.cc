#include "core/contact/constrained_dynamics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/base/check.h"
#include "core/math/dense_solve.h"
#include "core/math/subtract_products.h"

namespace rollgait {
namespace {

// Columns of A are scaled to unit norm, so a remainder this small is what rounding leaves of a dependent column.
constexpr double kRankTolerance = 1e-10;
// Forces of dependent rows that cancel up to this share of their size move the tree alike: bodies that slide side by
// side turn a little in trial steps. Forces that really differ are of order 1.
constexpr double kSameMotion = 1e-3;

// The next multiple of four: vectors are filled with zeros up to it, so that loops over them have no remainder.
int RoundUp(int length) { return (length + 3) & ~3; }

using Four = Eigen::Map<Eigen::Array<double, 4, 1>>;
using ConstFour = Eigen::Map<const Eigen::Array<double, 4, 1>>;

// xᵀ y and y −= d x for filled vectors.
double Dot(const double* x, const double* y, int n) {
  Eigen::Array<double, 4, 1> sum = ConstFour(x) * ConstFour(y);
  for (int i = 4; i < n; i += 4) sum += ConstFour(x + i) * ConstFour(y + i);
  return sum.sum();
}
void Subtract(double d, const double* x, double* y, int n) {
  for (int i = 0; i < n; i += 4) Four(y + i) -= d * ConstFour(x + i);
}

}  // namespace

void ConstrainedSolver::Factorise() {
  const int n = static_cast<int>(a_.rows()), m = static_cast<int>(a_.cols());
  q_.resize(n, m);
  r_.setZero(m, m);
  pivots_.resize(m);
  for (int j = 0; j < m; ++j) pivots_[j] = j;
  rank_ = 0;
  for (int k = 0; k < m && k < n; ++k) {
    // Columns k … m−1 of a_ (in pivot order) hold what is left of them orthogonal to q_0 … q_{k−1}.
    int best = k;
    double best_square = -1;
    for (int j = k; j < m; ++j) {
      const double* const left = a_.col(pivots_[j]).data();
      const double square = Dot(left, left, n);
      if (square > best_square) best = j, best_square = square;
    }
    if (!(best_square > kRankTolerance * kRankTolerance)) return;
    std::swap(pivots_[k], pivots_[best]);
    if (best != k) r_.col(k).swap(r_.col(best));
    // A second pass makes q_k orthogonal to rounding level ("twice is enough").
    double* const q = q_.col(k).data();
    q_.col(k) = a_.col(pivots_[k]);
    for (int i = 0; i < k; ++i) {
      const double* const before = q_.col(i).data();
      const double d = Dot(before, q, n);
      r_(i, k) += d;
      Subtract(d, before, q, n);
    }
    const double norm = std::sqrt(Dot(q, q, n));
    if (!(norm > kRankTolerance)) return;
    q_.col(k) *= 1 / norm;
    r_(k, k) = norm;
    rank_ = k + 1;
    for (int j = k + 1; j < m; ++j) {
      double* const left = a_.col(pivots_[j]).data();
      const double d = Dot(q, left, n);
      r_(k, j) = d;
      Subtract(d, q, left, n);
    }
  }
}

void ConstrainedSolver::FactoriseMass(const MatrixX& mass) {
  if (!tree_ && factor_.size() != mass.rows()) factor_ = TreeFactor::Dense(static_cast<int>(mass.rows()));
  factor_.Factorise(mass);
}

void ConstrainedSolver::Solve(const MatrixX& mass, const VectorX& force, const MatrixX& jacobian,
                              const VectorX& right_side, ConstrainedSolution* solution) {
  const int n = static_cast<int>(mass.rows()), m = static_cast<int>(jacobian.rows());
  ROLLGAIT_CHECK(jacobian.cols() == n && force.size() == n && right_side.size() == m);
  FactoriseMass(mass);
  // In y = L a:  y = L⁻ᵀ f + A λ  with A = L⁻ᵀ Jᵀ, and the constraint is  Aᵀ y = r.
  const int width = RoundUp(m + 1);
  columns_.setZero(n, width);
  columns_.leftCols(m) = jacobian.transpose();
  columns_.col(m) = force;
  factor_.SolveTransposed(columns_.data(), width, width);
  free_.setZero(RoundUp(n));
  free_.head(n) = columns_.col(m);
  solution->rank = 0;
  solution->independence = 1;
  solution->determined = true;
  solution->redundant = false;
  solution->residual = 0;
  solution->forces.resize(m);
  if (m == 0) {
    pivots_.clear();
    rank_ = 0;
    q_.resize(n, 0);
    solution->acceleration = free_.head(n);
    factor_.Solve(solution->acceleration.data(), 1, 1);
    return;
  }
  a_.setZero(RoundUp(n), m);
  a_.topRows(n) = columns_.leftCols(m);
  right_.resize(m);
  scale_.resize(m);
  for (int j = 0; j < m; ++j) {
    const double* const column = a_.col(j).data();
    const double norm = std::sqrt(Dot(column, column, RoundUp(n)));
    scale_[j] = norm > 0 ? 1 / norm : 1.0;
    right_[j] = (right_side[j] - Dot(column, free_.data(), RoundUp(n))) * scale_[j];
    a_.col(j) *= scale_[j];
  }
  Factorise();

  // A P = Q R. With y = L⁻ᵀ f + Q z:  Rᵀ z = right side, of which the first `rank` rows decide.
  z_.resize(rank_);
  for (int i = 0; i < rank_; ++i) {
    double sum = right_[pivots_[i]];
    for (int k = 0; k < i; ++k) sum -= r_(k, i) * z_[k];
    z_[i] = sum / r_(i, i);
  }
  for (int i = 0; i < rank_; ++i) Subtract(-z_[i], q_.col(i).data(), free_.data(), RoundUp(n));
  solution->acceleration = free_.head(n);
  factor_.Solve(solution->acceleration.data(), 1, 1);

  // Forces: R λ = z, square if no row is redundant, else its solution of least norm λ = Rᵀ (R Rᵀ)⁻¹ z.
  forces_.setZero(m);
  if (rank_ < m && rank_ > 0) {
    gram_.noalias() = r_.topRows(rank_) * r_.topRows(rank_).transpose();
    least_norm_.compute(gram_);
    least_norm_.solveInPlace(z_);
    forces_.noalias() = r_.topRows(rank_).transpose() * z_;
  } else if (rank_ == m) {
    for (int i = m - 1; i >= 0; --i) {
      double sum = z_[i];
      for (int k = i + 1; k < m; ++k) sum -= r_(i, k) * forces_[k];
      forces_[i] = sum / r_(i, i);
    }
  }
  for (int i = 0; i < m; ++i) solution->forces[pivots_[i]] = forces_[i] * scale_[pivots_[i]];
  solution->rank = rank_;
  solution->redundant = rank_ < m;
  for (int i = 0; i < rank_; ++i) solution->independence = std::min(solution->independence, r_(i, i));
  for (int i = 0; i < m; ++i) {
    const double residual = std::abs(jacobian.row(i).dot(solution->acceleration) - right_side[i]);
    if (!(residual <= solution->residual)) solution->residual = residual;
  }
}

void ConstrainedSolver::SolveSliding(const MatrixX& mass, const VectorX& force, const MatrixX& jacobian,
                                     const MatrixX& force_jacobian, const VectorX& right_side,
                                     ConstrainedSolution* solution) {
  const int m = static_cast<int>(jacobian.rows());
  ROLLGAIT_CHECK(m > 0 && force_jacobian.rows() == m && right_side.size() == m);
  FactoriseMass(mass);
  const int width = RoundUp(2 * m + 1);
  columns_.setZero(mass.rows(), width);
  columns_.leftCols(m) = jacobian.transpose();
  columns_.middleCols(m, m) = force_jacobian.transpose();
  columns_.col(2 * m) = force;
  factor_.SolveTransposed(columns_.data(), width, width);
  a_ = columns_.leftCols(m);
  q_ = columns_.middleCols(m, m);
  free_ = columns_.col(2 * m);
  scale_.resize(m);
  // (D AᵀB D) μ = D (r − Aᵀ L⁻ᵀ f),  λ = D μ,  with B = L⁻ᵀ Fᵀ and D = 1 / |columns of A|.
  right_ = right_side;
  right_.noalias() -= a_.transpose() * free_;
  for (int j = 0; j < m; ++j) {
    const double scale = 1 / a_.col(j).norm();
    a_.col(j) *= scale;
    q_.col(j) *= scale;
    right_[j] *= scale;
    scale_[j] = scale;
  }
  gram_.noalias() = a_.transpose() * q_;
  solution->determined = (gram_.diagonal().array() > kRankTolerance).all();
  const LeastNormSolution forces = SolveLeastNorm(gram_, right_, kRankTolerance);
  solution->rank = forces.rank;
  solution->redundant = forces.rank < m;
  solution->independence = std::sqrt(forces.least_pivot);  // the matrix is Aᵀ A but for friction
  if (solution->redundant && !((q_ * forces.null_space).norm() <= kSameMotion)) solution->determined = false;
  solution->forces = scale_.cwiseProduct(forces.x);
  solution->acceleration = free_ + q_ * forces.x;
  factor_.Solve(solution->acceleration.data(), 1, 1);
  solution->residual = (jacobian * solution->acceleration - right_side).cwiseAbs().maxCoeff();
  if (!solution->determined) solution->acceleration.setConstant(std::numeric_limits<double>::quiet_NaN());
}

void ConstrainedSolver::Differentiate(RowMajorMatrix* acceleration, RowMajorMatrix* forces) {
  const int n = factor_.size(), m = static_cast<int>(pivots_.size()), k = static_cast<int>(acceleration->cols());
  ROLLGAIT_CHECK(acceleration->rows() == n && forces->rows() == m && forces->cols() == k);
  // As in Solve:  dy = L⁻ᵀ df + Q t,  t = R₁⁻ᵀ dr − Qᵀ L⁻ᵀ df  with R₁ the columns of R that were chosen,  R dλ = t.
  factor_.SolveTransposed(acceleration->data(), k, k);
  chosen_.resize(rank_, k);
  for (int i = 0; i < rank_; ++i) {
    chosen_.row(i) = scale_[pivots_[i]] * forces->row(pivots_[i]);
    SubtractProducts(chosen_.data(), k, r_.col(i).data(), 1, i, k, chosen_.row(i).data());
    chosen_.row(i) *= 1 / r_(i, i);
  }
  for (int i = 0; i < rank_; ++i) {
    SubtractProducts(acceleration->data(), k, q_.col(i).data(), 1, n, k, chosen_.row(i).data());
  }
  chosen_ = -chosen_;
  const int stride = static_cast<int>(q_.rows());
  for (int j = 0; j < n; ++j) {
    SubtractProducts(chosen_.data(), k, q_.data() + j, stride, rank_, k, acceleration->row(j).data());
  }
  factor_.Solve(acceleration->data(), k, k);
  if (rank_ < m) {
    if (rank_ > 0) least_norm_.solveInPlace(chosen_);
    forces->setZero();
    for (int i = 0; i < m; ++i) {
      const int row = pivots_[i];
      SubtractProducts(chosen_.data(), k, r_.col(i).data(), 1, rank_, k, forces->row(row).data());
      forces->row(row) *= scale_[row];
    }
    return;
  }
  for (int i = m - 1; i >= 0; --i) {
    // −λ in chosen_, unscaled.
    SubtractProducts(chosen_.data() + static_cast<ptrdiff_t>(i + 1) * k, k, r_.data() + i + (i + 1) * m, m, m - 1 - i,
                     k, chosen_.row(i).data());
    chosen_.row(i) *= 1 / r_(i, i);
    forces->row(pivots_[i]) = -scale_[pivots_[i]] * chosen_.row(i);
  }
}

ConstrainedDynamics::ConstrainedDynamics(const BodyDynamics& dynamics, std::vector<ContactSurface> surfaces,
                                         Baumgarte baumgarte)
    : dynamics_(dynamics),
      surfaces_(std::move(surfaces)),
      baumgarte_(baumgarte),
      contacts_(surfaces_.size()),
      solver_(dynamics.model().ColumnParents()) {
  int rows = 0;
  for (const ContactSurface& surface : surfaces_) {
    first_row_.push_back(rows);
    rows += static_cast<int>(surface.directions.size());
  }
  jacobian_.setZero(rows, dynamics_.size());
  right_side_.setZero(rows);
}

const ConstrainedSolution& ConstrainedDynamics::Evaluate(const VectorX& q, const VectorX& v, const VectorX& tau,
                                                         const Vector3& gravity) {
  dynamics_.ComputeState(q, v, &state_);
  dynamics_.MassMatrix(state_, &workspace_, &mass_);
  dynamics_.BiasForce(state_, gravity, &workspace_, &bias_);
  force_ = tau - bias_;
  for (size_t k = 0; k < surfaces_.size(); ++k) {
    const ContactSurface& surface = surfaces_[k];
    const RollingContact contact = ComputeRollingContact(surface, state_);
    contacts_[k] = contact;
    RollingJacobian(dynamics_, surface, state_, contact.p_WP, first_row_[k], &jacobian_);
    for (size_t i = 0; i < surface.directions.size(); ++i) {
      const int axis = surface.directions[i];
      const double correction = axis == 2 ? 2 * baumgarte_.damping * baumgarte_.frequency * contact.slip.z() +
                                                baumgarte_.frequency * baumgarte_.frequency * contact.gap
                                          : baumgarte_.slip_rate * contact.slip[axis];
      right_side_[first_row_[k] + static_cast<int>(i)] = -contact.drift[axis] - correction;
    }
  }
  solver_.Solve(mass_, force_, jacobian_, right_side_, &solution_);
  return solution_;
}

Vector3 ConstrainedDynamics::Force(int k) const {
  Vector3 force = Vector3::Zero();
  const ContactSurface& surface = surfaces_[k];
  for (size_t i = 0; i < surface.directions.size(); ++i) {
    force[surface.directions[i]] = solution_.forces[first_row_[k] + static_cast<int>(i)];
  }
  return force;
}

}  // namespace rollgait
