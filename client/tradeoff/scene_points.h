// The points of `rollgait tradeoff --scene`: one scene with several tolerances and drift controls.
#ifndef ROLLGAIT_CLIENT_TRADEOFF_SCENE_POINTS_H_
#define ROLLGAIT_CLIENT_TRADEOFF_SCENE_POINTS_H_

#include <optional>
#include <string>
#include <vector>

#include "rollgait/v1/simulation.pb.h"

namespace rollgait::client {

struct ScenePoint {
  double tolerance;                // of the integrator
  std::optional<double> absolute;  // absolute_tolerance; none: the number of `tolerance`
  v1::DriftControl::Kind drift;
};

// All combinations, the last axis changes fastest: numbers as ParseSweepValues reads them, "projection,none". An empty
// text leaves the scene's own value. Tolerances are in [1e-13, 1e-2], absolute ones in [1e-29, 1e-2], as a reference
// ten times finer must be in the service's range. Throws Failure(kUsage), which names flag, value and limit; also for
// baumgarte if the scene does not state its numbers.
std::vector<ScenePoint> MakeScenePoints(const v1::SimulationScene& scene, const std::string& tolerances,
                                        const std::string& absolutes, const std::string& drifts);

// A tenth of the least tolerances of the points, with the drift control of the first; or another share
// of them.
ScenePoint Finer(const std::vector<ScenePoint>& points, double share = 0.1);

v1::SimulationScene SceneOfPoint(v1::SimulationScene scene, const ScenePoint& point);

// "projection", "baumgarte", "none"; the kind is not unspecified.
std::string DriftWord(v1::DriftControl::Kind drift);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_TRADEOFF_SCENE_POINTS_H_
