#ifndef ROLLGAIT_TESTS_CORE_NLP_SUITE_FORMULA_PROGRAM_H_
#define ROLLGAIT_TESTS_CORE_NLP_SUITE_FORMULA_PROGRAM_H_

#include <vector>

#include "tests/core/nlp/stored_program.h"
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
class FormulaProgram : public StoredProgram {
 public:
  FormulaProgram(const Formula& formula, const std::vector<Interval>& variables, const std::vector<Interval>& rows);

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
  VectorX y_;
  std::vector<HyperDual> dual_x_, dual_y_;
};

}  // namespace rollgait::suite

#endif  // ROLLGAIT_TESTS_CORE_NLP_SUITE_FORMULA_PROGRAM_H_
