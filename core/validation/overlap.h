#ifndef ROLLGAIT_CORE_VALIDATION_OVERLAP_H_
#define ROLLGAIT_CORE_VALIDATION_OVERLAP_H_

#include <vector>

#include "core/models/scene.h"
#include "core/multibody/body_dynamics.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/criteria.h"

namespace rollgait {

// How deep the pairs of a scene overlap: max(0, −signed distance), m, at every instant of the polynomials.
struct OverlapFindings {
  Finding worst;                  // `where`: "left_shank / right_heel"
  std::vector<double> intervals;  // m, of all phases in order: the largest depth of any pair within it
  std::vector<double> pairs;      // m, for each of Scene::pairs its largest depth

  // Pairs that overlap by more than `bound`, m.
  std::vector<int> Deeper(double bound) const;
};

// Samples every interval, leaves out pairs whose bodies cannot meet before the next sample, as far as both of them move
// between two samples, and follows the others in time to every local minimum of the plane distance at their scaled
// contact (body_overlap.h), which is negative when they overlap and only then, and differs from the depth by its
// square over a radius. There the depth is measured. Half a cycle stands for both halves: the other is its mirror
// image. Contract: `dynamics` of the scene's model; bodies are ellipsoids.
OverlapFindings MeasureOverlap(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_OVERLAP_H_
