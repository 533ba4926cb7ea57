#include "tests/formats/published_bodies.h"

#include <filesystem>

#include "client/import/tree_file.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

std::optional<std::string> FileOfPackage(const std::string& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  return ReadModelBytes(path);
}

// A link whose inertia about its centre of mass, at `height` above its joint, is the same about every axis: of motion
// in the plane one counts, and one is published.
std::string RabbitLink(const std::string& name, double mass, double height, double inertia, const std::string& foot) {
  const std::string moment = FormatNumber(inertia);
  return "  <link name=\"" + name + "\">\n    <inertial><origin xyz=\"0 0 " + FormatNumber(height) +
         "\"/><mass value=\"" + FormatNumber(mass) + "\"/><inertia ixx=\"" + moment + "\" iyy=\"" + moment +
         "\" izz=\"" + moment + "\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>\n" + foot + "  </link>\n";
}

// A motor of 150 N m: 3 N m behind a gear of 50.
std::string RabbitJoint(const std::string& name, const std::string& parent, const std::string& child, double height,
                        double lower, double upper) {
  return "  <joint name=\"" + name + "\" type=\"revolute\"><parent link=\"" + parent + "\"/><child link=\"" + child +
         "\"/><origin xyz=\"0 0 " + FormatNumber(height) + "\"/><axis xyz=\"0 1 0\"/><limit lower=\"" +
         FormatNumber(lower) + "\" upper=\"" + FormatNumber(upper) + "\" effort=\"150\" velocity=\"20\"/></joint>\n";
}

}  // namespace

std::string RabbitUrdf() {
  std::string urdf = "<robot name=\"rabbit\">\n" + RabbitLink("torso", 12, 0.24, 1.33, "");
  const std::string ball =
      "    <collision><origin xyz=\"0 0 -0.4\"/><geometry><sphere radius=\"0.02\"/></geometry></collision>\n";
  for (const std::string side : {"left", "right"}) {
    urdf += RabbitLink(side + "_femur", 6.8, -0.11, 0.47, "") + RabbitLink(side + "_tibia", 3.2, -0.24, 0.2, ball) +
            RabbitJoint(side + "_hip", "torso", side + "_femur", 0, -1.6, 1.6) +
            RabbitJoint(side + "_knee", side + "_femur", side + "_tibia", -0.4, 0, 2.4);
  }
  return urdf + "</robot>\n";
}

std::vector<PublishedBody> PublishedBodies() {
  return {{"humanoid", MUJOCO_HUMANOID, "Debian's libmujoco-samples", FileOfPackage(MUJOCO_HUMANOID), 1.0},
          {"rabbit", "rabbit.urdf", "Westervelt 2003", RabbitUrdf(), 0.7},
          {"gait2392", "gait2392.osim", "Delp 1990", Gait2392Osim(), 1.2}};
}

}  // namespace rollgait::client
