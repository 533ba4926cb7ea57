#ifndef ROLLGAIT_TESTS_CORE_NLP_SUITE_FORMULA_PROGRAM_H_
#define ROLLGAIT_TESTS_CORE_NLP_SUITE_FORMULA_PROGRAM_H_

#include <vector>

#include "core/nlp/problem.h"
#include "tests/core/nlp/suite/hyper_dual.h"

namespace rollgait::suite {

struct Interval {
  double lower = 0, upper = 0;
};
inline constexpr double kNone = 1e20;
inline constexpr Interval kFree{-kNone, kNone}, kPositive{0, kNone}, kZero{0, 0};

// Fills y with f(x), g₀(x), g₁(x), …
struct Formula {
  void (*real)(const double* x, double* y);
  void (*dual)(const HyperDual* x, HyperDual* y);
};

// Of a lambda without captures,  [](const auto* x, auto* y) { y[0] = …; y[1] = …; }.
template <typename F>
Formula Written(F) {
  return {[](const double* x, double* y) { F{}(x, y); }, [](const HyperDual* x, HyperDual* y) { F{}(x, y); }};
}

// minimise y₀(x) subject to bounds on x and on y₁ …; its derivatives are those of hyper-dual numbers, its patterns are
// dense.
class FormulaProgram : public NlpProblem {
 public:
  FormulaProgram(const Formula& formula, const std::vector<Interval>& variables, const std::vector<Interval>& rows);

  int variables() const override { return static_cast<int>(lower_.size()); }
  int constraints() const override { return static_cast<int>(row_lower_.size()); }
  const VectorX& lower_bounds() const override { return lower_; }
  const VectorX& upper_bounds() const override { return upper_; }
  const VectorX& constraint_lower() const override { return row_lower_; }
  const VectorX& constraint_upper() const override { return row_upper_; }
  const SparsityPattern& jacobian_pattern() const override { return jacobian_; }
  const SparsityPattern& hessian_pattern() const override { return hessian_; }
  bool Objective(const double* x, double* value) override;
  bool Gradient(const double* x, double* gradient) override;
  bool Constraints(const double* x, double* g) override;
  bool Jacobian(const double* x, double* values) override;
  bool Hessian(const double* x, double sigma, const double* lambda, double* values) override;

 private:
  bool EvaluateReal(const double* x);
  // Along unknowns i and j.
  void EvaluateDual(const double* x, int i, int j);

  Formula formula_;
  VectorX lower_, upper_, row_lower_, row_upper_;
  SparsityPattern jacobian_, hessian_;
  VectorX y_;
  std::vector<HyperDual> dual_x_, dual_y_;
};

}  // namespace rollgait::suite

#endif  // ROLLGAIT_TESTS_CORE_NLP_SUITE_FORMULA_PROGRAM_H_
