#include "core/validation/gait_events.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <tuple>

#include "core/contact/rolling_kinematics.h"

namespace rollgait {
namespace {

bool Holds(const std::vector<int>& contacts, int contact) {
  return std::find(contacts.begin(), contacts.end(), contact) != contacts.end();
}

// The contacts of one foot; `rear` and `front` are the same where it has only one.
struct FootSurfaces {
  std::vector<int> contacts;
  int rear = -1, front = -1;

  bool On(const GaitCycle::Span& span) const {
    return std::any_of(contacts.begin(), contacts.end(), [&](int contact) { return Holds(span.contacts, contact); });
  }
  bool Flat(const GaitCycle::Span& span) const { return Holds(span.contacts, rear) && Holds(span.contacts, front); }
};

FootSurfaces SurfacesOf(const Scene& scene, const GaitCycle& cycle, Foot foot) {
  const BodyDynamics dynamics(scene.model);
  BodyDynamics::State upright;
  const VectorX zero = VectorX::Zero(scene.model.size());
  dynamics.ComputeState(zero, zero, &upright);
  const auto place = [&](int contact) { return ComputeRollingContact(scene.contacts[contact], upright).p_WP.x(); };
  FootSurfaces surfaces;
  for (int c = 0; c < static_cast<int>(scene.contacts.size()); ++c) {
    if (!(foot == Foot::kRight ? cycle.IsRight(c) : cycle.IsLeft(c))) continue;
    surfaces.contacts.push_back(c);
    if (surfaces.rear < 0 || place(c) < place(surfaces.rear)) surfaces.rear = c;
    if (surfaces.front < 0 || place(c) > place(surfaces.front)) surfaces.front = c;
  }
  return surfaces;
}

// Follows one foot from its first heel strike once round the cycle.
void AddEvents(const std::vector<GaitCycle::Span>& spans, const FootSurfaces& surfaces, Foot foot,
               std::vector<GaitEvent>* events) {
  const size_t n = spans.size();
  const auto before = [&](size_t i) -> const GaitCycle::Span& { return spans[(i + n - 1) % n]; };
  size_t strike = 0;
  while (strike < n && !(surfaces.On(spans[strike]) && !surfaces.On(before(strike)))) ++strike;
  if (strike == n) return;
  bool flat_seen = false;
  constexpr double kNone = -1;
  double heel_off = kNone;
  for (size_t step = 0; step < n; ++step) {
    const size_t i = (strike + step) % n;
    const GaitCycle::Span& span = spans[i];
    const double percent = span.begin;
    const bool on = surfaces.On(span), was_on = surfaces.On(before(i));
    if (on && !was_on) {
      events->push_back({GaitEventKind::kHeelStrike, foot, percent});
      flat_seen = false;
      heel_off = kNone;
    }
    if (surfaces.rear != surfaces.front) {
      if (surfaces.Flat(span) && !flat_seen) {
        events->push_back({GaitEventKind::kFootFlat, foot, percent});
        flat_seen = true;
      }
      if (on && was_on && Holds(before(i).contacts, surfaces.rear) && !Holds(span.contacts, surfaces.rear))
        heel_off = percent;
    }
    if (was_on && !on) {
      if (heel_off != kNone) events->push_back({GaitEventKind::kHeelOff, foot, heel_off});
      events->push_back({GaitEventKind::kToeOff, foot, percent});
    }
  }
  // The stance that began last ends where the first one begins only if the foot is never off, and then it has no heel
  // strike.
}

class Plates {
 public:
  Plates(const Scene& scene, const GaitCycle& cycle, const Vector3& gravity)
      : scene_(scene),
        cycle_(cycle),
        dynamics_(scene.model),
        least_(kLeastLoad * scene.model.total_mass() * gravity.norm()) {
    const Vector3 up = -gravity.normalized(), forward = Vector3::UnitY().cross(up).normalized();
    axes_ << forward.transpose(), up.cross(forward).transpose(), up.transpose();
  }

  void Measure(std::array<FootOnGround, kFootCount>* feet) {
    for (FootOnGround& foot : *feet) {
      foot.force = foot.level_force = MatrixX::Zero(3, kCycleSteps + 1);
      foot.center_of_pressure = MatrixX::Zero(2, kCycleSteps + 1);
    }
    for (int i = 0; i <= kCycleSteps; ++i) {
      const MotionSample sample = cycle_.At(100.0 * i / kCycleSteps);
      dynamics_.ComputeState(sample.position, sample.velocity, &state_);
      for (FootOnGround& foot : *feet) MeasureFoot(sample.forces, i, &foot);
    }
  }

 private:
  void MeasureFoot(const VectorX& forces, int column, FootOnGround* foot) const {
    Vector3 sum = Vector3::Zero();
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    for (const int c : foot->contacts) {
      const Vector3 force = forces.segment<3>(3 * c);
      if (force.isZero(0)) continue;
      sum += force;
      moment += force.z() * ComputeRollingContact(scene_.contacts[c], state_).p_WP.head<2>();
    }
    foot->force.col(column) = sum;
    foot->level_force.col(column) = axes_ * sum;
    foot->center_of_pressure.col(column) = sum.z() >= least_
                                               ? Eigen::Vector2d(moment / sum.z())
                                               : Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  }

  const Scene& scene_;
  const GaitCycle& cycle_;
  const BodyDynamics dynamics_;
  const double least_;
  Matrix3 axes_;  // rows: forward, left, up
  BodyDynamics::State state_;
};

// Of the surfaces of a foot that come down at `percent`, the place of the rearmost along x, m.
double StrikePlace(const Scene& scene, const GaitCycle& cycle, const std::vector<int>& contacts, double percent) {
  const BodyDynamics dynamics(scene.model);
  BodyDynamics::State state;
  const MotionSample sample = cycle.At(percent);
  dynamics.ComputeState(sample.position, sample.velocity, &state);
  double place = std::numeric_limits<double>::infinity();
  for (const GaitCycle::Span& span : cycle.spans()) {
    if (span.begin != percent) continue;
    for (const int c : contacts) {
      if (Holds(span.contacts, c)) place = std::min(place, ComputeRollingContact(scene.contacts[c], state).p_WP.x());
    }
  }
  return place;
}

void MeasureSteps(const Scene& scene, const GaitCycle& cycle, GaitEvents* result) {
  const auto strike_right = result->First(GaitEventKind::kHeelStrike, Foot::kRight);
  const auto strike_left = result->First(GaitEventKind::kHeelStrike, Foot::kLeft);
  if (!strike_right || !strike_left || *strike_left == *strike_right) return;
  const bool right_first = *strike_right < *strike_left;
  FootOnGround &first = result->feet[right_first ? 0 : 1], &second = result->feet[right_first ? 1 : 0];
  const double begin = std::min(*strike_right, *strike_left), end = std::max(*strike_right, *strike_left);
  second.step_length =
      StrikePlace(scene, cycle, second.contacts, end) - StrikePlace(scene, cycle, first.contacts, begin);
  first.step_length = cycle.displacement() - second.step_length;
  second.step_duration = (end - begin) / 100 * cycle.duration();
  first.step_duration = cycle.duration() - second.step_duration;
}

// What both feet share of the ground from the heel strike of one on.
double LoadingAfter(const std::vector<GaitCycle::Span>& spans, std::optional<double> strike) {
  double share = 0;
  const size_t n = spans.size();
  size_t i = 0;
  while (strike && i < n && spans[i].begin != *strike) ++i;
  if (!strike || i == n) return 0;
  for (size_t step = 0; step < n; ++step, i = (i + 1) % n) {
    if (!spans[i].right || !spans[i].left) break;
    share += (spans[i].end - spans[i].begin) / 100;
  }
  return share;
}

double Asymmetry(double right, double left) {
  const double mean = (right + left) / 2;
  return mean == 0 ? 0 : (right - left) / mean;
}

}  // namespace

double GaitEvents::StepLengthAsymmetry() const { return Asymmetry(feet[0].step_length, feet[1].step_length); }
double GaitEvents::StepDurationAsymmetry() const { return Asymmetry(feet[0].step_duration, feet[1].step_duration); }
double GaitEvents::StanceAsymmetry() const { return Asymmetry(feet[0].stance, feet[1].stance); }

std::optional<double> GaitEvents::First(GaitEventKind kind, Foot foot) const {
  for (const GaitEvent& event : events) {
    if (event.kind == kind && event.foot == foot) return event.percent;
  }
  return std::nullopt;
}

BodySide SideOf(Foot foot) { return foot == Foot::kRight ? BodySide::kRight : BodySide::kLeft; }

std::optional<GaitEvents> MeasureGaitEvents(const Scene& scene, const Trajectory& trajectory, const Vector3& gravity,
                                            Foot first) {
  const auto cycle = GaitCycle::Of(scene, trajectory, SideOf(first));
  if (!cycle) return std::nullopt;
  GaitEvents result;
  result.start = cycle->start();
  result.duration = cycle->duration();
  result.displacement = cycle->displacement();
  result.body_weight = scene.model.total_mass() * gravity.norm();
  result.spans = cycle->spans();
  for (const Foot foot : {Foot::kRight, Foot::kLeft}) {
    const FootSurfaces surfaces = SurfacesOf(scene, *cycle, foot);
    result.feet[static_cast<int>(foot)].contacts = surfaces.contacts;
    AddEvents(result.spans, surfaces, foot, &result.events);
  }
  std::stable_sort(result.events.begin(), result.events.end(), [](const GaitEvent& a, const GaitEvent& b) {
    return std::tuple(a.percent, a.foot, a.kind) < std::tuple(b.percent, b.foot, b.kind);
  });
  for (const GaitCycle::Span& span : result.spans) {
    const double share = (span.end - span.begin) / 100;
    if (span.right) result.feet[0].stance += share;
    if (span.left) result.feet[1].stance += share;
    (span.right && span.left   ? result.double_support
     : span.right || span.left ? result.single_support
                               : result.flight) += share;
  }
  for (const Foot foot : {Foot::kRight, Foot::kLeft}) {
    result.feet[static_cast<int>(foot)].loading =
        LoadingAfter(result.spans, result.First(GaitEventKind::kHeelStrike, foot));
  }
  MeasureSteps(scene, *cycle, &result);
  Plates(scene, *cycle, gravity).Measure(&result.feet);
  return result;
}

}  // namespace rollgait
