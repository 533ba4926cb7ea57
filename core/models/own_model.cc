#include "core/models/own_model.h"

#include <algorithm>
#include <utility>

#include "core/models/own_model_check.h"
#include "core/multibody/joint_number.h"

namespace rollgait {
namespace {

// How Model::Create names a field of a joint, as rollgait.v1.Joint does.
std::string WireField(const std::string& field) {
  constexpr std::pair<const char*, const char*> kNames[] = {{"p_PJ", "origin_m"},
                                                            {"R_PJ", "orientation"},
                                                            {"center_of_mass", "center_of_mass_m"},
                                                            {"inertia", "inertia_kg_m2"}};
  for (const auto& [ours, wire] : kNames) {
    if (field == ours) return wire;
  }
  for (const JointNumber& number : kJointNumbers) {
    if (field == number.name) return number.field;
  }
  return field;
}

// What Model::Create says, with the names of joint and link before it.
Violations OfModel(const Violations& violations, const OwnModel& own) {
  Violations named;
  for (const Violation& violation : violations) {
    const size_t bracket = violation.field.find('['), dot = violation.field.rfind('.');
    if (bracket == std::string::npos) {
      named.push_back(violation);
      continue;
    }
    const int index = std::stoi(violation.field.substr(bracket + 1));
    const Joint& joint = own.joints[index];
    named.push_back({JointPath(own.chains, index, WireField(violation.field.substr(dot + 1))),
                     "of joint \"" + joint.name + "\", link \"" + joint.link + "\": " + violation.message});
  }
  return named;
}

// Hip joint to the lowest point of the feet, m; of the longer leg. Contract: hips and contacts on both sides.
double LegLength(const OwnModelCheck& check, const Model& model) {
  double length = -kInfinity;
  for (const BodySide side : {BodySide::kLeft, BodySide::kRight}) {
    const int hip = model.Find(JointRole::kHipFlexion, side);
    for (const ContactSurface& contact : check.own.contacts) {
      if (contact.side == side) length = std::max(length, check.p_WL[hip].z() - check.Lowest(contact));
    }
  }
  return length;
}

// The pair of the mirror images of two bodies; itself if the model has no such pair.
int MirrorPair(const OwnModel& own, int index) {
  const int first = own.bodies[own.pairs[index].first].mirror_body;
  const int second = own.bodies[own.pairs[index].second].mirror_body;
  for (size_t k = 0; k < own.pairs.size(); ++k) {
    const BodyPair& pair = own.pairs[k];
    if ((pair.first == first && pair.second == second) || (pair.first == second && pair.second == first)) {
      return static_cast<int>(k);
    }
  }
  return index;
}

}  // namespace

Result<Scene> OwnScene(const OwnModel& own) {
  OwnModelCheck check(own);
  CheckOwnSizes(&check);
  if (!check.ok()) return check.Take();
  Result<Model> created = Model::Create(own.joints);
  if (!created.ok()) return OfModel(created.violations(), own);
  const Model& model = created.value();
  check.PlaceLinks();
  CheckOwnBase(&check);
  for (const BodySide side : {BodySide::kLeft, BodySide::kRight}) {
    const char* const name = side == BodySide::kLeft ? "left" : "right";
    if (model.Find(JointRole::kHipFlexion, side) < 0) {
      check.RefuseModel("joints", "have no ROLE_HIP_FLEXION on the ", name,
                        " side; say which joint swings each leg forward");
    }
    if (std::none_of(own.contacts.begin(), own.contacts.end(),
                     [side](const ContactSurface& contact) { return contact.side == side; })) {
      check.RefuseModel("contacts", "have none on the ", name, " side; give each foot at least one surface");
    }
  }
  if (!check.ok()) return check.Take();
  const double measured = LegLength(check, model);
  CheckOwnUnits(measured, &check);
  if (!check.ok()) return check.Take();
  CheckOwnJoints(measured, &check);
  CheckOwnChains(&check);
  CheckOwnFeet(measured, &check);
  CheckOwnMirror(measured, &check);
  if (own.leg_length && !(*own.leg_length >= measured / 2 && *own.leg_length <= 2 * measured)) {
    check.RefuseModel("leg_length_m", "is ", *own.leg_length, " m; from hip to sole at position zero it is ", measured,
                      " m: give between half and twice that, or leave it out");
  }
  if (!check.ok()) return check.Take();

  BodySelection selection;
  selection.model = own.name;
  selection.mass = model.total_mass();
  selection.own = true;
  const auto mirrors = [](const Joint& joint) { return joint.mirror_sign < 0; };
  bool symmetric = std::any_of(model.joints().begin(), model.joints().end(), mirrors);
  for (int i = 0; i < model.size(); ++i) symmetric = symmetric || model.joint(i).mirror_joint != i;
  Scene scene{.name = own.name,
              .description = own.description,
              .selection = std::move(selection),
              .model = model,
              .contacts = own.contacts,
              .leg_length = own.leg_length.value_or(measured),
              .sources = own.sources,
              .symmetric = symmetric,
              .bodies = own.bodies,
              .pairs = own.pairs,
              .chains = own.chains};
  for (int i = 0; i < static_cast<int>(scene.pairs.size()); ++i) scene.pairs[i].mirror_pair = MirrorPair(own, i);
  return scene;
}

}  // namespace rollgait
