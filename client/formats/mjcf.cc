#include "client/formats/mjcf.h"

#include <cmath>
#include <vector>

#include "client/formats/body_links.h"
#include "client/formats/exact_number.h"
#include "client/formats/link_shapes.h"
#include "client/formats/xml_writer.h"
#include "client/joint_kinds.h"
#include "client/principal_axes.h"

namespace rollgait::client {
namespace {

class MjcfWriter {
 public:
  MjcfWriter(const v1::Model& model, const Ground& ground)
      : model_(model),
        ground_(ground),
        bodies_(BodyLinks(model)),
        shapes_(LinkShapes(model)),
        zero_(LinkPoses(model, std::vector<double>(model.joints_size(), 0.0))) {}

  std::string Write() {
    xml_.Open("mujoco", {{"model", model_.summary().name()}});
    xml_.Comment("SI units, rad. World: x forward along the ground, y left, z its normal. " + ground_.Describe());
    xml_.Empty("compiler", {{"angle", "radian"}, {"inertiafromgeom", "false"}});
    xml_.Empty("option", {{"gravity", Exact(ground_.Gravity())}, {"timestep", "0.001"}});
    xml_.Open("worldbody");
    xml_.Empty("geom", {{"name", "ground"},
                        {"type", "plane"},
                        {"size", "50 50 1"},
                        {"friction", Friction()},
                        {"contype", "0"},
                        {"conaffinity", "1"},
                        {"rgba", "0.8 0.8 0.8 1"}});
    WriteChildren(-1);
    xml_.Close();
    WriteActuators();
    xml_.Close();
    return xml_.Text();
  }

 private:
  // Sliding as requested; the other two are MuJoCo's defaults. MuJoCo takes the larger value of two geoms.
  std::string Friction() const { return Exact(ground_.friction) + " 0.005 0.0001"; }

  void WriteChildren(int parent) {
    for (size_t b = 0; b < bodies_.size(); ++b) {
      if (bodies_[b].parent == parent) WriteBody(static_cast<int>(b));
    }
  }

  void WriteBody(int index) {
    const BodyLink& body = bodies_[index];
    const v1::Joint& link = model_.joints(body.link());
    const Pose world{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
    const Pose& carrier = body.parent < 0 ? world : zero_[bodies_[body.parent].link()];
    const Pose place = Relative(carrier, zero_[body.link()]);
    xml_.Open("body",
              {{"name", link.link_name()}, {"pos", Exact(place.position)}, {"quat", ExactQuaternion(place.rotation)}});
    for (const int joint : body.joints) WriteJoint(joint, Relative(zero_[body.link()], zero_[joint]));
    WriteInertia(MassOf(link));
    for (const LinkShape& shape : shapes_) {
      if (shape.joint == body.link()) WriteShape(shape);
    }
    WriteChildren(index);
    xml_.Close();
  }

  // By principal moments: MuJoCo finds those of a full tensor to nine digits only.
  void WriteInertia(const LinkMass& body) {
    const PrincipalAxes principal = PrincipalAxesOf(body.inertia);
    xml_.Empty("inertial", {{"pos", Exact(body.center_of_mass)},
                            {"quat", ExactQuaternion(principal.axes)},
                            {"mass", Exact(body.mass)},
                            {"diaginertia", Exact(principal.moments)}});
  }

  // `frame`: the joint's in the axes of the body.
  void WriteJoint(int index, const Pose& frame) {
    const v1::Joint& joint = model_.joints(index);
    const bool limited = std::isfinite(joint.position_min()) && std::isfinite(joint.position_max());
    XmlWriter::Attributes attributes = {{"name", joint.name()},
                                        {"type", IsSlide(joint) ? "slide" : "hinge"},
                                        {"pos", Exact(frame.position)},
                                        {"axis", Exact(Eigen::Vector3d(frame.rotation * ToVector(joint.axis())))},
                                        {"limited", limited ? "true" : "false"}};
    if (limited) attributes.emplace_back("range", Exact(joint.position_min()) + " " + Exact(joint.position_max()));
    if (joint.stiffness() != 0) {
      attributes.emplace_back("stiffness", Exact(joint.stiffness()));
      attributes.emplace_back("springref", Exact(joint.rest_position()));
    }
    if (joint.damping() != 0) attributes.emplace_back("damping", Exact(joint.damping()));
    xml_.Empty("joint", attributes);
  }

  void WriteShape(const LinkShape& shape) {
    const bool contact = shape.kind == LinkShape::Kind::kContact;
    XmlWriter::Attributes attributes = {{"name", shape.name},
                                        {"type", "ellipsoid"},
                                        {"size", Exact(shape.semi_axes)},
                                        {"pos", Exact(shape.center)},
                                        {"quat", ExactQuaternion(shape.rotation)},
                                        {"contype", contact ? "1" : "0"},
                                        {"conaffinity", "0"}};
    if (contact) attributes.emplace_back("friction", Friction());
    if (!contact) attributes.emplace_back("group", "1");
    xml_.Empty("geom", attributes);
  }

  void WriteActuators() {
    xml_.Open("actuator");
    for (const v1::Joint& joint : model_.joints()) {
      if (!joint.actuated()) continue;
      const bool limited = std::isfinite(joint.effort_min()) && std::isfinite(joint.effort_max());
      XmlWriter::Attributes attributes = {
          {"name", joint.name()}, {"joint", joint.name()}, {"ctrllimited", limited ? "true" : "false"}};
      if (limited) attributes.emplace_back("ctrlrange", Exact(joint.effort_min()) + " " + Exact(joint.effort_max()));
      xml_.Empty("motor", attributes);
    }
    xml_.Close();
  }

  const v1::Model& model_;
  const Ground& ground_;
  std::vector<BodyLink> bodies_;
  std::vector<LinkShape> shapes_;
  std::vector<Pose> zero_;  // of every link, all positions zero
  XmlWriter xml_;
};

}  // namespace

std::string ToMjcf(const v1::Model& model, const Ground& ground) { return MjcfWriter(model, ground).Write(); }

}  // namespace rollgait::client
