#include "core/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/simulation/event_locator.h"
#include "core/simulation/frictional_impact.h"
#include "core/simulation/held_contacts.h"
#include "core/simulation/initial_state.h"
#include "core/simulation/recording.h"

namespace rollgait {
namespace {

// Samples in a step from which the continuous extension, with its check, takes fewer evaluations than a step for each.
constexpr long kSamplesToInterpolate = 2;

class SimulationRun {
 public:
  SimulationRun(const SimulationScene& scene, const SimulationObserver& observer, const StopFlag* stop)
      : scene_(scene),
        observer_(observer),
        stop_(stop),
        tolerance_(scene.options.tolerance, scene.options.absolute_tolerance.value_or(scene.options.tolerance)),
        dynamics_(scene),
        locator_(scene, &dynamics_) {
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
    // Those before the end: a multiple of the step that rounding puts before the end is the end.
    samples_ = std::lround(std::ceil(scene_.options.duration / scene_.options.output_step *
                                     (1 - 4 * std::numeric_limits<double>::epsilon())));
    if (!Settle() || !EmitSample(t_, x_)) return;
    ++next_sample_;
    const double end = scene_.options.duration;
    integrator_.Start(right_side_, t_, x_, std::min(dynamics_.FirstStep(x_, derivative_), end));
    while (t_ < end) {
      if (stop_ != nullptr && stop_->requested()) return End(SimulationEnd::kStopped);
      const double step_start = t_;
      const VectorX step_from = x_;
      int attempts_before = attempts_;
      const IntegrationStatus status =
          integrator_.Advance(right_side_, end, tolerance_, scene_.options.max_steps, &t_, &x_, &attempts_);
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

  // Samples of the step, up to t_. A sample after a single step from its start is as accurate as the step; the
  // continuous extension takes twelve evaluations less for each and is used where it is as accurate, too.
  bool EmitSamples(double step_start, const VectorX& step_from) {
    const long first = next_sample_;
    while (SampleTime(next_sample_) <= t_ && next_sample_ < samples_) ++next_sample_;
    bool interpolates = next_sample_ - first >= kSamplesToInterpolate;
    if (interpolates) {
      integrator_.PrepareInterpolation(right_side_);
      const double middle = 0.5 * (integrator_.step_start() + integrator_.step_end());
      single_.Step(right_side_, step_start, step_from, middle - step_start, tolerance_, &between_);
      integrator_.Interpolate(middle, &interpolated_);
      interpolates = integrator_.Error(between_, interpolated_, tolerance_) <= 1;
    }
    for (long k = first; k < next_sample_; ++k) {
      const double time = SampleTime(k);
      if (time == t_) {
        between_ = x_;
      } else if (interpolates) {
        integrator_.Interpolate(time, &between_);
      } else {
        single_.Step(right_side_, step_start, step_from, time - step_start, tolerance_, &between_);
      }
      dynamics_.Project(time, false, &between_);
      if (!EmitSample(time, between_)) return false;
    }
    return true;
  }

  double SampleTime(long k) const { return static_cast<double>(k) * scene_.options.output_step; }

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
        return Settle(crossing.contact);
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
        if (!listed && dynamics_.IsSliding(k) && dynamics_.TangentialSlip(k).norm() <= kAtRest) ended.push_back(k);
      }
    }
    return Settle();
  }

  // Which contacts push, after one was let go (-1: none); then, which of them slide.
  bool Settle(int let_go = -1) { return ChooseHeld(let_go) && ChooseSliding(); }

  bool ChooseHeld(int let_go) {
    const HeldChoice choice = ChooseHeldContacts(scene_, let_go, t_, x_, &dynamics_);
    if (choice.outcome == HeldChoice::Outcome::kNotFinite) End(NotFinite());
    if (choice.outcome == HeldChoice::Outcome::kNone) {
      End(choice.may_slide ? SimulationEnd::kFrictionUndetermined : SimulationEnd::kRollingImpossible);
    }
    if (choice.outcome != HeldChoice::Outcome::kFound) return false;
    for (int k : choice.let_go) {
      if (!EmitEvent(MakeEvent(SimulationEventKind::kLiftOff, k))) return false;
    }
    for (int k : choice.began_to_slide) {
      if (!EmitEvent(MakeEvent(SimulationEventKind::kFrictionLoss, k))) return false;
    }
    for (int k : choice.taken_up) {
      SimulationEvent event = MakeEvent(SimulationEventKind::kTouchDown, k);
      event.impulses.assign(scene_.contacts.size(), Vector3::Zero());
      if (!EmitEvent(event)) return false;
    }
    return true;
  }

  // Contacts that may slide and need more friction than there is, begin to; this can make others need more, or less.
  bool ChooseSliding() {
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
    const std::optional<Impact> resolved = ResolveTouchDown(scene_, contact, t_, x_, &dynamics_);
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
    // The sample at the end, unless the observer wants no more or the instant has no accelerations.
    const SimulationEnd end = report_.end;
    const bool has_accelerations = end != SimulationEnd::kNotFinite && end != SimulationEnd::kRollingImpossible;
    if (has_accelerations && end != SimulationEnd::kStopped) EmitSample(t_, x_);
  }

  const SimulationScene& scene_;
  const SimulationObserver& observer_;
  const StopFlag* stop_;
  const Tolerance tolerance_;
  SceneDynamics dynamics_;
  EventLocator locator_;
  Dop853 integrator_, single_;
  Dop853::RightSide right_side_;
  SimulationReport report_;
  VectorX x_, derivative_, between_, interpolated_;
  std::vector<Vector3> directions_;
  double t_ = 0;
  long next_sample_ = 0, samples_ = 0;
  int attempts_ = 0, events_ = 0;
};

}  // namespace

Result<SimulationReport> Simulate(const SimulationScene& scene, const SimulationObserver& observer,
                                  const StopFlag* stop) {
  return SimulationRun(scene, observer, stop).Run();
}

}  // namespace rollgait
