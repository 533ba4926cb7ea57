#include "core/validation/residuals.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/trajectory/sampling.h"
#include "core/validation/jumps.h"

namespace rollgait {
namespace {

// Of the kinetic and potential energy: what rounding may add to them. A body at rest does no work to compare it with.
constexpr double kEnergyRounding = 1e-13;

// Gauss–Legendre quadrature on [0, 1] with 4 points, exact to degree 7; power has degree 2s − 1 <= 5.
constexpr int kGaussPoints = 4;
constexpr double kGaussNodes[kGaussPoints] = {0.0694318442029737123880267555535953, 0.330009478207571867598667120448378,
                                              0.669990521792428132401332879551622, 0.930568155797026287611973244446405};
constexpr double kGaussWeights[kGaussPoints] = {
    0.173927422568726928686531974610999, 0.326072577431273071313468025389001, 0.326072577431273071313468025389001,
    0.173927422568726928686531974610999};

// What is balanced, at a node: J, N s.
struct NodeBalance {
  double energy = 0;
  Vector3 momentum = Vector3::Zero();
};

int Intervals(const TrajectoryPhase& phase) { return static_cast<int>(phase.node_times.size()) - 1; }

}  // namespace

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
  const int forward = model.Find(JointRole::kBaseForward);
  if (forward >= 0) end.position[forward] += trajectory.displacement;
  return end;
}

double PeriodicityError(const Model& model, const Trajectory& trajectory, FindingLog* log) {
  if (trajectory.cycle == Cycle::kOnce) return 0;
  const EndState end = PeriodicEnd(model, trajectory);
  const TrajectoryPhase& last = trajectory.phases.back();
  const Instant at{static_cast<int>(trajectory.phases.size()) - 1, last.node_times.back()};
  double worst = 0;
  const auto compare = [&](int joint, double difference) {
    RaiseTo(std::abs(difference), &worst);
    log->Raise(Criterion::kPeriodicity, std::abs(difference), model.joint(joint).name, at);
  };
  for (int j = 0; j < model.size(); ++j) {
    compare(j, last.node_positions(j, Intervals(last)) - end.position[j]);
    if (Jumps(trajectory.phases.front())) continue;
    compare(j, last.node_velocities(j, Intervals(last)) - end.velocity[j]);
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
                              const Vector3& gravity, FindingLog* log) {
  double work = 0, positive = 0, negative = 0, largest_kinetic = 0, largest_energy = 0;
  Vector3 impulse = Vector3::Zero();
  struct IntervalBalance {
    Instant start;
    double energy, momentum;  // errors, J and N s
  };
  std::vector<IntervalBalance> intervals;
  MotionSample sample;
  NodeBalance first, before, after;
  BodyDynamics::State state;
  for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    if (p > 0 && Jumps(phase)) {
      for (int c = 0; c < static_cast<int>(phase.contacts.size()); ++c) impulse += phase.impulses.segment<3>(3 * c);
      work -= phase.impact_loss;
    }
    for (int k = 0; k <= Intervals(phase); ++k) {
      dynamics.ComputeState(phase.node_positions.col(k), phase.node_velocities.col(k), &state);
      const double kinetic = dynamics.KineticEnergy(state);
      RaiseTo(kinetic, &largest_kinetic);
      const double potential = dynamics.PotentialEnergy(state, gravity);
      RaiseTo(kinetic + std::abs(potential), &largest_energy);
      after = {kinetic + potential, dynamics.LinearMomentum(state)};
      if (p == 0 && k == 0) first = after;
      if (k > 0) {
        const IntervalPolynomials interval(trajectory, p, k - 1);
        double done = 0;
        Vector3 pushed = Vector3::Zero();
        for (int i = 0; i < kGaussPoints; ++i) {
          const double weight = kGaussWeights[i] * interval.length();
          interval.Evaluate(kGaussNodes[i], &sample);
          for (size_t a = 0; a < model.actuated().size(); ++a) {
            const double power =
                sample.efforts[static_cast<int>(a)] * sample.velocity[model.v_index(model.actuated()[a])];
            done += weight * power;
            (power > 0 ? positive : negative) += weight * std::abs(power);
          }
          for (int j = 0; j < model.size(); ++j) {
            const double rate = sample.velocity[model.v_index(j)];
            done -= weight * model.joint(j).damping * rate * rate;
          }
          pushed += weight * dynamics.total_mass() * gravity;
          for (int c = 0; c < static_cast<int>(phase.contacts.size()); ++c)
            pushed += weight * sample.forces.segment<3>(3 * c);
        }
        work += done;
        impulse += pushed;
        intervals.push_back({{p, interval.start(), static_cast<int>(intervals.size())},
                             std::abs(after.energy - before.energy - done),
                             (pushed - after.momentum + before.momentum).norm()});
      }
      before = after;
    }
  }

  BalanceErrors errors;
  RaiseTo(std::abs(after.energy - first.energy - work), &errors.energy);
  const double done = std::max(positive, negative);
  const double scale = done > 0 ? done : largest_kinetic;
  const double rounding = kEnergyRounding * largest_energy;
  const auto relative = [scale, rounding](double energy) {
    return energy <= rounding ? 0.0 : scale > 0 ? energy / scale : kInfinity;
  };
  errors.energy_relative = relative(errors.energy);
  RaiseTo((impulse - after.momentum + first.momentum).norm(), &errors.momentum);

  // The measures are the whole motion's: errors of intervals may cancel. The intervals say where most of it arises.
  FindingLog own(static_cast<int>(intervals.size()));
  for (const IntervalBalance& interval : intervals) {
    own.Raise(Criterion::kEnergy, relative(interval.energy), "", interval.start);
    own.Raise(Criterion::kMomentum, interval.momentum / dynamics.total_mass(), "", interval.start);
  }
  for (const Criterion criterion : {Criterion::kEnergy, Criterion::kMomentum}) {
    const double whole =
        criterion == Criterion::kEnergy ? errors.energy_relative : errors.momentum / dynamics.total_mass();
    log->Raise(criterion, whole, "", {own[criterion].phase, own[criterion].time});
    for (size_t i = 0; i < intervals.size(); ++i)
      log->RaiseInterval(criterion, own.intervals()[i][criterion], static_cast<int>(i));
  }
  return errors;
}

}  // namespace rollgait
