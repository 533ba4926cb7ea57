#include "client/import/urdf_document.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <utility>

#include "client/failure.h"
#include "client/import/link_tree.h"
#include "client/import/xml_source.h"

namespace rollgait::client {
namespace {

// Checks one document and copies what a model needs of it.
class UrdfCleaner {
 public:
  explicit UrdfCleaner(UrdfDocument* document) : document_(document), source_(document->path) {}

  void Clean(const tinyxml2::XMLDocument& xml) {
    const tinyxml2::XMLElement* const robot = xml.RootElement();
    if (robot == nullptr || std::strcmp(robot->Name(), "robot") != 0) {
      throw Failure(ExitCode::kUsage, document_->path + ": the root element is <" +
                                          (robot == nullptr ? std::string() : std::string(robot->Name())) +
                                          ">, must be <robot>: a URDF (run xacro first on a .xacro file)");
    }
    document_->robot = Name(*robot);
    tinyxml2::XMLElement* const to = out_.NewElement("robot");
    to->SetAttribute("name", document_->robot.c_str());
    out_.InsertEndChild(to);
    for (const auto* element = robot->FirstChildElement(); element != nullptr;
         element = element->NextSiblingElement()) {
      const std::string kind = element->Name();
      if (kind == "link") {
        CleanLink(*element, to);
      } else if (kind == "joint") {
        CleanJoint(*element, to);
      } else {
        others_.insert("<" + kind + ">");
      }
    }
    if (document_->links.empty()) Refuse(*robot, "has no <link>");
    CheckTree(*robot);
    if (!others_.empty()) {
      std::string names;
      for (const std::string& name : others_) names += (names.empty() ? "" : ", ") + name;
      document_->left_out.push_back("elements that are not part of a body: " + names.substr(0, 500));
    }
    if (meshes_ > 0) {
      document_->left_out.push_back(std::to_string(meshes_) +
                                    " collision shapes that are no box, sphere or cylinder; no mesh file is opened");
    }
    if (rubbing_ > 0) {
      document_->left_out.push_back("friction of " + std::to_string(rubbing_) + " joints, which a model does not have");
    }
    tinyxml2::XMLPrinter printer(nullptr, true);
    out_.Print(&printer);
    document_->xml = printer.CStr();
  }

 private:
  [[noreturn]] void Refuse(const tinyxml2::XMLElement& element, const std::string& reason) const {
    source_.Refuse(element, reason);
  }
  std::string Text(const tinyxml2::XMLElement& element, const char* attribute) const {
    return source_.Text(element, attribute);
  }
  std::string Name(const tinyxml2::XMLElement& element, const char* attribute = "name") const {
    return source_.Name(element, attribute);
  }
  const tinyxml2::XMLElement* Only(const tinyxml2::XMLElement& element, const char* child, bool required) const {
    return source_.Only(element, child, required);
  }
  // The attribute as so many finite numbers with one space between.
  std::string Numbers(const tinyxml2::XMLElement& element, const char* attribute, size_t count) const {
    return source_.Numbers(element, attribute, Text(element, attribute).c_str(), count, count).text;
  }

  tinyxml2::XMLElement* Add(tinyxml2::XMLElement* to, const char* name) {
    tinyxml2::XMLElement* const element = out_.NewElement(name);
    to->InsertEndChild(element);
    return element;
  }
  void CopyNumbers(const tinyxml2::XMLElement& from, const char* attribute, size_t count, bool required,
                   tinyxml2::XMLElement* to) {
    if (!required && from.Attribute(attribute) == nullptr) return;
    to->SetAttribute(attribute, Numbers(from, attribute, count).c_str());
  }
  void CopyOrigin(const tinyxml2::XMLElement& from, tinyxml2::XMLElement* to) {
    const tinyxml2::XMLElement* const origin = Only(from, "origin", false);
    if (origin == nullptr) return;
    tinyxml2::XMLElement* const copy = Add(to, "origin");
    CopyNumbers(*origin, "xyz", 3, false, copy);
    if (origin->Attribute("quat_xyzw") != nullptr) Refuse(*origin, "has quat_xyzw; give the rotation as rpy");
    CopyNumbers(*origin, "rpy", 3, false, copy);
  }

  void CleanLink(const tinyxml2::XMLElement& link, tinyxml2::XMLElement* robot) {
    const std::string name = Name(link);
    AddName(link, name, &link_names_, &document_->links);
    tinyxml2::XMLElement* const copy = Add(robot, "link");
    copy->SetAttribute("name", name.c_str());
    if (const auto* inertial = Only(link, "inertial", false)) {
      tinyxml2::XMLElement* const to = Add(copy, "inertial");
      CopyOrigin(*inertial, to);
      CopyNumbers(*Only(*inertial, "mass", true), "value", 1, true, Add(to, "mass"));
      tinyxml2::XMLElement* const inertia = Add(to, "inertia");
      for (const char* entry : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}) {
        CopyNumbers(*Only(*inertial, "inertia", true), entry, 1, true, inertia);
      }
    }
    for (const auto* collision = link.FirstChildElement("collision"); collision != nullptr;
         collision = collision->NextSiblingElement("collision")) {
      CleanCollision(*collision, copy);
    }
  }

  void CleanCollision(const tinyxml2::XMLElement& collision, tinyxml2::XMLElement* link) {
    constexpr std::pair<const char*, std::pair<const char*, size_t>> kSizes[] = {
        {"box", {"size", 3}}, {"sphere", {"radius", 1}}, {"cylinder", {"radius", 1}}};
    const tinyxml2::XMLElement* const shape = Only(collision, "geometry", true)->FirstChildElement();
    for (const auto& [kind, size] : kSizes) {
      if (shape == nullptr || std::strcmp(shape->Name(), kind) != 0) continue;
      tinyxml2::XMLElement* const copy = Add(link, "collision");
      CopyOrigin(collision, copy);
      tinyxml2::XMLElement* const to = Add(Add(copy, "geometry"), kind);
      CopyNumbers(*shape, size.first, size.second, true, to);
      if (std::strcmp(kind, "cylinder") == 0) CopyNumbers(*shape, "length", 1, true, to);
      return;
    }
    ++meshes_;
  }

  void CleanJoint(const tinyxml2::XMLElement& joint, tinyxml2::XMLElement* robot) {
    const std::string name = Name(joint), type = Text(joint, "type");
    AddName(joint, name, &joint_names_, &document_->joints);
    const std::vector<std::string> types = {"fixed", "revolute", "continuous", "prismatic", "floating", "planar"};
    if (std::find(types.begin(), types.end(), type) == types.end()) {
      Refuse(joint, "type \"" + type.substr(0, 40) +
                        "\" is unknown; must be fixed, revolute, continuous, prismatic, floating or planar");
    }
    tinyxml2::XMLElement* const copy = Add(robot, "joint");
    copy->SetAttribute("name", name.c_str());
    copy->SetAttribute("type", type.c_str());
    std::string ends[2];
    for (const int end : {0, 1}) {
      const char* const kind = end == 0 ? "parent" : "child";
      ends[end] = Name(*Only(joint, kind, true), "link");
      Add(copy, kind)->SetAttribute("link", ends[end].c_str());
    }
    edges_.push_back({&joint, ends[0], ends[1]});
    CopyOrigin(joint, copy);
    if (const auto* axis = Only(joint, "axis", false)) CopyNumbers(*axis, "xyz", 3, true, Add(copy, "axis"));
    const bool bounded = type == "revolute" || type == "prismatic";
    if (const auto* limit = Only(joint, "limit", bounded)) {
      tinyxml2::XMLElement* const to = Add(copy, "limit");
      for (const char* end : {"lower", "upper"}) CopyNumbers(*limit, end, 1, false, to);
      for (const char* most : {"effort", "velocity"}) CopyNumbers(*limit, most, 1, true, to);
    }
    if (const auto* mimic = Only(joint, "mimic", false)) {
      tinyxml2::XMLElement* const to = Add(copy, "mimic");
      to->SetAttribute("joint", Name(*mimic, "joint").c_str());
    }
    if (const auto* dynamics = Only(joint, "dynamics", false)) {
      if (dynamics->Attribute("damping") != nullptr) {
        CopyNumbers(*dynamics, "damping", 1, true, Add(copy, "dynamics"));
      }
      if (dynamics->Attribute("friction") != nullptr) ++rubbing_;
    }
    if (joint.FirstChildElement("safety_controller") != nullptr) others_.insert("<safety_controller>");
    if (joint.FirstChildElement("calibration") != nullptr) others_.insert("<calibration>");
  }

  // Every link but one is the child of one joint, and leads to that one.
  void CheckTree(const tinyxml2::XMLElement& robot) const {
    std::map<std::string, const Edge*> to_parent;
    for (const Edge& edge : edges_) {
      for (const std::string& end : {edge.parent, edge.child}) {
        if (link_names_.count(end) == 0)
          Refuse(*edge.joint, "names the link \"" + end + "\", which the file does not have");
      }
      if (!to_parent.emplace(edge.child, &edge).second) {
        Refuse(*edge.joint, "the link \"" + edge.child + "\" is also the child of joint \"" +
                                to_parent[edge.child]->joint->Attribute("name") +
                                "\"; a URDF is a tree: closed chains are not read");
      }
    }
    std::vector<std::string> roots;
    for (const std::string& link : document_->links) {
      if (to_parent.count(link) == 0) roots.push_back(link);
      std::string at = link;
      for (size_t steps = 0; to_parent.count(at) != 0; ++steps) {
        if (steps > document_->links.size())
          Refuse(*to_parent[at]->joint, "is part of a cycle: following parents never ends");
        at = to_parent[at]->parent;
      }
    }
    if (roots.size() > 1) {
      Refuse(robot, "has several links that are the child of no joint, \"" + roots[0] + "\" and \"" + roots[1] +
                        "\"; connect them by a joint, or remove one");
    }
  }

  void AddName(const tinyxml2::XMLElement& element, const std::string& name, std::set<std::string>* seen,
               std::vector<std::string>* names) {
    if (!seen->insert(name).second) Refuse(element, "the name is used twice; give each a name of its own");
    names->push_back(name);
    if (names->size() > kMaxTreeLinks) {
      Refuse(element, "is one of more than " + std::to_string(kMaxTreeLinks) + "; a model has at most 64 joints");
    }
  }

  struct Edge {
    const tinyxml2::XMLElement* joint;
    std::string parent, child;  // names of links
  };

  UrdfDocument* const document_;
  const XmlSource source_;
  std::vector<Edge> edges_;
  tinyxml2::XMLDocument out_;
  std::set<std::string> link_names_, joint_names_, others_;
  int meshes_ = 0, rubbing_ = 0;  // collision shapes and joints of which something is left out
};

}  // namespace

UrdfDocument CheckUrdf(const std::string& path, const tinyxml2::XMLDocument& xml) {
  UrdfDocument document;
  document.path = path;
  UrdfCleaner(&document).Clean(xml);
  return document;
}

}  // namespace rollgait::client
