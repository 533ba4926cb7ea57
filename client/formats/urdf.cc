#include "client/formats/urdf.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "client/failure.h"
#include "client/formats/body_links.h"
#include "client/formats/exact_number.h"
#include "client/formats/xml_writer.h"
#include "client/joint_kinds.h"
#include "client/report/kinematics.h"

namespace rollgait::client {
namespace {

// Fixed-axis roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll).
Eigen::Vector3d RollPitchYaw(const Eigen::Matrix3d& rotation) {
  const double pitch = std::atan2(-rotation(2, 0), std::hypot(rotation(2, 1), rotation(2, 2)));
  if (std::hypot(rotation(2, 1), rotation(2, 2)) < 1e-12) {
    return {0, pitch, std::atan2(-rotation(0, 1), rotation(1, 1))};
  }
  return {std::atan2(rotation(2, 1), rotation(2, 2)), pitch, std::atan2(rotation(1, 0), rotation(0, 0))};
}

double Bounded(double value) { return std::clamp(value, -kUrdfUnlimited, kUrdfUnlimited); }

void WriteLink(const v1::Joint& joint, XmlWriter& xml) {
  xml.Open("link", {{"name", joint.link_name()}});
  if (joint.mass_kg() > 0) {
    const LinkMass mass = MassOf(joint);
    const Eigen::Matrix3d& inertia = mass.inertia;
    xml.Open("inertial");
    xml.Empty("origin", {{"xyz", Exact(mass.center_of_mass)}, {"rpy", "0 0 0"}});
    xml.Empty("mass", {{"value", Exact(mass.mass)}});
    xml.Empty("inertia", {{"ixx", Exact(inertia(0, 0))},
                          {"ixy", Exact(inertia(0, 1))},
                          {"ixz", Exact(inertia(0, 2))},
                          {"iyy", Exact(inertia(1, 1))},
                          {"iyz", Exact(inertia(1, 2))},
                          {"izz", Exact(inertia(2, 2))}});
    xml.Close();
  }
  xml.Close();
}

void WriteJoint(const v1::Joint& joint, const std::string& parent, XmlWriter& xml) {
  const bool prismatic = IsSlide(joint);
  const bool bounded = std::isfinite(joint.position_min()) && std::isfinite(joint.position_max());
  xml.Open("joint", {{"name", joint.name()}, {"type", prismatic ? "prismatic" : bounded ? "revolute" : "continuous"}});
  xml.Empty("parent", {{"link", parent}});
  xml.Empty("child", {{"link", joint.link_name()}});
  xml.Empty("origin", {{"xyz", Exact(ToVector(joint.origin_m()))},
                       {"rpy", Exact(RollPitchYaw(ToRotation(joint.orientation())))}});
  xml.Empty("axis", {{"xyz", Exact(ToVector(joint.axis()))}});
  XmlWriter::Attributes limit = {
      {"effort", Exact(Bounded(std::max(std::abs(joint.effort_min()), std::abs(joint.effort_max()))))},
      {"velocity", Exact(Bounded(joint.velocity_max()))}};
  if (prismatic || bounded) {
    limit.emplace_back("lower", Exact(Bounded(joint.position_min())));
    limit.emplace_back("upper", Exact(Bounded(joint.position_max())));
  }
  xml.Empty("limit", limit);
  if (joint.stiffness() != 0) {
    xml.Comment("Spring, which URDF cannot state; the side file (urdf-side) has it: stiffness " +
                Exact(joint.stiffness()) + (prismatic ? " N/m, at rest at " : " N m/rad, at rest at ") +
                Exact(joint.rest_position()) + (prismatic ? " m." : " rad."));
  }
  if (joint.damping() != 0) xml.Empty("dynamics", {{"damping", Exact(joint.damping())}});
  xml.Close();
}

}  // namespace

std::string ToUrdf(const v1::Model& model) {
  XmlWriter xml;
  xml.Open("robot", {{"name", model.summary().name()}});
  xml.Comment("SI units, rad. World: x forward along the ground, y left, z its normal. Gravity: " +
              Exact(model.gravity_m_s2()) + " m/s^2.");
  // MuJoCo takes no link without mass: it gets one that changes torques by less than 1e-9.
  xml.Open("mujoco");
  xml.Empty("compiler", {{"fusestatic", "false"}, {"boundmass", "1e-12"}, {"boundinertia", "1e-12"}});
  xml.Close();
  xml.Empty("link", {{"name", "world"}});
  for (int i = 0; i < model.joints_size(); ++i) {
    const v1::Joint& joint = model.joints(i);
    RequireTurnOrSlide(joint, i);
    WriteLink(joint, xml);
    WriteJoint(joint, joint.parent() < 0 ? "world" : model.joints(joint.parent()).link_name(), xml);
  }
  xml.Close();
  return xml.Text();
}

}  // namespace rollgait::client
