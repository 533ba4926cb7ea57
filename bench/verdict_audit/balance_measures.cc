#include <algorithm>
#include <cmath>

#include "bench/verdict_audit/interval_motion.h"
#include "bench/verdict_audit/kinematics.h"
#include "bench/verdict_audit/measures.h"
#include "bench/verdict_audit/second_judge.h"

namespace rollgait::audit {
namespace {

// What the efforts, each by itself, and the ground do over an interval, by Simpson's rule over the instants.
struct Work {
  double positive = 0, negative = 0;  // J
  Vector3 impulse = Vector3::Zero();  // N s, of the contact forces
};

void AddInterval(const Model& model, const IntervalMotion& interval, Work* work) {
  for (int i = 0; i <= kInstants; ++i) {
    const double theta = static_cast<double>(i) / kInstants;
    const double weight = (i == 0 || i == kInstants ? 1 : i % 2 == 1 ? 4 : 2) * interval.length() / (3 * kInstants);
    const VectorX v = interval.Velocity(theta), efforts = interval.Efforts(theta), forces = interval.Forces(theta);
    for (size_t a = 0; a < model.actuated().size(); ++a) {
      const double power = efforts[static_cast<Eigen::Index>(a)] * v[model.actuated()[a]];
      (power > 0 ? work->positive : work->negative) += weight * power;
    }
    for (Eigen::Index c = 0; c + 2 < forces.size(); c += 3) work->impulse += weight * forces.segment<3>(c);
  }
}

}  // namespace

void MeasureBalances(const GaitSpec& spec, const Trajectory& trajectory, Measures* measures) {
  const Model& model = spec.scene.model;
  Work work;
  double loss = 0;
  Vector3 impulse = Vector3::Zero();
  for (size_t p = 0; p < trajectory.phases.size(); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    for (int k = 0; k + 1 < static_cast<int>(phase.node_times.size()); ++k) {
      AddInterval(model, IntervalMotion(trajectory, phase, k), &work);
    }
    if (p == 0 || phase.impulses.size() == 0) continue;  // the motion starts after the first impact
    loss += phase.impact_loss;
    for (Eigen::Index c = 0; c + 2 < phase.impulses.size(); c += 3) impulse += phase.impulses.segment<3>(c);
  }
  const TrajectoryPhase &first = trajectory.phases.front(), &last = trajectory.phases.back();
  const auto start = Poses(model, first.node_positions.col(0), first.node_velocities.col(0));
  const auto end = Poses(model, last.node_positions.rightCols(1), last.node_velocities.rightCols(1));
  const double energy =
      Energy(model, end, spec.gravity) - Energy(model, start, spec.gravity) + loss - work.positive - work.negative;
  measures->Raise(Criterion::kEnergy, std::abs(energy) / std::max(work.positive, -work.negative));
  const double duration = last.node_times.back() - first.node_times.front();
  const Vector3 change = Momentum(model, end) - Momentum(model, start);
  const Vector3 given = work.impulse + impulse + duration * model.total_mass() * spec.gravity;
  measures->Raise(Criterion::kMomentum, (change - given).norm() / model.total_mass());
}

}  // namespace rollgait::audit
