// What friction the ground needs.
#ifndef ROLLGAIT_BENCH_VERDICT_AUDIT_FRICTION_H_
#define ROLLGAIT_BENCH_VERDICT_AUDIT_FRICTION_H_

#include <vector>

#include "core/models/scene.h"

namespace rollgait::audit {

// Largest |tangential| over normal force over the contacts, where a normal force below `floor` (N) counts as that much.
// The forces of two contacts on one link may be changed by equal and opposite forces along the line between their
// points, which do not move the body: the change that gives the least ratio counts. Contract: at most two contacts a
// link.
//   contacts  indices into scene.contacts
//   points    m, where the forces act
//   forces    N, on the body, or N s with a floor in N s
double LeastFrictionRatio(const Scene& scene, const std::vector<int>& contacts, const std::vector<Vector3>& points,
                          const std::vector<Vector3>& forces, double floor);

}  // namespace rollgait::audit

#endif  // ROLLGAIT_BENCH_VERDICT_AUDIT_FRICTION_H_
