#ifndef ROLLGAIT_CORE_NLP_INTERIOR_POINT_SOLVER_H_
#define ROLLGAIT_CORE_NLP_INTERIOR_POINT_SOLVER_H_

#include <chrono>
#include <optional>

#include "core/nlp/barrier_parameter.h"
#include "core/nlp/interior_point.h"
#include "core/nlp/newton_step.h"
#include "core/nlp/optimality.h"
#include "core/nlp/restoration.h"
#include "core/nlp/step_acceptance.h"

namespace rollgait {

// One solve by SolveWithInteriorPoint. Its line search is in interior_point_line_search.cc.
class InteriorPointSolver {
 public:
  InteriorPointSolver(NlpProblem& problem, const NlpStart& start, const NlpOptions& options,
                      const SolveControl& control, const Resumption& resumption)
      : problem_(problem),
        start_(start),
        options_(options),
        control_(control),
        resumption_(resumption),
        barrier_(problem, options.BoundRelaxation()),
        newton_(barrier_, options),
        parameter_(options),
        begin_(Clock::now()) {}

  InteriorPointResult Run();

 private:
  using Clock = std::chrono::steady_clock;
  using Point = BarrierProblem::Point;
  enum class Search { kStep, kTinyStep, kFailed };

  bool Begin();
  bool Resume(const InteriorPointState& state);
  InteriorPointState State(const Restoration* phase) const;
  // Gives the keeper the state of the present iteration where it wants it. phase: null outside restoration.
  void KeepState(const Restoration* phase);
  bool Linearise();
  Termination Iterate();
  // Why the solve is to end at this iteration whatever its point is; nothing: it goes on.
  std::optional<Termination> Limit() const;
  // Where no step can be found: the restoration phase. Nothing: the solve goes on from a better point.
  std::optional<Termination> Restore();
  // The phase from here, or from a state of it, and what follows from its end.
  std::optional<Termination> RunRestoration(const RestorationState* from);
  void TakeRestored(const Point& restored);
  bool IsNotWorthFinishing();
  bool HasAcceptableError() const;
  void ReduceBarrier(bool stuck);
  Search LineSearch();
  // The whole Newton step for what it does to the optimality conditions, whatever the filter says of it: close to a
  // solution the filter compares roundings (Wächter and Biegler, section 3.3, before the restoration phase).
  bool TryForOptimality();
  // The recentred step, if it is longer in one and not much shorter in the other of primal and dual, and the filter
  // takes it whole.
  bool TryRecentred(double alpha);
  bool Try(double alpha, const VectorX& step);
  bool IsAcceptable(double alpha);
  bool SecondOrderCorrection(double alpha);
  void Accept(double alpha, const NewtonStep& step);
  double Elapsed() const;
  void Report(const Restoration* phase = nullptr) const;
  void Fill(Termination termination, NlpResult* result) const;

  NlpProblem& problem_;
  const NlpStart& start_;
  const NlpOptions& options_;
  const SolveControl& control_;
  const Resumption resumption_;
  BarrierProblem barrier_;
  NewtonSystem newton_;
  BarrierParameter parameter_;
  Clock::time_point begin_;

  Point point_, trial_;
  Multipliers multipliers_;
  NewtonStep step_, corrected_;
  StepAcceptance acceptance_;
  LinePoint from_;
  VectorX gradient_, objective_gradient_, barrier_gradient_, lagrangian_, corrected_c_;
  OptimalityError error_;
  double primal_step_ = 0, dual_step_ = 0, step_norm_ = 0;
  double before_s_ = 0;  // spent before the resumption
  int iteration_ = 0, trials_ = 0, tiny_steps_ = 0;
  bool needs_restoration_ = false, asked_ = false, rough_ = false;
  bool has_restored_ = false;  // the step to the present point is one of restoration
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_INTERIOR_POINT_SOLVER_H_
