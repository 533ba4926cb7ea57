#ifndef ROLLGAIT_CORE_GAIT_MESH_CONTINUATION_H_
#define ROLLGAIT_CORE_GAIT_MESH_CONTINUATION_H_

#include <optional>

#include "core/gait/gait_solver.h"
#include "core/gait/solve_budget.h"
#include "core/ocp/problem.h"

namespace rollgait {

// Continuation in the mesh. In a cold start the iterations grow with the number of intervals, from the solution of a
// coarser mesh they do not, so a fine mesh is solved after coarser ones. What a finer mesh changes most lies where
// contacts change, so intermediate meshes are one step ahead at the ends of each phase: where the intervals of the last
// one are halved, those at the ends have their final length already.

// The spec with half as many intervals in each phase, as often as it takes for a cold start to converge well; motions
// between the nodes are not bounded and nothing is refined. Nothing where the spec has few enough.
std::optional<GaitSpec> CoarseStart(const GaitSpec& spec);

// From a solution on a coarser mesh to the spec, by way of those meshes between its own and the spec's that have more
// intervals than the one and fewer than the other. Where the solution is none from which a finer mesh finds a motion,
// or the spec's mesh does not converge: that solution, which says so by its termination.
GaitSolution SolveFromCoarse(const GaitSpec& spec, const OptimalControlProblem& problem, GaitSolution start,
                             SolveBudget* budget);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_MESH_CONTINUATION_H_
