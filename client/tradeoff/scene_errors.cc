#include "client/tradeoff/scene_errors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "client/failure.h"
#include "client/joint_kinds.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr double kDegrees = 180 / kPi;

using Numbers = google::protobuf::RepeatedField<double>;
using EventsOfContacts = std::map<std::string, std::vector<const v1::SimulationEvent*>>;

struct Span {
  double from_s, to_s;
};

EventsOfContacts ByContact(const v1::Simulation& simulation) {
  EventsOfContacts events;
  for (const v1::SimulationEvent& event : simulation.events()) events[event.contact()].push_back(&event);
  return events;
}

// The times that the two say of each event; nullopt if they have others.
std::optional<std::vector<Span>> MatchEvents(const v1::Simulation& one, const v1::Simulation& other) {
  const EventsOfContacts ones = ByContact(one), others = ByContact(other);
  if (ones.size() != others.size()) return std::nullopt;
  std::vector<Span> spans;
  for (const auto& [contact, events] : ones) {
    const auto found = others.find(contact);
    if (found == others.end() || found->second.size() != events.size()) return std::nullopt;
    for (size_t i = 0; i < events.size(); ++i) {
      if (events[i]->kind() != found->second[i]->kind()) return std::nullopt;
      const auto [from_s, to_s] = std::minmax({events[i]->time_s(), found->second[i]->time_s()});
      spans.push_back({from_s, to_s});
    }
  }
  return spans;
}

Eigen::Quaterniond OrientationAt(const Numbers& q, int at) {
  return Eigen::Quaterniond(q[at], q[at + 1], q[at + 2], q[at + 3]).normalized();
}

Eigen::Vector3d VectorAt(const Numbers& v, int at) { return {v[at], v[at + 1], v[at + 2]}; }

void Raise(double& largest, double value) { largest = std::max(largest, std::abs(value)); }

void Compare(const v1::SimulationScene& scene, const v1::SimulationSample& one, const v1::SimulationSample& other,
             bool compares_velocities, SceneErrors& errors) {
  int at_q = 0, at_v = 0;
  for (const v1::SceneJoint& joint : scene.joints()) {
    const Numbers &q = one.positions(), &p = other.positions(), &v = one.velocities(), &u = other.velocities();
    const bool is_free = joint.type() == v1::Joint::TYPE_FREE;
    const int end_q = at_q + (is_free ? 7 : 1), end_v = at_v + (is_free ? 6 : 1);
    if (std::min(q.size(), p.size()) < end_q || std::min(v.size(), u.size()) < end_v) {
      throw Failure(ExitCode::kUsage, "a sample at " + FormatNumber(one.time_s()) + " s lacks joint " + joint.name());
    }
    if (is_free) {
      const Eigen::Quaterniond a = OrientationAt(q, at_q), b = OrientationAt(p, at_q);
      const Eigen::Quaterniond turn = a.conjugate() * b;
      Raise(errors.angle_deg, 2 * std::atan2(turn.vec().norm(), std::abs(turn.w())) * kDegrees);
      Raise(errors.position_m, (VectorAt(q, at_q + 4) - VectorAt(p, at_q + 4)).norm());
      if (compares_velocities) {
        Raise(errors.angular_velocity_deg_s, (a * VectorAt(v, at_v) - b * VectorAt(u, at_v)).norm() * kDegrees);
        Raise(errors.velocity_m_s, (a * VectorAt(v, at_v + 3) - b * VectorAt(u, at_v + 3)).norm());
      }
    } else {
      const bool turns = Turns(joint.type());
      const double scale = turns ? kDegrees : 1;
      Raise(turns ? errors.angle_deg : errors.position_m, (q[at_q] - p[at_q]) * scale);
      if (compares_velocities) {
        Raise(turns ? errors.angular_velocity_deg_s : errors.velocity_m_s, (v[at_v] - u[at_v]) * scale);
      }
    }
    at_q = end_q;
    at_v = end_v;
  }
}

}  // namespace

double SceneErrors::pose() const { return std::max(position_m, angle_deg / kDegrees); }

SceneErrors ErrorsAgainst(const v1::SimulationScene& scene, const v1::Simulation& reference,
                          const v1::Simulation& simulation) {
  SceneErrors errors;
  const auto spans = MatchEvents(reference, simulation);
  errors.same_motion = spans.has_value() && reference.report().end() == simulation.report().end();
  for (const Span& span : spans.value_or(std::vector<Span>())) {
    errors.event_time_s = std::max(errors.event_time_s.value_or(0), span.to_s - span.from_s);
  }
  bool any = false;
  const int size = std::min(reference.samples_size(), simulation.samples_size());
  for (int i = 0; i < size; ++i) {
    const v1::SimulationSample &one = reference.samples(i), &other = simulation.samples(i);
    const double time_s = one.time_s();
    if (time_s != other.time_s()) continue;  // where an event ended one of them
    any = true;
    const bool jumps = spans && std::any_of(spans->begin(), spans->end(), [&](const Span& span) {
                         return span.from_s <= time_s && time_s <= span.to_s;
                       });
    Compare(scene, one, other, !jumps, errors);
  }
  if (!any) throw Failure(ExitCode::kUsage, "two simulations of one scene have no sample of the same time");
  return errors;
}

}  // namespace rollgait::client
