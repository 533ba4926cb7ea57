// CollocationNlp's exchange with motions: start vector from a guess, trajectory from a solution.

#include "core/trajectory/sampling.h"
#include "core/transcription/collocation_nlp.h"
#include "core/transcription/impulse_distribution.h"

namespace rollgait {

namespace {

// A point at the end of an interval is one of this interval, not of the neighbour, whose efforts and forces there are
// others: it is looked for by this part of a half interval further in.
constexpr double kInside = 1e-9;

Cycle CycleOf(const OptimalControlProblem& problem) {
  return problem.ends ? Cycle::kOnce : problem.mirrored ? Cycle::kHalf : Cycle::kFull;
}

}  // namespace

VectorX CollocationNlp::MakeStart(const MotionGuess& guess) const {
  const int n = problem_.model.size();
  VectorX x = VectorX::Zero(variables());
  for (int p = 0; p < layout_.phases(); ++p) x(layout_.duration(p)) = guess.durations[p];
  x(layout_.displacement()) = guess.displacement;
  const auto set_node = [&](int node, const MotionSample& sample) {
    x.segment(node, n) = sample.position;
    x.segment(node + n, n) = sample.velocity;
  };
  // From 3 per active contact to those of its directions.
  const auto set_forces = [&](int p, const VectorX& forces, double size, int first) {
    int index = 0;
    for (const ActiveContact& active : problem_.ActiveContacts(p)) {
      for (size_t d = 0; d < active.directions.size(); ++d) {
        x(first + active.offset + static_cast<int>(d)) = forces(3 * index + active.directions[d]) / size;
      }
      ++index;
    }
  };
  for (int p = 0; p < layout_.phases(); ++p) {
    if (!layout_.jumps(p)) continue;
    if (p > 0) set_node(layout_.end_node(layout_.first_interval(p) - 1), guess.motion(p - 1, 1));
    if (!guess.impulses.empty() && guess.impulses[p].size() > 0) {
      set_forces(p, guess.impulses[p], problem_.impulse_size(), layout_.impulse(p));
    }
  }
  for (int k = 0; k < layout_.intervals(); ++k) {
    const int p = layout_.phase(k);
    set_node(layout_.node(k), guess.motion(p, layout_.start(k)));
    for (int i = 0; i < scheme_.points(); ++i) {
      const double c = scheme_.tableau().c(i) + kInside * (0.5 - scheme_.tableau().c(i));
      const MotionSample sample = guess.motion(p, layout_.start(k) + c * layout_.length(k));
      if (i < scheme_.points() - 2)
        x.segment(layout_.free_acceleration(k, i), n) = sample.acceleration / kAccelerationScale;
      x.segment(layout_.efforts(k, i), sample.efforts.size()) = sample.efforts / problem_.effort_size();
      set_forces(p, sample.forces, problem_.force_size(), layout_.forces(k, i));
      ShareForces(p, x.data() + layout_.forces(k, i));
    }
  }
  set_node(layout_.node(layout_.intervals()), guess.motion(layout_.phases() - 1, 1));
  return x;
}

void CollocationNlp::ShareForces(int p, double* forces) const {
  const std::vector<ActiveContact> active = problem_.ActiveContacts(p);
  for (const ActiveContact& contact : active) {
    double normal = 0, along = 0;
    int count = 0;
    const auto normal_of = [forces](const ActiveContact& of) -> double {
      return forces[of.offset + static_cast<int>(of.directions.size()) - 1];
    };
    for (const ActiveContact& other : active) {
      if (problem_.contacts[other.contact].joint != problem_.contacts[contact.contact].joint) continue;
      if (other.offset < contact.offset)
        count = -static_cast<int>(active.size());  // the first of its link does it for all
      normal += normal_of(other);
      along += forces[other.offset];
      ++count;
    }
    if (count < 2 || normal <= 0 || contact.directions.front() != 0) continue;
    for (const ActiveContact& other : active) {
      if (problem_.contacts[other.contact].joint != problem_.contacts[contact.contact].joint) continue;
      forces[other.offset] = along * normal_of(other) / normal;
    }
  }
}

Trajectory CollocationNlp::Extract(const double* x) {
  Trajectory trajectory;
  trajectory.scheme = returned_.scheme;
  trajectory.points_per_interval = static_cast<int>(returned_.fractions.size());
  trajectory.point_fractions.assign(returned_.fractions.begin(), returned_.fractions.end());
  trajectory.cycle = CycleOf(problem_);
  trajectory.duration = duration(x);
  trajectory.displacement = x[layout_.displacement()];
  double start = 0;
  for (int p = 0; p < layout_.phases(); ++p) {
    trajectory.phases.push_back(ExtractPhase(x, p, start));
    start += trajectory.phases.back().duration;
  }
  FillPointStates(&trajectory);
  return trajectory;
}

CoarseMotion CollocationNlp::ExtractCoarse(const double* x, int most_of_a_phase) const {
  ROLLGAIT_CHECK(most_of_a_phase >= 2);
  const int n = problem_.model.size();
  CoarseMotion motion;
  motion.cycle = CycleOf(problem_);
  motion.duration = duration(x);
  motion.displacement = x[layout_.displacement()];
  double start = 0;
  for (int p = 0; p < layout_.phases(); ++p) {
    const int count = layout_.intervals_in(p), first = layout_.first_interval(p);
    const int samples = std::min(count + 1, most_of_a_phase);
    CoarseMotion::Phase phase{problem_.phases[p].active, start, x[layout_.duration(p)], {}, MatrixX(n, samples)};
    for (int i = 0; i < samples; ++i) {
      const int k = i * count / (samples - 1);
      const double* node = x + (k < count ? layout_.node(first + k) : layout_.end_node(first + k - 1));
      phase.times.push_back(start + phase.duration * (k < count ? layout_.start(first + k) : 1));
      phase.positions.col(i) = Eigen::Map<const VectorX>(node, n);
    }
    start += phase.duration;
    motion.phases.push_back(std::move(phase));
  }
  return motion;
}

TrajectoryPhase CollocationNlp::ExtractPhase(const double* x, int p, double start) {
  const int n = problem_.model.size(), s = static_cast<int>(returned_.fractions.size());
  const int efforts = static_cast<int>(problem_.model.actuated().size());
  const int count = layout_.intervals_in(p), first = layout_.first_interval(p);
  const auto active = problem_.ActiveContacts(p);
  TrajectoryPhase phase;
  phase.contacts = problem_.phases[p].active;
  phase.start = start;
  phase.duration = x[layout_.duration(p)];
  phase.node_positions.resize(n, count + 1);
  phase.node_velocities.resize(n, count + 1);
  phase.point_accelerations.resize(n, count * s);
  phase.point_efforts.resize(efforts, count * s);
  phase.point_forces = MatrixX::Zero(3 * static_cast<int>(active.size()), count * s);
  for (int k = 0; k <= count; ++k) {
    phase.node_times.push_back(start + phase.duration * (k < count ? layout_.start(first + k) : 1));
    const double* node = x + (k < count ? layout_.node(first + k) : layout_.end_node(first + k - 1));
    phase.node_positions.col(k) = Eigen::Map<const VectorX>(node, n);
    phase.node_velocities.col(k) = Eigen::Map<const VectorX>(node + n, n);
  }
  MatrixX points(blocks_[p]->PointState(x + layout_.node(first), Step(x, first), 0).size(), scheme_.points());
  for (int k = first; k < first + count; ++k) {
    for (int i = 0; i < scheme_.points(); ++i) {
      points.col(i) = blocks_[p]->PointState(x + layout_.node(k), Step(x, k), i);
    }
    const int column = (k - first) * s;
    for (int i = 0; i < s; ++i) {
      const double fraction = layout_.start(k) + returned_.fractions(i) * layout_.length(k);
      phase.point_times.push_back(start + phase.duration * fraction);
    }
    phase.point_accelerations.middleCols(column, s) =
        points.middleRows(2 * n, n) * returned_.acceleration_map.transpose();
    const MatrixX controls = points.bottomRows(points.rows() - 3 * n) * returned_.control_map.transpose();
    phase.point_efforts.middleCols(column, s) = controls.topRows(efforts);
    for (size_t c = 0; c < active.size(); ++c) {
      for (size_t d = 0; d < active[c].directions.size(); ++d) {
        phase.point_forces.row(3 * static_cast<int>(c) + active[c].directions[d]).segment(column, s) =
            controls.row(efforts + active[c].offset + static_cast<int>(d));
      }
    }
  }
  if (layout_.jumps(p)) ExtractImpact(x, p, &phase);
  return phase;
}

void CollocationNlp::ExtractImpact(const double* x, int p, TrajectoryPhase* phase) {
  phase->impulses = VectorX::Zero(3 * static_cast<int>(phase->contacts.size()));
  int index = 0;
  for (const ActiveContact& active : problem_.ActiveContacts(p)) {
    for (size_t d = 0; d < active.directions.size(); ++d) {
      phase->impulses(3 * index + active.directions[d]) =
          problem_.impulse_size() * x[layout_.impulse(p) + active.offset + static_cast<int>(d)];
    }
    ++index;
  }
  TakeLeastImpulses(problem_, p, phase->node_positions.col(0), &phase->impulses);
  phase->impact_loss = jumps_.EnergyLoss(x, p);
}

}  // namespace rollgait
