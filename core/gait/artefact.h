#ifndef ROLLGAIT_CORE_GAIT_ARTEFACT_H_
#define ROLLGAIT_CORE_GAIT_ARTEFACT_H_

#include "core/gait/gait_solver.h"

namespace rollgait {

// True if the surfaces slip between nodes at a fair part of the speed of the motion, or if half of its work comes from
// nothing: the optimiser has found a motion that exists on its mesh only.
bool IsArtefact(const GaitSpec& spec, const GaitSolution& solution);

// True beyond half the speed: not even a finer mesh, started from there, is likely to find a motion of the body.
bool IsBeyondRefinement(const GaitSpec& spec, const GaitSolution& solution);

// What converged on every mesh is no motion of the body: says so, and where.
void RefuseArtefact(const GaitSpec& spec, GaitSolution* solution);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_ARTEFACT_H_
