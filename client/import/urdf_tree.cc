#include "client/import/urdf_tree.h"

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <map>

#include "client/failure.h"

namespace rollgait::client {
namespace {

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

TreeShape ReadShape(const urdf::Collision& collision) {
  TreeShape shape{TreeShape::Kind::kBox, Eigen::Vector3d::Zero(), FromUrdf(collision.origin)};
  if (collision.geometry->type == urdf::Geometry::SPHERE) {
    shape.kind = TreeShape::Kind::kSphere;
    shape.half_size.setConstant(static_cast<const urdf::Sphere&>(*collision.geometry).radius);
  } else if (collision.geometry->type == urdf::Geometry::CYLINDER) {
    const auto& cylinder = static_cast<const urdf::Cylinder&>(*collision.geometry);
    shape.kind = TreeShape::Kind::kCylinder;
    shape.half_size = {cylinder.radius, cylinder.radius, cylinder.length / 2};
  } else {
    shape.half_size = FromUrdf(static_cast<const urdf::Box&>(*collision.geometry).dim) / 2;
  }
  return shape;
}

MassProperties ReadMass(const urdf::Inertial& from) {
  const Pose place = FromUrdf(from.origin);
  Eigen::Matrix3d inertia;
  inertia << from.ixx, from.ixy, from.ixz, from.ixy, from.iyy, from.iyz, from.ixz, from.iyz, from.izz;
  const bool turned = !place.rotation.isIdentity(0);
  return {from.mass, place.position,
          turned ? Eigen::Matrix3d(place.rotation * inertia * place.rotation.transpose()) : inertia};
}

TreeLink ReadLink(const urdf::Link& from) {
  TreeLink link{.name = from.name};
  if (from.inertial != nullptr) link.mass = ReadMass(*from.inertial);
  for (const auto& collision : from.collision_array) link.shapes.push_back(ReadShape(*collision));
  return link;
}

TreeJoint::Type ReadType(const urdf::Joint& from) {
  switch (from.type) {
    case urdf::Joint::REVOLUTE:
      return TreeJoint::Type::kRevolute;
    case urdf::Joint::CONTINUOUS:
      return TreeJoint::Type::kContinuous;
    case urdf::Joint::PRISMATIC:
      return TreeJoint::Type::kPrismatic;
    case urdf::Joint::FLOATING:
      return TreeJoint::Type::kFloating;
    case urdf::Joint::PLANAR:
      return TreeJoint::Type::kPlanar;
    default:
      return TreeJoint::Type::kFixed;
  }
}

TreeJoint ReadJoint(const LinkTree& tree, const urdf::Joint& from, const std::map<std::string, int>& links) {
  TreeJoint joint;
  joint.name = from.name;
  joint.type = ReadType(from);
  joint.parent = links.at(from.parent_link_name);
  joint.child = links.at(from.child_link_name);
  joint.origin = FromUrdf(from.parent_to_joint_origin_transform);
  if (!joint.Moves()) return joint;
  joint.axis = FromUrdf(from.axis);
  if (from.mimic != nullptr) joint.mimics = from.mimic->joint_name;
  if (from.dynamics != nullptr) joint.damping = from.dynamics->damping;
  if (from.limits == nullptr) return joint;
  joint.lower = from.limits->lower;
  joint.upper = from.limits->upper;
  if (from.limits->effort < 0) tree.RefuseJoint(joint.name, "its effort limit is negative");
  joint.effort_min = 0.0 - from.limits->effort;
  joint.effort_max = from.limits->effort;
  joint.velocity = from.limits->velocity;
  return joint;
}

}  // namespace

LinkTree ReadUrdf(const std::string& path, const tinyxml2::XMLDocument& xml) {
  const UrdfDocument document = CheckUrdf(path, xml);
  ParserMessages messages;
  const urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(document.xml);
  if (robot == nullptr) {
    throw Failure(ExitCode::kUsage, path + ": liburdfdom refuses it: " +
                                        (messages.first().empty() ? "without a reason" : messages.first()));
  }
  LinkTree tree;
  tree.name = document.robot;
  tree.path = path;
  tree.link_element = "link";
  tree.joint_element = "joint";
  tree.left_out = document.left_out;
  std::map<std::string, int> links;
  for (const std::string& name : document.links) {
    links.emplace(name, tree.AddLink(ReadLink(*robot->getLink(name))));
  }
  for (const std::string& name : document.joints) tree.joints.push_back(ReadJoint(tree, *robot->getJoint(name), links));
  return tree;
}

}  // namespace rollgait::client
