#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/verdict_audit/dense_dynamics.h"
#include "bench/verdict_audit/friction.h"
#include "bench/verdict_audit/kinematics.h"
#include "bench/verdict_audit/measures.h"

namespace rollgait::audit {
namespace {

// A state as the next cycle begins with it: mirrored where the trajectory is half a cycle, and moved back by the
// displacement.
struct End {
  VectorX q, v;
};
End NextStart(const Model& model, const Trajectory& trajectory) {
  const TrajectoryPhase& last = trajectory.phases.back();
  const VectorX q = last.node_positions.rightCols(1), v = last.node_velocities.rightCols(1);
  End end{q, v};
  for (int i = 0; i < model.size(); ++i) {
    if (trajectory.cycle == Cycle::kHalf) {
      const Joint& joint = model.joint(i);
      end.q[i] = joint.mirror_sign * q[joint.mirror_joint];
      end.v[i] = joint.mirror_sign * v[joint.mirror_joint];
    }
    if (model.joint(i).name == "base_x") end.q[i] -= trajectory.displacement;
  }
  return end;
}

// Before a phase: the end of the one before it.
struct Before {
  End end;
  std::vector<int> contacts;
};

Before BeforePhase(const Scene& scene, const Trajectory& trajectory, size_t p) {
  if (p > 0) {
    const TrajectoryPhase& last = trajectory.phases[p - 1];
    return {{last.node_positions.rightCols(1), last.node_velocities.rightCols(1)}, last.contacts};
  }
  Before before{NextStart(scene.model, trajectory), trajectory.phases.back().contacts};
  if (trajectory.cycle == Cycle::kHalf) {
    for (int& c : before.contacts) c = scene.contacts[static_cast<size_t>(c)].mirror_contact;
  }
  return before;
}

// The impact must be the plastic one of all contacts of the phase, and its impulses must push and lie in the friction
// cone.
void MeasureImpact(const GaitSpec& spec, const TrajectoryPhase& phase, const VectorX& v_before, Measures* measures) {
  const VectorX q = phase.node_positions.col(0), v = phase.node_velocities.col(0);
  const DenseDynamics::Impact impact = DenseDynamics(spec.scene, phase.contacts, spec.gravity).Stop(q, v_before);
  measures->Raise(Criterion::kVelocityDefect, (v - impact.velocity).cwiseAbs().maxCoeff());
  // An impulse compares with a force that lasts for a tenth of a second.
  const double weight = 0.1 * BodyWeight(spec);
  std::vector<Vector3> impulses;
  Vector3 sum = Vector3::Zero();
  for (size_t i = 0; i < phase.contacts.size(); ++i) {
    impulses.push_back(phase.impulses.segment<3>(static_cast<Eigen::Index>(3 * i)));
    measures->Raise(Criterion::kPull, -impulses.back().z() / weight);
    sum += impulses.back();
  }
  const double ratio = LeastFrictionRatio(spec.scene, phase.contacts, impact.points, impulses, kFrictionFloor * weight);
  measures->Raise(Criterion::kFriction, ratio / spec.friction_coefficient - 1);
  const Model& model = spec.scene.model;
  const Vector3 change = Momentum(model, Poses(model, q, v)) - Momentum(model, Poses(model, q, v_before));
  measures->Raise(Criterion::kMomentum, (change - sum).norm() / model.total_mass());
}

}  // namespace

void MeasureJoins(const GaitSpec& spec, const Trajectory& trajectory, Measures* measures) {
  for (size_t p = 0; p < trajectory.phases.size(); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    const Before before = BeforePhase(spec.scene, trajectory, p);
    const std::vector<LinkPose> poses = Poses(spec.scene.model, before.end.q, before.end.v);
    for (const int c : phase.contacts) {
      if (std::find(before.contacts.begin(), before.contacts.end(), c) != before.contacts.end()) continue;
      const LowestPoint lowest = FindLowestPoint(spec.scene.contacts[static_cast<size_t>(c)], poses);
      measures->Raise(Criterion::kApproach, lowest.velocity.z());
    }
    const bool jumps = phase.impulses.size() > 0;
    if (jumps) MeasureImpact(spec, phase, before.end.v, measures);
    const double q_error = (before.end.q - phase.node_positions.col(0)).cwiseAbs().maxCoeff();
    const double v_error = jumps ? 0 : (before.end.v - phase.node_velocities.col(0)).cwiseAbs().maxCoeff();
    measures->Raise(p == 0 ? Criterion::kPeriodicity : Criterion::kPositionDefect, q_error);
    measures->Raise(p == 0 ? Criterion::kPeriodicity : Criterion::kVelocityDefect, v_error);
  }
}

}  // namespace rollgait::audit
