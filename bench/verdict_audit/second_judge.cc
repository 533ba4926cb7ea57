#include "bench/verdict_audit/second_judge.h"

#include "bench/verdict_audit/measures.h"

namespace rollgait::audit {

double BodyWeight(const GaitSpec& spec) { return spec.scene.model.total_mass() * spec.gravity.norm(); }

CriterionValues MeasureTrajectory(const GaitSpec& spec, const Trajectory& trajectory) {
  Measures measures;
  MeasurePath(spec, trajectory, &measures);
  MeasureMotion(spec, trajectory, &measures);
  MeasureJoins(spec, trajectory, &measures);
  MeasureBalances(spec, trajectory, &measures);
  return measures.values();
}

}  // namespace rollgait::audit
