#include <string>
#include <vector>

#include "client/text.h"
#include "tests/formats/published_bodies.h"

namespace rollgait::client {
namespace {

struct Body {
  const char* name;
  double mass;        // kg
  double center[3];   // m, of the right side
  double xx, yy, zz;  // kg m²
  bool has_sides = true;
};
constexpr Body kBodies[] = {{"pelvis", 11.777, {-0.0707, 0, 0}, 0.1028, 0.0871, 0.0579, false},
                            {"torso", 34.2366, {-0.03, 0.32, 0}, 1.4745, 0.7555, 1.4314, false},
                            {"femur", 9.3014, {0, -0.17, 0}, 0.1339, 0.0351, 0.1412},
                            {"tibia", 3.7075, {0, -0.1867, 0}, 0.0504, 0.0051, 0.0511},
                            {"talus", 0.1, {0, 0, 0}, 0.001, 0.001, 0.001},
                            {"calcn", 1.25, {0.1, 0.03, 0}, 0.0014, 0.0039, 0.0041},
                            {"toes", 0.2166, {0.0346, 0.006, -0.0175}, 0.0001, 0.0002, 0.0001}};

// A coordinate and the axis that it moves about or along, of the right side; left ones have the mirror image.
struct Axis {
  const char* coordinate;
  double axis[3];
  double least, most;  // rad or m
  double effort = 0;   // N m; 0: none
};

struct JointOf {
  const char *name, *parent, *child;
  double place[3];  // in the parent, m, of the right side
  std::vector<Axis> axes;
  bool has_sides = true;
};

const std::vector<JointOf>& Joints() {
  static const std::vector<JointOf> joints = {
      {"back",
       "pelvis",
       "torso",
       {-0.1007, 0.0815, 0},
       {{"lumbar_extension", {0, 0, 1}, -1.5708, 1.5708, 250},
        {"lumbar_bending", {1, 0, 0}, -1.5708, 1.5708, 200},
        {"lumbar_rotation", {0, 1, 0}, -1.5708, 1.5708, 100}},
       false},
      {"hip",
       "pelvis",
       "femur",
       {-0.0707, -0.0661, 0.0835},
       {{"hip_flexion", {0, 0, 1}, -2.0944, 2.0944, 250},
        {"hip_adduction", {1, 0, 0}, -2.0944, 2.0944, 200},
        {"hip_rotation", {0, 1, 0}, -2.0944, 2.0944, 100}}},
      {"ankle",
       "tibia",
       "talus",
       {0, -0.43, 0},
       {{"ankle_angle", {-0.10501355, -0.17402245, 0.97912632}, -1.5708, 1.5708, 200}}},
      {"subtalar",
       "talus",
       "calcn",
       {-0.04877, -0.04195, 0.00792},
       {{"subtalar_angle", {0.78717961, 0.60474746, -0.12094949}, -1.5708, 1.5708, 60}}},
      {"mtp",
       "calcn",
       "toes",
       {0.1788, -0.002, 0.00108},
       {{"mtp_angle", {-0.5809544, 0, 0.81393611}, -1.5708, 1.5708, 20}}}};
  return joints;
}

constexpr char kKneeX[] =
    "<SimmSpline name=\"function\"><x>-2.0944 -1.74533 -1.39626 -1.0472 -0.698132 -0.349066 -0.174533 0.197344 "
    "0.337395 "
    "0.490178 1.52146 2.0944</x><y>-0.0032 0.00179 0.00411 0.0041 0.00212 -0.001 -0.0031 -0.005227 -0.005435 -0.005574 "
    "-0.005435 -0.00525</y></SimmSpline>";
constexpr char kKneeY[] =
    "<SimmSpline name=\"function\"><x>-2.0944 -1.22173 -0.523599 -0.349066 -0.174533 0.159149 2.0944</x><y>-0.4226 "
    "-0.4082 -0.399 -0.3976 -0.3966 -0.395264 -0.396</y></SimmSpline>";
constexpr char kLinear[] = "<LinearFunction name=\"function\"><coefficients>1 0</coefficients></LinearFunction>";
constexpr char kZero[] = "<Constant name=\"function\"><value>0</value></Constant>";

struct Sphere {
  const char* body;
  double x, z;
};
constexpr double kSphereRadius = 0.032, kSphereHeight = -0.021859;
constexpr Sphere kSpheres[] = {{"calcn", 0.00190115788407966, -0.00382630379623308},
                               {"calcn", 0.148386399942063, -0.028713422052654},
                               {"calcn", 0.133001170607051, 0.0516362473449566},
                               {"calcn", 0.0662346661991635, 0.0263641606741698},
                               {"toes", 0.06, -0.0187603084619177},
                               {"toes", 0.045, 0.0618569567549652}};
constexpr double kToeStiffness = 25, kToeDamping = 1.9;  // N m/rad, N m s/rad

std::string Triple(double x, double y, double z) {
  return FormatNumber(x, 10) + " " + FormatNumber(y, 10) + " " + FormatNumber(z, 10);
}

std::string BodyXml(const Body& body, const std::string& end, double side) {
  return "<Body name=\"" + (body.name + end) + "\"><mass>" + FormatNumber(body.mass, 8) + "</mass><mass_center>" +
         Triple(body.center[0], body.center[1], side * body.center[2]) + "</mass_center><inertia>" +
         Triple(body.xx, body.yy, body.zz) + " 0 0 0</inertia></Body>\n";
}

std::string CoordinateXml(const std::string& name, double least, double most) {
  // The toes are locked: with toes of 0.2 kg free, a gait still exceeded a bound on its third mesh.
  const bool locked = name.rfind("mtp_angle", 0) == 0;
  return "<Coordinate name=\"" + name + "\"><default_value>0</default_value><range>" + FormatNumber(least, 8) + " " +
         FormatNumber(most, 8) + "</range><clamped>false</clamped><locked>" + (locked ? "true" : "false") +
         "</locked></Coordinate>";
}

std::string AxisXml(const std::string& name, const std::string& coordinate, const std::string& axis,
                    const std::string& function) {
  return "<TransformAxis name=\"" + name + "\"><coordinates>" + coordinate + "</coordinates><axis>" + axis + "</axis>" +
         function + "</TransformAxis>";
}

// The frames of a joint between two bodies.
std::string FramesXml(const std::string& parent, const std::string& child, const std::string& place) {
  const auto frame = [](const std::string& name, const std::string& body, const std::string& at) {
    return "<PhysicalOffsetFrame name=\"" + name + "\"><socket_parent>" + body + "</socket_parent><translation>" + at +
           "</translation><orientation>0 0 0</orientation></PhysicalOffsetFrame>";
  };
  return "<socket_parent_frame>a</socket_parent_frame><socket_child_frame>b</socket_child_frame><frames>" +
         frame("a", parent == "ground" ? "/ground" : "/bodyset/" + parent, place) +
         frame("b", "/bodyset/" + child, "0 0 0") + "</frames>";
}

// Turns about given axes, in order.
std::string JointXml(const JointOf& joint, const std::string& end, double side) {
  std::string coordinates, axes;
  const std::string names[] = {"rotation1", "rotation2", "rotation3"};
  for (size_t i = 0; i < joint.axes.size(); ++i) {
    const Axis& axis = joint.axes[i];
    // The axis of a turn is a pseudovector: of its mirror image x and y change sign.
    const std::string name = axis.coordinate + end;
    coordinates += CoordinateXml(name, axis.least, axis.most);
    axes += AxisXml(names[i], name, Triple(side * axis.axis[0], side * axis.axis[1], axis.axis[2]), kLinear);
  }
  // What does not move; the reader must not need the axes of it.
  const char* const unused[] = {"1 0 0", "0 1 0", "1 0 0"};
  for (size_t i = joint.axes.size(); i < 3; ++i) axes += AxisXml(names[i], "", unused[i], kZero);
  axes += AxisXml("translation1", "", "1 0 0", kZero) + AxisXml("translation2", "", "0 1 0", kZero) +
          AxisXml("translation3", "", "0 0 1", kZero);
  const std::string parent = joint.parent + (joint.has_sides && std::string(joint.parent) != "pelvis" ? end : "");
  return "<CustomJoint name=\"" + (joint.name + end) + "\">" +
         FramesXml(parent, joint.child + end, Triple(joint.place[0], joint.place[1], side * joint.place[2])) +
         "<coordinates>" + coordinates + "</coordinates><SpatialTransform>" + axes +
         "</SpatialTransform></CustomJoint>\n";
}

std::string KneeXml(const std::string& end) {
  const std::string knee = "knee_angle" + end;
  return "<CustomJoint name=\"knee" + end + "\">" + FramesXml("femur" + end, "tibia" + end, "0 0 0") + "<coordinates>" +
         CoordinateXml(knee, -2.0944, 0.174533) + "</coordinates><SpatialTransform>" +
         AxisXml("rotation1", knee, "0 0 1", kLinear) + AxisXml("rotation2", "", "0 1 0", kZero) +
         AxisXml("rotation3", "", "1 0 0", kZero) + AxisXml("translation1", knee, "1 0 0", kKneeX) +
         AxisXml("translation2", knee, "0 1 0", kKneeY) + AxisXml("translation3", "", "0 0 1", kZero) +
         "</SpatialTransform></CustomJoint>\n";
}

std::string PelvisXml() {
  std::string coordinates, axes;
  const struct {
    const char *axis, *coordinate, *direction;
    double most;
  } kAxes[] = {{"rotation1", "pelvis_tilt", "0 0 1", 1.5708},     {"rotation2", "pelvis_list", "1 0 0", 1.5708},
               {"rotation3", "pelvis_rotation", "0 1 0", 1.5708}, {"translation1", "pelvis_tx", "1 0 0", 5},
               {"translation2", "pelvis_ty", "0 1 0", 2},         {"translation3", "pelvis_tz", "0 0 1", 3}};
  for (const auto& [axis, coordinate, direction, most] : kAxes) {
    coordinates += CoordinateXml(coordinate, -most, most);
    axes += AxisXml(axis, coordinate, direction, kLinear);
  }
  return "<CustomJoint name=\"ground_pelvis\">" + FramesXml("ground", "pelvis", "0 0 0") + "<coordinates>" +
         coordinates + "</coordinates><SpatialTransform>" + axes + "</SpatialTransform></CustomJoint>\n";
}

std::string ActuatorXml(const std::string& coordinate, double effort) {
  return "<CoordinateActuator name=\"" + coordinate + "_actuator\"><coordinate>" + coordinate +
         "</coordinate><optimal_force>" + FormatNumber(effort) + "</optimal_force></CoordinateActuator>\n";
}

}  // namespace

std::string Gait2392Osim() {
  std::string bodies, joints = PelvisXml(), forces, contacts;
  const auto add = [&](const std::string& end, double side) {
    const bool middle = end.empty();
    for (const Body& body : kBodies) {
      if (body.has_sides != middle) bodies += BodyXml(body, end, side);
    }
    for (const JointOf& joint : Joints()) {
      if (joint.has_sides == middle) continue;
      if (std::string(joint.name) == "ankle") joints += KneeXml(end);
      joints += JointXml(joint, end, side);
      for (const Axis& axis : joint.axes) forces += ActuatorXml(axis.coordinate + end, axis.effort);
    }
    if (middle) return;
    forces += ActuatorXml("knee_angle" + end, 250);
    forces += "<SpringGeneralizedForce name=\"toes" + end + "\"><coordinate>mtp_angle" + end +
              "</coordinate><stiffness>" + FormatNumber(kToeStiffness) + "</stiffness><rest_length>0</rest_length>" +
              "<viscosity>" + FormatNumber(kToeDamping) + "</viscosity></SpringGeneralizedForce>\n";
    forces += "<Thelen2003Muscle name=\"soleus" + end + "\"/>\n";
    int index = 0;
    for (const Sphere& sphere : kSpheres) {
      contacts += "<ContactSphere name=\"s" + std::to_string(++index) + end + "\"><socket_frame>/bodyset/" +
                  (sphere.body + end) + "</socket_frame><location>" + Triple(sphere.x, kSphereHeight, side * sphere.z) +
                  "</location><radius>" + FormatNumber(kSphereRadius) + "</radius></ContactSphere>\n";
    }
  };
  add("", 1);
  add("_r", 1);
  add("_l", -1);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<OpenSimDocument Version=\"40000\"><Model name=\"gait2392\">\n"
         "<gravity>0 -9.80665 0</gravity><Ground name=\"ground\"/>\n<BodySet><objects>\n" +
         bodies + "</objects></BodySet>\n<JointSet><objects>\n" + joints +
         "</objects></JointSet>\n<ForceSet><objects>\n" + forces +
         "</objects></ForceSet>\n<ContactGeometrySet><objects>\n" + contacts +
         "</objects></ContactGeometrySet>\n</Model></OpenSimDocument>\n";
}

}  // namespace rollgait::client
