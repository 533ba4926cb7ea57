#include "core/models/human_scene.h"

#include <algorithm>
#include <numbers>
#include <sstream>
#include <utility>

#include "core/base/check.h"
#include "core/base/field_path.h"
#include "core/models/human.h"
#include "core/models/mirror_image.h"
#include "core/models/reduction.h"
#include "core/models/subject_changes.h"

namespace rollgait {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// Which switch of the selection fixes a joint, null if none does.
const char* FixedBy(const Joint& joint, const BodySelection& selection) {
  const bool lateral = joint.kind().is_slide() ? joint.axis.y() != 0 : joint.axis.y() == 0;
  if (selection.sagittal && lateral) return "sagittal";
  if (selection.drop_arms && (joint.name.starts_with("shoulder") || joint.name.starts_with("elbow"))) {
    return "drop_arms";
  }
  if (selection.rigid_trunk && joint.name.starts_with("trunk_")) return "rigid_trunk";
  return nullptr;
}

// What is wrong with locking a joint of the full human, empty if nothing is.
std::string LockProblem(const Joint& joint, double angle, const BodySelection& selection) {
  std::ostringstream message;
  if (IsOfBase(joint.role)) {
    message << "belongs to the floating base, which cannot be locked; use `sagittal` for a walk in the plane";
  } else if (const char* fixed = FixedBy(joint, selection)) {
    message << "is fixed already by `" << fixed << "`"
            << (selection.model == "planar" ? ", which is part of the model \"planar\"" : "")
            << "; leave one of the two out";
  } else if (!(angle >= joint.position_min && angle <= joint.position_max)) {
    message << "is " << angle << " rad (" << angle / kRadiansPerDegree << " deg); must be within the joint's range, "
            << joint.position_min << " to " << joint.position_max << " rad (" << joint.position_min / kRadiansPerDegree
            << " to " << joint.position_max / kRadiansPerDegree << " deg)";
  }
  return message.str();
}

// Every joint to fix and where, by the switches and by name.
std::map<std::string, double> CheckLocks(const Model& model, const BodySelection& selection, Violations* violations) {
  std::map<std::string, double> locked;
  for (const auto& [name, angle] : selection.locked_joints) {
    const std::string field = Keyed("locked_joints_rad", name);
    const int joint = model.Find(name);
    if (joint < 0) {
      std::vector<std::string> known;
      for (const Joint& each : model.joints()) {
        if (!IsOfBase(each.role) && FixedBy(each, selection) == nullptr) known.push_back(each.name);
      }
      violations->push_back({field, NoSuchJoint(name, known)});
      continue;
    }
    const std::string problem = LockProblem(model.joint(joint), angle, selection);
    if (problem.empty())
      locked[name] = angle;
    else
      violations->push_back({field, problem});
  }
  int driven = 0;
  for (const Joint& joint : model.joints()) {
    if (FixedBy(joint, selection) != nullptr) locked[joint.name] = 0;
    driven += joint.actuated && locked.count(joint.name) == 0;
  }
  if (driven == 0) {
    violations->push_back({"locked_joints_rad", "leaves no joint that a muscle could move; leave at least one free"});
  }
  return locked;
}

// A model takes no pair of joints of which one alone has muscles: both become their own images. True if there was none.
bool UnpairUnlike(std::vector<Joint>* joints) {
  bool alike = true;
  for (size_t i = 0; i < joints->size(); ++i) {
    const auto image = static_cast<size_t>((*joints)[i].mirror_joint);
    if ((*joints)[i].actuated == (*joints)[image].actuated) continue;
    alike = false;
    (*joints)[image].mirror_joint = static_cast<int>(image);
    (*joints)[i].mirror_joint = static_cast<int>(i);
  }
  return alike;
}

}  // namespace

Result<Scene> HumanScene(const BodySelection& selection) {
  Violations violations;
  const bool toes_fit = selection.feet != FootShape::kOneEllipsoid;
  if (selection.toes && !toes_fit) {
    violations.push_back({"toes",
                          "needs feet of two ellipsoids: one that spans heel and toes cannot bend; leave `feet` "
                          "unset or set it to FEET_TWO_ELLIPSOIDS"});
  }
  const SidedTables tables = TablesOf(selection, &violations);
  const SidedFeet feet = FeetOf(selection, tables, &violations);
  const HumanBody human = Human(tables.left, tables.right,
                                {selection.feet, selection.ranges, selection.toes && toes_fit, feet.left, feet.right});
  const std::map<std::string, double> locked = CheckLocks(human.model, selection, &violations);
  std::vector<Joint> joints = ChangedJoints(human.model, tables, selection, locked, &violations);
  if (!violations.empty()) return violations;

  const bool alike = UnpairUnlike(&joints) && feet.left == feet.right;
  const Result<Model> changed = Model::Create(std::move(joints));
  if (!changed.ok()) return changed.violations();
  Result<ModelReduction> reduction = ReduceModel(changed.value(), locked);
  if (!reduction.ok()) return reduction.violations();
  std::vector<ContactSurface> contacts;
  for (const ContactSurface& contact : human.contacts) {
    contacts.push_back(ReduceContact(contact, reduction.value()));
    if (selection.sagittal) contacts.back().directions = {0, 2};
  }
  const MotionSpace space = selection.sagittal ? MotionSpace::kSagittalPlane : MotionSpace::kSpace;
  const Model& reduced = reduction.value().model;
  const bool symmetric = alike && reduction.value().symmetric && IsOwnMirrorImage(reduced, contacts, space);
  std::vector<BodySurface> bodies;
  for (const BodySurface& body : human.bodies) bodies.push_back(ReduceBody(body, reduction.value()));
  std::vector<BodyPair> pairs;
  if (!selection.sagittal) pairs = ReducePairs(human.pairs, bodies);
  return Scene{
      .name = selection.model,
      .description = "",
      .selection = selection,
      .model = symmetric ? reduced : WithoutMirror(reduced),
      .contacts = std::move(contacts),
      .leg_length = std::max(tables.left.LegLength(), tables.right.LegLength()),
      .sources = HumanSources(symmetric),
      .symmetric = symmetric,
      .bodies = std::move(bodies),
      .pairs = std::move(pairs),
  };
}

}  // namespace rollgait
