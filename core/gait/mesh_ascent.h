#ifndef ROLLGAIT_CORE_GAIT_MESH_ASCENT_H_
#define ROLLGAIT_CORE_GAIT_MESH_ASCENT_H_

#include <optional>

#include "core/gait/gait_solver.h"
#include "core/gait/solve_budget.h"
#include "core/ocp/problem.h"

namespace rollgait {

// From afar the iterations grow with the number of intervals, from the solution of a coarser mesh they do not: a fine
// mesh is reached by way of coarser ones. What a finer mesh changes most lies where contacts change, so the meshes on
// the way are one step ahead at the ends of each phase: where the intervals of the last one are halved, those at the
// ends have their final length already.

// The spec with half as many intervals in each phase, as often as it takes to be solved well from afar; motions between
// the nodes are not bounded and nothing is refined. Nothing where the spec has few enough.
std::optional<GaitSpec> CoarseStart(const GaitSpec& spec);

// From a solution on a coarser mesh to the spec, by way of those meshes between its own and the spec's that have more
// intervals than the one and fewer than the other. The meshes list every program from `start` on. Where one does not
// converge, or leads astray: that one's solution, which is not the spec's and says so by its termination.
GaitSolution Ascend(const GaitSpec& spec, const OptimalControlProblem& problem, GaitSolution start,
                    SolveBudget* budget);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_MESH_ASCENT_H_
