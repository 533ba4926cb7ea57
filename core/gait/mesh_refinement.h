#ifndef ROLLGAIT_CORE_GAIT_MESH_REFINEMENT_H_
#define ROLLGAIT_CORE_GAIT_MESH_REFINEMENT_H_

#include "core/gait/gait_request.h"
#include "core/transcription/layout.h"

namespace rollgait {

// The next mesh for a solution that slips or leaves the ground between nodes by more than the request allows: each interval is
// cut into as many parts as the order of the scheme needs to bring its own slip, and its own share of the gap, within the
// bounds (at most 4). Intervals that are good enough stay as they are, unless refinement has stalled: then every interval of a
// phase with one that is not is cut in two at least.
Mesh RefineMesh(const Mesh& mesh, const GaitSpec& spec, const Trajectory& trajectory, bool stalled);

// Every interval cut in two.
Mesh Halved(const Mesh& mesh);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_MESH_REFINEMENT_H_
