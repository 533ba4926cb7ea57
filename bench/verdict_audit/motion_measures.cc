#include "bench/verdict_audit/dense_dynamics.h"
#include "bench/verdict_audit/friction.h"
#include "bench/verdict_audit/measures.h"
#include "bench/verdict_audit/second_judge.h"

namespace rollgait::audit {

void MeasureForces(const GaitSpec& spec, const std::vector<int>& contacts, const std::vector<Vector3>& points,
                   const std::vector<Vector3>& forces, Measures* measures) {
  const double weight = BodyWeight(spec), least = spec.min_normal_force_bw * weight;
  for (const Vector3& force : forces) measures->Raise(Criterion::kPull, (least - force.z()) / weight);
  const double ratio = LeastFrictionRatio(spec.scene, contacts, points, forces, kFrictionFloor * weight);
  measures->Raise(Criterion::kFriction, ratio / spec.friction_coefficient - 1);
}

void MeasureMotion(const GaitSpec& spec, const Trajectory& trajectory, Measures* measures) {
  for (const TrajectoryPhase& phase : trajectory.phases) {
    DenseDynamics dynamics(spec.scene, phase.contacts, spec.gravity);
    for (int k = 0; k + 1 < static_cast<int>(phase.node_times.size()); ++k) {
      const IntervalMotion interval(trajectory, phase, k);
      DenseDynamics::State state{phase.node_positions.col(k), phase.node_velocities.col(k)};
      for (int i = 0; i <= kInstants; ++i) {
        const double theta = static_cast<double>(i) / kInstants;
        const DenseDynamics::Answer answer = dynamics.Evaluate(state.q, state.v, interval.Efforts(theta));
        MeasureForces(spec, phase.contacts, answer.points, answer.forces, measures);
        if (i < kInstants) state = dynamics.Step(state, interval, theta, 1.0 / kInstants, answer);
      }
      measures->Raise(Criterion::kPositionDefect, (state.q - phase.node_positions.col(k + 1)).cwiseAbs().maxCoeff());
      measures->Raise(Criterion::kVelocityDefect, (state.v - phase.node_velocities.col(k + 1)).cwiseAbs().maxCoeff());
    }
  }
}

}  // namespace rollgait::audit
