#include "core/validation/gait_cycle.h"

#include <algorithm>
#include <string>

#include "core/base/check.h"

namespace rollgait {
namespace {

// Which contacts belong to the leg of a side.
std::vector<bool> ContactsOn(const Scene& scene, BodySide side) {
  std::vector<bool> on;
  for (const ContactSurface& contact : scene.contacts) on.push_back(contact.side == side);
  return on;
}

double Length(const TrajectoryPhase& phase) { return phase.node_times.back() - phase.node_times.front(); }

}  // namespace

std::optional<GaitCycle> GaitCycle::Of(const Scene& scene, const Trajectory& trajectory, BodySide side) {
  const std::vector<bool> leg = ContactsOn(scene, side);
  if (std::find(leg.begin(), leg.end(), true) == leg.end()) return std::nullopt;
  ROLLGAIT_CHECK(scene.symmetric || trajectory.cycle == Cycle::kFull);
  GaitCycle cycle(scene, trajectory);
  cycle.right_ = ContactsOn(scene, BodySide::kRight);
  cycle.left_ = ContactsOn(scene, BodySide::kLeft);

  std::vector<Piece> pieces;
  std::vector<double> starts;  // s, from the start of the trajectory
  const int halves = trajectory.cycle == Cycle::kHalf ? 2 : 1;
  double time = 0;
  for (int half = 0; half < halves; ++half) {
    for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
      pieces.push_back({0, p, half == 1, half * trajectory.displacement});
      starts.push_back(time);
      time += Length(trajectory.phases[p]);
    }
  }
  const size_t n = pieces.size();
  const auto on = [&](size_t i) { return cycle.Touches(pieces[i % n], leg); };
  size_t strike = 0;
  while (strike < n && !(on(strike) && !on(strike + n - 1))) ++strike;
  if (strike == n) return std::nullopt;
  cycle.start_ = starts[strike];
  cycle.displacement_ = halves * trajectory.displacement;
  for (size_t i = strike; i < strike + n; ++i) {
    Piece piece = pieces[i % n];
    piece.start = cycle.duration_;
    if (i >= n) piece.shift += cycle.displacement_;
    cycle.duration_ += Length(trajectory.phases[piece.phase]);
    cycle.pieces_.push_back(piece);
  }
  cycle.BuildSpans();
  return cycle;
}

std::vector<int> GaitCycle::ContactsOf(const Piece& piece) const {
  std::vector<int> contacts = trajectory_->phases[piece.phase].contacts;
  if (piece.mirrored) {
    for (int& contact : contacts) contact = scene_->contacts[contact].mirror_contact;
  }
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

bool GaitCycle::Touches(const Piece& piece, const std::vector<bool>& leg) const {
  const std::vector<int> contacts = ContactsOf(piece);
  return std::any_of(contacts.begin(), contacts.end(), [&](int contact) { return leg[contact]; });
}

void GaitCycle::BuildSpans() {
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const std::vector<int> contacts = ContactsOf(pieces_[i]);
    const double end = i + 1 < pieces_.size() ? 100 * End(i) / duration_ : 100;
    if (!spans_.empty() && spans_.back().contacts == contacts) {
      spans_.back().end = end;
      continue;
    }
    spans_.push_back(
        {100 * pieces_[i].start / duration_, end, contacts, Touches(pieces_[i], right_), Touches(pieces_[i], left_)});
  }
}

MotionSample GaitCycle::Mirrored(const MotionSample& sample) const {
  const Model& model = scene_->model;
  MotionSample image = sample;
  std::vector<int> effort_of(model.size(), -1);
  for (size_t a = 0; a < model.actuated().size(); ++a) effort_of[model.actuated()[a]] = static_cast<int>(a);
  for (int j = 0; j < model.size(); ++j) {
    const int source = model.joint(j).mirror_joint;
    const double sign = model.joint(j).mirror_sign;
    image.position[j] = sign * sample.position[source];
    image.velocity[j] = sign * sample.velocity[source];
    image.acceleration[j] = sign * sample.acceleration[source];
    if (effort_of[j] >= 0) image.efforts[effort_of[j]] = sign * sample.efforts[effort_of[source]];
  }
  for (size_t c = 0; c < scene_->contacts.size(); ++c) {
    const Vector3 force = sample.forces.segment<3>(3 * scene_->contacts[c].mirror_contact);
    image.forces.segment<3>(3 * static_cast<int>(c)) = Vector3(force.x(), -force.y(), force.z());
  }
  return image;
}

MotionSample GaitCycle::At(double percent) const {
  ROLLGAIT_CHECK(percent >= 0 && percent <= 100);
  const double time = percent / 100 * duration_;
  size_t place = pieces_.size() - 1;
  const double rounding = 1e-12 * duration_;  // of sums of durations
  while (place > 0 && pieces_[place].start > time + rounding) --place;
  const Piece& piece = pieces_[place];
  const TrajectoryPhase& phase = trajectory_->phases[piece.phase];
  const double local = phase.node_times.front() + time - piece.start;
  int interval = static_cast<int>(phase.node_times.size()) - 2;
  while (interval > 0 && phase.node_times[interval] > local) --interval;
  const double begin = phase.node_times[interval], length = phase.node_times[interval + 1] - begin;
  MotionSample sample = Sample(*trajectory_, piece.phase, interval, std::clamp((local - begin) / length, 0.0, 1.0));

  VectorX forces = VectorX::Zero(3 * static_cast<int>(scene_->contacts.size()));
  for (size_t c = 0; c < phase.contacts.size(); ++c) {
    forces.segment<3>(3 * phase.contacts[c]) = sample.forces.segment<3>(3 * static_cast<int>(c));
  }
  sample.forces = forces;
  if (piece.mirrored) sample = Mirrored(sample);
  const int forward = scene_->model.Find(JointRole::kBaseForward);
  if (forward >= 0) sample.position[forward] += piece.shift;
  return sample;
}

}  // namespace rollgait
