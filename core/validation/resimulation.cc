#include "core/validation/resimulation.h"

#include <cmath>
#include <vector>

#include "core/contact/constrained_dynamics.h"
#include "core/trajectory/sampling.h"
#include "core/math/integrator.h"
#include "core/validation/jumps.h"

namespace rollgait {
namespace {

std::vector<ContactSurface> ActiveSurfaces(const Scene& scene, const TrajectoryPhase& phase) {
  std::vector<ContactSurface> surfaces;
  for (int c : phase.contacts) surfaces.push_back(scene.contacts[c]);
  return surfaces;
}

// The forward dynamics of one phase as an ordinary differential equation in x = [q; v].
class PhaseMotion {
 public:
  PhaseMotion(const Scene& scene, const BodyDynamics& dynamics, const TrajectoryPhase& phase, const Vector3& gravity)
      : model_(scene.model),
        contacts_(static_cast<int>(phase.contacts.size())),
        gravity_(gravity),
        dynamics_(dynamics, ActiveSurfaces(scene, phase)),
        tau_(VectorX::Zero(scene.model.size())) {}

  // Carries x over the interval.
  IntegrationStatus Run(const IntervalPolynomials& interval, double tolerance, Dop853* integrator, VectorX* x,
                        ForceExtremes* forces) {
    Dop853::Options options;
    options.tolerance = tolerance;
    options.first_step = integrator->proposed_step();
    const int n = model_.size();
    const auto right_side = [&](double t, const VectorX& state, VectorX* derivative) {
      interval.EvaluateEfforts(t / interval.length(), &efforts_);
      for (size_t a = 0; a < model_.actuated().size(); ++a) tau_[model_.actuated()[a]] = efforts_[static_cast<int>(a)];
      q_ = state.head(n);
      v_ = state.tail(n);
      derivative->head(n) = v_;
      derivative->tail(n) = dynamics_.Evaluate(q_, v_, tau_, gravity_).acceleration;
    };
    const auto observe = [&](double, const VectorX&) {
      for (int c = 0; c < contacts_; ++c) forces->Add(dynamics_.Force(c));
    };
    return integrator->Integrate(right_side, 0, interval.length(), options, x, observe);
  }

 private:
  const Model& model_;
  int contacts_;
  Vector3 gravity_;
  ConstrainedDynamics dynamics_;
  VectorX tau_, efforts_, q_, v_;
};

double Largest(const VectorX& difference) {
  double largest = 0;
  for (double value : difference) RaiseTo(std::abs(value), &largest);
  return largest;
}

void Compare(const VectorX& end, const Eigen::Ref<const VectorX>& expected, double time, Defect* defect) {
  for (int j = 0; j < expected.size(); ++j) {
    const double before = defect->value;
    RaiseTo(std::abs(end[j] - expected[j]), &defect->value);
    if (defect->value == before) continue;
    defect->joint = j;
    defect->time = time;
  }
}

}  // namespace

Resimulation Resimulate(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                        const Vector3& gravity, double tolerance, ForceExtremes* forces) {
  const int n = scene.model.size();
  Resimulation result;
  Dop853 integrator;
  VectorX x(2 * n);
  for (size_t p = 0; p < trajectory.phases.size(); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    PhaseMotion motion(scene, dynamics, phase, gravity);
    const int intervals = static_cast<int>(phase.node_times.size()) - 1;
    for (int k = 0; k < intervals; ++k) {
      const IntervalPolynomials interval(trajectory, static_cast<int>(p), k);
      x << phase.node_positions.col(k), phase.node_velocities.col(k);
      const double time = phase.node_times[k + 1];
      if (motion.Run(interval, tolerance, &integrator, &x, forces) != IntegrationStatus::kReachedEnd) {
        result.position = result.velocity = {kInfinity, 0, time};
        return result;
      }
      const auto compare = [&](const Eigen::Ref<const VectorX>& q, const Eigen::Ref<const VectorX>& v) {
        Compare(x.head(n), q, time, &result.position);
        Compare(x.tail(n), v, time, &result.velocity);
      };
      compare(phase.node_positions.col(k + 1), phase.node_velocities.col(k + 1));
      result.interval_positions.push_back(Largest(x.head(n) - phase.node_positions.col(k + 1)));
      result.interval_velocities.push_back(Largest(x.tail(n) - phase.node_velocities.col(k + 1)));
      if (k + 1 < intervals) continue;
      if (p + 1 < trajectory.phases.size()) {
        const TrajectoryPhase& next = trajectory.phases[p + 1];
        compare(next.node_positions.col(0), Jumps(next) ? VectorX(x.tail(n)) : VectorX(next.node_velocities.col(0)));
      } else if (trajectory.cycle != Cycle::kOnce) {
        const EndState end = PeriodicEnd(scene.model, trajectory);
        compare(end.position, Jumps(trajectory.phases.front()) ? VectorX(x.tail(n)) : end.velocity);
      }
    }
  }
  return result;
}

}  // namespace rollgait
