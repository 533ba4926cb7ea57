#ifndef ROLLGAIT_CORE_TRANSCRIPTION_RATE_TERM_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_RATE_TERM_H_

#include <utility>
#include <vector>

#include "core/transcription/coupling_term.h"

namespace rollgait {

// What a quantity changes by from one collocation point to the next, Δt = ratio · T_phase later:  Σ coefficient ·
// x[unknown]  in the quantity's unit.
struct Change {
  std::vector<std::pair<int, double>> terms;
  double weight = 1;
  int phase = 0;
  double ratio = 0;  // > 0
};

// ∫ Σ w (dy/dt)² dt of quantities that are linear between points:  Σ w Δy² / Δt.
class RateTerm : public CouplingTerm {
 public:
  RateTerm(const DecisionLayout& layout, std::vector<Change> changes);

  double Integral(const double* x) override;
  void AddGradient(const double* x, double factor, double* gradient) override;
  void Hessian(const double* x, double factor, double* values) override;

 private:
  const DecisionLayout& layout_;
  std::vector<Change> changes_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_RATE_TERM_H_
