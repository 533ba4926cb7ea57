#ifndef ROLLGAIT_CORE_GAIT_NEWEST_SOLUTION_H_
#define ROLLGAIT_CORE_GAIT_NEWEST_SOLUTION_H_

#include <optional>

#include "core/gait/gait_solver.h"
#include "core/gait/similarity.h"

namespace rollgait {

// Takes what a running search has, in SI units and judged by the bounds of the request: solutions of programs that have
// converged, each in place of the one before. Called in the solving thread, between programs; it only reads, so that
// the search is the same with and without one.
class SolutionSink {
 public:
  virtual ~SolutionSink() = default;
  // Its termination, meshes and message are those of the programs so far; it has a trajectory, and errors where they
  // are known.
  virtual void Take(const GaitSolution& solution) = 0;
};

// The solution that a search ends with if it is stopped or its time is up: the newest one of a program that converged,
// to its rough tolerance at least, and is the request's but for the mesh and the smoothing of powers. One with the
// request's smoothing is not replaced by a smoother one, one within the bounds not by one that exceeds them, and one
// whose errors are known not by one without.
class NewestSolution {
 public:
  // `own` is the request in its own units (own_units.h), `request` in SI units. All outlive this; `sink` may be null.
  NewestSolution(const GaitSpec& request, const GaitSpec& own, const Units& units, SolutionSink* sink)
      : request_(request), own_(own), units_(units), sink_(sink) {}

  // `solution` is in own units and belongs to a program of `spec`. What is no solution of the request is left.
  void Offer(const GaitSpec& spec, const GaitSolution& solution, double elapsed);
  // In own units; nothing: no program has converged yet.
  const std::optional<GaitSolution>& solution() const { return solution_; }

 private:
  bool IsOfRequest(const GaitSpec& spec) const;

  const GaitSpec& request_;
  const GaitSpec& own_;
  const Units units_;
  SolutionSink* const sink_;
  std::optional<GaitSolution> solution_;
  int rank_ = 0;
};

// What is left to say of a search that was stopped or whose time was up (`cut`): a solution that is not all that was
// asked for has this termination, and one that did not converge, or whose errors are not known where those of the
// newest one are, gives way to that one. The verdict stays that of the trajectory; powers that are smoother than the
// request's are the first of the constraints that are not met. In SI units.
GaitSolution InSiWhenCut(const GaitSpec& request, const GaitSpec& own, const Units& units, GaitSolution solution,
                         Termination cut, const std::optional<GaitSolution>& newest);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_NEWEST_SOLUTION_H_
