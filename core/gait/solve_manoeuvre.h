#ifndef ROLLGAIT_CORE_GAIT_SOLVE_MANOEUVRE_H_
#define ROLLGAIT_CORE_GAIT_SOLVE_MANOEUVRE_H_

#include "core/gait/mesh_sequence.h"

namespace rollgait {

// The least cost from the start of the manoeuvre to its end. Local minima are many (how often to turn, on which side to
// go round), so it is solved on the requested mesh from several sketches, straight and with detours, and the best is
// carried to finer meshes. A sketch has its own chart of the orientation; a solution at the edge of its chart is
// carried on in another. Contract: spec.manoeuvre is set.
GaitSolution SolveManoeuvre(const GaitSpec& spec, SolveBudget* budget);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_SOLVE_MANOEUVRE_H_
