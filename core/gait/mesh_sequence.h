#ifndef ROLLGAIT_CORE_GAIT_MESH_SEQUENCE_H_
#define ROLLGAIT_CORE_GAIT_MESH_SEQUENCE_H_

#include "core/gait/gait_solver.h"
#include "core/gait/judge_solution.h"
#include "core/gait/solve_budget.h"
#include "core/ocp/problem.h"

namespace rollgait {

// Solves the problem of the spec from a guess on `mesh`, and on finer meshes started from its solution until gap and
// slip between the nodes are within the bounds of the request.
GaitSolution SolveOnMeshes(const GaitSpec& spec, const OptimalControlProblem& problem, const MotionGuess& guess,
                           Mesh mesh, SolveBudget* budget);

// The same from the warm start of the spec. The first mesh is that of its trajectory, where gap and slip are bounded
// and it is nowhere coarser than what the request asks for, and has to converge within max_iterations.
GaitSolution SolveFromWarmStart(const GaitSpec& spec, const OptimalControlProblem& problem, int max_iterations,
                                SolveBudget* budget);

// The same where the spec's warm start is the solution of a request that differs a little, such as one with dearer
// rates.
GaitSolution SolveFromNeighbour(const GaitSpec& spec, const OptimalControlProblem& problem, int max_iterations,
                                SolveBudget* budget);

// The same where the spec's warm start consists of the solution of half of the request and its mirror image.
GaitSolution SolveFromImage(const GaitSpec& spec, const OptimalControlProblem& problem, int max_iterations,
                            SolveBudget* budget);

// The same where the spec's warm start is `smoother`, the solution of the same request with smoother powers. With
// bounds the first mesh is refined where the motion of `smoother` misses them.
GaitSolution SolveFromSmoother(const GaitSpec& spec, const OptimalControlProblem& problem, const GaitSolution& smoother,
                               int max_iterations, SolveBudget* budget);

// The start that a solution is for the next program.
WarmStart StartFrom(const GaitSpec& spec, const GaitSolution& solution);

// The same from the solution of a coarser mesh.
GaitSolution SolveFromCoarser(const GaitSpec& spec, const OptimalControlProblem& problem, const WarmStart& coarser,
                              Mesh mesh, SolveBudget* budget);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_MESH_SEQUENCE_H_
