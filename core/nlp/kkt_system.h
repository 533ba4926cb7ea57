#ifndef ROLLGAIT_CORE_NLP_KKT_SYSTEM_H_
#define ROLLGAIT_CORE_NLP_KKT_SYSTEM_H_

#include <vector>

#include "core/nlp/frontal_ldlt.h"
#include "core/nlp/symmetric_matrix.h"

namespace rollgait {

// The symmetric linear systems of an interior point method,
//   [ H + diag(p)   Jᵀ      ] [ u ]   [ a ]
//   [ J           −diag(d)  ] [ v ] = [ b ],
// with the patterns and elimination groups of a problem. Variables that are fixed are taken out: their u is 0.
class KktSystem {
 public:
  // fixed (variables()): nonzero where the variable is no unknown. fine_residual: where the refinement of a solution
  // ends (NlpOptions::step_residual).
  KktSystem(const NlpProblem& problem, std::vector<char> fixed, double fine_residual);

  // Where the values of H and J go, in the order of the problem's patterns; kept from one factorisation to the next.
  double* hessian() { return values_.data(); }
  double* jacobian() { return values_.data() + jacobian_start_; }
  const double* jacobian() const { return values_.data() + jacobian_start_; }

  enum class Outcome { kRight, kWrongInertia, kSingular };
  // Factors the matrix. kRight: it has as many positive eigenvalues as unknowns and as many negative ones as rows.
  Outcome Factorise(const VectorX& primal_diagonal, const VectorX& dual_diagonal);

  // Solves with iterative refinement. False if the residual stays above 1e-6 of the right-hand side: the factors are
  // not to be trusted.
  bool Solve(const VectorX& a, const VectorX& b, VectorX* u, VectorX* v);

  // y += Jᵀ v with the present Jacobian, fixed variables included.
  void AddTransposedProduct(const VectorX& v, VectorX* y) const;

  const FrontalLdlt& factors() const { return factors_; }

  // Least size of a pivot, relative to the entries it divides; grows where solutions were too coarse.
  double threshold() const { return threshold_; }
  void set_threshold(double threshold) { threshold_ = threshold; }

 private:
  static SparsityPattern MakePattern(const NlpProblem& problem);
  static std::vector<int> MakeGroups(const NlpProblem& problem);

  int variables_, rows_;
  const SparsityPattern& jacobian_pattern_;
  int jacobian_start_, primal_start_, dual_start_;
  std::vector<char> fixed_;
  VectorX values_;                  // of H, of J and of the two diagonals
  SymmetricMatrix matrix_;          // the same without what is fixed
  std::vector<int> fixed_entries_;  // of the matrix, with a fixed variable
  double fine_residual_, threshold_;
  FrontalLdlt factors_;
  VectorX right_, solution_, residual_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_KKT_SYSTEM_H_
