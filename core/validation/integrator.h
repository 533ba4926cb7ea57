#ifndef ROLLGAIT_CORE_VALIDATION_INTEGRATOR_H_
#define ROLLGAIT_CORE_VALIDATION_INTEGRATOR_H_

#include <array>
#include <functional>

#include "core/base/types.h"

namespace rollgait {

// How an integration ended.
enum class IntegrationStatus {
  kReachedEnd,
  kNotFinite,     // the right-hand side returned a NaN or an infinity that smaller steps did not avoid
  kStepTooSmall,  // the tolerance cannot be met with steps that still change t
  kTooManySteps,
};

// Explicit Runge–Kutta method of order 8 with 12 stages and an error estimate of orders 5 and 3 (DOP853), with steps of
// variable length. Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed. 1993, section II.5
// and appendix. Not thread-safe: one object a thread.
class Dop853 {
 public:
  struct Options {
    double tolerance = 1e-10;  // relative and absolute, > 0
    double first_step = 0;     // s, 0: the whole span
    int max_steps = 10000;     // accepted and rejected together
  };
  // Writes ẋ at (t, x) into `derivative`, which has the size of x.
  using RightSide = std::function<void(double t, const VectorX& x, VectorX* derivative)>;
  // Called at the start and after every accepted step, right after the right-hand side was evaluated there.
  using Observer = std::function<void(double t, const VectorX& x)>;

  // Carries x from t to `end` >= t. On failure x is the last accepted state. The observer may be empty.
  IntegrationStatus Integrate(const RightSide& right_side, double t, double end, const Options& options, VectorX* x,
                              const Observer& observer = {});

  // One step of length h from (t, x) without error control: `next` and an error estimate relative to the tolerance
  // (accurate enough if <= 1). Used by Integrate and by the tests of the order.
  double Step(const RightSide& right_side, double t, const VectorX& x, double h, double tolerance, VectorX* next);

  // Length that the last Integrate would have used next; a good first_step for a similar problem.
  double proposed_step() const { return proposed_step_; }
  // Accepted steps of the last Integrate.
  int accepted_steps() const { return accepted_; }

 private:
  // The first stage is at (t, x) and given; fills the others, `next` and the estimate.
  double StepFromFirstStage(const RightSide& right_side, double t, const VectorX& x, double h, double tolerance,
                            VectorX* next);

  std::array<VectorX, 12> stages_;
  VectorX argument_, next_;
  double proposed_step_ = 0;
  int accepted_ = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_INTEGRATOR_H_
