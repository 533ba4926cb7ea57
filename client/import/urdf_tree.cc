#include "client/import/urdf_tree.h"

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "client/failure.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr double kMaxUrdfLength = 10;  // m
constexpr double kMaxUrdfMass = 1e6;   // kg

// What urdfdom says while it parses, in place of standard error.
class ParserMessages : public console_bridge::OutputHandler {
 public:
  ParserMessages() { console_bridge::useOutputHandler(this); }
  ~ParserMessages() override { console_bridge::restorePreviousOutputHandler(); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && first_.empty()) first_ = text;
  }
  const std::string& first() const { return first_; }

 private:
  std::string first_;
};

Eigen::Vector3d FromUrdf(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }
Pose FromUrdf(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  const Eigen::Vector3d turn(r.x, r.y, r.z);
  return {turn.isZero(0) ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                         : Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix(),
          FromUrdf(pose.position)};
}

class TreeReader {
 public:
  TreeReader(UrdfDocument document, const urdf::ModelInterface& robot) : robot_(robot) {
    tree_.document = std::move(document);
  }

  UrdfTree Read() {
    for (const std::string& name : tree_.document.links) tree_.links.push_back(ReadLink(*robot_.getLink(name)));
    tree_.root = tree_.FindLink(robot_.getRoot()->name);
    std::map<std::string, int> links;
    for (size_t i = 0; i < tree_.links.size(); ++i) links.emplace(tree_.links[i].name, static_cast<int>(i));
    std::vector<UrdfJoint> joints;
    for (const std::string& name : tree_.document.joints) joints.push_back(ReadJoint(*robot_.getJoint(name), links));
    Sort(joints);
    return std::move(tree_);
  }

 private:
  [[noreturn]] void Refuse(const char* element, const std::string& name, const std::string& reason) const {
    throw Failure(ExitCode::kUsage, tree_.document.path + ": <" + element + " name=\"" + name + "\">: " + reason);
  }

  void RequireLength(const char* element, const std::string& name, const std::string& what,
                     const Eigen::Vector3d& v) const {
    if (v.cwiseAbs().maxCoeff() <= kMaxUrdfLength) return;
    Refuse(element, name,
           what + " is (" + FormatNumber(v.x()) + ", " + FormatNumber(v.y()) + ", " + FormatNumber(v.z()) +
               ") m; every component must be within ±10 m: URDF lengths are metres, these look like "
               "millimetres");
  }

  UrdfLink ReadLink(const urdf::Link& from) const {
    UrdfLink link{from.name, {}, {}};
    if (from.inertial != nullptr) link.mass = ReadMass(from.name, *from.inertial);
    for (const auto& collision : from.collision_array) {
      UrdfShape shape{UrdfShape::Kind::kBox, Eigen::Vector3d::Zero(), FromUrdf(collision->origin)};
      if (collision->geometry->type == urdf::Geometry::SPHERE) {
        shape.kind = UrdfShape::Kind::kSphere;
        shape.half_size.setConstant(static_cast<const urdf::Sphere&>(*collision->geometry).radius);
      } else if (collision->geometry->type == urdf::Geometry::CYLINDER) {
        const auto& cylinder = static_cast<const urdf::Cylinder&>(*collision->geometry);
        shape.kind = UrdfShape::Kind::kCylinder;
        shape.half_size = {cylinder.radius, cylinder.radius, cylinder.length / 2};
      } else {
        shape.half_size = FromUrdf(static_cast<const urdf::Box&>(*collision->geometry).dim) / 2;
      }
      if (!(shape.half_size.minCoeff() > 0)) Refuse("link", from.name, "a <collision> shape has a size <= 0");
      RequireLength("link", from.name, "the size of a <collision> shape", shape.half_size);
      RequireLength("link", from.name, "the origin of a <collision> shape", shape.place.position);
      link.shapes.push_back(shape);
    }
    return link;
  }

  UrdfMass ReadMass(const std::string& link, const urdf::Inertial& from) const {
    const Pose place = FromUrdf(from.origin);
    Eigen::Matrix3d inertia;
    inertia << from.ixx, from.ixy, from.ixz, from.ixy, from.iyy, from.iyz, from.ixz, from.iyz, from.izz;
    if (!(from.mass >= 0 && from.mass <= kMaxUrdfMass)) {
      Refuse("link", link, "<mass> is " + FormatNumber(from.mass) + " kg; must be in [0, 1e6] kg");
    }
    if (from.mass == 0 && !inertia.isZero(0)) {
      Refuse("link", link, "<mass> is 0, but <inertia> is not; give a mass, or no <inertial>");
    }
    RequireLength("link", link, "the centre of mass", place.position);
    const Eigen::Vector3d moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvalues();
    if (moments(0) < -1e-6 * moments.cwiseAbs().maxCoeff()) {
      Refuse("link", link,
             "<inertia> has the principal moment " + FormatNumber(moments(0)) + " kg m²; none may be negative");
    }
    const bool turned = !place.rotation.isIdentity(0);
    return {from.mass, place.position,
            turned ? Eigen::Matrix3d(place.rotation * inertia * place.rotation.transpose()) : inertia};
  }

  UrdfJoint ReadJoint(const urdf::Joint& from, const std::map<std::string, int>& links) const {
    UrdfJoint joint{from.name,
                    UrdfJoint::Type::kFixed,
                    links.at(from.parent_link_name),
                    links.at(from.child_link_name),
                    FromUrdf(from.parent_to_joint_origin_transform),
                    Eigen::Vector3d::Zero(),
                    0,
                    0,
                    0,
                    0,
                    0,
                    {}};
    RequireLength("joint", from.name, "<origin>", joint.origin.position);
    switch (from.type) {
      case urdf::Joint::REVOLUTE:
        joint.type = UrdfJoint::Type::kRevolute;
        break;
      case urdf::Joint::CONTINUOUS:
        joint.type = UrdfJoint::Type::kContinuous;
        break;
      case urdf::Joint::PRISMATIC:
        joint.type = UrdfJoint::Type::kPrismatic;
        break;
      case urdf::Joint::FLOATING:
        joint.type = UrdfJoint::Type::kFloating;
        return joint;
      case urdf::Joint::PLANAR:
        joint.type = UrdfJoint::Type::kPlanar;
        return joint;
      default:
        return joint;
    }
    joint.axis = FromUrdf(from.axis);
    if (!(joint.axis.norm() > 1e-6)) Refuse("joint", from.name, "<axis> has length 0; give a direction");
    if (std::abs(joint.axis.norm() - 1) > 1e-15) joint.axis.normalize();
    if (from.mimic != nullptr) joint.mimics = from.mimic->joint_name;
    if (from.dynamics != nullptr) joint.damping = from.dynamics->damping;
    if (joint.damping < 0) {
      Refuse("joint", from.name, "<dynamics> has damping " + FormatNumber(joint.damping) + "; must be at least 0");
    }
    if (from.limits == nullptr) return joint;
    joint.lower = from.limits->lower;
    joint.upper = from.limits->upper;
    joint.effort = from.limits->effort;
    joint.velocity = from.limits->velocity;
    if (joint.type != UrdfJoint::Type::kContinuous && !(joint.lower < joint.upper)) {
      Refuse("joint", from.name,
             "<limit> has lower " + FormatNumber(joint.lower) + " and upper " + FormatNumber(joint.upper) +
                 "; lower must be below upper");
    }
    if (joint.effort < 0 || joint.velocity < 0) {
      Refuse("joint", from.name,
             "<limit> has effort " + FormatNumber(joint.effort) + " and velocity " + FormatNumber(joint.velocity) +
                 "; neither may be negative");
    }
    return joint;
  }

  // Parents first; among those that can come next, the first of the file.
  void Sort(std::vector<UrdfJoint>& joints) {
    std::vector<bool> placed(tree_.links.size(), false), taken(joints.size(), false);
    placed[static_cast<size_t>(tree_.root)] = true;
    while (tree_.joints.size() < joints.size()) {
      size_t next = 0;
      while (taken[next] || !placed[static_cast<size_t>(joints[next].parent)]) ++next;
      taken[next] = true;
      placed[static_cast<size_t>(joints[next].child)] = true;
      tree_.joints.push_back(joints[next]);
    }
  }

  const urdf::ModelInterface& robot_;
  UrdfTree tree_;
};

}  // namespace

int UrdfTree::FindLink(const std::string& name) const {
  const auto found = std::find_if(links.begin(), links.end(), [&](const UrdfLink& link) { return link.name == name; });
  return found == links.end() ? -1 : static_cast<int>(found - links.begin());
}

int UrdfTree::FindJoint(const std::string& name) const {
  const auto found =
      std::find_if(joints.begin(), joints.end(), [&](const UrdfJoint& joint) { return joint.name == name; });
  return found == joints.end() ? -1 : static_cast<int>(found - joints.begin());
}

UrdfTree ReadUrdfText(const std::string& path, const std::string& text) {
  UrdfDocument document = CheckUrdfText(path, text);
  ParserMessages messages;
  const urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(document.xml);
  if (robot == nullptr) {
    throw Failure(ExitCode::kUsage, path + ": liburdfdom refuses it: " +
                                        (messages.first().empty() ? "without a reason" : messages.first()));
  }
  return TreeReader(std::move(document), *robot).Read();
}

UrdfTree ReadUrdf(const std::string& path) { return ReadUrdfText(path, ReadUrdfBytes(path)); }

}  // namespace rollgait::client
