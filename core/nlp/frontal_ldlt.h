#ifndef ROLLGAIT_CORE_NLP_FRONTAL_LDLT_H_
#define ROLLGAIT_CORE_NLP_FRONTAL_LDLT_H_

#include <utility>
#include <vector>

#include "core/nlp/front_plan.h"
#include "core/nlp/outer_products.h"
#include "core/nlp/panel_store.h"
#include "core/nlp/problem.h"

namespace rollgait {

// Factors of a sparse symmetric indefinite matrix, P A Pᵀ = L D Lᵀ with pivots of order 1 and 2, by the multifrontal
// method (Duff and Reid, ACM TOMS 9, 1983) in an order that the caller knows: the unknowns come in groups, and a group
// is eliminated in one dense front with threshold pivoting (Bunch and Kaufman). A pivot that no exchange inside its
// front makes large enough is left to the next front, so the order governs the cost and never the stability.
//
// For an optimal control problem the groups are its stages: time and memory grow linearly with their number.
// Results depend on the input alone. Allocates while it is made, and later only if pivots are delayed more than ever
// before. One object a thread.
class FrontalLdlt {
 public:
  struct Inertia {
    int positive = 0, negative = 0;
    // Pivots that could not be found: the matrix is singular to working precision. With more than a few fronts take up
    // (rows depend on each other in every stage, or entries are not numbers) the factorisation ends there, so that its
    // memory stays bounded.
    int zero = 0;
  };

  // Of the matrix that a pattern and outer products make up (FrontPlan). Fastest where the pattern has the entries
  // column by column, in the order of elimination.
  FrontalLdlt(int size, const SparsityPattern& pattern, const std::vector<int>& groups,
              const OuterProducts& products = {});

  // Values in the order of the pattern. A pivot must be at least `threshold` times the entries it divides (0 <
  // threshold <= 0.5): large values are accurate, small ones keep the fronts narrow.
  Inertia Factorise(const double* values, double threshold, const OuterProductValues& products = {});

  // x (size) := A⁻¹ x. Contract: Factorise has been called and found no zero.
  void Solve(double* x);

  // Of the last Factorise: entries of L, and pivots that went to a later front.
  long factor_entries() const { return factor_entries_; }
  int delayed_pivots() const { return delayed_pivots_; }

 private:
  struct Front : PlannedFront {
    explicit Front(PlannedFront planned) : PlannedFront(std::move(planned)) {}
    double* Column(int c) const { return panel + static_cast<size_t>(c) * stride; }
    // Rows: pivots, columns that were delayed, zeros up to the next line of the cache, update.
    int columns = 0, first_update = 0, rows = 0, stride = 0, pivots = 0;
    std::vector<int> unknowns;               // of the columns
    double* panel = nullptr;                 // rows × columns in steps of `stride`; L in the first `pivots` columns
    std::vector<double> diagonal, coupling;  // D; coupling[k] != 0: pivots k and k + 1 belong together
    int block = 0;                           // of blocks_, with the Schur complement: update × update, lower triangle
  };

  void AssignBlocks();
  double* Schur(const Front& front) { return blocks_[front.block].data(); }
  void Assemble(const double* values, const OuterProductValues& products, Front* front);
  void AddProducts(const OuterProductValues& products, Front* front);
  void AddChild(const Front& child, int first_slot, Front* front);
  void AddRuns(const double* column, int first, int end, double* target) const;
  void CopySchur(const Front& child, int first, Front* front);
  void FactorPanel(Front* front, double threshold);
  void UpdateSchur(Front* front);

  std::vector<Front> fronts_;
  std::vector<int> product_rows_, product_values_;  // FrontPlan
  PanelStore panels_;
  std::vector<std::vector<double>> blocks_;  // as many as are in use at once, until the parent has taken them up
  std::vector<int> map_,
      run_ends_;  // of the update of the child in work: rows in its parent, where a run of neighbours ends
  std::vector<int> updated_;
  std::vector<double> scaled_;  // L D of the front in work
  std::vector<double> gathered_;
  Inertia inertia_;
  long factor_entries_ = 0;
  int delayed_pivots_ = 0;
  int most_delayed_ = 0;  // that one front takes up
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_FRONTAL_LDLT_H_
