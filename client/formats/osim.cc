#include "client/formats/osim.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "client/formats/body_links.h"
#include "client/formats/body_markers.h"
#include "client/formats/custom_joint.h"
#include "client/formats/exact_number.h"
#include "client/formats/link_shapes.h"
#include "client/formats/opensim_coordinates.h"
#include "client/formats/xml_writer.h"

namespace rollgait::client {
namespace {

// Body-fixed X, Y, Z angles: R = Rx Ry Rz.
Eigen::Vector3d BodyFixedAngles(const Eigen::Matrix3d& rotation) {
  const double across = std::hypot(rotation(0, 0), rotation(0, 1));
  const double y = std::atan2(rotation(0, 2), across);
  if (across < 1e-12) return {std::atan2(rotation(1, 0), rotation(1, 1)), y, 0};
  return {std::atan2(-rotation(1, 2), rotation(2, 2)), y, std::atan2(-rotation(0, 1), rotation(0, 0))};
}

class OsimWriter {
 public:
  OsimWriter(const v1::Model& model, const Ground& ground)
      : model_(model),
        ground_(ground),
        bodies_(BodyLinks(model)),
        shapes_(LinkShapes(model)),
        coordinates_(OpensimCoordinates(model)) {}

  std::string Write() {
    xml_.Open("OpenSimDocument", {{"Version", "40000"}});
    xml_.Open("Model", {{"name", model_.summary().name()}});
    xml_.Comment("Axes: X forward along the ground, Y its normal, Z right. " + ground_.Describe());
    xml_.Leaf("length_units", "meters");
    xml_.Leaf("force_units", "N");
    xml_.Leaf("gravity", Exact(ToOpensim(ground_.Gravity())));
    xml_.Empty("Ground", {{"name", "ground"}});
    Set("BodySet", [this] {
      for (const BodyLink& body : bodies_) WriteBody(body);
    });
    Set("JointSet", [this] {
      for (const BodyLink& body : bodies_) WriteJoint(body);
    });
    Set("ForceSet", [this] {
      WriteActuators();
      WriteSprings();
    });
    Set("MarkerSet", [this] { WriteMarkers(); });
    xml_.Close();
    xml_.Close();
    return xml_.Text();
  }

 private:
  template <typename Write>
  void Set(const std::string& name, const Write& write) {
    xml_.Open(name);
    xml_.Open("objects");
    write();
    xml_.Close();
    xml_.Open("groups");
    xml_.Close();
    xml_.Close();
  }

  std::string Path(const BodyLink& body) const { return "/bodyset/" + model_.joints(body.link()).link_name(); }

  void WriteBody(const BodyLink& body) {
    const LinkMass mass = MassOf(model_.joints(body.link()));
    const Eigen::Matrix3d inertia = ToOpensim(mass.inertia);
    xml_.Open("Body", {{"name", model_.joints(body.link()).link_name()}});
    xml_.Open("components");
    for (const LinkShape& shape : shapes_) {
      if (shape.joint == body.link()) WriteShape(shape, Path(body));
    }
    xml_.Close();
    xml_.Leaf("mass", Exact(mass.mass));
    xml_.Leaf("mass_center", Exact(ToOpensim(mass.center_of_mass)));
    xml_.Leaf("inertia", Exact(Eigen::Vector3d(inertia.diagonal())) + " " + Exact(inertia(0, 1)) + " " +
                             Exact(inertia(0, 2)) + " " + Exact(inertia(1, 2)));
    xml_.Close();
  }

  // The axes of the ellipsoid are renamed, too.
  void WriteShape(const LinkShape& shape, const std::string& body) {
    const Eigen::Vector3d& radii = shape.semi_axes;
    xml_.Open("PhysicalOffsetFrame", {{"name", shape.name}});
    xml_.Open("attached_geometry");
    xml_.Open("Ellipsoid", {{"name", shape.name + "_shape"}});
    xml_.Leaf("socket_frame", "..");
    xml_.Leaf("radii", Exact(Eigen::Vector3d(radii.x(), radii.z(), radii.y())));
    xml_.Close();
    xml_.Close();
    WritePlace(body, shape.center, shape.rotation);
    xml_.Close();
  }

  void WritePlace(const std::string& frame, const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation) {
    xml_.Leaf("socket_parent", frame);
    xml_.Leaf("translation", Exact(ToOpensim(position)));
    xml_.Leaf("orientation", Exact(BodyFixedAngles(ToOpensim(rotation))));
  }

  void WriteJoint(const BodyLink& body) {
    const CustomJoint custom = ToCustomJoint(model_, body);
    const std::string& link = model_.joints(body.link()).link_name();
    const bool at_root = body.parent < 0;
    const std::string carrier = at_root ? "ground" : model_.joints(bodies_[body.parent].link()).link_name();
    xml_.Open("CustomJoint", {{"name", at_root ? "ground_" + link : model_.joints(body.joints.front()).name()}});
    xml_.Leaf("socket_parent_frame", carrier + "_offset");
    xml_.Leaf("socket_child_frame", link + "_offset");
    xml_.Open("coordinates");
    // Rotations first: Simbody's function-based mobilizer takes the n-th rotation for the n-th speed.
    for (const auto* const axes : {&custom.rotations, &custom.translations}) {
      for (const TransformAxis& axis : *axes) {
        if (axis.joint >= 0) WriteCoordinate(axis.joint);
      }
    }
    xml_.Close();
    xml_.Open("frames");
    xml_.Open("PhysicalOffsetFrame", {{"name", carrier + "_offset"}});
    WritePlace(at_root ? "/ground" : Path(bodies_[body.parent]), custom.parent_frame.position,
               custom.parent_frame.rotation);
    xml_.Close();
    xml_.Open("PhysicalOffsetFrame", {{"name", link + "_offset"}});
    WritePlace(Path(body), Eigen::Vector3d::Zero(), custom.child_frame);
    xml_.Close();
    xml_.Close();
    xml_.Open("SpatialTransform");
    WriteAxes("rotation", custom.rotations);
    WriteAxes("translation", custom.translations);
    xml_.Close();
    xml_.Close();
  }

  void WriteCoordinate(int index) {
    const v1::Joint& joint = model_.joints(index);
    const double sign = coordinates_[index].sign;
    const double a = sign * joint.position_min(), b = sign * joint.position_max();
    xml_.Open("Coordinate", {{"name", coordinates_[index].name}});
    xml_.Leaf("default_value", "0");
    xml_.Leaf("default_speed_value", "0");
    xml_.Leaf("range",
              Exact(std::max(std::min(a, b), -kOsimUnlimited)) + " " + Exact(std::min(std::max(a, b), kOsimUnlimited)));
    xml_.Leaf("clamped", "false");
    xml_.Leaf("locked", "false");
    xml_.Close();
  }

  void WriteAxes(const std::string& kind, const std::vector<TransformAxis>& axes) {
    for (size_t k = 0; k < axes.size(); ++k) {
      const bool moves = axes[k].joint >= 0;
      const double sign = moves ? coordinates_[axes[k].joint].sign : 1;
      xml_.Open("TransformAxis", {{"name", kind + std::to_string(k + 1)}});
      xml_.Leaf("coordinates", moves ? coordinates_[axes[k].joint].name : "");
      xml_.Leaf("axis", Exact(Eigen::Vector3d(sign * ToOpensim(axes[k].axis))));
      xml_.Open(moves ? "LinearFunction" : "Constant", {{"name", "function"}});
      xml_.Leaf(moves ? "coefficients" : "value", moves ? "1 0" : "0");
      xml_.Close();
      xml_.Close();
    }
  }

  void WriteActuators() {
    for (int i = 0; i < model_.joints_size(); ++i) {
      const v1::Joint& joint = model_.joints(i);
      if (!joint.actuated()) continue;
      const double a = coordinates_[i].sign * joint.effort_min(), b = coordinates_[i].sign * joint.effort_max();
      xml_.Open("CoordinateActuator", {{"name", coordinates_[i].name + "_actuator"}});
      xml_.Leaf("coordinate", coordinates_[i].name);
      xml_.Leaf("optimal_force", "1");
      xml_.Leaf("min_control", Exact(std::min(a, b)));
      xml_.Leaf("max_control", Exact(std::max(a, b)));
      xml_.Close();
    }
  }

  void WriteSprings() {
    for (int i = 0; i < model_.joints_size(); ++i) {
      const v1::Joint& joint = model_.joints(i);
      if (joint.stiffness() == 0 && joint.damping() == 0) continue;
      xml_.Open("SpringGeneralizedForce", {{"name", coordinates_[i].name + "_spring"}});
      xml_.Leaf("coordinate", coordinates_[i].name);
      xml_.Leaf("stiffness", Exact(joint.stiffness()));
      xml_.Leaf("rest_length", Exact(coordinates_[i].sign * joint.rest_position()));
      xml_.Leaf("viscosity", Exact(joint.damping()));
      xml_.Close();
    }
  }

  void WriteMarkers() {
    for (const BodyMarker& marker : BodyMarkers(model_)) {
      xml_.Open("Marker", {{"name", marker.name}});
      xml_.Leaf("socket_parent_frame", "/bodyset/" + model_.joints(marker.joint).link_name());
      xml_.Leaf("location", Exact(ToOpensim(marker.location)));
      xml_.Leaf("fixed", "true");
      xml_.Close();
    }
  }

  const v1::Model& model_;
  const Ground& ground_;
  std::vector<BodyLink> bodies_;
  std::vector<LinkShape> shapes_;
  std::vector<OpensimCoordinate> coordinates_;
  XmlWriter xml_;
};

}  // namespace

std::string ToOsim(const v1::Model& model, const Ground& ground) { return OsimWriter(model, ground).Write(); }

}  // namespace rollgait::client
