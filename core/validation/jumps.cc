#include "core/validation/jumps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/base/check.h"
#include "core/contact/contact_dynamics.h"
#include "core/contact/impact.h"

namespace rollgait {
namespace {

Grip GripOf(const ContactSurface& contact) {
  const auto acts = [&contact](int axis) {
    return std::find(contact.directions.begin(), contact.directions.end(), axis) != contact.directions.end();
  };
  if (acts(0) && acts(1)) return Grip::kRolling;
  ROLLGAIT_CHECK(!acts(1));
  return acts(0) ? Grip::kRollingAlong : Grip::kFrictionless;
}

std::vector<TreeContact> ContactsOf(const Scene& scene, const TrajectoryPhase& phase) {
  std::vector<TreeContact> contacts;
  for (int index : phase.contacts) {
    const ContactSurface& surface = scene.contacts[index];
    TreeContact contact;
    contact.name = surface.name;
    contact.link = surface.joint;
    contact.surface = {surface.surface, surface.p_LE, surface.R_LE};
    contact.grip = GripOf(surface);
    contacts.push_back(contact);
  }
  return contacts;
}

}  // namespace

VectorX VelocityBefore(const Model& model, const Trajectory& trajectory, int phase) {
  const TrajectoryPhase& last = phase > 0 ? trajectory.phases[phase - 1] : trajectory.phases.back();
  const VectorX v = last.node_velocities.col(last.node_velocities.cols() - 1);
  if (phase > 0 || trajectory.cycle != Cycle::kHalf) return v;
  VectorX mirrored = v;
  for (int j = 0; j < model.size(); ++j) {
    const Joint& joint = model.joint(j);
    mirrored[j] = joint.mirror_sign * v[joint.mirror_joint < 0 ? j : joint.mirror_joint];
  }
  return mirrored;
}

JumpErrors MeasureJumps(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                        ForceExtremes* impulses) {
  JumpErrors errors;
  BodyDynamics::State before, after;
  for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    if (!Jumps(phase)) continue;
    const VectorX q = phase.node_positions.col(0), v = VelocityBefore(scene.model, trajectory, p);
    ContactDynamics contacts(dynamics, ContactsOf(scene, phase));
    contacts.SetState(q, v, {FrameMotion()});
    std::vector<int> held(phase.contacts.size());
    std::iota(held.begin(), held.end(), 0);
    const Impact impact = ResolveImpact(held, held, &contacts);
    for (int j = 0; j < v.size(); ++j) RaiseTo(std::abs(phase.node_velocities(j, 0) - impact.velocity[j]), &errors.velocity);

    dynamics.ComputeState(q, v, &before);
    dynamics.ComputeState(q, phase.node_velocities.col(0), &after);
    Vector3 missing = dynamics.LinearMomentum(before) - dynamics.LinearMomentum(after);
    for (size_t c = 0; c < phase.contacts.size(); ++c) {
      const Vector3 impulse = phase.impulses.segment<3>(3 * static_cast<int>(c));
      impulses->Add(impulse);
      missing += impulse;
    }
    RaiseTo(missing.norm(), &errors.impulse);
    errors.loss += dynamics.KineticEnergy(before) - dynamics.KineticEnergy(after);
  }
  return errors;
}

}  // namespace rollgait
