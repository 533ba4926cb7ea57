#include "core/validation/residuals.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/check.h"
#include "core/contact/rolling_kinematics.h"
#include "core/trajectory/sampling.h"
#include "core/validation/jumps.h"

namespace rollgait {
namespace {

constexpr double kFrictionFloor = 1e-3;  // of the weight

// Gauss–Legendre quadrature on [0, 1] with 4 points, exact to degree 7; power has degree 2s − 1 <= 5.
constexpr int kGaussPoints = 4;
constexpr double kGaussNodes[kGaussPoints] = {0.0694318442029737123880267555535953, 0.330009478207571867598667120448378,
                                              0.669990521792428132401332879551622, 0.930568155797026287611973244446405};
constexpr double kGaussWeights[kGaussPoints] = {0.173927422568726928686531974610999, 0.326072577431273071313468025389001,
                                                0.326072577431273071313468025389001, 0.173927422568726928686531974610999};

int Intervals(const TrajectoryPhase& phase) { return static_cast<int>(phase.node_times.size()) - 1; }

double Slip(const ContactSurface& surface, const RollingContact& contact) {
  double sum = 0;
  for (int axis : surface.directions) sum += contact.slip[axis] * contact.slip[axis];
  return std::sqrt(sum);
}

}  // namespace

void RaiseTo(double value, double* worst) {
  if (!(value <= *worst)) *worst = std::isnan(value) ? kInfinity : value;
}

void ForceExtremes::Add(const Vector3& force) {
  any_ = true;
  if (force.hasNaN()) {
    min_normal_ = -kInfinity;
    max_friction_ratio_ = kInfinity;
    return;
  }
  min_normal_ = std::min(min_normal_, force.z());
  RaiseTo(force.head<2>().norm() / std::max(force.z(), kFrictionFloor * weight_), &max_friction_ratio_);
}

ContactResiduals MeasureContacts(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                                 int samples_per_interval, ForceExtremes* forces) {
  ROLLGAIT_CHECK(samples_per_interval >= 1);
  std::vector<double> fractions = trajectory.point_fractions;
  for (int k = 0; k <= samples_per_interval; ++k) fractions.push_back(static_cast<double>(k) / samples_per_interval);

  ContactResiduals residuals;
  double depth = -kInfinity;  // −gap of inactive contacts
  MotionSample sample;
  BodyDynamics::State state;
  for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
    const std::vector<int>& active = trajectory.phases[p].contacts;
    for (int k = 0; k < Intervals(trajectory.phases[p]); ++k) {
      const IntervalPolynomials interval(trajectory, p, k);
      for (double theta : fractions) {
        interval.Evaluate(theta, &sample);
        dynamics.ComputeState(sample.position, sample.velocity, &state);
        for (int c = 0; c < static_cast<int>(scene.contacts.size()); ++c) {
          const RollingContact contact = ComputeRollingContact(scene.contacts[c], state);
          if (std::find(active.begin(), active.end(), c) == active.end()) {
            RaiseTo(-contact.gap, &depth);
          } else {
            RaiseTo(std::abs(contact.gap), &residuals.max_gap);
            RaiseTo(Slip(scene.contacts[c], contact), &residuals.max_slip);
          }
        }
      }
      // Forces between the points are those of the re-integrated motion; the polynomial through the points says nothing
      // before the first of them.
      for (double theta : trajectory.point_fractions) {
        interval.Evaluate(theta, &sample);
        for (size_t c = 0; c < active.size(); ++c) forces->Add(sample.forces.segment<3>(3 * static_cast<int>(c)));
      }
    }
  }
  residuals.min_swing_clearance = depth == -kInfinity ? 0 : -depth;
  return residuals;
}

EndState PeriodicEnd(const Model& model, const Trajectory& trajectory) {
  const VectorX q = trajectory.phases.front().node_positions.col(0);
  const VectorX v = trajectory.phases.front().node_velocities.col(0);
  EndState end{q, v};
  if (trajectory.cycle == Cycle::kHalf) {
    for (int j = 0; j < model.size(); ++j) {
      const Joint& joint = model.joint(j);
      const int source = joint.mirror_joint < 0 ? j : joint.mirror_joint;
      end.position[j] = joint.mirror_sign * q[source];
      end.velocity[j] = joint.mirror_sign * v[source];
    }
  }
  const int base_x = model.Find("base_x");
  if (base_x >= 0) end.position[base_x] += trajectory.displacement;
  return end;
}

double PeriodicityError(const Model& model, const Trajectory& trajectory) {
  if (trajectory.cycle == Cycle::kOnce) return 0;
  const EndState end = PeriodicEnd(model, trajectory);
  const TrajectoryPhase& last = trajectory.phases.back();
  double worst = 0;
  for (int j = 0; j < model.size(); ++j) {
    RaiseTo(std::abs(last.node_positions(j, Intervals(last)) - end.position[j]), &worst);
    if (Jumps(trajectory.phases.front())) continue;
    RaiseTo(std::abs(last.node_velocities(j, Intervals(last)) - end.velocity[j]), &worst);
  }
  return worst;
}

double EndError(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                const Manoeuvre& manoeuvre) {
  const ContactSurface& surface = scene.contacts.front();
  double worst = 0;
  BodyDynamics::State state;
  const auto compare = [&](const TrajectoryPhase& phase, int node, const BodyState& asked) {
    dynamics.ComputeState(phase.node_positions.col(node), phase.node_velocities.col(node), &state);
    const BodyDynamics::Link& body = state[surface.joint];
    if (asked.x) RaiseTo(std::abs(body.p_WL.x() - *asked.x), &worst);
    if (asked.y) RaiseTo(std::abs(body.p_WL.y() - *asked.y), &worst);
    if (asked.orientation) {
      const Eigen::Quaterniond actual(body.R_WL * surface.R_LE);
      RaiseTo(actual.angularDistance(*asked.orientation), &worst);
    }
    RaiseTo((body.R_WL * body.twist.angular - asked.angular_velocity).norm(), &worst);
  };
  compare(trajectory.phases.front(), 0, manoeuvre.start);
  compare(trajectory.phases.back(), Intervals(trajectory.phases.back()), manoeuvre.end);
  return worst;
}

BalanceErrors MeasureBalances(const BodyDynamics& dynamics, const Model& model, const Trajectory& trajectory,
                              const Vector3& gravity) {
  double work = 0, positive = 0, negative = 0, largest_kinetic = 0;
  Vector3 impulse = Vector3::Zero();
  MotionSample sample;
  BodyDynamics::State state;
  for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    if (p > 0 && Jumps(phase)) {
      for (int c = 0; c < static_cast<int>(phase.contacts.size()); ++c) impulse += phase.impulses.segment<3>(3 * c);
      work -= phase.impact_loss;
    }
    for (int k = 0; k < Intervals(phase); ++k) {
      const IntervalPolynomials interval(trajectory, p, k);
      for (int i = 0; i < kGaussPoints; ++i) {
        const double weight = kGaussWeights[i] * interval.length();
        interval.Evaluate(kGaussNodes[i], &sample);
        for (size_t a = 0; a < model.actuated().size(); ++a) {
          const double power = sample.efforts[static_cast<int>(a)] * sample.velocity[model.actuated()[a]];
          work += weight * power;
          (power > 0 ? positive : negative) += weight * std::abs(power);
        }
        impulse += weight * dynamics.total_mass() * gravity;
        for (int c = 0; c < static_cast<int>(phase.contacts.size()); ++c) {
          impulse += weight * sample.forces.segment<3>(3 * c);
        }
      }
    }
    for (int k = 0; k <= Intervals(phase); ++k) {
      dynamics.ComputeState(phase.node_positions.col(k), phase.node_velocities.col(k), &state);
      RaiseTo(dynamics.KineticEnergy(state), &largest_kinetic);
    }
  }

  // `state` is the last node's.
  const TrajectoryPhase& first = trajectory.phases.front();
  BodyDynamics::State start;
  dynamics.ComputeState(first.node_positions.col(0), first.node_velocities.col(0), &start);
  const double change = dynamics.KineticEnergy(state) + dynamics.PotentialEnergy(state, gravity) -
                        dynamics.KineticEnergy(start) - dynamics.PotentialEnergy(start, gravity);
  BalanceErrors errors;
  RaiseTo(std::abs(change - work), &errors.energy);
  const double done = std::max(positive, negative);
  const double scale = done > 0 ? done : largest_kinetic;
  if (errors.energy > 0) errors.energy_relative = scale > 0 ? errors.energy / scale : kInfinity;
  RaiseTo((impulse - dynamics.LinearMomentum(state) + dynamics.LinearMomentum(start)).norm(), &errors.momentum);
  return errors;
}

}  // namespace rollgait
