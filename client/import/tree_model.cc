#include "client/import/tree_model.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <string_view>

#include "client/failure.h"
#include "client/import/lumped_links.h"
#include "client/import/mirror_average.h"
#include "client/import/mirror_images.h"
#include "client/import/side_file.h"
#include "client/import/tree_file.h"
#include "client/import/tree_limits.h"
#include "client/principal_axes.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

void SetXyz(const Eigen::Vector3d& from, v1::Vector3* to) {
  to->set_x(from.x());
  to->set_y(from.y());
  to->set_z(from.z());
}

// Left unset for the identity.
template <typename Part>
void SetOrientation(const Eigen::Matrix3d& rotation, Part* part) {
  if (rotation.isIdentity(0)) return;
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  v1::Quaternion* const to = part->mutable_orientation();
  to->set_w(q.w());
  to->set_x(q.x());
  to->set_y(q.y());
  to->set_z(q.z());
}

bool IsNameLetter(unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; }

class ModelMaker {
 public:
  ModelMaker(const LinkTree& tree, const std::string& side_path, const v1::ModelSideFile& side)
      : tree_(tree), side_path_(side_path), side_(side), carried_(tree.links.size()) {
    for (const v1::SideJoint& joint : side.joints()) said_.emplace(joint.name(), &joint);
  }

  ImportedModel Make() {
    result_.assumed = tree_.assumed;
    if (!tree_.states_velocity) {
      result_.assumed.push_back("limits of velocity, which " + tree_.format +
                                " does not state: 20 rad/s and 2 m/s where the side file gives no velocityMax");
    }
    RequireOneBase();
    AddBase();
    for (const TreeJoint& joint : tree_.joints) AddTreeJoint(joint);
    AddMasses();
    AddContacts();
    AddBodies();
    for (const std::string& line : SetMirrorImages(side_path_, side_, &result_.model)) result_.assumed.push_back(line);
    if (side_.mirror() == v1::ModelSideFile::MIRROR_AVERAGED) {
      result_.assumed.push_back("left and right averaged: " + AverageMirrorImages(&result_.model).Describe());
    }
    AddSummary();
    return std::move(result_);
  }

 private:
  // Where a link of the tree is: in the link frame of a joint of the model, -1 the world.
  struct Carried {
    int joint = -1;
    Pose place = kNoMotion;
  };

  [[noreturn]] void Refuse(const TreeJoint& joint, const std::string& reason) const {
    tree_.RefuseJoint(joint.name, reason);
  }
  const v1::SideJoint& Said(std::string_view joint) const {
    static const v1::SideJoint nothing;
    const auto found = said_.find(joint);
    return found == said_.end() ? nothing : *found->second;
  }
  void RequireName(const std::string& what, const std::string& name) const {
    if (!name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), IsNameLetter)) return;
    throw Failure(ExitCode::kUsage, tree_.path + ": the " + what + " \"" + name +
                                        "\" must be 1 to 64 letters, digits, \"_\", \"-\" or \".\"; rename it");
  }

  Carried& Of(int link) { return carried_[static_cast<size_t>(link)]; }
  const TreeLink& Link(int link) const { return tree_.links[static_cast<size_t>(link)]; }

  // What is not behind the floating joint, if there is one, is the world: it must not weigh nor move.
  void RequireOneBase() const {
    const TreeJoint* base = nullptr;
    std::vector<bool> behind(tree_.links.size());
    for (const TreeJoint& joint : tree_.joints) {
      const bool floats = joint.type == TreeJoint::Type::kFloating;
      if (floats && base != nullptr) {
        Refuse(joint, "is floating, and so is joint \"" + base->name +
                          "\"; a model has one floating base: make this joint fixed, or remove it");
      }
      if (floats) base = &joint;
      behind[static_cast<size_t>(joint.child)] = floats || behind[static_cast<size_t>(joint.parent)];
    }
    if (base == nullptr) return;
    if (Link(tree_.root).mass.mass > 0 || HasOwnBase(side_, tree_)) {
      Refuse(*base,
             "a floating joint must be the first of the tree, below links without mass: it is the floating base");
    }
    for (const TreeJoint& joint : tree_.joints) {
      if (behind[static_cast<size_t>(joint.child)]) continue;
      const std::string where = "is not behind the floating joint \"" + base->name + "\", so it is part of the world";
      if (joint.type != TreeJoint::Type::kFixed && !Said(joint.name).locked()) {
        Refuse(joint, where + ", which does not move; remove it, or lock it in the side file: \"locked\": true");
      }
      if (Link(joint.child).mass.mass > 0) {
        Refuse(joint, where + ", but its link \"" + Link(joint.child).name + "\" has a mass of " +
                          FormatNumber(Link(joint.child).mass.mass) + " kg; remove it, or its mass");
      }
    }
  }

  // The base that the file does not have; its last joint carries the root link.
  void AddBase() {
    if (HasOwnBase(side_, tree_)) {
      result_.read.push_back("floating base: the joints of the file that have base roles");
      return;
    }
    Carried& root = Of(tree_.root);
    const v1::Quaternion& q = side_.base_orientation();
    if (side_.has_base_orientation()) {
      root.place.rotation = Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized().toRotationMatrix();
    }
    const std::vector<BaseJoint> base = BaseJoints(side_.base());
    for (const BaseJoint& from : base) {
      if (tree_.FindJoint(from.name) >= 0) {
        Refuse(tree_.joints[static_cast<size_t>(tree_.FindJoint(from.name))],
               "has the name of a joint of the floating base; give it a base role in the side file, or rename it");
      }
      v1::Joint& joint = *result_.model.add_joints();
      joint.set_name(from.name);
      joint.set_role(from.role);
      joint.set_type(from.type);
      joint.set_parent(result_.model.joints_size() - 2);
      SetXyz(from.axis, joint.mutable_axis());
      const v1::SideJoint& said = Said(from.name);
      joint.set_position_min(said.has_position_min() ? said.position_min() : from.least);
      joint.set_position_max(said.has_position_max() ? said.position_max() : from.most);
      joint.set_velocity_max(said.has_velocity_max() ? said.velocity_max() : kUnbounded);
      joint.set_link_name(std::string(from.name) + "_link");
    }
    if (side_.has_base_position_m()) *result_.model.mutable_joints(0)->mutable_origin_m() = side_.base_position_m();
    root.joint = result_.model.joints_size() - 1;
    result_.model.mutable_joints(root.joint)->set_link_name(Link(tree_.root).name);
    result_.read.push_back("floating base: " + std::to_string(base.size()) + " joints added, which carry link \"" +
                           Link(tree_.root).name + "\"");
  }

  void AddTreeJoint(const TreeJoint& joint) {
    const v1::SideJoint& said = Said(joint.name);
    const Carried& parent = Of(joint.parent);
    const Pose frame = Compose(Compose(parent.place, joint.origin), MotionOf(joint, said.reference()));
    const Pose link = Compose(frame, joint.end);
    const bool floats = joint.type == TreeJoint::Type::kFloating;
    if (floats) {
      result_.read.push_back("joint \"" + joint.name + "\" is the floating base, \"" + Link(joint.child).name +
                             "\" its link");
      result_.model.mutable_joints(parent.joint)->set_link_name(Link(joint.child).name);
    }
    if (floats || joint.type == TreeJoint::Type::kFixed || said.locked()) {
      Of(joint.child) = {parent.joint, link};
      if (said.locked()) RequireReference(tree_, joint, side_path_, said, joint.lower, joint.upper);
      if (!floats) {
        result_.merged.push_back("\"" + Link(joint.child).name + "\" into \"" + Link(joint.parent).name +
                                 "\": joint \"" + joint.name + "\" is " +
                                 (said.locked() ? "locked at " + FormatNumber(said.reference()) : "fixed"));
      }
      return;
    }
    if (joint.type == TreeJoint::Type::kPlanar) {
      Refuse(joint, "is planar, which a model does not have; lock it in the side file: \"locked\": true");
    }
    if (!joint.mimics.empty()) {
      Refuse(joint, "mimics \"" + joint.mimics +
                        "\", which a model cannot express; lock it in the side file: \"locked\": true");
    }
    v1::Joint& to = *result_.model.add_joints();
    to.set_parent(parent.joint);
    Of(joint.child) = {result_.model.joints_size() - 1, joint.end};
    RequireName("joint", joint.name);
    to.set_name(joint.name);
    to.set_link_name(Link(joint.child).name);
    to.set_type(joint.type == TreeJoint::Type::kPrismatic ? v1::Joint::TYPE_PRISMATIC : v1::Joint::TYPE_REVOLUTE);
    SetXyz(frame.position, to.mutable_origin_m());
    SetOrientation(frame.rotation, &to);
    SetXyz(joint.axis, to.mutable_axis());
    to.set_role(said.role());
    to.set_side(said.side());
    to.set_passive(said.passive());
    SetLimits(tree_, joint, side_path_, said, &to, &result_);
    SetSpring(joint, said, &to);
  }

  static void SetSpring(const TreeJoint& joint, const v1::SideJoint& said, v1::Joint* to) {
    const bool sprung = said.stiffness() != 0;  // what the side file says wins
    if (sprung || joint.stiffness != 0) {
      to->set_stiffness(sprung ? said.stiffness() : joint.stiffness);
      to->set_rest_position((sprung ? said.rest_position() : joint.rest) - said.reference());
    }
    to->set_damping(said.has_damping() ? said.damping() : joint.damping);
  }

  void AddMasses() {
    std::vector<std::vector<MassProperties>> parts(static_cast<size_t>(result_.model.joints_size()));
    double total = 0;
    for (size_t i = 0; i < tree_.links.size(); ++i) {
      const TreeLink& link = tree_.links[i];
      if (link.mass.mass == 0) continue;
      if (carried_[i].joint < 0) {
        tree_.RefuseLink(link.name, "has mass, but no joint of the base carries it: it would be fixed to the world");
      }
      parts[static_cast<size_t>(carried_[i].joint)].push_back(Placed(link.mass, carried_[i].place));
      total += link.mass.mass;
    }
    for (int i = 0; i < result_.model.joints_size(); ++i) {
      const MassProperties mass = Lump(parts[static_cast<size_t>(i)]);
      v1::Joint& joint = *result_.model.mutable_joints(i);
      RequireName("link", joint.link_name());
      const Eigen::Vector3d moments = PrincipalAxesOf(mass.inertia).moments;
      if (moments(2) > (moments(0) + moments(1)) * (1 + 1e-6)) {
        tree_.RefuseLink(joint.link_name(), "with what is merged into it, it has the principal moments " +
                                                FormatNumber(moments(0)) + ", " + FormatNumber(moments(1)) + " and " +
                                                FormatNumber(moments(2)) +
                                                " kg m²; no body has one above the sum of the two others. Correct its "
                                                "inertia, or lock joint \"" +
                                                joint.name() + "\" in the side file, which merges the link");
      }
      joint.set_mass_kg(mass.mass);
      SetXyz(mass.center, joint.mutable_center_of_mass_m());
      const Eigen::Matrix3d& inertia = mass.inertia;
      for (const double entry :
           {inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1), inertia(0, 2), inertia(1, 2)}) {
        joint.add_inertia_kg_m2(entry);
      }
    }
    result_.read.insert(result_.read.begin(),
                        tree_.format + " \"" + tree_.name + "\": " + std::to_string(tree_.links.size()) + " links, " +
                            std::to_string(tree_.joints.size()) + " joints, " + FormatNumber(total) + " kg");
  }

  // Index of the joint that carries a part of the side file, and where on its link.
  template <typename From>
  Carried PlaceOf(const char* list, const From& from) {
    const Carried& link = Of(tree_.FindLink(from.link()));
    if (link.joint < 0) {
      throw Failure(ExitCode::kUsage, side_path_ + ": " + list + " \"" + from.name() + "\": link \"" + from.link() +
                                          "\" is fixed to the world, no joint carries it");
    }
    return {link.joint, Compose(link.place, {ToRotation(from.orientation()), ToVector(from.center_m())})};
  }

  // Name, joint, shape and place of a surface, whether it touches the ground or other bodies.
  template <typename From, typename To>
  static void SetSurface(const Carried& carried, const From& from, To* to) {
    to->set_name(from.name());
    to->set_joint(carried.joint);
    *to->mutable_surface() = from.surface();
    SetXyz(carried.place.position, to->mutable_center_m());
    SetOrientation(carried.place.rotation, to);
  }

  void AddContacts() {
    const bool in_plane =
        std::none_of(result_.model.joints().begin(), result_.model.joints().end(),
                     [](const v1::Joint& joint) { return joint.role() == v1::Joint::ROLE_BASE_LATERAL; });
    for (const v1::SideContact& from : side_.contacts()) {
      v1::ContactSurface& to = *result_.model.add_contacts();
      SetSurface(PlaceOf("contact", from), from, &to);
      to.set_mirror_contact(from.mirror_contact());
      for (const int axis : {0, 1, 2}) {
        if (!in_plane || axis != 1) SetXyz(Eigen::Vector3d::Unit(axis), to.add_directions());
      }
      to.set_side(from.side());
      to.set_part(from.part());
    }
  }

  void AddBodies() {
    for (const v1::SideBody& from : side_.bodies()) {
      v1::BodySurface& to = *result_.model.add_bodies();
      SetSurface(PlaceOf("body", from), from, &to);
      to.set_mirror_body(from.mirror_body());
    }
    *result_.model.mutable_body_pairs() = side_.body_pairs();
  }

  void AddSummary() {
    v1::Model& model = result_.model;
    const std::string& name = side_.name().empty() ? tree_.name : side_.name();
    if (side_.name().empty()) RequireName("name of the robot", name);
    model.mutable_summary()->set_name(name);
    model.mutable_summary()->set_description(side_.description().empty()
                                                 ? "Robot " + tree_.name + ", read from " + tree_.format + "."
                                                 : side_.description());
    model.set_leg_length_m(side_.leg_length_m());
    *model.mutable_sources() = side_.sources();
    model.add_sources(tree_.format + " " + std::filesystem::path(tree_.path).filename().string() + " with side file " +
                      std::filesystem::path(side_path_).filename().string() + ".");
    for (const std::string& line : result_.assumed) {
      if (model.sources_size() < 60) model.add_sources(("Assumed: " + line).substr(0, 1900));
    }
    result_.left_out = tree_.left_out;
  }

  const LinkTree& tree_;
  const std::string& side_path_;
  const v1::ModelSideFile& side_;
  std::map<std::string, const v1::SideJoint*, std::less<>> said_;
  std::vector<Carried> carried_;  // of each link of the tree
  ImportedModel result_;
};

}  // namespace

ImportedModel ModelOfTree(const LinkTree& tree, const std::string& side_path, const v1::ModelSideFile& side) {
  return ModelMaker(tree, side_path, side).Make();
}

std::string AsModelName(const std::string& name) {
  std::string accepted = name.empty() ? "model" : name.substr(0, 64);
  std::replace_if(
      accepted.begin(), accepted.end(), [](unsigned char c) { return !IsNameLetter(c); }, '_');
  return accepted;
}

ImportedModel ReadImportedModel(const std::string& path, const std::string& side_path) {
  const LinkTree tree = ReadLinkTree(path);
  return ModelOfTree(tree, side_path, ReadSideFile(side_path, tree));
}

}  // namespace rollgait::client
