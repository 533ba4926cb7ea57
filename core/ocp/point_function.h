#ifndef ROLLGAIT_CORE_OCP_POINT_FUNCTION_H_
#define ROLLGAIT_CORE_OCP_POINT_FUNCTION_H_

#include <string>
#include <utility>
#include <vector>

#include "core/ocp/point.h"

namespace rollgait {

// Positions (row, column) of the entries of a matrix that may differ from zero.
using Entries = std::vector<std::pair<int, int>>;

// Rows  lower ≤ g(z) ≤ upper  at one instant. Every method may be called again and again without allocation; scratch is
// owned by the object, so one object serves one thread.
class PointConstraint {
 public:
  virtual ~PointConstraint() = default;

  virtual int rows() const = 0;
  // For messages, for example "rolling left_foot z", with the unit of the row.
  virtual std::string Name(int row) const = 0;
  virtual std::string Unit(int row) const = 0;
  // Natural size of a row in its unit, by which it is divided in the NLP.
  virtual double Size(int row) const = 0;
  // Bounds at the given fraction (0 … 1) of the phase, rows() each.
  virtual void Bounds(double fraction, double* lower, double* upper) const = 0;
  // Whether the rows have no lower bound at the last point of a phase, which is the first node of the next one.
  virtual bool FreeAtEndOfPhase() const { return false; }

  virtual Entries JacobianPattern() const = 0;
  // Pairs of variables with a second derivative; one of (i, j), (j, i) suffices.
  virtual Entries HessianPattern() const = 0;

  virtual void Value(const PointContext& at, double* g) = 0;
  // Fills the entries of the pattern; jacobian is rows() × z-size.
  virtual void Jacobian(const PointContext& at, Eigen::Ref<MatrixX> jacobian) = 0;
  // Adds Σ λ_r ∇²g_r to blocks (α, β), α ≤ β in the order q, v, a, τ, f; diagonal blocks in full.
  virtual void AddHessian(const PointContext& at, const double* lambda, Eigen::Ref<MatrixX> hessian) = 0;
};

// Of a cost: as it is minimised, or with the corners that are made round for that.
enum class CostForm { kMinimised, kUnsmoothed };

// Integrand of one cost term.
class PointCost {
 public:
  virtual ~PointCost() = default;
  // Order of magnitude of the integrand in walking, to scale the objective.
  virtual double Typical() const = 0;
  virtual Entries HessianPattern() const = 0;
  virtual double Value(const PointContext& at) = 0;
  // With the corners that Value makes round.
  virtual double Unsmoothed(const PointContext& at) { return Value(at); }
  virtual void AddGradient(const PointContext& at, double weight, Eigen::Ref<VectorX> gradient) = 0;
  // As PointConstraint::AddHessian.
  virtual void AddHessian(const PointContext& at, double weight, Eigen::Ref<MatrixX> hessian) = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_POINT_FUNCTION_H_
