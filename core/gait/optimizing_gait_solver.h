#ifndef ROLLGAIT_CORE_GAIT_OPTIMIZING_GAIT_SOLVER_H_
#define ROLLGAIT_CORE_GAIT_OPTIMIZING_GAIT_SOLVER_H_

#include "core/gait/gait_solver.h"

namespace rollgait {

// The pipeline: scene → optimal control problem → NLP → trajectory → accuracy report, on finer meshes until accurate.
class OptimizingGaitSolver : public GaitSolver {
 public:
  GaitSolution Solve(const GaitSpec& spec, const SolveControl& control) override;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_OPTIMIZING_GAIT_SOLVER_H_
