#ifndef ROLLGAIT_TESTS_CORE_NLP_HS071_H_
#define ROLLGAIT_TESTS_CORE_NLP_HS071_H_

#include <cmath>

#include "tests/core/nlp/stored_program.h"

namespace rollgait {

// Problem 71 of Hock and Schittkowski:  min x₀x₃(x₀+x₁+x₂) + x₂,  x₀x₁x₂x₃ ≥ 25,  Σ x² = 40,  1 ≤ x ≤ 5.
class Hs071 : public StoredProgram {
 public:
  explicit Hs071(double sum_of_squares = 40) {
    lower_ = VectorX::Ones(4);
    upper_ = VectorX::Constant(4, 5);
    row_lower_ = Eigen::Vector2d(25, sum_of_squares);
    row_upper_ = Eigen::Vector2d(kInfinity, sum_of_squares);
    for (int r = 0; r < 2; ++r) {
      for (int c = 0; c < 4; ++c) jacobian_.Add(r, c);
    }
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c <= r; ++c) hessian_.Add(r, c);
    }
  }
  static VectorX Start() { return Eigen::Vector4d(1, 5, 5, 1); }
  bool Objective(const double* x, double* value) override {
    *value = x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2];
    return std::isfinite(*value);
  }
  bool Gradient(const double* x, double* gradient) override {
    gradient[0] = x[3] * (2 * x[0] + x[1] + x[2]);
    gradient[1] = x[0] * x[3];
    gradient[2] = x[0] * x[3] + 1;
    gradient[3] = x[0] * (x[0] + x[1] + x[2]);
    return true;
  }
  bool Constraints(const double* x, double* g) override {
    g[0] = x[0] * x[1] * x[2] * x[3];
    g[1] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3];
    return true;
  }
  bool Jacobian(const double* x, double* values) override {
    const double product = x[0] * x[1] * x[2] * x[3];
    for (int c = 0; c < 4; ++c) {
      values[c] = product / x[c];
      values[4 + c] = 2 * x[c];
    }
    return true;
  }
  bool Hessian(const double* x, double sigma, const double* lambda, double* values) override {
    const double product = x[0] * x[1] * x[2] * x[3];
    const double f[] = {2 * x[3], x[3], 0, x[3], 0, 0, 2 * x[0] + x[1] + x[2], x[0], x[0], 0};
    for (int r = 0, e = 0; r < 4; ++r) {
      for (int c = 0; c <= r; ++c, ++e) {
        values[e] = sigma * f[e] + (r == c ? 2 * lambda[1] : lambda[0] * product / (x[r] * x[c]));
      }
    }
    return true;
  }
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_CORE_NLP_HS071_H_
