#include "core/models/own_model_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/models/joint_limits.h"

namespace rollgait {
namespace {

constexpr size_t kMaxName = 64, kMaxText = 2000;
constexpr double kStraight = 1e-6;                 // of unit axes
constexpr double kMinMass = 0.5, kMaxMass = 1000;  // kg
constexpr double kMinLeg = 0.05, kMaxLeg = 3;      // m
constexpr double kLargestNumber = 1e6;

bool IsText(const std::string& text) {
  return text.size() <= kMaxText &&
         std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; });
}

// Names of a list: allowed, and each once. Where they are not, they are not repeated: they may be anything.
template <typename Named>
void CheckNames(const char* list, const std::vector<Named>& parts, OwnModelCheck* check) {
  std::set<std::string> seen;
  for (size_t i = 0; i < parts.size(); ++i) {
    const int index = static_cast<int>(i);
    if (!IsOwnName(parts[i].name)) {
      check->Refuse(list, index, "name", "is not 1 to ", kMaxName, " letters, digits, \"_\", \"-\" or \".\"");
    } else if (!seen.insert(parts[i].name).second) {
      check->Refuse(list, index, "name", "\"", parts[i].name, "\" is used twice; give each a name of its own");
    }
  }
}

void CheckCount(const char* list, size_t count, int least, int most, OwnModelCheck* check) {
  if (count >= static_cast<size_t>(least) && count <= static_cast<size_t>(most)) return;
  check->RefuseModel(list, "are ", count, "; ", least, " to ", most, " are accepted");
}

bool IsIndex(int index, size_t count) { return index >= 0 && static_cast<size_t>(index) < count; }

// What the surfaces of contacts and bodies have in common.
void CheckSurface(const char* list, int index, const Surface& surface, const Vector3& center, const Matrix3& rotation,
                  OwnModelCheck* check) {
  constexpr double kLeast = 0.001, kMost = 1;  // m
  if (const std::optional<WalkingShape> shape = surface.walking()) {
    const std::string field = std::string("surface.") + shape->field + ".";
    const Vector3& axes = shape->semi_axes;
    if (!(axes.minCoeff() >= kLeast && axes.maxCoeff() <= kMost)) {
      check->Refuse(list, index, field + "semi_axes_m", "are (", axes.transpose(), ") m; each must be between ", kLeast,
                    " and ", kMost, " m");
    }
    for (const WalkingShape::Number& number : shape->numbers) {
      if (number.value >= number.least && number.value <= number.most) continue;
      check->Refuse(list, index, field + number.field, "is ", number.value,
                    "; of a body that walks it must be between ", number.least, " and ", number.most);
    }
  } else {
    std::string kinds;
    for (const std::string& kind : Surface::WalkingKinds()) kinds += (kinds.empty() ? "" : " nor ") + kind;
    check->Refuse(list, index, "surface", "is neither ", kinds, ", without rounding; no other surface walks");
  }
  if (!(center.cwiseAbs().maxCoeff() <= 10)) {
    check->Refuse(list, index, "center_m", "is (", center.transpose(), ") m; every component must be within ±10 m");
  }
  if (!(rotation.transpose() * rotation).isIdentity(1e-9)) {
    check->Refuse(list, index, "orientation", "is not a rotation; give a quaternion of length 1, or leave it out");
  }
}

const char* RoleName(JointRole role) {
  switch (role) {
    case JointRole::kBaseForward:
      return "ROLE_BASE_FORWARD";
    case JointRole::kBaseLateral:
      return "ROLE_BASE_LATERAL";
    case JointRole::kBaseVertical:
      return "ROLE_BASE_VERTICAL";
    case JointRole::kBaseYaw:
      return "ROLE_BASE_YAW";
    case JointRole::kBaseRoll:
      return "ROLE_BASE_ROLL";
    case JointRole::kBasePitch:
      return "ROLE_BASE_PITCH";
    default:
      return "";
  }
}

// Index of the world axis along (translations) or about (turns) which a joint of the base moves; -1: not of the base.
int BaseAxis(JointRole role) {
  switch (role) {
    case JointRole::kBaseForward:
    case JointRole::kBaseRoll:
      return 0;
    case JointRole::kBaseLateral:
    case JointRole::kBasePitch:
      return 1;
    case JointRole::kBaseVertical:
    case JointRole::kBaseYaw:
      return 2;
    default:
      return -1;
  }
}

bool IsTranslation(JointRole role) {
  return role == JointRole::kBaseForward || role == JointRole::kBaseLateral || role == JointRole::kBaseVertical;
}

void CheckBaseJoint(int index, OwnModelCheck* check) {
  const Joint& joint = check->own.joints[index];
  const char* const role = RoleName(joint.role);
  const JointType wanted = IsTranslation(joint.role) ? JointType::kPrismatic : JointType::kRevolute;
  if (joint.type != wanted) {
    check->Refuse("joints", index, "type", "of joint \"", joint.name, "\" with ", role, " must be ",
                  KindOf(wanted).word);
  }
  if (joint.actuated) {
    check->Refuse("joints", index, "actuated", "of joint \"", joint.name,
                  "\" must be false: nothing drives a floating base");
  }
  if (joint.side != BodySide::kMidline) {
    check->Refuse("joints", index, "side", "of joint \"", joint.name, "\" must be unset: the base is in the middle");
  }
  const Vector3 axis = check->R_WL[index] * joint.axis;
  const double along = axis(BaseAxis(joint.role));
  if ((IsTranslation(joint.role) ? along : std::abs(along)) < 1 - kStraight) {
    check->Refuse("joints", index, "axis", "of joint \"", joint.name, "\" with ", role, " is (", axis.transpose(),
                  ") in the world; must be ", IsTranslation(joint.role) ? "+" : "±", "xyz"[BaseAxis(joint.role)]);
  }
}

}  // namespace

bool IsOwnName(const std::string& name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  return !name.empty() && name.size() <= kMaxName && std::all_of(name.begin(), name.end(), allowed);
}

void OwnModelCheck::PlaceLinks() {
  for (const Joint& joint : own.joints) {
    const Matrix3 R_WP = joint.parent < 0 ? Matrix3(Matrix3::Identity()) : R_WL[joint.parent];
    const Vector3 p_WP = joint.parent < 0 ? Vector3(Vector3::Zero()) : p_WL[joint.parent];
    p_WL.push_back(p_WP + R_WP * joint.p_PJ);
    R_WL.push_back(R_WP * joint.R_PJ);
  }
}

double OwnModelCheck::Lowest(const ContactSurface& contact) const {
  const Matrix3 R_WE = R_WL[contact.joint] * contact.R_LE;
  const Vector3 down = -Vector3::UnitZ();
  return (p_WL[contact.joint] + R_WL[contact.joint] * contact.p_LE).z() -
         contact.surface.Support(R_WE.transpose() * down);
}

void CheckOwnSizes(OwnModelCheck* check) {
  const OwnModel& own = check->own;
  if (!IsOwnName(own.name)) {
    check->RefuseModel("summary.name", "is not 1 to ", kMaxName, " letters, digits, \"_\", \"-\" or \".\"");
  }
  if (!IsText(own.description)) {
    check->RefuseModel("summary.description", "is longer than ", kMaxText, " bytes or holds a control character");
  }
  CheckCount("sources", own.sources.size(), 0, kMaxOwnSources, check);
  if (!std::all_of(own.sources.begin(), own.sources.end(), IsText)) {
    check->RefuseModel("sources", "hold a line of more than ", kMaxText, " bytes or with a control character");
  }
  CheckCount("joints", own.joints.size(), 1, kMaxOwnJoints, check);
  CheckCount("contacts", own.contacts.size(), 2, kMaxOwnContacts, check);
  CheckCount("bodies", own.bodies.size(), 0, kMaxOwnBodies, check);
  CheckCount("body_pairs", own.pairs.size(), 0, kMaxOwnPairs, check);
  if (!check->ok()) return;
  CheckNames("joints", own.joints, check);
  CheckNames("contacts", own.contacts, check);
  CheckNames("bodies", own.bodies, check);
  for (int i = 0; i < static_cast<int>(own.joints.size()); ++i) {
    const Joint& joint = own.joints[i];
    if (!joint.link.empty() && !IsOwnName(joint.link)) {
      check->Refuse("joints", i, "link_name", "is not 1 to ", kMaxName, " letters, digits, \"_\", \"-\" or \".\"");
    }
    if (joint.kind().is_free()) {
      check->Refuse("joints", i, "type", "of joint \"", joint.name,
                    "\" is TYPE_FREE, which is for Simulate; a floating base is a chain of six joints");
    }
    if (!(joint.p_PJ.cwiseAbs().maxCoeff() <= 10)) {
      check->Refuse("joints", i, "origin_m", "of joint \"", joint.name, "\" is (", joint.p_PJ.transpose(),
                    ") m; every component must be within ±10 m (lengths are in metres)");
    }
    if (!(joint.center_of_mass.cwiseAbs().maxCoeff() <= 10)) {
      check->Refuse("joints", i, "center_of_mass_m", "of link \"", joint.link, "\" is (",
                    joint.center_of_mass.transpose(),
                    ") m; every component must be within ±10 m (lengths are in metres)");
    }
  }
  for (int c = 0; c < static_cast<int>(own.contacts.size()); ++c) {
    const ContactSurface& contact = own.contacts[c];
    if (!IsIndex(contact.joint, own.joints.size())) {
      check->Refuse("contacts", c, "joint", "is ", contact.joint, "; the model has joints 0 to ",
                    own.joints.size() - 1);
    }
    CheckSurface("contacts", c, contact.surface, contact.p_LE, contact.R_LE, check);
  }
  for (int b = 0; b < static_cast<int>(own.bodies.size()); ++b) {
    const BodySurface& body = own.bodies[b];
    if (!IsIndex(body.joint, own.joints.size())) {
      check->Refuse("bodies", b, "joint", "is ", body.joint, "; the model has joints 0 to ", own.joints.size() - 1);
    }
    CheckSurface("bodies", b, body.placed.surface, body.placed.p_BE, body.placed.R_BE, check);
  }
  for (int c = 0; c < static_cast<int>(own.contacts.size()); ++c) {
    const int image = own.contacts[c].mirror_contact;
    if (!IsIndex(image, own.contacts.size()) || own.contacts[image].mirror_contact != c) {
      check->Refuse("contacts", c, "mirror_contact", "is no contact of which \"", own.contacts[c].name,
                    "\" is the mirror image in turn");
    }
    const std::vector<int>& directions = own.contacts[c].directions;
    if (directions != own.contacts.front().directions ||
        (directions != std::vector<int>{0, 1, 2} && directions != std::vector<int>{0, 2})) {
      check->Refuse("contacts", c, "directions", "must be x, y, z, or x, z in the plane, the same of all contacts");
    }
  }
  for (int b = 0; b < static_cast<int>(own.bodies.size()); ++b) {
    const int image = own.bodies[b].mirror_body;
    if (!IsIndex(image, own.bodies.size()) || own.bodies[image].mirror_body != b) {
      check->Refuse("bodies", b, "mirror_body", "is no body of which \"", own.bodies[b].name,
                    "\" is the mirror image in turn");
    }
  }
  for (int k = 0; k < static_cast<int>(own.pairs.size()); ++k) {
    const BodyPair& pair = own.pairs[k];
    if (!IsIndex(pair.first, own.bodies.size()) || !IsIndex(pair.second, own.bodies.size())) {
      check->Refuse("body_pairs", k, "first", "or second is no body of the model");
    }
  }
  for (int k = 0; check->ok() && k < static_cast<int>(own.pairs.size()); ++k) {
    const BodyPair& pair = own.pairs[k];
    if (own.bodies[pair.first].joint == own.bodies[pair.second].joint) {
      check->Refuse("body_pairs", k, "second", "is on the link of first, from which it keeps its distance; leave the ",
                    "pair out");
    }
  }
}

void CheckOwnBase(OwnModelCheck* check) {
  const std::vector<Joint>& joints = check->own.joints;
  int last = -1;
  std::vector<int> turns;
  for (int i = 0; i < static_cast<int>(joints.size()); ++i) {
    if (BaseAxis(joints[i].role) < 0) continue;
    if (joints[i].parent != last) {
      check->Refuse("joints", i, "parent", "of joint \"", joints[i].name, "\" is ", check->Named(joints[i].parent),
                    "; joints of the base are one chain from the world, so it must be ", check->Named(last));
    }
    if (IsTranslation(joints[i].role) && !turns.empty()) {
      check->Refuse("joints", i, "role", "of joint \"", joints[i].name, "\" is ", RoleName(joints[i].role),
                    " behind a joint that turns; translations of the base come first");
    }
    if (!IsTranslation(joints[i].role)) turns.push_back(i);
    CheckBaseJoint(i, check);
    last = i;
  }
  const auto has = [&](JointRole role) {
    return std::any_of(joints.begin(), joints.end(), [role](const Joint& joint) { return joint.role == role; });
  };
  const bool in_space = check->own.contacts.front().directions.size() == 3;
  for (const JointRole role : {JointRole::kBaseForward, JointRole::kBaseLateral, JointRole::kBaseVertical,
                               JointRole::kBaseYaw, JointRole::kBaseRoll, JointRole::kBasePitch}) {
    const bool in_plane =
        role == JointRole::kBaseForward || role == JointRole::kBaseVertical || role == JointRole::kBasePitch;
    if (!has(role) && (in_space || in_plane)) {
      check->RefuseModel("joints", "have none with ", RoleName(role), "; the base must float: ",
                         in_space ? "six joints carry a body in space" : "three joints carry a body in the plane");
    } else if (has(role) && !in_space && !in_plane) {
      check->RefuseModel("joints", "have one with ", RoleName(role),
                         ", but contacts work in x and z only; give them three directions");
    }
  }
  for (int i = 0; i < static_cast<int>(joints.size()); ++i) {
    if (BaseAxis(joints[i].role) >= 0) continue;
    if (joints[i].parent < 0 || (joints[i].parent != last && BaseAxis(joints[joints[i].parent].role) >= 0)) {
      check->Refuse("joints", i, "parent", "of joint \"", joints[i].name, "\" is ", check->Named(joints[i].parent),
                    "; everything hangs on the last joint of the base, ", check->Named(last));
    }
    const double sideways = std::abs((check->R_WL[i] * joints[i].axis).y());
    const bool turns_out = joints[i].kind().turns && sideways < 1 - kStraight;
    if (!in_space && (turns_out || (joints[i].Advance() != 0 && sideways > kStraight))) {
      check->Refuse("joints", i, "axis", "of joint \"", joints[i].name,
                    "\" moves the body out of the plane, in which its contacts work (directions x and z)");
    }
  }
  if (turns.size() == 3) {
    const Joint& middle = joints[turns[1]];
    constexpr double kMost = kLargestBaseRoll * std::numbers::pi / 180 + kStraight;
    if (!(middle.position_min >= -kMost && middle.position_max <= kMost)) {
      check->Refuse("joints", turns[1], "position_min", "to position_max of joint \"", middle.name, "\" is ",
                    middle.position_min, " to ", middle.position_max,
                    " rad; the second of three turns must stay within ±", kMost,
                    " rad, since the three lose a direction at ±π/2");
    }
  }
}

void CheckOwnUnits(double leg_length, OwnModelCheck* check) {
  const OwnModel& own = check->own;
  double mass = 0;
  for (const Joint& joint : own.joints) mass += joint.mass;
  if (!(leg_length >= kMinLeg && leg_length <= kMaxLeg)) {
    check->RefuseModel("joints", "put the hip ", leg_length, " m above the sole at position zero; must be between ",
                       kMinLeg, " and ", kMaxLeg, " m",
                       leg_length > 30 * kMinLeg && leg_length / 1000 >= kMinLeg ? ". This looks like millimetres; "
                                                                                   "lengths are in metres"
                       : leg_length <= 0                                         ? ". The feet cannot reach the ground"
                                                                                 : "");
  }
  if (!(mass >= kMinMass && mass <= kMaxMass)) {
    check->RefuseModel("joints", "have links of ", mass, " kg together; must be between ", kMinMass, " and ", kMaxMass,
                       " kg",
                       mass > kMaxMass && mass / 1000 >= kMinMass ? ". This looks like grams; masses are in kg" : "");
  }
  if (own.total_mass && !(std::abs(*own.total_mass - mass) <= 1e-6 * mass)) {
    check->RefuseModel("total_mass_kg", "is ", *own.total_mass, " kg, but the links have ", mass,
                       " kg together; correct one of the two or leave it out");
  }
  if (!check->ok()) return;
  for (int i = 0; i < static_cast<int>(own.joints.size()); ++i) {
    const Joint& joint = own.joints[i];
    if (joint.mass == 0) continue;
    const double radius = std::sqrt(joint.inertia.diagonal().maxCoeff() / joint.mass), most = 2 * leg_length;
    if (radius > most) {
      check->Refuse("joints", i, "inertia_kg_m2", "of link \"", joint.link, "\" is ",
                    joint.inertia.diagonal().transpose(), " kg m² (xx, yy, zz) at ", joint.mass,
                    " kg: a radius of gyration of ", radius, " m; at most twice the leg, ", most,
                    " m. Divide by 1e6 if it is in kg mm², by 1e9 if in g mm²");
    }
  }
}

}  // namespace rollgait
