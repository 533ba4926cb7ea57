#ifndef ROLLGAIT_TESTS_CORE_NLP_SUITE_CHAIN_PROGRAM_H_
#define ROLLGAIT_TESTS_CORE_NLP_SUITE_CHAIN_PROGRAM_H_

#include "tests/core/nlp/stored_program.h"

namespace rollgait::suite {

// A discrete-time optimal control problem with random coefficients: states x₀ … x_N of 3, controls u₀ … u_{N−1} of 2,
//   minimise  Σ_k ½ (x_kᵀ x_k + r u_kᵀ u_k) + Σ_k Σ_i c cos(x_ki)
//   subject to  x_{k+1} = A x_k + B u_k + s sin(x_k),  x₀ given (fixed variables),  |u| ≤ 1,  u_kᵀ u_k ≤ 1.5,
//               x_N = final, if it is asked for.
// Unknowns by stages: (x₀, u₀), (x₁, u₁), …, x_N; its elimination groups are the stages.
class ChainProgram : public StoredProgram {
 public:
  struct Kind {
    unsigned seed = 1;
    int stages = 10;
    double cosine = 0;  // c; with more than 1 the objective is not convex
    double sine = 0.1;  // s
    bool has_final = false;
    double final_state = 0;  // of all three
  };
  explicit ChainProgram(const Kind& kind);

  EliminationGroups elimination_groups() const override { return groups_; }
  bool Objective(const double* x, double* value) override;
  bool Gradient(const double* x, double* gradient) override;
  bool Constraints(const double* x, double* g) override;
  bool Jacobian(const double* x, double* values) override;
  bool Hessian(const double* x, double sigma, const double* lambda, double* values) override;

 private:
  static constexpr int kStates = 3, kControls = 2, kStage = kStates + kControls, kRows = kStates + 1;
  void MakePatterns();

  Kind kind_;
  double control_weight_ = 0.1;
  Eigen::Matrix<double, kStates, kStates> a_;
  Eigen::Matrix<double, kStates, kControls> b_;
  EliminationGroups groups_;
};

}  // namespace rollgait::suite

#endif  // ROLLGAIT_TESTS_CORE_NLP_SUITE_CHAIN_PROGRAM_H_
