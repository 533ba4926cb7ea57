#include "core/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/simulation/event_locator.h"
#include "core/simulation/frictional_impact.h"
#include "core/simulation/initial_state.h"
#include "core/simulation/recording.h"

namespace rollgait {
namespace {

// A normal force this far below zero, relative to the largest force, is rounding.
constexpr double kForceRounding = 1e-11;
// Contacts closer than this (relative to their distance from the origin and their size) take part in an impact.
constexpr double kTouching = 1e-10;
// A slip below this, m/s, ends together with another one's.
constexpr double kStopped = 1e-9;

class SimulationRun {
 public:
  SimulationRun(const SimulationScene& scene, const SimulationObserver& observer, const StopFlag* stop)
      : scene_(scene), observer_(observer), stop_(stop), dynamics_(scene), locator_(scene, &dynamics_) {
    right_side_ = [this](double t, const VectorX& x, VectorX* dx) { dynamics_.RightSide(t, x, dx); };
    derivative_.resize(dynamics_.size());
    directions_.resize(scene.contacts.size());
    integrator_.SetQuadratures(SceneDynamics::kQuadratures);
  }

  Result<SimulationReport> Run() {
    Result<VectorX> start = InitialState(scene_, &dynamics_);
    if (!start.ok()) return start.violations();
    x_ = std::move(start).value();
    dynamics_.SetState(0, x_);
    report_.energy_initial = dynamics_.KineticEnergy() + dynamics_.PotentialEnergy();
    Loop();
    Finish();
    return report_;
  }

 private:
  void Loop() {
    if (!Settle() || !EmitSample(t_, x_)) return;
    ++next_sample_;
    const double end = scene_.options.duration;
    const double speed = derivative_.cwiseAbs().maxCoeff();
    const double first = speed > 0 ? 0.01 * std::max(1.0, x_.cwiseAbs().maxCoeff()) / speed : end;
    integrator_.Start(right_side_, t_, x_, std::min(first, end));
    while (t_ < end) {
      if (stop_ != nullptr && stop_->requested()) return End(SimulationEnd::kStopped);
      const double step_start = t_;
      const VectorX step_from = x_;
      int attempts_before = attempts_;
      const IntegrationStatus status = integrator_.Advance(right_side_, end, scene_.options.tolerance,
                                                           scene_.options.max_steps, &t_, &x_, &attempts_);
      if (status != IntegrationStatus::kReachedEnd) return End(Failure(status));
      ++report_.steps;
      report_.rejected_steps += attempts_ - attempts_before - 1;
      const std::optional<Crossing> crossing = locator_.FirstInStep(right_side_, step_from, &integrator_);
      if (crossing) {
        t_ = crossing->time;
        x_ = crossing->state;
      }
      if (!EmitSamples(step_start, step_from)) return;
      if (!CorrectDrift()) return;
      if (crossing && !Handle(*crossing)) return;
      dynamics_.SetState(t_, x_);
      const bool sliding = dynamics_.FollowSlip();
      // The state was changed, if only by the norm of a quaternion; or the direction of friction.
      if (crossing || sliding || scene_.options.drift == DriftControl::kProjection || scene_.model.HasFreeJoint()) {
        integrator_.Restart(right_side_, t_, x_);
      }
    }
  }

  SimulationEnd Failure(IntegrationStatus status) const {
    switch (status) {
      case IntegrationStatus::kTooManySteps:
        return SimulationEnd::kTooManySteps;
      case IntegrationStatus::kStepTooSmall:
        return SimulationEnd::kStepTooSmall;
      default:
        return NotFinite();
    }
  }

  SimulationEnd NotFinite() const {
    return dynamics_.solution().determined ? SimulationEnd::kNotFinite : SimulationEnd::kFrictionUndetermined;
  }

  void End(SimulationEnd end) { report_.end = end; }

  // Quaternions to unit norm always; gaps and slips as the scene says. Records what was found before.
  bool CorrectDrift() {
    const bool project = scene_.options.drift == DriftControl::kProjection;
    const SceneDynamics::Drift drift = dynamics_.Project(t_, project, &x_);
    report_.max_quaternion_error = std::max(report_.max_quaternion_error, drift.quaternion);
    report_.max_gap = std::max(report_.max_gap, drift.gap);
    report_.max_slip = std::max(report_.max_slip, drift.slip);
    dynamics_.RightSide(t_, x_, &derivative_);
    if (!derivative_.allFinite()) {
      End(NotFinite());
      return false;
    }
    Record(t_, x_);
    return true;
  }

  bool EmitSamples(double step_start, const VectorX& step_from) {
    VectorX between;
    for (; next_sample_ * scene_.options.output_step <= t_; ++next_sample_) {
      const double time = static_cast<double>(next_sample_) * scene_.options.output_step;
      if (time >= scene_.options.duration) break;  // the last sample is at the end
      if (time == t_) {
        between = x_;
      } else {
        single_.Step(right_side_, step_start, step_from, time - step_start, 1, &between);
      }
      dynamics_.Project(time, false, &between);
      if (!EmitSample(time, between)) return false;
    }
    return true;
  }

  bool EmitSample(double time, const VectorX& x) {
    dynamics_.RightSide(time, x, &derivative_);
    Record(time, x);
    if (observer_.sample && !observer_.sample(MakeSample(time, x, &dynamics_))) {
      End(SimulationEnd::kStopped);
      return false;
    }
    return true;
  }

  // The extremes of the report, at the state of the last right side.
  void Record(double time, const VectorX& x) { RecordExtremes(scene_, time, x, &dynamics_, &report_); }

  SimulationEvent MakeEvent(SimulationEventKind kind, int contact) const {
    SimulationEvent event;
    event.kind = kind;
    event.time = t_;
    event.contact = contact;
    event.q = dynamics_.Positions(x_);
    event.velocity_before = event.velocity_after = dynamics_.Velocities(x_);
    return event;
  }

  bool EmitEvent(const SimulationEvent& event) {
    if (++events_ > scene_.options.max_events) {
      End(SimulationEnd::kTooManyEvents);
      return false;
    }
    if (observer_.event && !observer_.event(event)) {
      End(SimulationEnd::kStopped);
      return false;
    }
    return true;
  }

  bool Handle(const Crossing& crossing) {
    switch (crossing.kind) {
      case SimulationEventKind::kTouchDown:
        return HandleImpact(crossing.contact);
      case SimulationEventKind::kLiftOff:
        return Release(crossing.contact) && Settle();
      case SimulationEventKind::kFrictionLoss:
        return LoseFriction(crossing.contact);
      case SimulationEventKind::kStick:
        return EndSlip(crossing.contact);
      case SimulationEventKind::kFrictionRegained:
        break;
    }
    return EmitEvent(MakeEvent(crossing.kind, crossing.contact));
  }

  bool LoseFriction(int contact) {
    if (dynamics_.MaySlide(contact)) return BeginSlip({contact}) && Settle();
    if (!EmitEvent(MakeEvent(SimulationEventKind::kFrictionLoss, contact))) return false;
    if (scene_.contacts[static_cast<size_t>(contact)].friction_loss != FrictionLoss::kStop) return true;
    End(SimulationEnd::kFrictionLoss);
    return false;
  }

  // Contacts at rest that cannot be held: each slides against the friction that holding it would take.
  bool BeginSlip(const std::vector<int>& contacts) {
    dynamics_.RightSide(t_, x_, &derivative_);
    for (int k : contacts) directions_[static_cast<size_t>(k)] = -dynamics_.TangentialForce(k).normalized();
    for (int k : contacts) {
      if (!EmitEvent(MakeEvent(SimulationEventKind::kFrictionLoss, k))) return false;
      dynamics_.Slide(k, directions_[static_cast<size_t>(k)]);
    }
    dynamics_.RightSide(t_, x_, &derivative_);
    if (derivative_.allFinite()) return true;
    End(NotFinite());
    return false;
  }

  // The slip of a contact passed through zero: it is held, unless that takes more friction than there is; and with it
  // those whose slip ends at the same instant.
  bool EndSlip(int contact) {
    std::vector<int> ended = {contact};
    for (size_t i = 0; i < ended.size(); ++i) {
      dynamics_.Stick(ended[i]);
      const SceneDynamics::Drift drift = dynamics_.Project(t_, true, &x_);
      report_.max_quaternion_error = std::max(report_.max_quaternion_error, drift.quaternion);
      if (!EmitEvent(MakeEvent(SimulationEventKind::kStick, ended[i]))) return false;
      dynamics_.SetState(t_, x_);
      for (int k : dynamics_.active()) {
        const bool listed = std::find(ended.begin(), ended.end(), k) != ended.end();
        if (!listed && dynamics_.IsSliding(k) && dynamics_.TangentialSlip(k).norm() <= kStopped) ended.push_back(k);
      }
    }
    return Settle();
  }

  bool Release(int contact) {
    if (!EmitEvent(MakeEvent(SimulationEventKind::kLiftOff, contact))) return false;
    std::vector<int> active = dynamics_.active();
    active.erase(std::remove(active.begin(), active.end(), contact), active.end());
    dynamics_.SetActive(std::move(active));
    dynamics_.Stick(contact);
    return true;
  }

  // Releases unilateral contacts that would have to pull, the worst first; then looks at friction.
  bool Settle() {
    while (true) {
      dynamics_.RightSide(t_, x_, &derivative_);
      if (!derivative_.allFinite()) {
        End(NotFinite());
        return false;
      }
      int worst = -1;
      double least = 0, size = 0;
      for (int k : dynamics_.active()) {
        size = std::max(size, dynamics_.contacts().Force(k).norm());
      }
      for (int k : dynamics_.active()) {
        if (scene_.contacts[static_cast<size_t>(k)].bilateral) continue;
        const double normal = dynamics_.contacts().Kinematics(k).normal.dot(dynamics_.contacts().Force(k));
        if (normal < -kForceRounding * size && normal < least) least = normal, worst = k;
      }
      if (worst < 0) break;
      if (!Release(worst)) return false;
    }
    // Contacts that may slide and need more friction than there is, begin to; this can make others need more, or less.
    for (int i = 0; i <= 2 * dynamics_.contacts().contact_count(); ++i) {
      std::vector<int> lost = locator_.MarkFriction(t_, x_), slide;
      for (int k : lost) {
        if (dynamics_.MaySlide(k)) {
          slide.push_back(k);
        } else if (!LoseFriction(k)) {
          return false;
        }
      }
      if (slide.empty()) return true;
      if (!BeginSlip(slide)) return false;
      for (int k : dynamics_.active()) {
        if (dynamics_.IsSliding(k) && dynamics_.TurnsBack(k)) dynamics_.Stick(k);
      }
    }
    End(SimulationEnd::kFrictionUndetermined);
    return false;
  }

  bool HandleImpact(int contact) {
    dynamics_.SetState(t_, x_);
    std::vector<int> touching, must_hold;
    for (int k = 0; k < dynamics_.contacts().contact_count(); ++k) {
      const PairKinematics& pair = dynamics_.contacts().Kinematics(k);
      const SceneContact& scene_contact = scene_.contacts[static_cast<size_t>(k)];
      const double size = 1 + pair.p_1.norm();
      const bool closes_too = !dynamics_.IsActive(k) && scene_contact.can_touch_down && scene_contact.gates.empty() &&
                              std::abs(pair.gap) <= kTouching * size && pair.gap_rate <= 0;
      if (k != contact && !dynamics_.IsActive(k) && !closes_too) continue;
      touching.push_back(k);
      if (k == contact || scene_contact.bilateral) must_hold.push_back(k);
    }
    const std::optional<Impact> resolved = ResolveFrictionalImpact(scene_, touching, must_hold, t_, x_, &dynamics_);
    if (!resolved) {
      End(SimulationEnd::kFrictionUndetermined);
      return false;
    }
    const Impact& impact = *resolved;
    SimulationEvent event = MakeEvent(SimulationEventKind::kTouchDown, contact);
    event.velocity_after = impact.velocity;
    event.impulses = impact.impulses;
    event.released = impact.released;
    for (int k : impact.released) event.released_gap_rates.push_back(impact.gap_rates[static_cast<size_t>(k)]);
    event.energy_loss = impact.energy_loss;
    event.redundant = impact.redundant;
    event.consistent = impact.consistent;
    x_.segment(scene_.model.nq(), scene_.model.nv()) = impact.velocity;
    dynamics_.SetState(t_, x_);
    const double before = x_[dynamics_.size() - 1];
    x_[dynamics_.size() - 1] = before - impact.energy_loss;
    dynamics_.SetActive(impact.held);
    ++report_.impacts;
    if (!EmitEvent(event)) return false;
    if (scene_.options.stop_after_impacts > 0 && report_.impacts >= scene_.options.stop_after_impacts) {
      End(SimulationEnd::kImpactCount);
      return false;
    }
    return Settle();
  }

  void Finish() {
    report_.end_time = t_;
    report_.evaluations = dynamics_.evaluations();
    report_.active_at_end = dynamics_.active();
    report_.q = dynamics_.Positions(x_);
    report_.v = dynamics_.Velocities(x_);
    // The sample at the end, unless the observer wants no more.
    if (report_.end != SimulationEnd::kStopped && report_.end != SimulationEnd::kNotFinite) EmitSample(t_, x_);
  }

  const SimulationScene& scene_;
  const SimulationObserver& observer_;
  const StopFlag* stop_;
  SceneDynamics dynamics_;
  EventLocator locator_;
  Dop853 integrator_, single_;
  Dop853::RightSide right_side_;
  SimulationReport report_;
  VectorX x_, derivative_;
  std::vector<Vector3> directions_;
  double t_ = 0;
  long next_sample_ = 0;
  int attempts_ = 0, events_ = 0;
};

}  // namespace

Result<SimulationReport> Simulate(const SimulationScene& scene, const SimulationObserver& observer,
                                  const StopFlag* stop) {
  return SimulationRun(scene, observer, stop).Run();
}

}  // namespace rollgait
