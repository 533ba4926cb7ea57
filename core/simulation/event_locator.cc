#include "core/simulation/event_locator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/simulation/held_contacts.h"

namespace rollgait {
namespace {

constexpr int kParts = 4;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// Rounding of a gap, over the bodies' size and distance from the origin.
constexpr double kGapRounding = 64 * kEpsilon;

}  // namespace

EventLocator::EventLocator(const SimulationScene& scene, SceneDynamics* dynamics)
    : scene_(scene), dynamics_(*dynamics), beyond_friction_(scene.contacts.size(), 0) {
  derivative_.resize(dynamics->size());
}

void EventLocator::ChooseWatched() {
  watched_.clear();
  forces_watched_ = false;
  for (size_t i = 0; i < scene_.contacts.size(); ++i) {
    const SceneContact& contact = scene_.contacts[i];
    const int k = static_cast<int>(i);
    if (!dynamics_.IsActive(k)) {
      if (contact.can_touch_down) watched_.push_back({SimulationEventKind::kTouchDown, k});
      continue;
    }
    if (!contact.bilateral) watched_.push_back({SimulationEventKind::kLiftOff, k});
    if (dynamics_.IsSliding(k)) {
      watched_.push_back({SimulationEventKind::kStick, k});
    } else if (contact.friction != kInfinity) {
      watched_.push_back(
          {beyond_friction_[i] != 0 ? SimulationEventKind::kFrictionRegained : SimulationEventKind::kFrictionLoss, k});
    }
    forces_watched_ = true;
  }
}

double EventLocator::Value(const Watched& watched) {
  ContactDynamics& contacts = dynamics_.contacts();
  const PairKinematics& pair = contacts.Kinematics(watched.contact);
  if (watched.kind == SimulationEventKind::kTouchDown) return pair.gap;
  if (watched.kind == SimulationEventKind::kStick) return contacts.SlipAlongReference(watched.contact);
  const Vector3 force = contacts.Force(watched.contact);
  const double normal = pair.normal.dot(force);
  if (watched.kind == SimulationEventKind::kLiftOff) return normal;
  const double margin =
      scene_.contacts[static_cast<size_t>(watched.contact)].friction * normal - (force - normal * pair.normal).norm();
  return watched.kind == SimulationEventKind::kFrictionLoss ? margin : -margin;
}

void EventLocator::Evaluate(Point* point) {
  if (forces_watched_) {
    dynamics_.RightSide(point->time, point->state, &derivative_);
  } else {
    dynamics_.SetState(point->time, point->state);
  }
  point->values.resize(watched_.size());
  point->rates.assign(watched_.size(), 0.0);
  point->rounding.assign(watched_.size(), 0.0);
  point->zero.assign(watched_.size(), 0.0);
  double largest_force = 0;
  for (int k : dynamics_.active()) largest_force = std::max(largest_force, dynamics_.contacts().Force(k).norm());
  for (size_t w = 0; w < watched_.size(); ++w) {
    point->values[w] = Value(watched_[w]);
    if (watched_[w].kind == SimulationEventKind::kTouchDown) {
      const PairKinematics& pair = dynamics_.contacts().Kinematics(watched_[w].contact);
      point->rates[w] = pair.gap_rate;
      const double size = 1 + pair.p_1.norm();
      point->rounding[w] = kGapRounding * size;
      point->zero[w] = kTouching * size;
    } else if (watched_[w].kind == SimulationEventKind::kLiftOff) {
      point->rounding[w] = point->zero[w] = kForceRounding * largest_force;
    }
  }
}

EventLocator::Point EventLocator::At(double t) {
  Point point;
  point.time = t;
  integrator_->Interpolate(t, &point.state);
  Evaluate(&point);
  return point;
}

bool EventLocator::GatesOpen(int contact, const VectorX& x) const {
  for (const Gate& gate : scene_.contacts[static_cast<size_t>(contact)].gates) {
    const double position = x[scene_.model.q_index(gate.joint)];
    if (!(position >= gate.min && position <= gate.max)) return false;
  }
  return true;
}

double EventLocator::RootBetween(size_t w, const Point& a, const Point& b) {
  // Regula falsi with the Illinois weight; it keeps the bracket.
  double low = a.time, high = b.time, at_low = a.values[w], at_high = b.values[w];
  for (int i = 0; i < 100 && high - low > 4 * kEpsilon * std::max(std::abs(low), std::abs(high)); ++i) {
    double middle = (low * at_high - high * at_low) / (at_high - at_low);
    if (!(middle > low && middle < high)) middle = 0.5 * (low + high);
    const double value = At(middle).values[w];
    if (value == 0) return middle;
    if (value > 0) {
      low = middle, at_low = value;
      at_high *= 0.5;
    } else {
      high = middle, at_high = value;
      at_low *= 0.5;
    }
    if (middle == low && middle == high) break;
  }
  return high;
}

Crossing EventLocator::Polish(const Watched& watched, double root, double slope, const VectorX& x) {
  Crossing crossing;
  crossing.kind = watched.kind;
  crossing.contact = watched.contact;
  const double start = integrator_->step_start(), end = integrator_->step_end();
  double t = root, before_t = root, before_value = 0;
  for (int i = 0; i < 8; ++i) {
    if (t > start) {
      single_.Step(*right_side_, start, x, t - start, 1, &crossing.state);
    } else {
      crossing.state = x;
    }
    Point point;
    point.time = t;
    point.state = crossing.state;
    Evaluate(&point);
    const double value = point.values[static_cast<size_t>(
        std::find_if(watched_.begin(), watched_.end(),
                     [&](const Watched& o) { return o.kind == watched.kind && o.contact == watched.contact; }) -
        watched_.begin())];
    if (i > 0 && std::abs(t - before_t) > 1e-6 * (end - start) && value != before_value) {
      slope = (value - before_value) / (t - before_t);
    }
    before_t = t, before_value = value;
    if (!(slope < 0)) break;
    const double next = std::clamp(t - value / slope, start, end);
    if (std::abs(next - t) <= 2 * kEpsilon * std::max(std::abs(t), end - start)) break;
    t = next;
  }
  crossing.time = before_t;
  return crossing;
}

EventLocator::Point EventLocator::TurnBetween(size_t w, const Point& a, const Point& b) {
  const bool least = a.rates[w] < 0;
  double low = a.time, high = b.time;
  Point turn;
  for (int i = 0; i < 40; ++i) {
    turn = At(0.5 * (low + high));
    if (least ? turn.values[w] < -turn.rounding[w] : turn.values[w] > turn.rounding[w]) break;
    (least == (turn.rates[w] < 0) ? low : high) = turn.time;
  }
  return turn;
}

std::optional<double> EventLocator::FallsAt(size_t w, const Point& a, const Point& b) {
  const bool is_gap = watched_[w].kind == SimulationEventKind::kTouchDown;
  if (a.values[w] > 0 && b.values[w] <= 0) return RootBetween(w, a, b);
  if (is_gap && a.values[w] > 0 && a.rates[w] < 0 && b.rates[w] > 0) {
    const Point least = TurnBetween(w, a, b);
    if (least.values[w] < -least.rounding[w]) return RootBetween(w, a, least);
    return std::nullopt;
  }
  const bool from_zero = a.zero[w] > 0 && a.values[w] <= 0 && a.values[w] >= -a.zero[w];
  if (!from_zero || !(b.values[w] < -b.zero[w])) return std::nullopt;
  if (is_gap && a.rates[w] > 0 && b.rates[w] < 0) {
    const Point greatest = TurnBetween(w, a, b);
    if (greatest.values[w] > greatest.rounding[w]) return RootBetween(w, greatest, b);
  }
  return a.time;
}

std::optional<Crossing> EventLocator::FirstBetween(const Point& a, const Point& b, const VectorX& x) {
  std::optional<size_t> first;
  double first_root = kInfinity;
  for (size_t w = 0; w < watched_.size(); ++w) {
    const std::optional<double> root = FallsAt(w, a, b);
    if (!root) continue;
    if (watched_[w].kind == SimulationEventKind::kTouchDown && !GatesOpen(watched_[w].contact, At(*root).state))
      continue;
    if (*root < first_root) first_root = *root, first = w;
  }
  if (!first) return std::nullopt;
  const double delta = 1e-5 * (b.time - a.time);
  const double t = std::clamp(first_root, a.time + delta, b.time - delta);
  const double slope = (At(t + delta).values[*first] - At(t - delta).values[*first]) / (2 * delta);
  const Watched watched = watched_[*first];
  return Polish(watched, first_root, slope, x);
}

std::optional<Crossing> EventLocator::FirstInStep(const Dop853::RightSide& right_side, const VectorX& x,
                                                  Dop853* integrator) {
  ChooseWatched();
  if (watched_.empty()) return std::nullopt;
  right_side_ = &right_side;
  integrator_ = integrator;
  integrator->PrepareInterpolation(right_side);
  const double start = integrator->step_start(), length = integrator->step_end() - start;
  Point before;
  before.time = start;
  before.state = x;
  Evaluate(&before);
  for (int i = 1; i <= kParts; ++i) {
    Point after = At(i == kParts ? integrator->step_end() : start + length * i / kParts);
    std::optional<Crossing> crossing = FirstBetween(before, after, x);
    if (crossing) {
      const size_t k = static_cast<size_t>(crossing->contact);
      if (crossing->kind == SimulationEventKind::kFrictionLoss) beyond_friction_[k] = 1;
      if (crossing->kind == SimulationEventKind::kFrictionRegained) beyond_friction_[k] = 0;
      return crossing;
    }
    before = std::move(after);
  }
  return std::nullopt;
}

std::vector<int> EventLocator::MarkFriction(double t, const VectorX& x) {
  dynamics_.RightSide(t, x, &derivative_);
  std::vector<int> lost;
  for (size_t k = 0; k < scene_.contacts.size(); ++k) {
    const int contact = static_cast<int>(k);
    const bool watched =
        dynamics_.IsActive(contact) && !dynamics_.IsSliding(contact) && scene_.contacts[k].friction != kInfinity;
    const bool beyond = watched && Value({SimulationEventKind::kFrictionLoss, contact}) < 0;
    if (beyond && beyond_friction_[k] == 0) lost.push_back(contact);
    beyond_friction_[k] = beyond ? 1 : 0;
  }
  return lost;
}

}  // namespace rollgait
