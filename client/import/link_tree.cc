#include "client/import/link_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "client/failure.h"
#include "client/principal_axes.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr double kMostLength = 10;  // m
constexpr double kMostMass = 1e6;   // kg

class TreeFinisher {
 public:
  explicit TreeFinisher(LinkTree* tree) : tree_(*tree) {}

  void Finish() {
    NameLinks();
    std::map<std::string, std::string> joints;  // what has the joint of a name as one of its turns
    for (const TreeLink& link : tree_.links) CheckLink(link);
    for (TreeJoint& joint : tree_.joints) {
      const auto [other, is_new] = joints.emplace(joint.name, joint.turn_of);
      if (!is_new) RefuseSecond(joint, other->second);
      CheckJoint(&joint);
    }
    FindRoot();
    Sort();
  }

 private:
  void NameLinks() {
    std::set<std::string> names;
    for (const TreeLink& link : tree_.links) {
      if (link.is_made || names.insert(link.name).second) continue;
      tree_.RefuseLink(link.name, "the name is used twice; give each its own");
    }
    for (TreeLink& link : tree_.links) {
      while (link.is_made && !names.insert(link.name).second) link.name += "_";
    }
  }

  // first_of: the joint that has the first of the name as one of its turns; empty: none has.
  [[noreturn]] void RefuseSecond(const TreeJoint& second, const std::string& first_of) {
    const std::string twice = "the name is used twice", end = "; give each its own";
    const std::string& ball = first_of.empty() ? second.turn_of : first_of;
    if (ball.empty()) tree_.RefuseJoint(second.name, twice + end);
    if (first_of == second.turn_of) tree_.RefuseJoint(ball, twice + end);
    tree_.RefuseJoint(second.name,
                      twice + ", and so is called one of the three turns of the joint \"" + ball + "\"" + end);
  }

  static std::string Millimetres(const std::string& what, const Eigen::Vector3d& v) {
    return what + " is (" + FormatNumber(v.x()) + ", " + FormatNumber(v.y()) + ", " + FormatNumber(v.z()) +
           ") m; every component must be within ±10 m: lengths are metres, these look like millimetres";
  }
  static bool IsFar(const Eigen::Vector3d& v) { return !(v.cwiseAbs().maxCoeff() <= kMostLength); }

  void CheckLink(const TreeLink& link) const {
    const auto require_near = [&](const std::string& what, const Eigen::Vector3d& v) {
      if (IsFar(v)) tree_.RefuseLink(link.name, Millimetres(what, v));
    };
    const MassProperties& mass = link.mass;
    if (!(mass.mass >= 0 && mass.mass <= kMostMass)) {
      tree_.RefuseLink(link.name, "its mass is " + FormatNumber(mass.mass) + " kg; must be in [0, 1e6] kg");
    }
    if (mass.mass == 0 && !mass.inertia.isZero(0)) {
      tree_.RefuseLink(link.name, "its mass is 0, but its inertia is not; give a mass, or no inertia");
    }
    require_near("the centre of mass", mass.center);
    const Eigen::Vector3d moments = PrincipalAxesOf(mass.inertia).moments;
    if (!(moments(0) >= -1e-6 * moments.cwiseAbs().maxCoeff())) {
      tree_.RefuseLink(link.name, "its inertia has the principal moment " + FormatNumber(moments(0)) +
                                      " kg m²; none may be negative");
    }
    for (const TreeShape& shape : link.shapes) {
      if (!(shape.half_size.minCoeff() > 0)) tree_.RefuseLink(link.name, "a shape has a size <= 0");
      require_near("the size of a shape", shape.half_size);
      require_near("the place of a shape", shape.place.position);
    }
  }

  void CheckJoint(TreeJoint* joint) const {
    const std::string& name = joint->name;
    if (IsFar(joint->origin.position)) tree_.RefuseJoint(name, Millimetres("its origin", joint->origin.position));
    if (IsFar(joint->end.position)) tree_.RefuseJoint(name, Millimetres("the child's place", joint->end.position));
    if (!joint->Moves()) return;
    const double length = joint->axis.norm();
    if (!(length > 1e-6)) tree_.RefuseJoint(name, "its axis has length 0; give a direction");
    if (std::abs(length - 1) > 1e-15) joint->axis.normalize();
    if (joint->type != TreeJoint::Type::kContinuous && !(joint->lower < joint->upper)) {
      tree_.RefuseJoint(name, "its range has lower " + FormatNumber(joint->lower) + " and upper " +
                                  FormatNumber(joint->upper) + "; lower must be below upper");
    }
    if (!(joint->effort_min <= 0 && joint->effort_max >= 0 && joint->velocity >= 0)) {
      tree_.RefuseJoint(name, "its effort is limited to " + FormatNumber(joint->effort_min) + " … " +
                                  FormatNumber(joint->effort_max) + " and its velocity to " +
                                  FormatNumber(joint->velocity) +
                                  "; the effort must reach 0 from both sides, no limit may be negative");
    }
    for (const auto& [what, value] : {std::pair("damping", joint->damping), {"stiffness", joint->stiffness}}) {
      if (!(value >= 0 && value <= 1e9)) {
        tree_.RefuseJoint(name, std::string("its ") + what + " is " + FormatNumber(value) + "; must be at least 0");
      }
    }
  }

  void FindRoot() {
    std::vector<bool> is_child(tree_.links.size());
    for (const TreeJoint& joint : tree_.joints) {
      const auto child = static_cast<size_t>(joint.child);
      if (is_child[child]) {
        tree_.RefuseJoint(joint.name, "its child \"" + tree_.links[child].name +
                                          "\" has a parent already; closed chains are not read");
      }
      is_child[child] = true;
    }
    for (size_t i = 0; i < tree_.links.size(); ++i) {
      if (is_child[i]) continue;
      if (tree_.root >= 0) {
        tree_.RefuseLink(tree_.links[i].name, "is the child of no joint, and neither is \"" +
                                                  tree_.links[static_cast<size_t>(tree_.root)].name +
                                                  "\"; connect them by a joint, or remove one");
      }
      tree_.root = static_cast<int>(i);
    }
    if (tree_.root < 0) tree_.RefuseLink(tree_.links[0].name, "is part of a cycle: following parents never ends");
  }

  // Parents first; among those that can come next, the first of the file.
  void Sort() {
    std::vector<TreeJoint> joints;
    std::vector<bool> placed(tree_.links.size(), false), taken(tree_.joints.size(), false);
    placed[static_cast<size_t>(tree_.root)] = true;
    while (joints.size() < tree_.joints.size()) {
      size_t next = 0;
      while (next < taken.size() && (taken[next] || !placed[static_cast<size_t>(tree_.joints[next].parent)])) ++next;
      if (next == taken.size()) {
        next = static_cast<size_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
        tree_.RefuseJoint(tree_.joints[next].name, "is part of a cycle: following parents never ends");
      }
      taken[next] = true;
      placed[static_cast<size_t>(tree_.joints[next].child)] = true;
      joints.push_back(tree_.joints[next]);
    }
    tree_.joints = std::move(joints);
  }

  LinkTree& tree_;
};

template <typename Parts>
int Find(const Parts& parts, const std::string& name) {
  const auto found = std::find_if(parts.begin(), parts.end(), [&](const auto& part) { return part.name == name; });
  return found == parts.end() ? -1 : static_cast<int>(found - parts.begin());
}

[[noreturn]] void RefusePart(const LinkTree& tree, const std::string& element, const std::string& name,
                             const std::string& reason) {
  throw Failure(ExitCode::kUsage, tree.path + ": <" + element + " name=\"" + name + "\">: " + reason);
}

}  // namespace

int LinkTree::AddLink(TreeLink link) {
  if (links.size() == kMaxTreeLinks) {
    RefuseLink(link.name, "is one of more than " + std::to_string(kMaxTreeLinks) + "; a model has at most 64 joints");
  }
  links.push_back(std::move(link));
  return static_cast<int>(links.size()) - 1;
}

int LinkTree::FindLink(const std::string& link) const { return Find(links, link); }
int LinkTree::FindJoint(const std::string& joint) const { return Find(joints, joint); }

void LinkTree::RefuseLink(const std::string& link, const std::string& reason) const {
  RefusePart(*this, link_element, link, reason);
}
void LinkTree::RefuseJoint(const std::string& joint, const std::string& reason) const {
  RefusePart(*this, joint_element, joint, reason);
}

void FinishTree(LinkTree* tree) { TreeFinisher(tree).Finish(); }

}  // namespace rollgait::client
