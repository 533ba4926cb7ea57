#include "server/convert/joint_chains.h"

#include <algorithm>
#include <utility>

#include "server/convert/field_decoding.h"

namespace rollgait::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

const ChainKind* KindOf(const v1::Joint& joint) { return FindChainKind(v1::Joint::Type_Name(joint.type())); }

// Copies a field of one value that both messages have by this name.
void CopyField(const Message& from, const char* name, Message* to) {
  const FieldDescriptor* const source = FieldOf(from, name);
  const FieldDescriptor* const target = FieldOf(*to, name);
  const auto &read = *from.GetReflection(), &write = *to->GetReflection();
  write.ClearField(to, target);
  switch (source->cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return write.SetDouble(to, target, read.GetDouble(from, source));
    case FieldDescriptor::CPPTYPE_BOOL:
      return write.SetBool(to, target, read.GetBool(from, source));
    case FieldDescriptor::CPPTYPE_ENUM:
      return write.SetEnumValue(to, target, read.GetEnumValue(from, source));
    case FieldDescriptor::CPPTYPE_STRING:
      return write.SetString(to, target, read.GetString(from, source));
    default:
      if (read.HasField(from, source)) {
        write.MutableMessage(to, target)->CopyFrom(read.GetMessage(from, source));
      }
  }
}

class Unfolder {
 public:
  Unfolder(std::string prefix, const v1::Model& model, Violations* violations)
      : prefix_(std::move(prefix)), model_(model), violations_(violations) {}

  UnfoldedModel Unfold() {
    if (!FindChains()) return std::move(result_);
    result_.model = model_;
    result_.model.clear_joints();
    for (int i = 0; i < model_.joints_size(); ++i) AddJoint(i);
    for (int i = 0; i < model_.contacts_size(); ++i) {
      v1::ContactSurface& contact = *result_.model.mutable_contacts(i);
      contact.set_joint(LastOf("contacts[" + std::to_string(i) + "].joint", contact.joint()));
    }
    for (int i = 0; i < model_.bodies_size(); ++i) {
      v1::BodySurface& body = *result_.model.mutable_bodies(i);
      body.set_joint(LastOf("bodies[" + std::to_string(i) + "].joint", body.joint()));
    }
    return std::move(result_);
  }

 private:
  static std::string At(int joint) { return "joints[" + std::to_string(joint) + "]."; }
  void Refuse(const std::string& field, const std::string& message) {
    violations_->push_back({prefix_ + field, message});
  }
  bool IsIndex(int joint) const { return joint >= 0 && joint < model_.joints_size(); }
  int Turns(int joint) const {
    const ChainKind* const kind = KindOf(model_.joints(joint));
    return kind == nullptr ? 1 : kind->turns;
  }

  // False if there is nothing to unfold, or something that cannot be.
  bool FindChains() {
    bool good = true;
    int size = 0;
    for (int i = 0; i < model_.joints_size(); ++i) {
      const v1::Joint& joint = model_.joints(i);
      const ChainKind* const kind = KindOf(joint);
      const int wanted = kind == nullptr ? 0 : kind->turns;
      if (joint.coordinates_size() != wanted) {
        Refuse(At(i) + "coordinates", "are " + std::to_string(joint.coordinates_size()) + "; must be " +
                                          (wanted == 0 ? "none of this type, which has one axis"
                                                       : std::to_string(wanted) + " of " + kind->name));
        good = false;
      }
      first_.push_back(size);
      size += Turns(i);
      if (kind == nullptr) continue;
      result_.chains.push_back({joint.name(), kind, first_.back()});
      for (const char* const field : kCoordinateFields) {
        const FieldDescriptor* const own = FieldOf(joint, field);
        if (std::string(field) == "name" || !joint.GetReflection()->HasField(joint, own)) continue;
        Refuse(At(i) + field, std::string("must be unset of ") + kind->name + ": each of its coordinates says its own");
        good = false;
      }
    }
    if (good && result_.chains.empty()) result_.model = model_;
    return good && !result_.chains.empty();
  }

  int LastOf(const std::string& field, int joint) {
    if (IsIndex(joint)) return first_[joint] + Turns(joint) - 1;
    Refuse(field,
           "is " + std::to_string(joint) + "; the model has joints 0 to " + std::to_string(model_.joints_size() - 1));
    return 0;
  }

  int ParentOf(int i) {
    const int parent = model_.joints(i).parent();
    if (parent == -1) return parent;
    if (parent < -1 || parent >= i) {
      Refuse(At(i) + "parent",
             "is " + std::to_string(parent) + "; must be -1 (the world) or the index of a joint before this one");
      return -1;
    }
    return first_[parent] + Turns(parent) - 1;
  }

  // Where the mirror image of the joint begins.
  int MirrorOf(int i) {
    const int image = model_.joints(i).mirror_joint();
    if (!IsIndex(image)) {
      Refuse(At(i) + "mirror_joint", "is " + std::to_string(image) + "; must be the index of a joint");
      return first_[i];
    }
    if (model_.joints(image).type() == model_.joints(i).type()) return first_[image];
    Refuse(At(i) + "mirror_joint", "is " + std::to_string(image) + ", but that joint is of another type");
    return first_[i];
  }

  void AddJoint(int i) {
    const v1::Joint& given = model_.joints(i);
    if (KindOf(given) == nullptr) {
      v1::Joint& joint = *result_.model.add_joints();
      joint = given;
      joint.set_parent(ParentOf(i));
      if (joint.mirror_sign() != 0) joint.set_mirror_joint(MirrorOf(i));
      return;
    }
    const int turns = given.coordinates_size();
    const auto& coordinates = given.coordinates();
    const bool mirrors = std::any_of(coordinates.begin(), coordinates.end(),
                                     [](const v1::JointCoordinate& each) { return each.mirror_sign() != 0; });
    const int image = mirrors ? MirrorOf(i) : first_[i];
    for (int k = 0; k < turns; ++k) {
      v1::Joint& joint = *result_.model.add_joints();
      const bool is_last = k + 1 == turns;
      if (is_last) {
        joint = given;
        joint.clear_coordinates();
      }
      for (const char* const field : kCoordinateFields) CopyField(coordinates[k], field, &joint);
      if (joint.name().empty()) joint.set_name(given.name() + "_" + std::to_string(k + 1));
      joint.set_type(v1::Joint::TYPE_REVOLUTE);
      joint.set_side(given.side());
      joint.set_parent(k == 0 ? ParentOf(i) : first_[i] + k - 1);
      *joint.mutable_origin_m() = k == 0 ? given.origin_m() : v1::Vector3();
      if (k == 0 && given.has_orientation()) {
        *joint.mutable_orientation() = given.orientation();
      } else {
        joint.clear_orientation();
        joint.mutable_orientation()->set_w(1);
      }
      joint.set_mirror_joint(image + k);
      if (is_last) continue;
      joint.set_link_name(joint.name() + "_link");
      joint.mutable_center_of_mass_m();
      for (int entry = 0; entry < 6; ++entry) joint.add_inertia_kg_m2(0);
    }
  }

  const std::string prefix_;
  const v1::Model& model_;
  Violations* const violations_;
  std::vector<int> first_;  // of each joint of the message, in the longer list
  UnfoldedModel result_;
};

}  // namespace

UnfoldedModel UnfoldJointChains(const std::string& prefix, const v1::Model& model, Violations* violations) {
  return Unfolder(prefix, model, violations).Unfold();
}

v1::Model FoldJointChains(const v1::Model& unfolded, const std::vector<JointChain>& chains) {
  v1::Model model = unfolded;
  if (chains.empty()) return model;
  model.clear_joints();
  auto chain = chains.begin();
  for (int i = 0; i < unfolded.joints_size(); ++i) {
    v1::Joint& joint = *model.add_joints();
    const bool is_chain = chain != chains.end() && chain->first == i;
    const int last = is_chain ? chain->last() : i;
    joint = unfolded.joints(last);
    joint.set_parent(MessageIndex(chains, unfolded.joints(i).parent()));
    joint.set_mirror_joint(MessageIndex(chains, joint.mirror_joint()));
    if (!is_chain) continue;
    for (; i <= last; ++i) {
      v1::JointCoordinate& coordinate = *joint.add_coordinates();
      for (const char* const field : kCoordinateFields) CopyField(unfolded.joints(i), field, &coordinate);
    }
    i = last;
    for (const char* const field : kCoordinateFields) {
      joint.GetReflection()->ClearField(&joint, FieldOf(joint, field));
    }
    *joint.mutable_origin_m() = unfolded.joints(chain->first).origin_m();
    *joint.mutable_orientation() = unfolded.joints(chain->first).orientation();
    joint.set_name(chain->name);
    v1::Joint::Type type = v1::Joint::TYPE_UNSPECIFIED;
    ROLLGAIT_CHECK(v1::Joint::Type_Parse(chain->kind->name, &type));
    joint.set_type(type);
    ++chain;
  }
  for (v1::ContactSurface& contact : *model.mutable_contacts())
    contact.set_joint(MessageIndex(chains, contact.joint()));
  for (v1::BodySurface& body : *model.mutable_bodies()) body.set_joint(MessageIndex(chains, body.joint()));
  return model;
}

}  // namespace rollgait::server
