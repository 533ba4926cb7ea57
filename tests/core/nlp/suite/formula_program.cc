#include "tests/core/nlp/suite/formula_program.h"

#include <cmath>

namespace rollgait::suite {

FormulaProgram::FormulaProgram(const Formula& formula, const std::vector<Interval>& variables,
                               const std::vector<Interval>& rows)
    : formula_(formula),
      y_(VectorX::Zero(1 + static_cast<int>(rows.size()))),
      dual_x_(variables.size()),
      dual_y_(1 + rows.size()) {
  const int n = static_cast<int>(variables.size()), m = static_cast<int>(rows.size());
  lower_ = upper_ = VectorX::Zero(n);
  row_lower_ = row_upper_ = VectorX::Zero(m);
  for (int i = 0; i < n; ++i) {
    lower_(i) = variables[i].lower;
    upper_(i) = variables[i].upper;
    for (int j = 0; j <= i; ++j) hessian_.Add(i, j);
  }
  for (int r = 0; r < m; ++r) {
    row_lower_(r) = rows[r].lower;
    row_upper_(r) = rows[r].upper;
    for (int j = 0; j < n; ++j) jacobian_.Add(r, j);
  }
}

bool FormulaProgram::EvaluateReal(const double* x) {
  formula_.real(x, y_.data());
  return y_.allFinite();
}

void FormulaProgram::EvaluateDual(const double* x, int i, int j) {
  for (int k = 0; k < variables(); ++k) dual_x_[k] = {x[k], k == i ? 1.0 : 0.0, k == j ? 1.0 : 0.0, 0};
  formula_.dual(dual_x_.data(), dual_y_.data());
}

bool FormulaProgram::Objective(const double* x, double* value) {
  const bool finite = EvaluateReal(x);
  *value = y_(0);
  return finite;
}

bool FormulaProgram::Constraints(const double* x, double* g) {
  const bool finite = EvaluateReal(x);
  for (int r = 0; r < constraints(); ++r) g[r] = y_(1 + r);
  return finite;
}

bool FormulaProgram::Gradient(const double* x, double* gradient) {
  bool finite = true;
  for (int i = 0; i < variables(); ++i) {
    EvaluateDual(x, i, i);
    gradient[i] = dual_y_[0].a;
    finite = finite && std::isfinite(gradient[i]);
  }
  return finite;
}

bool FormulaProgram::Jacobian(const double* x, double* values) {
  bool finite = true;
  for (int i = 0; i < variables(); ++i) {
    EvaluateDual(x, i, i);
    for (int r = 0; r < constraints(); ++r) {
      values[r * variables() + i] = dual_y_[1 + r].a;
      finite = finite && std::isfinite(dual_y_[1 + r].a);
    }
  }
  return finite;
}

bool FormulaProgram::Hessian(const double* x, double sigma, const double* lambda, double* values) {
  bool finite = true;
  for (int i = 0, e = 0; i < variables(); ++i) {
    for (int j = 0; j <= i; ++j, ++e) {
      EvaluateDual(x, i, j);
      values[e] = sigma * dual_y_[0].ab;
      for (int r = 0; r < constraints(); ++r) values[e] += lambda[r] * dual_y_[1 + r].ab;
      finite = finite && std::isfinite(values[e]);
    }
  }
  return finite;
}

}  // namespace rollgait::suite
