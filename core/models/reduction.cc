#include "core/models/reduction.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/check.h"
#include "core/base/field_path.h"
#include "core/models/rigid_body.h"

namespace rollgait {
namespace {

constexpr double kMoves = std::numeric_limits<double>::quiet_NaN();

// Fixed position of every joint, kMoves for those that are not fixed.
std::vector<double> FixedPositions(const Model& model, const std::map<std::string, double>& locked,
                                   Violations* violations) {
  std::vector<double> fixed(model.size(), kMoves);
  size_t left = model.joints().size();
  for (const auto& [name, position] : locked) {
    const std::string field = Keyed("locked_joints_rad", name);
    const int joint = model.Find(name);
    if (joint < 0) {
      violations->push_back({field, "the model has no joint of that name; see GetModel for its joints"});
    } else if (model.joint(joint).kind().is_free()) {
      violations->push_back({field, "is a free joint, which cannot be locked; lock joints with one degree of freedom"});
    } else if (!std::isfinite(position)) {
      violations->push_back({field, "is not a finite number; give the position to lock the joint at"});
    } else {
      fixed[joint] = position;
      --left;
    }
  }
  if (left == 0) violations->push_back({"locked_joints_rad", "locks every joint; leave at least one free"});
  return fixed;
}

bool IsSymmetric(const Model& model, const std::vector<double>& fixed) {
  for (int i = 0; i < model.size(); ++i) {
    const Joint& joint = model.joint(i);
    const double image = joint.mirror_sign * fixed[joint.mirror_joint];
    if (std::isnan(fixed[i]) != std::isnan(image)) return false;
    if (!std::isnan(fixed[i]) && fixed[i] != image) return false;
  }
  return true;
}

// The joint frame in the link that carries the parent; then moved by the fixed position.
ModelReduction::Place JointFrame(const Joint& joint, const std::vector<ModelReduction::Place>& places) {
  if (joint.parent < 0) return {-1, joint.R_PJ, joint.p_PJ};
  const ModelReduction::Place& parent = places[joint.parent];
  return {parent.joint, parent.R_KL * joint.R_PJ, parent.p_KL + parent.R_KL * joint.p_PJ};
}

ModelReduction::Place Moved(const Joint& joint, double position, ModelReduction::Place frame) {
  const double advance = joint.Advance();
  if (advance != 0) frame.p_KL += frame.R_KL * joint.axis * (advance * position);
  // At zero exactly the identity, so that nothing is lost to rounding.
  if (joint.kind().turns && position != 0) {
    frame.R_KL *= Eigen::AngleAxisd(position, joint.axis).toRotationMatrix();
  }
  return frame;
}

void SetLumped(const std::vector<RigidBody>& bodies, Joint* joint) {
  if (bodies.empty()) return;
  const RigidBody body = Lumped(bodies);
  joint->mass = body.mass;
  joint->center_of_mass = body.center_of_mass;
  joint->inertia = 0.5 * (body.inertia + body.inertia.transpose());
}

}  // namespace

Result<ModelReduction> ReduceModel(const Model& model, const std::map<std::string, double>& locked) {
  Violations violations;
  const std::vector<double> fixed = FixedPositions(model, locked, &violations);
  if (!violations.empty()) return violations;

  std::vector<int> kept;
  std::vector<ModelReduction::Place> places;
  std::vector<Joint> joints;
  std::vector<std::vector<RigidBody>> bodies;  // fixed to each other on one link
  std::vector<int> index(model.size(), -1);
  for (int i = 0; i < model.size(); ++i) {
    const Joint& joint = model.joint(i);
    const ModelReduction::Place frame = JointFrame(joint, places);
    if (std::isnan(fixed[i])) {
      index[i] = static_cast<int>(joints.size());
      kept.push_back(i);
      places.push_back({index[i], Matrix3::Identity(), Vector3::Zero()});
      joints.push_back(joint);
      joints.back().parent = frame.joint;
      joints.back().R_PJ = frame.R_KL;
      joints.back().p_PJ = frame.p_KL;
      bodies.emplace_back();
    } else {
      places.push_back(Moved(joint, fixed[i], frame));
    }
    const ModelReduction::Place& place = places.back();
    if (place.joint < 0 || joint.mass == 0) continue;
    if (bodies[place.joint].empty()) joints[place.joint].link = joint.link;  // named after the first that has mass
    bodies[place.joint].push_back(Placed({joint.mass, joint.center_of_mass, joint.inertia}, place.R_KL, place.p_KL));
  }
  const bool symmetric = IsSymmetric(model, fixed);
  for (size_t k = 0; k < joints.size(); ++k) {
    SetLumped(bodies[k], &joints[k]);
    joints[k].mirror_joint = symmetric ? index[model.joint(kept[k]).mirror_joint] : static_cast<int>(k);
    if (!symmetric) joints[k].mirror_sign = 1;
  }
  Result<Model> reduced = Model::Create(std::move(joints));
  if (!reduced.ok()) return reduced.violations();
  return ModelReduction{std::move(reduced).value(), std::move(kept), std::move(places), symmetric};
}

ContactSurface ReduceContact(const ContactSurface& contact, const ModelReduction& reduction) {
  const ModelReduction::Place& place = reduction.places[contact.joint];
  ROLLGAIT_CHECK(place.joint >= 0);
  ContactSurface reduced = contact;
  reduced.joint = place.joint;
  reduced.p_LE = place.p_KL + place.R_KL * contact.p_LE;
  reduced.R_LE = place.R_KL * contact.R_LE;
  return reduced;
}

BodySurface ReduceBody(const BodySurface& body, const ModelReduction& reduction) {
  const ModelReduction::Place& place = reduction.places[body.joint];
  ROLLGAIT_CHECK(place.joint >= 0);
  BodySurface reduced = body;
  reduced.joint = place.joint;
  reduced.placed.p_BE = place.p_KL + place.R_KL * body.placed.p_BE;
  reduced.placed.R_BE = place.R_KL * body.placed.R_BE;
  return reduced;
}

std::vector<BodyPair> ReducePairs(const std::vector<BodyPair>& pairs, const std::vector<BodySurface>& reduced_bodies) {
  const auto moves = [&](const BodyPair& pair) {
    return reduced_bodies[pair.first].joint != reduced_bodies[pair.second].joint;
  };
  std::vector<int> index(pairs.size(), -1);
  int kept = 0;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (moves(pairs[i])) index[i] = kept++;
  }
  std::vector<BodyPair> reduced;
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (index[i] < 0) continue;
    reduced.push_back(pairs[i]);
    const int image = index[pairs[i].mirror_pair];
    reduced.back().mirror_pair = image >= 0 ? image : index[i];
  }
  return reduced;
}

}  // namespace rollgait
