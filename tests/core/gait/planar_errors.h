// Planar gaits on one mesh, with estimated errors.
#ifndef ROLLGAIT_TESTS_CORE_GAIT_PLANAR_ERRORS_H_
#define ROLLGAIT_TESTS_CORE_GAIT_PLANAR_ERRORS_H_

#include <numbers>

#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {

inline GaitRequest Planar(double slope_deg, Preset preset, int intervals) {
  GaitRequest request;
  request.body.model = "planar";
  request.slope = slope_deg * std::numbers::pi / 180;
  request.motion.speed = 1.3;
  request.preset = preset;
  request.discretization.single_support_intervals = intervals;
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  request.accuracy.estimate_errors = true;
  return request;
}

inline GaitSolution SolvePlanar(const GaitRequest& request, const SolveControl& control = {}) {
  return OptimizingGaitSolver().Solve(CheckRequest(request).value(), control);
}

inline double Largest(const MotionDifference& difference, MotionQuantity quantity) {
  return difference[static_cast<int>(quantity)].largest;
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_CORE_GAIT_PLANAR_ERRORS_H_
