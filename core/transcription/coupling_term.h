#ifndef ROLLGAIT_CORE_TRANSCRIPTION_COUPLING_TERM_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_COUPLING_TERM_H_

#include <memory>
#include <vector>

#include "core/math/collocation.h"
#include "core/ocp/problem.h"
#include "core/transcription/layout.h"

namespace rollgait {

// A cost integral that no single interval knows: it couples instants of several intervals, or depends on the durations
// other than through the length of its interval. x is the decision vector (DecisionLayout). Evaluations allocate
// nothing; one object serves one thread.
class CouplingTerm {
 public:
  virtual ~CouplingTerm() = default;

  // Unknowns with a gradient, without the durations (on which every integral depends), ascending.
  const std::vector<int>& unknowns() const { return unknowns_; }
  // (row, column) with row >= column, in the order in which Hessian delivers; entries that occur twice add.
  const Entries& hessian_pattern() const { return hessian_pattern_; }

  virtual double Integral(const double* x) = 0;
  // Adds factor · ∂Integral to the gradient by all unknowns.
  virtual void AddGradient(const double* x, double factor, double* gradient) = 0;
  // Writes factor · ∂²Integral on hessian_pattern().
  virtual void Hessian(const double* x, double factor, double* values) = 0;

 protected:
  void SetUnknowns(std::vector<int> unknowns);
  void AddPair(int a, int b) { hessian_pattern_.emplace_back(a > b ? a : b, a > b ? b : a); }

 private:
  std::vector<int> unknowns_;
  Entries hessian_pattern_;
};

// The coupling term of a cost, or null if the cost has an integrand. Layout and scheme must outlive it.
std::unique_ptr<CouplingTerm> MakeCouplingTerm(const OptimalControlProblem& problem, const CostDescription& cost,
                                               const DecisionLayout& layout, const EliminatedScheme& scheme);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_COUPLING_TERM_H_
