#include "client/import/osim_tree.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "client/import/lumped_links.h"
#include "client/import/osim_forces.h"
#include "client/import/osim_frames.h"
#include "client/import/osim_joint.h"
#include "client/import/osim_values.h"
#include "client/import/tree_chain.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

// Children of <Model> that are not read and hold something that a user may miss.
struct OsimReason {
  const char* kind;
  const char* reason;
};
constexpr OsimReason kOsimNotRead[] = {
    {"MarkerSet", "a model has no markers"},
    {"ControllerSet", "efforts are what is computed"},
    {"ProbeSet", "nothing to be told"},
    {"ComponentSet", "a model is made of BodySet and JointSet"},
    {"components", "a model is made of BodySet and JointSet"},
    {"WrapObjectSet", "a model has no muscles"},
    {"ModelVisualPreferences", "looks are no part of a model"},
};

class OsimReader {
 public:
  explicit OsimReader(const std::string& path) : source_(path), left_out_(&source_) {
    tree_.path = path;
    tree_.link_element = "Body";
    tree_.joint_element = "Coordinate";
    tree_.states_velocity = false;
    tree_.AddLink({.name = "ground"});
  }

  LinkTree Read(const tinyxml2::XMLElement& root) {
    RequireVersion(root);
    const OsimElement model(&source_, source_.Only(root, "Model", true));
    tree_.name = model.xml().Attribute("name") == nullptr ? "OpenSim" : model.Name();
    RequireUpright(model);
    if (const auto* ground = source_.Only(model.xml(), "Ground", false)) {
      frames_.AddBody(OsimElement(&source_, ground), "ground", 0);
    } else {
      frames_.AddBody(model, "ground", 0);
    }
    for (const OsimElement& body : model.Objects("BodySet")) ReadBody(body);
    if (tree_.links.size() == 1) model.Refuse("has no <Body> in a <BodySet>");
    for (const OsimElement& joint : model.Objects("JointSet")) ReadJoint(joint);
    for (const OsimElement& shape : model.Objects("ContactGeometrySet")) ReadContact(shape);
    for (const OsimElement& constraint : model.Objects("ConstraintSet")) ReadConstraint(constraint);
    bool unlimited = false;
    for (const OsimElement& force : model.Objects("ForceSet")) {
      unlimited = AddOsimForce(force, base_, &tree_, &left_out_) || unlimited;
    }
    if (unlimited) tree_.assumed.push_back("controls of actuators without min_control and max_control: ±1");
    for (const auto& [kind, reason] : kOsimNotRead) {
      for (const OsimElement& object : model.Objects(kind)) left_out_.Add(object.xml(), reason);
    }
    tree_.left_out = left_out_.Lines();
    return std::move(tree_);
  }

 private:
  void RequireVersion(const tinyxml2::XMLElement& root) const {
    const double version = source_.Number(root, "Version", source_.Text(root, "Version").c_str());
    if (version >= 40000) return;
    source_.Refuse(root, "is of version " + FormatNumber(version, 6) +
                             "; from 40000 on are read: open it in OpenSim 4 and save it");
  }

  void RequireUpright(const OsimElement& model) const {
    const Eigen::Vector3d gravity = model.Vector("gravity", -Eigen::Vector3d::UnitY());
    if (gravity.isZero(0) || -gravity.y() > 0.7 * gravity.norm()) return;
    model.Refuse("its gravity is (" + FormatNumber(gravity.x()) + ", " + FormatNumber(gravity.y()) + ", " +
                 FormatNumber(gravity.z()) + "); Y must be up: gravity within 45° of −Y");
  }

  void ReadBody(const OsimElement& body) {
    if (body.Kind() != "Body") body.Refuse("must be a Body");
    TreeLink link{.name = body.Name()};
    link.mass.mass = body.Number("mass", 0);
    link.mass.center = FromOpensim(body.Vector("mass_center", Eigen::Vector3d::Zero()));
    const std::vector<double> i = body.Numbers("inertia", 6, 6);
    if (!i.empty()) {
      Eigen::Matrix3d inertia;
      inertia << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
      link.mass.inertia = FromOpensim(inertia);
    }
    ReadShapes(body, kNoMotion, &link);
    for (const OsimElement& component : body.Objects("components")) {
      if (component.Kind() == "PhysicalOffsetFrame") ReadShapes(component, component.Place(), &link);
    }
    const std::string name = link.name;
    frames_.AddBody(body, name, tree_.AddLink(std::move(link)));
  }

  void ReadShapes(const OsimElement& frame, const Pose& place, TreeLink* link) {
    for (const OsimElement& shape : frame.Objects("attached_geometry")) {
      const std::string kind = shape.Kind();
      if (kind == "Ellipsoid" || kind == "Brick") {
        const Eigen::Vector3d half =
            FromOpensim(shape.Vector(kind == "Brick" ? "half_lengths" : "radii", Eigen::Vector3d::Zero())).cwiseAbs();
        link->shapes.push_back({kind == "Brick" ? TreeShape::Kind::kBox : TreeShape::Kind::kEllipsoid, half, place});
      } else if (kind == "Sphere") {
        link->shapes.push_back(SphereOf(shape, place));
      } else {
        left_out_.Add(shape.xml(), "it is only to look at; no file is opened");
      }
    }
  }

  static TreeShape SphereOf(const OsimElement& shape, const Pose& place) {
    return {TreeShape::Kind::kSphere, Eigen::Vector3d::Constant(shape.Number("radius", 0)), place};
  }

  void ReadJoint(const OsimElement& joint) {
    const std::vector<OsimElement> frames = joint.Objects("frames");
    const OsimPlace parent = frames_.Find(joint, joint.Text("socket_parent_frame"), frames);
    const OsimPlace child = frames_.Find(joint, joint.Text("socket_child_frame"), frames);
    if (child.link == 0) joint.Refuse("its child is the ground; exchange parent and child");
    OsimMotion motion = ReadOsimMotion(joint, &left_out_);
    const Pose to_child = Inverse(child.pose);
    TreeChain chain{.name = joint.Name(), .parent = parent.link, .child = child.link, .from_world = parent.link == 0};
    chain.end = Compose(motion.end, to_child);
    if (motion.joints.empty()) {
      chain.end = Compose(parent.pose, chain.end);
    } else {
      motion.joints[0].origin = Compose(parent.pose, motion.joints[0].origin);
    }
    chain.joints = motion.joints;
    if (AddChain(std::move(chain), &tree_)) {
      for (const TreeJoint& coordinate : motion.joints) base_.insert(coordinate.name);
    }
  }

  static Pose Inverse(const Pose& pose) {
    return {pose.rotation.transpose(), -(pose.rotation.transpose() * pose.position)};
  }

  // Spheres of feet are shapes to fit an ellipsoid to.
  void ReadContact(const OsimElement& shape) {
    if (shape.Kind() == "ContactSphere") {
      OsimPlace place = frames_.Find(shape, shape.Text("socket_frame"), {});
      place.pose.position += place.pose.rotation * FromOpensim(shape.Vector("location", Eigen::Vector3d::Zero()));
      if (place.link > 0) tree_.links[static_cast<size_t>(place.link)].shapes.push_back(SphereOf(shape, place.pose));
    }
    left_out_.Add(shape.xml(), "the ground is met by the contacts of the side file");
  }

  void ReadConstraint(const OsimElement& constraint) {
    if (!constraint.Flag("isEnforced", true)) return;
    const std::vector<std::string> independent = constraint.Words("independent_coordinate_names");
    const int joint = tree_.FindJoint(constraint.Text("dependent_coordinate_name"));
    if (constraint.Kind() == "CoordinateCouplerConstraint" && !independent.empty() && joint >= 0) {
      source_.RequireName(constraint.xml(), "independent_coordinate_names", independent[0]);
      tree_.joints[static_cast<size_t>(joint)].mimics = independent[0];
    } else {
      left_out_.Add(constraint.xml(), "a model is a tree without constraints");
    }
  }

  const XmlSource source_;
  LeftOut left_out_;
  LinkTree tree_;
  OsimFrames frames_;
  std::set<std::string> base_;  // names of coordinates
};

}  // namespace

LinkTree ReadOsim(const std::string& path, const tinyxml2::XMLDocument& xml) {
  return OsimReader(path).Read(*xml.RootElement());
}

}  // namespace rollgait::client
