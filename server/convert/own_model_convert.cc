#include "server/convert/own_model_convert.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <utility>

#include "server/convert/joint_chains.h"
#include "server/convert/joint_convert.h"
#include "server/convert/surface_convert.h"

namespace rollgait::server {
namespace {

class Decoder {
 public:
  Decoder(std::string prefix, const UnfoldedModel& unfolded, Violations* violations)
      : prefix_(std::move(prefix)), model_(unfolded.model), chains_(unfolded.chains), violations_(violations) {}

  OwnModel Decode() {
    OwnModel own;
    own.chains = chains_;
    own.name = model_.summary().name();
    own.description = model_.summary().description();
    for (int i = 0; i < model_.contacts_size(); ++i) contacts_.emplace(model_.contacts(i).name(), i);
    for (int i = 0; i < model_.bodies_size(); ++i) bodies_.emplace(model_.bodies(i).name(), i);
    for (int i = 0; i < model_.joints_size(); ++i) own.joints.push_back(DecodeJoint(i));
    for (int i = 0; i < model_.contacts_size(); ++i) own.contacts.push_back(DecodeContact(i));
    for (int i = 0; i < model_.bodies_size(); ++i) own.bodies.push_back(DecodeBody(i));
    for (int i = 0; i < model_.body_pairs_size(); ++i) {
      const v1::BodyPair& pair = model_.body_pairs(i);
      const std::string path = At("body_pairs", i);
      own.pairs.push_back({Find(bodies_, path + "first", pair.first(), -1),
                           Find(bodies_, path + "second", pair.second(), -1), 0, pair.usual()});
    }
    if (model_.total_mass_kg() != 0) own.total_mass = model_.total_mass_kg();
    if (model_.leg_length_m() != 0) own.leg_length = model_.leg_length_m();
    own.sources = {model_.sources().begin(), model_.sources().end()};
    return own;
  }

 private:
  static std::string At(const char* list, int index) { return list + ("[" + std::to_string(index) + "]."); }
  void Refuse(const std::string& field, const std::string& message) {
    violations_->push_back({prefix_ + field, message});
  }

  template <typename Ours, typename Wire>
  Ours DecodeEnum(const std::string& field, Wire value, bool is_known) {
    if (is_known) return static_cast<Ours>(value);
    Refuse(field, "enum value " + std::to_string(value) + " is not known to this server; use a named one");
    return Ours{};
  }

  BodySide DecodeSide(const std::string& field, v1::BodySide side) {
    return DecodeEnum<BodySide>(field, side, v1::BodySide_IsValid(side));
  }

  // Index by name; `otherwise` for the empty name.
  int Find(const std::map<std::string, int>& names, const std::string& field, const std::string& name, int otherwise) {
    if (name.empty() && otherwise >= 0) return otherwise;
    const auto found = names.find(name);
    if (found != names.end()) return found->second;
    Refuse(field, "is the name of no part of the model; names must be those of the same list");
    return 0;
  }

  static Vector3 Vector(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

  Matrix3 Rotation(const std::string& field, bool given, const v1::Quaternion& q) {
    if (!given) return Matrix3::Identity();
    const Eigen::Quaterniond rotation(q.w(), q.x(), q.y(), q.z());
    if (!(std::abs(rotation.norm() - 1) <= 1e-6)) {
      Refuse(field, "is a quaternion of length " + std::to_string(rotation.norm()) + "; must be 1 to 1e-6");
      return Matrix3::Identity();
    }
    if (rotation.vec().isZero(0)) return Matrix3::Identity();
    return rotation.normalized().toRotationMatrix();
  }

  Surface DecodeSurface(const std::string& field, const v1::Surface& surface) {
    return rollgait::server::DecodeSurface(prefix_ + field, surface, violations_)
        .value_or(Ellipsoid(Vector3::Constant(0.1)));
  }

  Joint DecodeJoint(int i) {
    const v1::Joint& encoded = model_.joints(i);
    const auto at = [&](const char* field) { return JointPath(chains_, i, field); };
    Joint joint;
    joint.name = encoded.name();
    joint.link = encoded.link_name();
    const JointKind* const kind = DecodeJointType(encoded.type());
    if (kind == nullptr || kind->is_free()) {
      Refuse(at("type"),
             "must be " + JointTypeNames(JointsOf::kWalker) + "; a floating base is a chain of such joints");
    } else {
      joint.type = kind->type;
    }
    DecodeJointNumbers(encoded, &joint);
    joint.parent = encoded.parent();
    joint.p_PJ = Vector(encoded.origin_m());
    joint.R_PJ = Rotation(at("orientation"), encoded.has_orientation(), encoded.orientation());
    joint.axis = Vector(encoded.axis());
    joint.actuated = encoded.actuated();
    joint.center_of_mass = Vector(encoded.center_of_mass_m());
    if (encoded.inertia_kg_m2_size() == 6) {
      const auto& e = encoded.inertia_kg_m2();
      joint.inertia << e[0], e[3], e[4], e[3], e[1], e[5], e[4], e[5], e[2];
    } else if (encoded.inertia_kg_m2_size() != 0) {
      Refuse(at("inertia_kg_m2"), "has " + std::to_string(encoded.inertia_kg_m2_size()) +
                                      " entries; must have 6 (xx, yy, zz, xy, xz, yz), or none without mass");
    }
    const bool mirrored = encoded.mirror_sign() != 0;
    joint.mirror_joint = mirrored ? encoded.mirror_joint() : i;
    joint.mirror_sign = mirrored ? encoded.mirror_sign() : 1;
    joint.role = DecodeEnum<JointRole>(at("role"), encoded.role(), v1::Joint::Role_IsValid(encoded.role()));
    joint.side = DecodeSide(at("side"), encoded.side());
    joint.passive =
        DecodeEnum<PassiveKind>(at("passive"), encoded.passive(), v1::Joint::Passive_IsValid(encoded.passive()));
    return joint;
  }

  ContactSurface DecodeContact(int i) {
    const v1::ContactSurface& encoded = model_.contacts(i);
    const std::string path = At("contacts", i);
    ContactSurface contact;
    contact.name = encoded.name();
    contact.joint = encoded.joint();
    contact.surface = DecodeSurface(path + "surface", encoded.surface());
    contact.p_LE = Vector(encoded.center_m());
    contact.R_LE = Rotation(path + "orientation", encoded.has_orientation(), encoded.orientation());
    contact.mirror_contact = Find(contacts_, path + "mirror_contact", encoded.mirror_contact(), i);
    if (encoded.directions_size() > 0) contact.directions.clear();
    for (int k = 0; k < encoded.directions_size() && k < 3; ++k) {
      const Vector3 direction = Vector(encoded.directions(k));
      for (int axis = 0; axis < 3; ++axis) {
        if (direction == Vector3::Unit(axis)) contact.directions.push_back(axis);
      }
    }
    if (encoded.directions_size() != static_cast<int>(contact.directions.size()) && encoded.directions_size() > 0) {
      Refuse(path + "directions", "are not unit vectors of the world; give x, y, z, or x, z in the plane");
    }
    contact.side = DecodeSide(path + "side", encoded.side());
    contact.part =
        DecodeEnum<FootPart>(path + "part", encoded.part(), v1::ContactSurface::FootPart_IsValid(encoded.part()));
    return contact;
  }

  BodySurface DecodeBody(int i) {
    const v1::BodySurface& encoded = model_.bodies(i);
    const std::string path = At("bodies", i);
    return {encoded.name(),
            encoded.joint(),
            {DecodeSurface(path + "surface", encoded.surface()), Vector(encoded.center_m()),
             Rotation(path + "orientation", encoded.has_orientation(), encoded.orientation())},
            Find(bodies_, path + "mirror_body", encoded.mirror_body(), i)};
  }

  const std::string prefix_;
  const v1::Model& model_;
  const std::vector<JointChain>& chains_;
  Violations* violations_;
  std::map<std::string, int> contacts_, bodies_;
};

// Of a message, before anything else is read of it; `joints` are those that it stands for.
bool CheckCounts(const std::string& prefix, const v1::Model& model, int joints, Violations* violations) {
  bool good = true;
  const std::pair<const char*, std::pair<int, int>> counts[] = {{"joints", {joints, kMaxOwnJoints}},
                                                                {"contacts", {model.contacts_size(), kMaxOwnContacts}},
                                                                {"bodies", {model.bodies_size(), kMaxOwnBodies}},
                                                                {"body_pairs", {model.body_pairs_size(), kMaxOwnPairs}},
                                                                {"sources", {model.sources_size(), kMaxOwnSources}}};
  for (const auto& [list, count] : counts) {
    if (count.first <= count.second) continue;
    violations->push_back(
        {prefix + list,
         "are " + std::to_string(count.first) +
             (joints != model.joints_size() && count.second == kMaxOwnJoints ? " with coordinates" : "") +
             "; at most " + std::to_string(count.second) + " are accepted"});
    good = false;
  }
  return good;
}

}  // namespace

std::shared_ptr<const OwnModel> DecodeOwnModel(const std::string& prefix, const v1::Model& model,
                                               Violations* violations) {
  const size_t before = violations->size();
  if (!CheckCounts(prefix, model, model.joints_size(), violations)) return std::make_shared<const OwnModel>();
  const UnfoldedModel unfolded = UnfoldJointChains(prefix, model, violations);
  if (violations->size() != before || !CheckCounts(prefix, model, unfolded.model.joints_size(), violations)) {
    return std::make_shared<const OwnModel>();
  }
  return std::make_shared<const OwnModel>(Decoder(prefix, unfolded, violations).Decode());
}

}  // namespace rollgait::server
