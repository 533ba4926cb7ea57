#ifndef ROLLGAIT_CORE_NLP_BARRIER_PARAMETER_H_
#define ROLLGAIT_CORE_NLP_BARRIER_PARAMETER_H_

#include <functional>

#include "core/nlp/nlp_options.h"

namespace rollgait {

// The barrier parameter μ of an interior point solve. It falls as in Wächter and Biegler (2006), equation 7: once its
// problem is solved to an error of κ_ε μ, to max(ε/11, min(μ/5, μ^θ_μ)). Fast settings of κ_ε and θ_μ (NlpOptions) may
// take it down before the bounds that matter are found: then every step ends after a short way at a bound that the
// point has come too close to. There it is raised again, and falls by Ipopt's settings from then on, as the monotone
// mode does that Nocedal, Wächter and Waltz (SIAM J. Optim. 19, 2009) go over to where their free mode makes no
// progress.
class BarrierParameter {
 public:
  // What is carried from one iteration to the next.
  struct Memory {
    double mu = 0;           // > 0
    double recent_step = 1;  // mean primal step in [0, 1], recent ones with more weight
    int raised = 0;          // how often it was raised, >= 0
  };

  explicit BarrierParameter(const NlpOptions& options);
  void Restore(const Memory& memory) { memory_ = memory; }
  const Memory& memory() const { return memory_; }

  // The least μ of a solve to `tolerance`: the one at which it ends, but for a solve that ends early.
  static double Least(double tolerance);

  double mu() const { return memory_.mu; }
  double tau() const;  // fraction to the boundary, in [0.99, 1)

  // Lets μ fall as far as the point allows: `error` is the scaled optimality error of the barrier problem of a μ. Once
  // at least where the solve is stuck. True if it fell.
  bool Reduce(bool stuck, const std::function<double(double mu)>& error);
  // Where the settings are faster than Ipopt's, after a step of length `primal_step`, in (0, 1]. True if μ was raised.
  bool RaiseWhereStepsAreShort(double primal_step);

 private:
  double least_, tolerance_, exponent_, raised_;
  Memory memory_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_BARRIER_PARAMETER_H_
