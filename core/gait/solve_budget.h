#ifndef ROLLGAIT_CORE_GAIT_SOLVE_BUDGET_H_
#define ROLLGAIT_CORE_GAIT_SOLVE_BUDGET_H_

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "core/gait/gait_solver.h"
#include "core/gait/gait_spec.h"
#include "core/gait/similarity.h"
#include "core/nlp/nlp_options.h"
#include "core/nlp/result.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {

class NewestSolution;

// What all nonlinear programs of one request share: observer and stop flag, the limits on iterations and time, and the
// log of the programs, whose places are their numbers (IterationInfo::mesh). Starts its clock when it is made.
class SolveBudget {
 public:
  // Observers see objectives times `units.objective`, and iterates in seconds: what the specs that are solved count in
  // these units, of the request.
  SolveBudget(const GaitSpec& spec, const SolveControl& control, const Units& units = {});

  // Solves the next program from `start`, as far as the budget goes, which is filled into the options. Record follows.
  NlpResult Run(CollocationNlp& nlp, const NlpStart& start, NlpOptions options);
  // Puts a program that was run at the end of the log.
  void Record(MeshStatistics program) { log_.push_back(std::move(program)); }
  // Every program so far, in the order in which they were run, whatever came of them.
  const std::vector<MeshStatistics>& log() const { return log_; }
  // Says of the programs from `first` on whether they only estimate the errors of a solution.
  void MarkForErrors(size_t first, bool for_errors);
  double elapsed() const;  // s, that of earlier processes included (SolveControl::journal)
  // False once the iterations or the time are used up, or the stop flag is set: what runs then ends at once.
  bool Left() const;
  // Why nothing is left whatever the iterations: the stop flag is set, or the time is up.
  std::optional<Termination> Cut() const;

  // Of a search that failed when nothing was left: that its limit was reached, with what its last program said behind
  // it, since other starts, meshes or ways might have followed. Leaves every other solution as it is.
  void TellLimit(GaitSolution* solution) const;

  // Who is offered the solutions that follow; outlives the budget. Null, as at first: nobody.
  void OfferTo(NewestSolution* newest) { newest_ = newest; }
  // A solution of a program of `spec`, which has converged. Its programs are those of the log.
  void Offer(const GaitSpec& spec, GaitSolution solution) const;

 private:
  // The control of one program, whose objective is this much larger than the request's.
  SolveControl ControlOf(const CollocationNlp& nlp, double scale) const;
  void Show(const IterationInfo& iteration, const CollocationNlp& nlp) const;

  const SolveControl& control_;
  std::chrono::steady_clock::time_point begin_;
  const Units units_;
  const bool shows_iterates_;
  NewestSolution* newest_ = nullptr;
  double max_wall_time_;
  int iterations_left_;
  std::vector<MeshStatistics> log_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_SOLVE_BUDGET_H_
