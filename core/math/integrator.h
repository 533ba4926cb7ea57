#ifndef ROLLGAIT_CORE_MATH_INTEGRATOR_H_
#define ROLLGAIT_CORE_MATH_INTEGRATOR_H_

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

// What a component of an error is compared with: absolute + relative · |x|, both >= 0 and not both 0. One number stands
// for both.
struct Tolerance {
  Tolerance(double both) : relative(both), absolute(both) {}  // NOLINT: a number is a tolerance
  Tolerance(double relative_part, double absolute_part) : relative(relative_part), absolute(absolute_part) {}
  double relative, absolute;
};

// Explicit Runge–Kutta method of order 8 with 12 stages, an error estimate of orders 5 and 3 (DOP853) and a continuous
// extension of order 7, with steps of variable length. Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential
// Equations I, 2nd ed. 1993, sections II.5, II.6 and appendix. Not thread-safe: one object a thread.
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

  // The last `count` components are integrals along the motion that nothing depends on: they are carried along, but do
  // not take part in the error control. Default 0.
  void SetQuadratures(int count) { quadratures_ = count; }

  // The same step by step. Start evaluates the derivative at (t, x) and takes first_step, or what is given, as the
  // length to try; Restart does so after the caller has changed x, and keeps the length.
  void Start(const RightSide& right_side, double t, const VectorX& x, double first_step);
  void Restart(const RightSide& right_side, double t, const VectorX& x);
  // One accepted step from (t, x), the state of the last Start, Restart or Advance, not beyond end > t. On failure t
  // and x stay what they were. kReachedEnd: the step was made (t need not be `end`). `attempts` counts accepted and
  // rejected.
  IntegrationStatus Advance(const RightSide& right_side, double end, const Tolerance& tolerance, int max_attempts,
                            double* t, VectorX* x, int* attempts);
  // ẋ at the end of the last step (or at Start).
  const VectorX& derivative() const { return derivative_; }

  // Prepares Interpolate over the last step of Advance: three more evaluations.
  void PrepareInterpolation(const RightSide& right_side);
  // x at a time within that step, of order 7; at both ends the values of the step.
  void Interpolate(double t, VectorX* x) const;
  double step_start() const { return step_start_; }
  double step_end() const { return step_start_ + step_; }

  // One step of length h from (t, x) without error control: `next` and an error estimate relative to the tolerance
  // (accurate enough if <= 1). `next` may not be x.
  double Step(const RightSide& right_side, double t, const VectorX& x, double h, const Tolerance& tolerance,
              VectorX* next);

  // How far two states are apart, quadratures left out: the largest difference over the tolerance.
  double Error(const VectorX& a, const VectorX& b, const Tolerance& tolerance) const;

  // Length that the last Integrate would have used next; a good first_step for a similar problem.
  double proposed_step() const { return proposed_step_; }
  // Accepted steps of the last Integrate.
  int accepted_steps() const { return accepted_; }

 private:
  // The first stage is at (t, x) and given; fills the others, `next` and the estimate.
  double StepFromFirstStage(const RightSide& right_side, double t, const VectorX& x, double h,
                            const Tolerance& tolerance, VectorX* next);

  std::array<VectorX, 12> stages_;
  std::array<VectorX, 3> extra_;  // stages of the continuous extension
  std::array<VectorX, 8> interpolation_;
  VectorX derivative_, argument_, next_;
  VectorX step_from_, step_to_;  // states at the ends of the last step of Advance
  double step_start_ = 0, step_ = 0;
  double proposed_step_ = 0;
  bool rejected_ = false;
  int quadratures_ = 0;
  int accepted_ = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MATH_INTEGRATOR_H_
