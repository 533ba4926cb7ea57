#ifndef ROLLGAIT_CORE_NLP_KKT_SYSTEM_H_
#define ROLLGAIT_CORE_NLP_KKT_SYSTEM_H_

#include <vector>

#include "core/nlp/frontal_ldlt.h"
#include "core/nlp/outer_products.h"
#include "core/nlp/symmetric_matrix.h"

namespace rollgait {

// The symmetric linear systems of an interior point method,
//   [ H + diag(p)   Jᵀ      ] [ u ]   [ a ]
//   [ J           −diag(d)  ] [ v ] = [ b ],
// with the patterns and elimination groups of a problem. Variables that are fixed are taken out: their u is 0.
//
// A row r with a slack has d_r > 0. It is eliminated before the others,
//   v_r = (J_r u − b_r) / d_r,  which leaves  H + J_rᵀ J_r / d_r  and  a + J_rᵀ b_r / d_r,
// so that the fronts do not see it; residuals are those of the whole system.
class KktSystem {
 public:
  // fixed (variables()): nonzero where the variable is no unknown. slack_rows: rows whose d is positive in every
  // factorisation. fine_residual: where the refinement of a solution ends (NlpOptions::step_residual).
  KktSystem(const NlpProblem& problem, std::vector<char> fixed, const std::vector<int>& slack_rows,
            double fine_residual);

  // Where the values of H and J go, in the order of the problem's patterns. TakeDerivatives is called when they are
  // there.
  double* hessian() { return values_.data(); }
  double* jacobian() { return values_.data() + jacobian_start_; }
  const double* jacobian() const { return values_.data() + jacobian_start_; }

  void TakeDerivatives();

  enum class Outcome { kRight, kWrongInertia, kSingular };
  // Factors the matrix. kRight: it has as many positive eigenvalues as unknowns and as many negative ones as rows.
  // Contract: dual_diagonal is positive in the slack rows.
  Outcome Factorise(const VectorX& primal_diagonal, const VectorX& dual_diagonal);

  // Solves with iterative refinement. False if the residual stays above 1e-6 of the right-hand side: the factors are
  // not to be trusted.
  bool Solve(const VectorX& a, const VectorX& b, VectorX* u, VectorX* v);

  // After a solution that was too coarse: whether another factorisation may do better. It will be done with a larger
  // threshold; where that is the largest, rows that are very close to their bounds are left to refinement, as they are
  // where the factors had no right inertia.
  bool TryHarder();
  // The next factorisation leaves no row to refinement at first.
  void TrustFactors() { bounds_weights_ = false; }

  // y += Jᵀ v with the present Jacobian, fixed variables included.
  void AddTransposedProduct(const VectorX& v, VectorX* y) const;

  const FrontalLdlt& factors() const { return factors_; }

  // Least size of a pivot, relative to the entries it divides; grows where solutions were too coarse.
  double threshold() const { return threshold_; }
  void set_threshold(double threshold) { threshold_ = threshold; }

 private:
  // A row with a slack; its entries are those of the same term of condensed_terms_.
  struct Condensed {
    explicit Condensed(int slack_row) : row(slack_row) {}
    int row;
    double own = 1;         // d
    double compliance = 1;  // d in the factors
  };

  std::vector<int> Places(const NlpProblem& problem) const;
  OuterProducts CondensedTerms() const;
  SparsityPattern MatrixPattern(const NlpProblem& problem) const;
  std::vector<int> GroupsByPlace(const NlpProblem& problem) const;
  int kept() const { return variables_ + rows_ - static_cast<int>(condensed_.size()); }
  Outcome FactoriseReduced();
  bool BoundWeights();  // from now on; false if that changes nothing
  // The product of the entries of a condensed row and x, by places.
  double Product(size_t condensed, const VectorX& x) const;
  void AddTransposed(size_t condensed, double factor, VectorX* x) const;
  void Multiply(const VectorX& x, VectorX* y) const;
  void SolveReduced(const VectorX& right, VectorX* solution);

  int variables_, rows_;
  const SparsityPattern& jacobian_pattern_;
  int jacobian_start_;
  std::vector<char> fixed_;
  VectorX values_;  // of H and of J
  std::vector<Condensed> condensed_;
  // Where a variable and a row are in the vectors below: first what is factored, by elimination groups, then the
  // condensed rows.
  std::vector<int> place_;
  OuterProducts condensed_terms_;  // unknowns by place, values by entry of the Jacobian
  SymmetricMatrix matrix_;         // what is factored, without the products of the condensed rows
  FrontalLdlt factors_;
  double fine_residual_, threshold_, factored_threshold_ = 0;
  bool bounds_weights_ = false, has_large_weights_ = false;  // of condensed rows
  VectorX weights_;                                          // of condensed rows, in the factors
  VectorX right_, solution_, residual_, correction_;         // by place
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_KKT_SYSTEM_H_
