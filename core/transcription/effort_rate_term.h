#ifndef ROLLGAIT_CORE_TRANSCRIPTION_EFFORT_RATE_TERM_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_EFFORT_RATE_TERM_H_

#include <vector>

#include "core/transcription/coupling_term.h"

namespace rollgait {

// Efforts of two consecutive collocation points, Δt = ratio · T_phase apart; ratio 0: the same instant. The last point of the
// motion is followed by the first one, mirrored in a half cycle.
struct EffortLink {
  std::vector<int> from, to;  // unknown of every actuated joint, before and after
  std::vector<double> sign;   // of the later effort
  int phase = 0;
  double ratio = 0;
};

// All links in the order of time.
std::vector<EffortLink> ConsecutiveEfforts(const OptimalControlProblem& problem, const DecisionLayout& layout,
                                           const VectorX& point_fractions);

// ∫ Σ w_j (dτ_j/dt)² dt of efforts that are linear between points:  Σ_links Σ_j w_j (τ_j' − τ_j)² / Δt.
class EffortRateTerm : public CouplingTerm {
 public:
  EffortRateTerm(const OptimalControlProblem& problem, const EffortRateCost& cost, const DecisionLayout& layout,
                 const EliminatedScheme& scheme);

  double Integral(const double* x) override;
  void AddGradient(const double* x, double factor, double* gradient) override;
  void Hessian(const double* x, double factor, double* values) override;

 private:
  double Difference(const double* x, const EffortLink& link, size_t joint) const {
    return effort_size_ * (link.sign[joint] * x[link.to[joint]] - x[link.from[joint]]);  // N m
  }

  const DecisionLayout& layout_;
  double effort_size_;
  std::vector<double> weights_;
  std::vector<EffortLink> links_;  // ratio > 0
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_EFFORT_RATE_TERM_H_
