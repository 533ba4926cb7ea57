#ifndef ROLLGAIT_CORE_GAIT_MESHES_H_
#define ROLLGAIT_CORE_GAIT_MESHES_H_

#include "core/gait/gait_spec.h"
#include "core/transcription/layout.h"

namespace rollgait {

// Of a mesh that a search makes by itself, at most: human29 then takes about 2 GB, half of what a solver is given by
// default, and a solver that runs out of memory would lose the solution that it had. A request may ask for more.
inline constexpr int kMostIntervals = 1000;

// Of all phases.
int TotalIntervals(const Mesh& mesh);

// The mesh that the request asks for.
Mesh RequestedMesh(const GaitSpec& spec);

// The one a trajectory was solved on, but for the rounding of its times.
Mesh MeshOf(const Trajectory& trajectory);

// Contract of what follows: both have the same phases.

// Whether they differ by no more than rounding.
bool IsSameMesh(const Mesh& mesh, const Mesh& other);

// Whether some phase has an interval that is shorter than all of that phase on the other.
bool HasShorterIntervals(const Mesh& mesh, const Mesh& other);

// Whether every phase has as many intervals as on the other, or more.
bool IsAtLeastAsFine(const Mesh& mesh, const Mesh& other);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_MESHES_H_
