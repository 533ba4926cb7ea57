#include "core/validation/gait_cycle.h"

#include <algorithm>
#include <string>

#include "core/base/check.h"

namespace rollgait {
namespace {

// The joint of a leg that is closest to the pelvis, -1 if there is none.
int LegRoot(const Model& model, const std::string& suffix) {
  for (const char* name : {"hip", "knee", "ankle"}) {
    const int joint = model.Find(name + suffix);
    if (joint >= 0) return joint;
  }
  return -1;
}

// Which contacts hang on a joint.
std::vector<bool> ContactsBeyond(const Scene& scene, int joint) {
  std::vector<bool> beyond;
  for (const ContactSurface& contact : scene.contacts) {
    beyond.push_back(joint >= 0 && scene.model.IsAncestor(joint, contact.joint));
  }
  return beyond;
}

double Length(const TrajectoryPhase& phase) { return phase.node_times.back() - phase.node_times.front(); }

}  // namespace

int RightJoint(const Model& model, const std::string& name) { return model.Find(name + "_r"); }

std::optional<GaitCycle> GaitCycle::Of(const Scene& scene, const Trajectory& trajectory) {
  const int root = LegRoot(scene.model, "_r");
  if (root < 0) return std::nullopt;
  ROLLGAIT_CHECK(scene.symmetric || trajectory.cycle == Cycle::kFull);
  GaitCycle cycle(scene, trajectory);
  cycle.right_ = ContactsBeyond(scene, root);
  const std::vector<bool> left = ContactsBeyond(scene, LegRoot(scene.model, "_l"));

  std::vector<Piece> pieces;
  const int spans = trajectory.cycle == Cycle::kHalf ? 2 : 1;
  for (int span = 0; span < spans; ++span) {
    for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
      Piece piece{0, p, span == 1, span * trajectory.displacement, false, false};
      for (const int c : trajectory.phases[p].contacts) {
        const int contact = piece.mirrored ? scene.contacts[c].mirror_contact : c;
        piece.right = piece.right || cycle.right_[contact];
        piece.left = piece.left || left[contact];
      }
      pieces.push_back(piece);
    }
  }
  const size_t n = pieces.size();
  size_t strike = 0;
  while (strike < n && !(pieces[strike].right && !pieces[(strike + n - 1) % n].right)) ++strike;
  if (strike == n) return std::nullopt;
  cycle.displacement_ = spans * trajectory.displacement;
  for (size_t i = strike; i < strike + n; ++i) {
    Piece piece = pieces[i % n];
    piece.start = cycle.duration_;
    if (i >= n) piece.shift += cycle.displacement_;
    cycle.duration_ += Length(trajectory.phases[piece.phase]);
    cycle.pieces_.push_back(piece);
  }
  return cycle;
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
  while (place > 0 && pieces_[place].start > time) --place;
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
  const int base_x = scene_->model.Find("base_x");
  if (base_x >= 0) sample.position[base_x] += piece.shift;
  return sample;
}

double GaitCycle::Stance() const {
  double sum = 0;
  for (size_t i = 0; i < pieces_.size(); ++i) sum += pieces_[i].right ? End(i) - pieces_[i].start : 0;
  return sum / duration_;
}

double GaitCycle::DoubleSupport() const {
  double sum = 0;
  for (size_t i = 0; i < pieces_.size(); ++i) {
    sum += pieces_[i].right && pieces_[i].left ? End(i) - pieces_[i].start : 0;
  }
  return sum / duration_;
}

std::optional<double> GaitCycle::FirstChange(bool Piece::*leg, bool on) const {
  for (size_t i = 1; i < pieces_.size(); ++i) {
    if (pieces_[i].*leg == on && pieces_[i - 1].*leg != on) return 100 * pieces_[i].start / duration_;
  }
  return std::nullopt;
}

std::optional<double> GaitCycle::OppositeToeOff() const { return FirstChange(&Piece::left, false); }
std::optional<double> GaitCycle::OppositeHeelStrike() const { return FirstChange(&Piece::left, true); }
std::optional<double> GaitCycle::ToeOff() const { return FirstChange(&Piece::right, false); }

}  // namespace rollgait
