#include "client/formats/ground_reaction.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "client/failure.h"
#include "client/gait_events_table.h"
#include "client/report/kinematics.h"

namespace rollgait::client {
namespace {

constexpr double kLeastNormalForce_n = 1e-3;

int CommonJoint(const v1::Model& model, const std::vector<int>& contacts) {
  for (const int contact : contacts) {
    if (model.contacts(contact).joint() != model.contacts(contacts.front()).joint()) return -1;
  }
  return contacts.empty() ? -1 : model.contacts(contacts.front()).joint();
}

int ContactIndex(const v1::Model& model, const std::string& name) {
  for (int c = 0; c < model.contacts_size(); ++c) {
    if (model.contacts(c).name() == name) return c;
  }
  throw Failure(ExitCode::kUsage, "gait_events.feet names the contact \"" + name + "\", which the model does not have");
}

// Of the contacts on the ground; `on_ground` says whether there is one.
Reaction ReactionAt(const Instant& instant, const v1::Model& model, const Plate& plate, bool& on_ground) {
  Reaction reaction{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // about the origin
  on_ground = false;
  const std::vector<Pose> poses = LinkPoses(model, instant.position);
  for (const int c : plate.contacts) {
    if (!instant.active[c]) continue;
    const Eigen::Vector3d point = LowestPoint(model.contacts(c), poses);
    const Eigen::Vector3d force(instant.force[c][0], instant.force[c][1], instant.force[c][2]);
    if (!on_ground) reaction.point = {point.x(), point.y(), 0};
    on_ground = true;
    reaction.force += force;
    moment += point.cross(force);
  }
  const double normal = reaction.force.z();
  if (normal >= kLeastNormalForce_n) reaction.point = {-moment.y() / normal, moment.x() / normal, 0};
  reaction.couple = moment - reaction.point.cross(reaction.force);
  if (normal >= kLeastNormalForce_n) reaction.couple.head<2>().setZero();
  return reaction;
}

}  // namespace

std::vector<Plate> FootPlates(const v1::Solve& solve) {
  const v1::Model& model = solve.result().model();
  std::vector<Plate> plates;
  for (const v1::FootOnGround& foot : solve.result().gait_events().feet()) {
    Plate plate{SideName(foot.foot()), {}, -1};
    for (const std::string& contact : foot.contacts()) plate.contacts.push_back(ContactIndex(model, contact));
    plate.joint = CommonJoint(model, plate.contacts);
    plates.push_back(std::move(plate));
  }
  if (plates.empty()) {
    for (int c = 0; c < model.contacts_size(); ++c) {
      plates.push_back({model.contacts(c).name(), {c}, model.contacts(c).joint()});
    }
  }
  return plates;
}

std::vector<Plate> LinkPlates(const v1::Solve& solve) {
  const v1::Model& model = solve.result().model();
  std::vector<Plate> plates;
  for (const Plate& foot : FootPlates(solve)) {
    if (foot.joint >= 0) {
      plates.push_back(foot);
      continue;
    }
    std::vector<Plate> links;
    for (const int c : foot.contacts) {
      const int joint = model.contacts(c).joint();
      const auto known = std::find_if(links.begin(), links.end(), [&](const Plate& p) { return p.joint == joint; });
      if (known != links.end()) {
        known->contacts.push_back(c);
      } else {
        links.push_back({model.joints(joint).link_name(), {c}, joint});
      }
    }
    plates.insert(plates.end(), links.begin(), links.end());
  }
  return plates;
}

std::vector<Reaction> Reactions(const Stride& stride, const v1::Model& model, const Plate& plate) {
  std::vector<Reaction> reactions;
  std::vector<bool> on_ground;
  for (const StrideSample& sample : stride.samples) {
    bool touches = false;
    reactions.push_back(ReactionAt(sample.instant, model, plate, touches));
    on_ground.push_back(touches);
  }
  const auto first = std::find(on_ground.begin(), on_ground.end(), true);
  if (first == on_ground.end()) return reactions;
  size_t last = first - on_ground.begin();
  for (size_t i = 0; i < reactions.size(); ++i) {
    if (on_ground[i]) last = i;
    if (!on_ground[i]) reactions[i].point = reactions[last].point;
  }
  return reactions;
}

}  // namespace rollgait::client
