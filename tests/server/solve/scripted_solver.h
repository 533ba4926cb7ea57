#ifndef ROLLGAIT_TESTS_SERVER_SOLVE_SCRIPTED_SOLVER_H_
#define ROLLGAIT_TESTS_SERVER_SOLVE_SCRIPTED_SOLVER_H_

#include <functional>
#include <utility>

#include "core/gait/gait_solver.h"

namespace rollgait::server {

// A GaitSolver that does what the test says.
class ScriptedSolver : public GaitSolver {
 public:
  using Script = std::function<GaitSolution(const GaitSpec&, const SolveControl&)>;
  explicit ScriptedSolver(Script script) : script_(std::move(script)) {}
  GaitSolution Solve(const GaitSpec& spec, const SolveControl& control) override { return script_(spec, control); }

 private:
  Script script_;
};

inline GaitSolution EndedWith(Termination termination) {
  GaitSolution solution;
  solution.termination = termination;
  solution.message = "scripted";
  return solution;
}

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SERVER_SOLVE_SCRIPTED_SOLVER_H_
