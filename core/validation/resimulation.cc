#include "core/validation/resimulation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/contact/constrained_dynamics.h"
#include "core/math/integrator.h"
#include "core/trajectory/sampling.h"
#include "core/validation/jumps.h"
#include "core/validation/pieces.h"
#include "core/validation/residuals.h"

namespace rollgait {
namespace {

// Interpolation of the forces within one accepted step.
constexpr int kForceDegree = 4, kForceGrid = 48, kForceHalvings = 8;
constexpr double kForceResolved =
    1e-3;  // of the least normal force of the contact, or of the least that friction is judged with
constexpr double kContactPointResolved = 1e-5;  // m, of the contact points, which say only where forces act
// The quintic through the ends of a step is good enough if it is off by at most this share of the velocities (and of 1
// rad/s or m/s).
constexpr double kQuinticError = 1e-5;

std::vector<ContactSurface> ActiveSurfaces(const Scene& scene, const TrajectoryPhase& phase) {
  std::vector<ContactSurface> surfaces;
  for (int c : phase.contacts) surfaces.push_back(scene.contacts[c]);
  return surfaces;
}

// The quintic polynomial through positions, velocities and accelerations at both ends of a step. Its error is of order
// 6 in the length of the step, that of its derivative of order 5.
class QuinticStep {
 public:
  // x = [q; v] and its derivative [v; a] at the start and at the end.
  void Set(double start, double length, const VectorX& x0, const VectorX& dx0, const VectorX& x1, const VectorX& dx1) {
    const int n = static_cast<int>(x0.size()) / 2;
    start_ = start, h_ = length;
    c_[0] = x0.head(n);
    c_[1] = h_ * x0.tail(n);
    c_[2] = 0.5 * h_ * h_ * dx0.tail(n);
    d_ = x1.head(n) - c_[0] - c_[1] - c_[2];
    v_ = h_ * x1.tail(n) - c_[1] - 2 * c_[2];
    a_ = h_ * h_ * dx1.tail(n) - 2 * c_[2];
    c_[3] = 10 * d_ - 4 * v_ + 0.5 * a_;
    c_[4] = -15 * d_ + 7 * v_ - a_;
    c_[5] = 6 * d_ - 3 * v_ + 0.5 * a_;
  }
  void Evaluate(double t, VectorX* x) const {
    const double s = (t - start_) / h_;
    const int n = static_cast<int>(c_[0].size());
    x->resize(2 * n);
    x->head(n) = c_[0] + s * (c_[1] + s * (c_[2] + s * (c_[3] + s * (c_[4] + s * c_[5]))));
    x->tail(n) = (c_[1] + s * (2 * c_[2] + s * (3 * c_[3] + s * (4 * c_[4] + s * 5 * c_[5])))) / h_;
  }
  // Largest difference of its acceleration at t from the given one, times the length of the step: how far its
  // velocities may be off.
  double VelocityError(double t, const Eigen::Ref<const VectorX>& acceleration) const {
    const double s = (t - start_) / h_;
    return ((2 * c_[2] + s * (6 * c_[3] + s * (12 * c_[4] + s * 20 * c_[5]))) / h_ - h_ * acceleration)
        .cwiseAbs()
        .maxCoeff();
  }

 private:
  double start_ = 0, h_ = 1;
  VectorX c_[6], d_, v_, a_;
};

// The forward dynamics of one phase as an ordinary differential equation in x = [q; v].
class PhaseMotion {
 public:
  PhaseMotion(const Scene& scene, const BodyDynamics& dynamics, const TrajectoryPhase& phase, int index,
              const Vector3& gravity, const ForceBounds& bounds, ForceExtremes* forces)
      : model_(scene.model),
        phase_(index),
        gravity_(gravity),
        dynamics_(dynamics, ActiveSurfaces(scene, phase)),
        judge_(scene, phase.contacts, bounds, forces),
        least_normal_(forces->floor()),
        tau_(VectorX::Zero(scene.model.size())),
        step_start_(Rows()),
        step_end_(Rows()) {}

  // Carries x over the interval and judges its forces.
  IntegrationStatus Run(const IntervalPolynomials& interval, int number, double tolerance, int most_steps,
                        Dop853* integrator, Pieces* pieces, VectorX* x, FindingLog* log) {
    const double end = interval.length();
    const int n = model_.size();
    const Dop853::RightSide right_side = [&](double t, const VectorX& state, VectorX* derivative) {
      interval.EvaluateEfforts(t / end, &efforts_);
      for (size_t a = 0; a < model_.actuated().size(); ++a) tau_[model_.actuated()[a]] = efforts_[static_cast<int>(a)];
      q_ = state.head(n);
      v_ = state.tail(n);
      derivative->head(n) = v_;
      derivative->tail(n) = dynamics_.Evaluate(q_, v_, tau_, gravity_).acceleration;
    };
    const double proposed = integrator->proposed_step();
    double t = 0;
    integrator->Start(right_side, t, *x, proposed > 0 ? std::min(proposed, end) : end);
    ReadForces(step_start_.data());
    from_state_ = *x, from_derivative_ = integrator->derivative();
    int attempts = 0;
    while (t < end) {
      const IntegrationStatus status = integrator->Advance(right_side, end, tolerance, most_steps, &t, x, &attempts);
      if (status != IntegrationStatus::kReachedEnd) return status;
      if (judge_.contacts() == 0) continue;
      ReadForces(step_end_.data());
      quintic_.Set(integrator->step_start(), integrator->step_end() - integrator->step_start(), from_state_,
                   from_derivative_, *x, integrator->derivative());
      JudgeStep(right_side, {phase_, 0, number}, interval.start(), integrator, pieces, log);
      step_start_.swap(step_end_);
      from_state_ = *x, from_derivative_ = integrator->derivative();
    }
    return IntegrationStatus::kReachedEnd;
  }

 private:
  int Rows() const { return ForceJudge::kRows * judge_.contacts(); }

  // Forces and contact points of the last evaluation.
  void ReadForces(double* rows) const {
    for (int c = 0; c < judge_.contacts(); ++c) {
      Eigen::Map<Eigen::Matrix<double, ForceJudge::kRows, 1>>(rows + ForceJudge::kRows * c) << dynamics_.Force(c),
          dynamics_.contact(c).p_WP.head<2>();
    }
  }

  // `offset`: time of the interval's start.
  void JudgeStep(const Dop853::RightSide& right_side, const Instant& at, double offset, Dop853* integrator,
                 Pieces* pieces, FindingLog* log) {
    const double from = integrator->step_start(), to = integrator->step_end(), middle = 0.5 * (from + to);
    const int n = model_.size();
    rates_.resize(2 * n);
    // Between its ends the step is the quintic through them; where that is not good enough, the integrator's continuous
    // extension of order 7, which costs three evaluations more.
    quintic_.Evaluate(middle, &state_);
    right_side(middle, state_, &rates_);
    const double fastest = std::max(1.0, state_.tail(n).cwiseAbs().maxCoeff());
    const bool use_quintic = quintic_.VelocityError(middle, rates_.tail(n)) <= kQuinticError * fastest;
    if (!use_quintic) integrator->PrepareInterpolation(right_side);
    MatrixX* const values = pieces->mutable_values(Rows());
    const int last = pieces->basis().size() - 1;
    static_assert(kForceDegree % 2 == 0);  // the middle is a node
    if (use_quintic) ReadForces(values->col(last / 2).data());
    const auto sample = [&](double t, MatrixX* rows, int column) {
      use_quintic ? quintic_.Evaluate(t, &state_) : integrator->Interpolate(t, &state_);
      right_side(t, state_, &rates_);
      ReadForces(rows->col(column).data());
    };
    const auto resolved = [&] { return Resolved(*pieces); };
    const auto visit = [&](double piece_from, double piece_to) {
      judge_.JudgeNormal(pieces->basis(), pieces->coefficients(), pieces->samples(), 0, offset + piece_from,
                         piece_to - piece_from, at, log);
      judge_.JudgeFriction(pieces->basis(), pieces->coefficients(), pieces->samples(), 0, offset + piece_from,
                           piece_to - piece_from, at, log);
    };
    // At its ends the forces of the step are known.
    values->col(0) = step_start_;
    values->col(last) = step_end_;
    for (int i = 1; i < last; ++i) {
      if (use_quintic && 2 * i == last) continue;
      sample(from + pieces->basis().node(i) * (to - from), values, i);
    }
    pieces->Continue(from, to, kForceHalvings, sample, resolved, visit);
  }

  bool Resolved(const Pieces& pieces) const {
    for (int row = 0; row < Rows(); ++row) {
      const int component = row % ForceJudge::kRows;
      const double normal = std::abs(pieces.values().row(row - component + 2).minCoeff());
      const double enough = component < 3 ? kForceResolved * std::max(normal, least_normal_) : kContactPointResolved;
      if (!(ChebyshevBasis::Tail(pieces.coefficients(), row) <= enough)) return false;
    }
    return true;
  }

  const Model& model_;
  int phase_;
  Vector3 gravity_;
  ConstrainedDynamics dynamics_;
  ForceJudge judge_;
  double least_normal_;
  VectorX tau_, efforts_, q_, v_, state_, rates_, from_state_, from_derivative_;
  QuinticStep quintic_;
  VectorX step_start_, step_end_;  // rows of ForceJudge
};

double LargestOf(const VectorX& difference) {
  double largest = 0;
  for (double value : difference) RaiseTo(std::abs(value), &largest);
  return largest;
}

// Differences of states, at the end of an interval or of a phase.
class DefectLog {
 public:
  DefectLog(const Model& model, Resimulation* result, FindingLog* log) : model_(model), result_(result), log_(log) {}

  // An infinite difference where the interval could not be integrated.
  void Compare(const VectorX& x, const VectorX& q, const VectorX& v, bool with_velocities, const Instant& at) {
    const int n = model_.size();
    for (int j = 0; j < n; ++j) {
      Add(Criterion::kPositionDefect, j, std::abs(x[j] - q[j]), at, &result_->position);
      if (with_velocities) Add(Criterion::kVelocityDefect, j, std::abs(x[n + j] - v[j]), at, &result_->velocity);
    }
  }
  void AddBroken(const Instant& at) {
    Add(Criterion::kPositionDefect, 0, kInfinity, at, &result_->position);
    Add(Criterion::kVelocityDefect, 0, kInfinity, at, &result_->velocity);
  }

 private:
  void Add(Criterion criterion, int joint, double difference, const Instant& at, Defect* defect) {
    log_->Raise(criterion, difference, model_.joint(joint).name, at);
    const double before = defect->value;
    RaiseTo(difference, &defect->value);
    if (defect->value == before) return;
    defect->joint = joint;
    defect->time = at.time;
  }

  const Model& model_;
  Resimulation* result_;
  FindingLog* log_;
};

}  // namespace

Resimulation Resimulate(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory,
                        const Vector3& gravity, double tolerance, int most_steps, const ForceBounds& bounds,
                        ForceExtremes* forces, FindingLog* log) {
  static const ChebyshevBasis basis(kForceDegree, kForceGrid);
  const int n = scene.model.size();
  Resimulation result;
  DefectLog defects(scene.model, &result, log);
  Dop853 integrator;
  Pieces pieces(basis);
  VectorX x(2 * n);
  int number = 0;
  for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    PhaseMotion motion(scene, dynamics, phase, p, gravity, bounds, forces);
    const int intervals = static_cast<int>(phase.node_times.size()) - 1;
    for (int k = 0; k < intervals; ++k, ++number) {
      const IntervalPolynomials interval(trajectory, p, k);
      x << phase.node_positions.col(k), phase.node_velocities.col(k);
      const Instant end{p, phase.node_times[k + 1], number}, border{p, phase.node_times[k + 1]};
      if (motion.Run(interval, number, tolerance, most_steps, &integrator, &pieces, &x, log) !=
          IntegrationStatus::kReachedEnd) {
        defects.AddBroken(end);
        integrator = Dop853();  // its steps were those of a motion that does not exist
        result.interval_positions.push_back(kInfinity);
        result.interval_velocities.push_back(kInfinity);
        continue;
      }
      defects.Compare(x, phase.node_positions.col(k + 1), phase.node_velocities.col(k + 1), true, end);
      result.interval_positions.push_back(LargestOf(x.head(n) - phase.node_positions.col(k + 1)));
      result.interval_velocities.push_back(LargestOf(x.tail(n) - phase.node_velocities.col(k + 1)));
      if (k + 1 < intervals) continue;
      if (p + 1 < static_cast<int>(trajectory.phases.size())) {
        const TrajectoryPhase& next = trajectory.phases[p + 1];
        defects.Compare(x, next.node_positions.col(0), next.node_velocities.col(0), !Jumps(next), border);
      } else if (trajectory.cycle != Cycle::kOnce) {
        const EndState start = PeriodicEnd(scene.model, trajectory);
        defects.Compare(x, start.position, start.velocity, !Jumps(trajectory.phases.front()), border);
      }
    }
  }
  return result;
}

}  // namespace rollgait
