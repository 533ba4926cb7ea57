#ifndef ROLLGAIT_CORE_NLP_PROBLEM_H_
#define ROLLGAIT_CORE_NLP_PROBLEM_H_

#include <vector>

#include "core/base/types.h"

namespace rollgait {

// Row and column of every entry of a sparse matrix, in the order in which values are delivered. Entries that occur
// twice add.
struct SparsityPattern {
  std::vector<int> rows;
  std::vector<int> columns;
  int size() const { return static_cast<int>(rows.size()); }
  void Add(int row, int column) {
    rows.push_back(row);
    columns.push_back(column);
  }
};

// Which group of unknowns and multipliers a variable and a row belong to when the Newton system of the problem is
// factored: smaller groups are eliminated first, each in one dense front. For a problem of stages the cost of
// the factorisation is then linear in their number.
struct EliminationGroups {
  std::vector<int> variables, constraints;  // variables(), constraints(); >= 0
};

//   minimise f(x)  subject to  g_l ≤ g(x) ≤ g_u,  x_l ≤ x ≤ x_u.
// Sizes, bounds and patterns are fixed for the life of the object. Evaluations allocate nothing and return false where
// a value is not finite. ±1e19 and beyond means "no bound".
class NlpProblem {
 public:
  virtual ~NlpProblem() = default;

  virtual int variables() const = 0;
  virtual int constraints() const = 0;
  virtual const VectorX& lower_bounds() const = 0;  // variables()
  virtual const VectorX& upper_bounds() const = 0;
  virtual const VectorX& constraint_lower() const = 0;  // constraints()
  virtual const VectorX& constraint_upper() const = 0;
  virtual const SparsityPattern& jacobian_pattern() const = 0;
  // Lower triangle of the Hessian of the Lagrangian  σ f + λᵀ g.
  virtual const SparsityPattern& hessian_pattern() const = 0;

  // Without a choice of the problem's own: everything in one group.
  virtual EliminationGroups elimination_groups() const {
    return {std::vector<int>(static_cast<size_t>(variables()), 0),
            std::vector<int>(static_cast<size_t>(constraints()), 0)};
  }

  // Natural size of a variable, > 0. A start keeps a distance from its bounds that is relative to this, or to the bound
  // where that is larger; a variable that matters at a hundredth of 1 has a smaller one than 1.
  virtual double variable_size(int) const { return 1; }

  virtual bool Objective(const double* x, double* value) = 0;
  virtual bool Gradient(const double* x, double* gradient) = 0;
  virtual bool Constraints(const double* x, double* g) = 0;
  virtual bool Jacobian(const double* x, double* values) = 0;
  virtual bool Hessian(const double* x, double sigma, const double* lambda, double* values) = 0;
  // Both at once, which a problem may do for less than the two apart.
  virtual bool Derivatives(const double* x, double sigma, const double* lambda, double* jacobian, double* hessian) {
    return Jacobian(x, jacobian) && Hessian(x, sigma, lambda, hessian);
  }
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_PROBLEM_H_
