#ifndef ROLLGAIT_CORE_GAIT_WALKING_SEARCH_H_
#define ROLLGAIT_CORE_GAIT_WALKING_SEARCH_H_

#include <optional>
#include <vector>

#include "core/gait/mesh_sequence.h"

namespace rollgait {

// The cheapest of what the first mesh finds from the spec's number of guesses (WalkingGuess), then refined. Its note
// says how many were found and which it is; its meshes list every program.
GaitSolution SolveFromStarts(const GaitSpec& spec, const OptimalControlProblem& problem, SolveBudget* budget);

// Walks from level ground to the slope of the spec, 5° at a time, each solution the guess of the next; steps are halved
// where one does not converge, three times at most. Says so in the note. Nothing if level ground or the slope is not
// reached. Every program is added to `meshes`, whatever comes of it; those of the solution are the last one's.
std::optional<GaitSolution> SolveByContinuation(const GaitSpec& spec, SolveBudget* budget,
                                                std::vector<MeshStatistics>* meshes);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_WALKING_SEARCH_H_
