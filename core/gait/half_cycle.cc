#include "core/gait/half_cycle.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/gait/added_constraints.h"
#include "core/gait/mesh_sequence.h"
#include "core/models/mirror_image.h"

namespace rollgait {
namespace {

std::vector<int> MirrorImage(std::vector<int> contacts, const Scene& scene) {
  for (int& contact : contacts) contact = scene.contacts[static_cast<size_t>(contact)].mirror_contact;
  return contacts;
}

bool AreMirrorImages(const GaitSpec::Phase& phase, const GaitSpec::Phase& other, const Scene& scene) {
  const std::vector<int> image = MirrorImage(phase.contacts, scene);
  return phase.intervals == other.intervals && phase.min_duration == other.min_duration &&
         phase.max_duration == other.max_duration &&
         std::is_permutation(image.begin(), image.end(), other.contacts.begin(), other.contacts.end());
}

// Limits of joints that a request may set for one side alone.
bool AreMirrorImages(const Joint& joint, const Joint& other) {
  const double sign = joint.mirror_sign;
  return IsMirroredRange(joint.position_min, joint.position_max, other.position_min, other.position_max, sign) &&
         IsMirroredRange(joint.effort_min, joint.effort_max, other.effort_min, other.effort_max, sign) &&
         joint.velocity_max == other.velocity_max;
}

// Whether a cost weighs both sides alike.
struct IsSymmetric {
  const Model& model;

  // A position that is held, alike on both sides, means the same in either step; but not that of the base along x and
  // y: the second step is further on, and a step lies beside its mirror image, a full cycle where it starts.
  bool operator()(const cost::Tracking& tracking) const {
    return std::all_of(tracking.channels.begin(), tracking.channels.end(), [&](const auto& channel) {
      const JointRole role = model.joint(model.Find(channel.joint)).role;
      if (role == JointRole::kBaseForward || role == JointRole::kBaseLateral) return false;
      const double held = channel.positions.front();
      for (const double position : channel.positions) {
        if (position != held) return false;
      }
      const Joint& joint = model.joint(model.Find(channel.joint));
      const std::string& image = model.joint(joint.mirror_joint).name;
      return std::any_of(tracking.channels.begin(), tracking.channels.end(), [&](const auto& other) {
        return other.joint == image && other.weight == channel.weight &&
               other.positions.front() == joint.mirror_sign * held;
      });
    });
  }
  template <typename Term>
  bool operator()(const Term& term) const {
    if constexpr (requires { term.joint_weights; }) {
      return std::all_of(term.joint_weights.begin(), term.joint_weights.end(), [&](const auto& named) {
        const int joint = model.Find(named.first);
        const auto image = term.joint_weights.find(model.joint(model.joint(joint).mirror_joint).name);
        return image != term.joint_weights.end() && image->second == named.second;
      });
    }
    return true;
  }
};

// Turns what belongs to the first step into what belongs to the second.
class Mirror {
 public:
  Mirror(const Scene& scene, double displacement)
      : scene_(scene), forward_(scene.model.Find(JointRole::kBaseForward)), displacement_(displacement) {
    place_.assign(static_cast<size_t>(scene.model.size()), -1);
    const std::vector<int>& actuated = scene.model.actuated();
    for (size_t a = 0; a < actuated.size(); ++a) place_[static_cast<size_t>(actuated[a])] = static_cast<int>(a);
  }

  // A row a joint; the base has moved on.
  MatrixX Positions(const MatrixX& of) const {
    MatrixX image = Joints(of);
    image.row(forward_).array() += displacement_;
    return image;
  }
  // A row a joint: velocities, accelerations.
  MatrixX Joints(const MatrixX& of) const {
    MatrixX image(of.rows(), of.cols());
    for (int j = 0; j < scene_.model.size(); ++j) {
      image.row(j) = scene_.model.joint(j).mirror_sign * of.row(scene_.model.joint(j).mirror_joint);
    }
    return image;
  }
  // A row an actuated joint.
  MatrixX Efforts(const MatrixX& of) const {
    MatrixX image(of.rows(), of.cols());
    for (const int j : scene_.model.actuated()) {
      const Joint& joint = scene_.model.joint(j);
      image.row(Place(j)) = joint.mirror_sign * of.row(Place(joint.mirror_joint));
    }
    return image;
  }
  // Three rows a contact, from the order of `contacts` to that of `images`.
  MatrixX Forces(const MatrixX& of, const std::vector<int>& contacts, const std::vector<int>& images) const {
    MatrixX image(of.rows(), of.cols());
    const std::vector<int> mirrored = MirrorImage(contacts, scene_);
    for (size_t c = 0; c < images.size(); ++c) {
      const auto source = std::find(mirrored.begin(), mirrored.end(), images[c]) - mirrored.begin();
      const int to = 3 * static_cast<int>(c);
      image.middleRows<3>(to) = of.middleRows<3>(3 * static_cast<int>(source));
      image.row(to + 1) *= -1;
    }
    return image;
  }

  BoundedBetween Bounds(const BoundedBetween& of) const {
    BoundedBetween image = of;
    for (std::vector<int>* joints : {&image.range, &image.velocity, &image.effort}) {
      for (int& joint : *joints) joint = scene_.model.joint(joint).mirror_joint;
      std::sort(joints->begin(), joints->end());
    }
    for (FrictionEdge& edge : image.friction) {
      edge.contact = scene_.contacts[static_cast<size_t>(edge.contact)].mirror_contact;
      edge.direction = (FrictionEdge::kDirections - edge.direction) % FrictionEdge::kDirections;
    }
    std::sort(image.friction.begin(), image.friction.end());
    return image;
  }

 private:
  int Place(int joint) const { return place_[static_cast<size_t>(joint)]; }

  const Scene& scene_;
  int forward_;
  double displacement_;
  std::vector<int> place_;  // of a joint among the actuated ones
};

TrajectoryPhase SecondStep(const TrajectoryPhase& phase, const std::vector<int>& contacts, double later,
                           const Mirror& mirror) {
  TrajectoryPhase image = phase;
  image.contacts = contacts;
  image.start += later;
  for (std::vector<double>* times : {&image.node_times, &image.point_times}) {
    for (double& time : *times) time += later;
  }
  image.node_positions = mirror.Positions(phase.node_positions);
  image.node_velocities = mirror.Joints(phase.node_velocities);
  image.point_positions = mirror.Positions(phase.point_positions);
  image.point_velocities = mirror.Joints(phase.point_velocities);
  image.point_accelerations = mirror.Joints(phase.point_accelerations);
  image.point_efforts = mirror.Efforts(phase.point_efforts);
  image.point_forces = mirror.Forces(phase.point_forces, phase.contacts, contacts);
  if (phase.impulses.size() > 0) image.impulses = mirror.Forces(phase.impulses, phase.contacts, contacts);
  return image;
}

// A step lies beside its mirror image; a full cycle starts with the base at y = 0.
void StartInTheMiddle(const Scene& scene, Trajectory* trajectory) {
  const int lateral = scene.model.Find(JointRole::kBaseLateral);
  if (lateral < 0) return;
  const double start = trajectory->phases.front().node_positions(lateral, 0);
  for (TrajectoryPhase& phase : trajectory->phases) {
    phase.node_positions.row(lateral).array() -= start;
    phase.point_positions.row(lateral).array() -= start;
  }
}

}  // namespace

std::optional<GaitSpec> HalfCycleOf(const GaitSpec& spec) {
  const Model& model = spec.scene.model;
  const size_t count = spec.phases.size() / 2;
  if (spec.cycle != Cycle::kFull || !spec.scene.symmetric || spec.phases.size() != 2 * count) return std::nullopt;
  for (size_t p = 0; p < count; ++p) {
    if (!AreMirrorImages(spec.phases[p], spec.phases[count + p], spec.scene)) return std::nullopt;
  }
  for (const Joint& joint : model.joints()) {
    if (!AreMirrorImages(joint, model.joint(joint.mirror_joint))) return std::nullopt;
  }
  for (const GaitSpec::CostTerm& cost : spec.costs) {
    if (!std::visit(IsSymmetric{model}, cost.term)) return std::nullopt;
  }
  GaitSpec half = spec;
  half.cycle = Cycle::kHalf;
  half.phases.resize(count);
  return half;
}

WarmStart BothSteps(const GaitSpec& spec, const GaitSolution& half) {
  WarmStart start = StartFrom(spec, half);
  start.multipliers.reset();
  Trajectory& both = start.trajectory;
  const Mirror mirror(spec.scene, both.displacement);
  const size_t count = both.phases.size();
  start.added.between.resize(count);
  for (size_t p = 0; p < count; ++p) {
    both.phases.push_back(SecondStep(both.phases[p], spec.phases[count + p].contacts, both.duration, mirror));
    start.added.between.push_back(mirror.Bounds(start.added.between[p]));
  }
  // Bodies that are kept apart in one step are so in the other, on the other side.
  std::vector<int> images;
  for (const int pair : start.added.separated) {
    images.push_back(spec.scene.pairs[static_cast<size_t>(pair)].mirror_pair);
  }
  KeepApart(images, &start.added);
  StartInTheMiddle(spec.scene, &both);
  both.cycle = Cycle::kFull;
  both.duration *= 2;
  both.displacement *= 2;
  return start;
}

}  // namespace rollgait
