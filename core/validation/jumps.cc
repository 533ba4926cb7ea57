#include "core/validation/jumps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/contact/contact_dynamics.h"
#include "core/contact/impact.h"
#include "core/contact/rolling_kinematics.h"

namespace rollgait {
namespace {

const std::string kTouchDown = "touch-down ";

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
  VectorX v = last.node_velocities.col(last.node_velocities.cols() - 1);
  if (phase > 0 || trajectory.cycle != Cycle::kHalf) return v;
  VectorX mirrored = v;
  for (int j = 0; j < model.size(); ++j) {
    const Joint& joint = model.joint(j);
    mirrored[j] = joint.mirror_sign * v[joint.mirror_joint < 0 ? j : joint.mirror_joint];
  }
  return mirrored;
}

JumpErrors MeasureJumps(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory, double friction,
                        ForceExtremes* impulses, FindingLog* log) {
  JumpErrors errors;
  BodyDynamics::State before, after;
  for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    if (!Jumps(phase)) continue;
    const Instant at{p, phase.node_times.front()};
    const VectorX q = phase.node_positions.col(0), v = VelocityBefore(scene.model, trajectory, p);
    ContactDynamics contacts(dynamics, ContactsOf(scene, phase));
    contacts.SetState(q, v, {FrameMotion()});
    std::vector<int> held(phase.contacts.size());
    std::iota(held.begin(), held.end(), 0);
    const Impact impact = ResolveImpact(held, held, &contacts);
    for (int j = 0; j < v.size(); ++j) {
      const double error = std::abs(phase.node_velocities(j, 0) - impact.velocity[j]);
      RaiseTo(error, &errors.velocity);
      log->Raise(Criterion::kVelocityDefect, error, kTouchDown + scene.model.joint(j).name, at);
    }

    dynamics.ComputeState(q, v, &before);
    dynamics.ComputeState(q, phase.node_velocities.col(0), &after);
    Vector3 missing = dynamics.LinearMomentum(before) - dynamics.LinearMomentum(after);
    ForceJudge judge(scene, phase.contacts, {friction, 0}, impulses);
    judge.SetPrefix(kTouchDown);
    std::vector<double> rows(ForceJudge::kRows * phase.contacts.size());
    for (int c = 0; c < judge.contacts(); ++c) {
      const Vector3 impulse = phase.impulses.segment<3>(3 * c);
      const Vector3 point = ComputeRollingContact(scene.contacts[phase.contacts[c]], before).p_WP;
      Eigen::Map<Eigen::Matrix<double, ForceJudge::kRows, 1>>(&rows[ForceJudge::kRows * c]) << impulse, point.head<2>();
      judge.AddNormal(c, impulse.z(), at, log);
      missing += impulse;
    }
    int worst = 0;
    const double ratio = judge.FrictionRatio(rows.data(), &worst);
    if (judge.contacts() > 0) judge.AddRatio(worst, ratio, at, log);
    RaiseTo(missing.norm(), &errors.impulse);
    log->Raise(Criterion::kMomentum, missing.norm() / dynamics.total_mass(), "touch-down", at);
    errors.loss += dynamics.KineticEnergy(before) - dynamics.KineticEnergy(after);
  }
  return errors;
}

JumpErrors MeasureJumps(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                        ForceExtremes* impulses) {
  FindingLog unused(0);
  return MeasureJumps(scene, dynamics, trajectory, kInfinity, impulses, &unused);
}

std::vector<int> TouchDowns(const Scene& scene, const Trajectory& trajectory, int phase) {
  if (phase == 0 && trajectory.cycle == Cycle::kOnce) return {};
  std::vector<int> before = (phase > 0 ? trajectory.phases[phase - 1] : trajectory.phases.back()).contacts;
  if (phase == 0 && trajectory.cycle == Cycle::kHalf) {
    for (int& contact : before) contact = scene.contacts[contact].mirror_contact;
  }
  std::vector<int> result;
  for (int contact : trajectory.phases[phase].contacts) {
    if (std::find(before.begin(), before.end(), contact) == before.end()) result.push_back(contact);
  }
  return result;
}

double MeasureApproach(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                       FindingLog* log) {
  double worst = 0;
  BodyDynamics::State state;
  for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    const std::vector<int> new_contacts = TouchDowns(scene, trajectory, p);
    if (new_contacts.empty()) continue;
    dynamics.ComputeState(phase.node_positions.col(0), VelocityBefore(scene.model, trajectory, p), &state);
    for (int c : new_contacts) {
      const double speed = std::max(ComputeRollingContact(scene.contacts[c], state).slip.z(), 0.0);
      RaiseTo(speed, &worst);
      log->Raise(Criterion::kApproach, speed, kTouchDown + scene.contacts[c].name, {p, phase.node_times.front()});
    }
  }
  return worst;
}

}  // namespace rollgait
