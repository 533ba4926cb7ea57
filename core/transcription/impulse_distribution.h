#ifndef ROLLGAIT_CORE_TRANSCRIPTION_IMPULSE_DISTRIBUTION_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_IMPULSE_DISTRIBUTION_H_

#include "core/ocp/problem.h"

namespace rollgait {

// Where contacts of one rigid link are hit together, the velocities do not depend on the impulse along the line that
// joins two of them. Replaces the impulses at the start of `phase`, 3 for each active contact, N s, by those with the
// same net wrench on each link that are in the friction cones and have the least norm (AdmissibleForces). `position`:
// the positions of the joints at the impact.
void TakeLeastImpulses(const OptimalControlProblem& problem, int phase, const VectorX& position, VectorX* impulses);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_IMPULSE_DISTRIBUTION_H_
