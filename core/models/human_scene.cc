#include "core/models/human_scene.h"

#include <numbers>
#include <sstream>
#include <utility>

#include "core/base/check.h"
#include "core/models/human.h"
#include "core/models/reduction.h"

namespace rollgait {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
// A segment may be this much shorter or longer than the table has it.
constexpr double kShortest = 0.7, kLongest = 1.4;

std::string Keyed(const char* field, const std::string& key) { return std::string(field) + "[\"" + key + "\"]"; }

SegmentScales CheckSegments(const BodySelection& selection, Violations* violations) {
  const SegmentTable table(selection.sex, selection.stature, selection.mass);
  SegmentScales scales = kTableScales;
  for (const auto& [name, length] : selection.segment_lengths) {
    const std::string field = Keyed("segment_lengths_m", name);
    int segment = 0;
    while (segment < kSegments && name != SegmentName(static_cast<Segment>(segment))) ++segment;
    std::ostringstream message;
    if (segment == kSegments) {
      message << "is not a segment; choose from";
      for (int s = 0; s < kSegments; ++s) message << (s == 0 ? " " : ", ") << SegmentName(static_cast<Segment>(s));
      violations->push_back({field, message.str()});
      continue;
    }
    const Segment kind = static_cast<Segment>(segment);
    const double usual = kind == Segment::kFoot ? table.FootLength() : table.Length(kind);  // a foot from heel to toe
    if (!(length >= kShortest * usual && length <= kLongest * usual)) {                     // refuses NaN
      message << "is " << length << " m; must be between " << kShortest * usual << " and " << kLongest * usual << " m ("
              << kShortest << " and " << kLongest << " times the table's at this stature)";
      violations->push_back({field, message.str()});
      continue;
    }
    scales[segment] = length / usual;
  }
  return scales;
}

bool IsBase(const Joint& joint) { return joint.name.starts_with("base_"); }

// Which switch of the selection fixes a joint, null if none does.
const char* FixedBy(const Joint& joint, const BodySelection& selection) {
  const bool lateral = joint.type == JointType::kPrismatic ? joint.axis.y() != 0 : joint.axis.y() == 0;
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
  if (IsBase(joint)) {
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
      violations->push_back({field, "the human has no joint of that name; see GetModel of \"human29\" for its joints"});
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

}  // namespace

Result<Scene> HumanScene(const BodySelection& selection) {
  Violations violations;
  if (selection.toes && selection.feet == FootShape::kOneEllipsoid) {
    violations.push_back({"toes",
                          "needs feet of two ellipsoids: one that spans heel and toes cannot bend; leave `feet` "
                          "unset or set it to FEET_TWO_ELLIPSOIDS"});
  }
  const SegmentScales scales = CheckSegments(selection, &violations);
  const SegmentTable table(selection.sex, selection.stature, selection.mass, scales);
  const HumanBody human = Human(table, {selection.feet, selection.ranges, selection.toes && violations.empty()});
  const std::map<std::string, double> locked = CheckLocks(human.model, selection, &violations);
  if (!violations.empty()) return violations;

  Result<ModelReduction> reduction = ReduceModel(human.model, locked);
  if (!reduction.ok()) return reduction.violations();
  std::vector<ContactSurface> contacts;
  for (const ContactSurface& contact : human.contacts) {
    contacts.push_back(ReduceContact(contact, reduction.value()));
    if (selection.sagittal) contacts.back().directions = {0, 2};
  }
  std::vector<BodySurface> bodies;
  for (const BodySurface& body : human.bodies) bodies.push_back(ReduceBody(body, reduction.value()));
  std::vector<BodyPair> pairs;
  if (!selection.sagittal) pairs = ReducePairs(human.pairs, bodies);
  return Scene{
      .name = selection.model,
      .description = "",
      .selection = selection,
      .model = reduction.value().model,
      .contacts = std::move(contacts),
      .leg_length = table.LegLength(),
      .sources = HumanSources(),
      .symmetric = reduction.value().symmetric,
      .bodies = std::move(bodies),
      .pairs = std::move(pairs),
  };
}

}  // namespace rollgait
