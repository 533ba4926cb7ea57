// The tree of links and joints of a file, whatever its format: what the importer makes a model of.
#ifndef ROLLGAIT_CLIENT_IMPORT_LINK_TREE_H_
#define ROLLGAIT_CLIENT_IMPORT_LINK_TREE_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "client/report/kinematics.h"

namespace rollgait::client {

constexpr size_t kMaxTreeLinks = 1000;  // and as many joints
inline const Pose kNoMotion{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};

// A shape for the fit of the feet, in its own axes with its centre as origin.
struct TreeShape {
  enum class Kind { kBox, kSphere, kCylinder, kCapsule, kEllipsoid };
  Kind kind;
  // m. Half sizes of a box, semi-axes of an ellipsoid; sphere: its radius thrice; cylinder: radius, radius, half length
  // along z; capsule: the same of its cylinder.
  Eigen::Vector3d half_size;
  Pose place = kNoMotion;  // in the link frame
};

// In the link frame.
struct MassProperties {
  double mass = 0;                                    // kg, >= 0
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   // m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // kg m², about the centre
};

struct TreeLink {
  std::string name;
  MassProperties mass = {};
  std::vector<TreeShape> shapes = {};
  bool is_made = false;  // the file gives it no name, or has no such link: its name gives way to those of the file
};

// The child's link frame is origin · motion(position − zero) · end in the parent's.
struct TreeJoint {
  enum class Type { kFixed, kRevolute, kContinuous, kPrismatic, kFloating, kPlanar };
  std::string name;
  Type type = Type::kFixed;
  int parent = -1, child = -1;                     // indices of links
  Pose origin = kNoMotion;                         // joint frame -> parent's link frame
  Pose end = kNoMotion;                            // child's link frame -> moved joint frame
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  // unit, joint frame; zero of fixed and floating joints
  double zero = 0;                                 // position without motion, rad or m
  // Range as the file counts positions, lower < upper; of revolute and prismatic joints.
  double lower = 0, upper = 0;
  // N m or N, min <= 0 <= max; both 0 if the file has none.
  double effort_min = 0, effort_max = 0;
  double velocity = 0;  // rad/s or m/s, >= 0; 0 if the file has none
  bool driven = true;   // false: the file says that nothing drives it
  // A spring that exerts −stiffness · (position − rest), and a damper.
  double stiffness = 0, rest = 0, damping = 0;
  std::string turn_of = {};  // name of the joint of three turns that has this one; empty: none
  std::string mimics = {};   // name of the joint whose position this one takes; empty: none

  bool Moves() const { return type == Type::kRevolute || type == Type::kContinuous || type == Type::kPrismatic; }
};

struct LinkTree {
  std::string path;    // of the file as given, for messages
  std::string format;  // "URDF", "MJCF", "OpenSim"
  std::string name;    // of the robot or body
  // What the file calls its links and joints: "link" and "joint" of a URDF.
  std::string link_element, joint_element;
  std::vector<TreeLink> links;
  // In the order of the file as far as parents come first.
  std::vector<TreeJoint> joints;
  int root = -1;                // index of the link that is no child
  bool states_velocity = true;  // whether the format has limits of velocity
  bool base_in_plane = false;   // the floating joint stands for one that moves in the plane of x and z
  // What the reader did not use, and what it took for granted, a sentence each.
  std::vector<std::string> left_out, assumed;

  // Adds a link and returns its index. Throws Failure(kUsage) beyond kMaxTreeLinks: readers need not go on.
  int AddLink(TreeLink link);
  // Index of a link or joint by name, or -1.
  int FindLink(const std::string& name) const;
  int FindJoint(const std::string& name) const;
  // Throws Failure(kUsage) with file, element and reason.
  [[noreturn]] void RefuseLink(const std::string& name, const std::string& reason) const;
  [[noreturn]] void RefuseJoint(const std::string& name, const std::string& reason) const;
};

// What holds for a tree of any format: finds the root, puts parents first, gives axes length 1. Throws Failure(kUsage)
// with file, element and reason for: doubled names; several roots and cycles; negative
// masses and masses beyond 1e6 kg, inertias with a negative principal moment, an inertia without mass; origins, centres
// of mass and shapes beyond 10 m, which look like millimetres; sizes <= 0; axes of length 0; ranges with lower >=
// upper; negative damping, stiffness and limits; springs beyond 1e9.
void FinishTree(LinkTree* tree);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_IMPORT_LINK_TREE_H_
