#ifndef ROLLGAIT_CORE_GAIT_MESH_REFINEMENT_H_
#define ROLLGAIT_CORE_GAIT_MESH_REFINEMENT_H_

#include "core/gait/gait_spec.h"
#include "core/transcription/layout.h"
#include "core/validation/report.h"

namespace rollgait {

// The next mesh for a solution that misses its bounds: each interval is cut into as many parts as the order of the
// scheme needs to bring the measure that is worst against its bound within it, and its own share of the gap (at most
// 4). Intervals that are good enough stay as they are, unless refinement has stalled: then every interval of a phase
// with one that is not is cut in two at least. `report` is that of the trajectory, on `mesh`.
Mesh RefineMesh(const Mesh& mesh, const GaitSpec& spec, const Trajectory& trajectory, const AccuracyReport& report,
                bool stalled);

// Every interval cut in two.
Mesh Halved(const Mesh& mesh);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_MESH_REFINEMENT_H_
