#include "client/import/mjcf_tree.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cstring>

#include "client/import/lumped_links.h"
#include "client/import/mjcf_actuators.h"
#include "client/import/mjcf_joint.h"
#include "client/import/mjcf_mass.h"
#include "client/import/tree_chain.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

using tinyxml2::XMLElement;

// Elements whose content the file does not have itself.
constexpr const char* kElsewhere[] = {"include", "attach", "composite", "replicate", "flexcomp"};
// Of the top level and of bodies.
struct MjcfReason {
  const char* kind;
  const char* reason;
};
constexpr MjcfReason kMjcfNotRead[] = {
    {"option", "gravity, steps and solvers are those of the request"},
    {"size", "nothing to be told"},
    {"statistic", "nothing to be told"},
    {"visual", "looks are no part of a model"},
    {"asset", "no file is opened; meshes and textures are no part of a model"},
    {"contact", "the ground is met by the contacts of the side file"},
    {"deformable", "a model has rigid links only"},
    {"tendon", "a model has no tendons"},
    {"sensor", "a model has no sensors"},
    {"keyframe", "the posture at position zero is that of the side file's references"},
    {"custom", "nothing to be told"},
    {"extension", "no plugin is loaded"},
    {"light", "looks are no part of a model"},
    {"camera", "looks are no part of a model"},
    {"site", "a model has no sites"},
    {"plugin", "no plugin is loaded"},
};

bool Is(const XMLElement& element, const char* kind) { return std::strcmp(element.Name(), kind) == 0; }

class MjcfReader {
 public:
  explicit MjcfReader(const std::string& path) : source_(path), left_out_(&source_) {
    tree_.path = path;
    tree_.link_element = "body";
    tree_.joint_element = "joint";
    tree_.states_velocity = false;
    tree_.AddLink({.name = "world"});
  }

  LinkTree Read(const XMLElement& root) {
    tree_.name = root.Attribute("model") == nullptr ? "MuJoCo" : source_.Name(root, "model");
    // What holds for all elements, wherever it stands.
    ForEach(root, [&](const XMLElement& part) {
      if (Is(part, "compiler")) compiler_.Read(source_, part);
      if (Is(part, "default")) defaults_.Add(source_, part);
    });
    ForEach(root, [&](const XMLElement& part) {
      if (Is(part, "worldbody")) ReadWorld(part);
    });
    if (tree_.links.size() == 1) source_.Refuse(root, "has no <body> in a <worldbody>");
    SetTotalMass();
    ForEach(root, [&](const XMLElement& part) { ReadPart(part); });
    if (actuated_ && all_of_joints_) {
      for (TreeJoint& joint : tree_.joints) joint.driven = actuated_joints_.driven.count(joint.name) != 0;
    }
    tree_.left_out = left_out_.Lines();
    return std::move(tree_);
  }

 private:
  // A body while its elements are read.
  struct Body {
    int link = -1;
    std::string childclass;
    TreeChain chain;
    const XMLElement* free = nullptr;
    const XMLElement* inertial = nullptr;
    const XMLElement* weighs_as_file = nullptr;
    std::vector<MassProperties> geoms;
    Eigen::Vector3d anchor = Eigen::Vector3d::Zero();  // of the last joint, in the body
    struct Child {
      const XMLElement* element;
      Pose frame;
      std::string childclass;
    };
    std::vector<Child> children;
  };

  template <typename Do>
  void ForEach(const XMLElement& parent, const Do& act) const {
    for (const auto* child = parent.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      for (const char* kind : kElsewhere) {
        if (Is(*child, kind)) {
          source_.Refuse(*child,
                         "is content of another file, or made by MuJoCo; no other file is opened. Write what it "
                         "stands for in its place");
        }
      }
      act(*child);
    }
  }

  MjcfElement Element(const XMLElement& element, const std::string& childclass, const char* kind) {
    const std::string own = element.Attribute("class") == nullptr ? childclass : source_.Name(element, "class");
    return {&source_, &compiler_, &element, &defaults_.Find(source_, element, own, kind)};
  }
  MjcfElement Element(const XMLElement& element) const { return {&source_, &compiler_, &element, nullptr}; }
  std::string ChildClass(const XMLElement& element, const std::string& otherwise) const {
    return element.Attribute("childclass") == nullptr ? otherwise : source_.Name(element, "childclass");
  }

  static bool HasJoint(const XMLElement& body) {
    for (const auto* child = body.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      if (Is(*child, "joint") || Is(*child, "freejoint")) return true;
      if ((Is(*child, "body") || Is(*child, "frame")) && HasJoint(*child)) return true;
    }
    return false;
  }

  void ReadWorld(const XMLElement& world) {
    Body body;
    body.link = 0;
    const bool any_moves = HasJoint(world);
    ReadContent(world, kNoMotion, ChildClass(world, ""), &body);
    for (const Body::Child& child : body.children) {
      if (any_moves && !HasJoint(*child.element)) {
        left_out_.Add(*child.element, "it is fixed to the world: no joint moves it or what it carries");
      } else {
        ReadBody(child, 0);
      }
    }
  }

  void ReadBody(const Body::Child& from, int parent) {
    const XMLElement& element = *from.element;
    Body body;
    body.childclass = ChildClass(element, from.childclass);
    const std::string name =
        element.Attribute("name") == nullptr ? "body_" + std::to_string(tree_.links.size()) : source_.Name(element);
    body.link = tree_.AddLink({.name = name, .is_made = element.Attribute("name") == nullptr});
    if (element.Attribute("mocap") != nullptr && source_.Flag(element, "mocap", element.Attribute("mocap"))) {
      source_.Refuse(element, "is moved by motion capture, which a model cannot express; remove it");
    }
    if (element.Attribute("gravcomp") != nullptr) left_out_.Add(element, "gravcomp: gravity acts on all links");
    const Pose place = Compose(from.frame, Element(element).Place());
    body.chain = {.name = name + "_fixed", .parent = parent, .child = body.link, .from_world = parent == 0};
    ReadContent(element, kNoMotion, body.childclass, &body);
    tree_.links[static_cast<size_t>(body.link)].mass = MassOf(body);
    if (body.free != nullptr) {
      AddFree(body, place);
    } else if (body.chain.joints.empty()) {
      body.chain.end = place;
      AddChain(body.chain, &tree_);
    } else {
      body.chain.joints[0].origin = Compose(place, body.chain.joints[0].origin);
      body.chain.end.position = -body.anchor;
      if (AddChain(body.chain, &tree_)) {
        for (const TreeJoint& joint : body.chain.joints) actuated_joints_.base.insert(joint.name);
      }
    }
    for (const Body::Child& child : body.children) ReadBody(child, body.link);
  }

  void AddFree(const Body& body, const Pose& place) {
    const char* const given = body.free->Attribute("name");
    if (body.chain.parent != 0 || !body.chain.joints.empty()) {
      source_.Refuse(*body.free, "is free; the body must be one of the world, and have no other joint");
    }
    TreeJoint joint{.name = given == nullptr ? body.chain.name : source_.Name(*body.free),
                    .type = TreeJoint::Type::kFloating,
                    .parent = 0,
                    .child = body.link};
    joint.origin.rotation = place.rotation;  // where it is does not matter to a gait
    actuated_joints_.base.insert(joint.name);
    tree_.joints.push_back(joint);
  }

  // `frame` places what is read in the body.
  void ReadContent(const XMLElement& element, const Pose& frame, const std::string& childclass, Body* body) {
    ForEach(element, [&](const XMLElement& part) {
      if (Is(part, "body")) {
        body->children.push_back({&part, frame, childclass});
      } else if (Is(part, "frame")) {
        ReadContent(part, Compose(frame, Element(part).Place()), ChildClass(part, childclass), body);
      } else if (Is(part, "geom")) {
        ReadGeom(part, frame, childclass, body);
      } else if (Is(part, "inertial")) {
        if (body->inertial != nullptr) source_.Refuse(part, "stands twice");
        body->inertial = &part;
      } else if (Is(part, "freejoint")) {
        SetFree(part, body);
      } else if (Is(part, "joint")) {
        ReadJoint(part, frame, childclass, body);
      } else {
        Omit(part);
      }
    });
  }

  void SetFree(const XMLElement& joint, Body* body) const {
    if (body->free != nullptr) source_.Refuse(joint, "is the second free joint of its body");
    body->free = &joint;
  }

  void ReadGeom(const XMLElement& part, const Pose& frame, const std::string& childclass, Body* body) {
    if (body->link == 0) return left_out_.Add(part, "it is fixed to the world; the ground is that of the request");
    const MjcfGeom geom = ReadMjcfGeom(Element(part, childclass, "geom"));
    if (geom.is_file) left_out_.Add(part, "its shape is in a file, and no file is opened");
    if (geom.weighs_as_file) body->weighs_as_file = &part;
    body->geoms.push_back(Placed(geom.mass, frame));
    if (!geom.shape) return;
    tree_.links[static_cast<size_t>(body->link)].shapes.push_back(*geom.shape);
    TreeShape& shape = tree_.links[static_cast<size_t>(body->link)].shapes.back();
    shape.place = Compose(frame, shape.place);
  }

  MassProperties MassOf(const Body& body) const {
    using FromGeoms = MjcfCompiler::FromGeoms;
    const FromGeoms rule = compiler_.inertia_from_geoms;
    const bool from_geoms = rule == FromGeoms::kAlways || (rule == FromGeoms::kWithoutInertial && !body.inertial);
    if (!from_geoms) {
      if (body.inertial == nullptr) return BoundedMass(compiler_, {});
      return BoundedMass(compiler_, ReadMjcfInertial(Element(*body.inertial)));
    }
    if (body.weighs_as_file != nullptr) {
      source_.Refuse(*body.weighs_as_file,
                     "is a mesh, and its mass counts, but no file is opened; give its body an "
                     "<inertial>, or the mesh mass=\"0\"");
    }
    return BoundedMass(compiler_, Lump(body.geoms));
  }

  void ReadJoint(const XMLElement& part, const Pose& frame, const std::string& childclass, Body* body) {
    const MjcfElement from = Element(part, childclass, "joint");
    const std::string type = MjcfJointType(from);
    if (body->link == 0) source_.Refuse(part, "is a joint of the world, which does not move");
    if (type == "free") return SetFree(part, body);
    const std::string name = NameOf(part, *body);
    if (type == "ball") return AddBall(from, name, frame, body);
    TreeJoint joint = ReadMjcfJoint(from, &left_out_);
    joint.name = name;
    const Eigen::Vector3d anchor = frame.position + frame.rotation * joint.origin.position;
    joint.origin.position = anchor - body->anchor;
    joint.axis = frame.rotation * joint.axis;
    body->anchor = anchor;
    actuated_joints_.ranges[joint.name] = ReadForceRange(from, "actuatorfrclimited", "actuatorfrcrange");
    body->chain.joints.push_back(joint);
  }

  void AddBall(const MjcfElement& from, const std::string& name, const Pose& frame, Body* body) {
    // Behind three slides it is a part of the floating base.
    if (body->chain.from_world && body->chain.joints.size() != 3) {
      actuated_joints_.base.insert(name);
      return left_out_.Add(from.xml(), "it holds the base, which floats: fixed in the posture of the file");
    }
    actuated_joints_.balls.insert(name);
    const ForceRange range = ReadForceRange(from, "actuatorfrclimited", "actuatorfrcrange");
    std::vector<TreeJoint> turns = ReadMjcfBall(from, name, &left_out_);
    if (!body->chain.from_world && turns[1].upper != turns[0].upper) {
      left_out_.Add(from.xml(), "turns about x of its body beyond ±80°: at ±90° three turns lose a direction");
    }
    for (TreeJoint& turn : turns) {
      const Eigen::Vector3d anchor = frame.position + frame.rotation * from.Vector("pos", Eigen::Vector3d::Zero());
      turn.origin.position = anchor - body->anchor;
      body->anchor = anchor;
      actuated_joints_.ranges[turn.name] = range;
      body->chain.joints.push_back(turn);
    }
  }

  std::string NameOf(const XMLElement& joint, const Body& body) const {
    if (joint.Attribute("name") != nullptr) return source_.Name(joint);
    const size_t count = body.chain.joints.size();
    return tree_.links[static_cast<size_t>(body.link)].name + "_joint" + (count == 0 ? "" : std::to_string(count + 1));
  }

  void SetTotalMass() {
    if (!(compiler_.total_mass > 0)) return;
    double total = 0;
    for (const TreeLink& link : tree_.links) total += link.mass.mass;
    if (!(total > 0)) return;
    for (TreeLink& link : tree_.links) {
      link.mass.mass *= compiler_.total_mass / total;
      link.mass.inertia *= compiler_.total_mass / total;
    }
  }

  void ReadPart(const XMLElement& part) {
    if (Is(part, "compiler") || Is(part, "default") || Is(part, "worldbody")) return;
    if (Is(part, "actuator")) {
      ForEach(part, [&](const XMLElement& actuator) { ReadActuator(actuator); });
    } else if (Is(part, "equality")) {
      ForEach(part, [&](const XMLElement& equality) { ReadEquality(equality); });
    } else {
      Omit(part);
    }
  }

  void ReadActuator(const XMLElement& part) {
    const MjcfElement actuator = Element(part, "", "motor");
    actuated_ = true;
    if (!AddMjcfActuator(actuator, &actuated_joints_, &tree_, &left_out_)) all_of_joints_ = false;
  }

  void ReadEquality(const XMLElement& part) {
    const char* const active = part.Attribute("active");
    if (active != nullptr && !source_.Flag(part, "active", active)) return;
    if (Is(part, "joint") && part.Attribute("joint2") != nullptr) {
      const int joint = tree_.FindJoint(source_.Name(part, "joint1"));
      if (joint < 0) source_.Refuse(part, "joint1 is no joint of the file that moves");
      tree_.joints[static_cast<size_t>(joint)].mimics = source_.Name(part, "joint2");
    } else {
      left_out_.Add(part, "a model is a tree without constraints");
    }
  }

  void Omit(const XMLElement& part) {
    const auto row = std::find_if(std::begin(kMjcfNotRead), std::end(kMjcfNotRead),
                                  [&](const MjcfReason& r) { return Is(part, r.kind); });
    left_out_.Add(part, row == std::end(kMjcfNotRead) ? "is not known to the reader" : row->reason);
  }

  const XmlSource source_;
  LeftOut left_out_;
  MjcfCompiler compiler_;
  MjcfDefaults defaults_;
  LinkTree tree_;
  ActuatedJoints actuated_joints_;
  bool actuated_ = false, all_of_joints_ = true;
};

}  // namespace

LinkTree ReadMjcf(const std::string& path, const tinyxml2::XMLDocument& xml) {
  return MjcfReader(path).Read(*xml.RootElement());
}

}  // namespace rollgait::client
