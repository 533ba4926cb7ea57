// The tree of links and joints of a URDF, as liburdfdom reads it.
#ifndef ROLLGAIT_CLIENT_IMPORT_URDF_TREE_H_
#define ROLLGAIT_CLIENT_IMPORT_URDF_TREE_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "client/import/urdf_document.h"
#include "client/report/kinematics.h"

namespace rollgait::client {

// A collision shape, in its own axes with its centre as origin.
struct UrdfShape {
  enum class Kind { kBox, kSphere, kCylinder };
  Kind kind;
  Eigen::Vector3d half_size;  // m; sphere: its radius thrice; cylinder: radius, radius, half length along z
  Pose place;                 // in the link frame
};

// Mass properties in the link frame.
struct UrdfMass {
  double mass = 0;                                    // kg, >= 0
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   // m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // kg m², about the centre
};

struct UrdfLink {
  std::string name;
  UrdfMass mass;
  std::vector<UrdfShape> shapes;
};

struct UrdfJoint {
  enum class Type { kFixed, kRevolute, kContinuous, kPrismatic, kFloating, kPlanar };
  std::string name;
  Type type = Type::kFixed;
  int parent = -1, child = -1;                                        // indices of links
  Pose origin{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};  // joint frame -> parent's link frame
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  // unit, joint frame; zero of fixed and floating joints
  double lower = 0, upper = 0;                     // rad or m, lower < upper; of revolute and prismatic joints
  double effort = 0, velocity = 0;                 // N m or N, rad/s or m/s; >= 0, 0 if the file has none
  double damping = 0;                              // N m s/rad or N s/m; >= 0
  std::string mimics;                              // name of the joint whose position this one takes; empty: none
};

struct UrdfTree {
  UrdfDocument document;
  std::vector<UrdfLink> links;
  // In the order of the file as far as parents come first.
  std::vector<UrdfJoint> joints;
  int root = -1;  // index of the link that is no child

  // Index of a link or joint by name, or -1.
  int FindLink(const std::string& name) const;
  int FindJoint(const std::string& name) const;
};

// Reads and checks a file. Throws Failure(kUsage) with file, element and reason for what CheckUrdfText refuses, and
// for: negative masses and masses beyond 1e6 kg, inertias with a negative principal
// moment, an inertia without mass; origins, centres of mass and shapes beyond 10 m,
// which look like millimetres; axes of length 0; ranges with lower >= upper; negative limits.
UrdfTree ReadUrdf(const std::string& path);
// The same for text. `path` is for messages only.
UrdfTree ReadUrdfText(const std::string& path, const std::string& text);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_URDF_TREE_H_
