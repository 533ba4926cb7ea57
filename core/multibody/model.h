#ifndef ROLLGAIT_CORE_MULTIBODY_MODEL_H_
#define ROLLGAIT_CORE_MULTIBODY_MODEL_H_

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/types.h"
#include "core/multibody/joint_kind.h"
#include "core/multibody/joint_role.h"

namespace rollgait {

// A joint and the link it moves. See rollgait.v1.Joint for the meaning of each field.
struct Joint {
  std::string name;
  JointType type = JointType::kRevolute;
  int parent = -1;                     // index of a joint before this one; -1 is the world
  Vector3 p_PJ = Vector3::Zero();      // m, origin of the joint frame in the parent's link frame
  Matrix3 R_PJ = Matrix3::Identity();  // joint frame -> parent's link frame
  Vector3 axis = Vector3::UnitZ();     // unit, in the joint frame; without meaning for a free joint
  double position_min = -kInfinity;    // rad or m
  double position_max = kInfinity;
  double velocity_max = kInfinity;  // rad/s or m/s
  bool actuated = false;
  double effort_min = 0;  // N m or N
  double effort_max = 0;
  // A spring and a damper between the parent and the link, beside what acts as effort: they exert
  // −stiffness · (q − rest_position) − damping · v. A free joint has no spring; its damper exerts the couple
  // −damping · ω on the link, ω the first three of its velocities.
  double stiffness = 0;      // N m/rad or N/m, >= 0; 0 of a free joint
  double rest_position = 0;  // rad or m
  double damping = 0;        // N m s/rad or N s/m, >= 0
  double pitch = 0;          // m/rad, of a screw: how far its link moves along the axis as it turns; 0 of any other

  std::string link;
  double mass = 0;                           // kg, >= 0
  Vector3 center_of_mass = Vector3::Zero();  // m, link frame
  Matrix3 inertia = Matrix3::Zero();         // kg m², about the centre of mass, link axes

  // Whose value this joint takes in the left/right mirror image. -1: itself; Model::Create puts the own index there.
  int mirror_joint = -1;
  double mirror_sign = 1;

  JointRole role = JointRole::kNone;
  BodySide side = BodySide::kMidline;
  PassiveKind passive = PassiveKind::kNone;

  const JointKind& kind() const { return KindOf(type); }
  // How far the link moves along the axis by unit of the position, m. Contract: one degree of freedom.
  double Advance() const { return kind().advance + pitch; }
};

// An immutable kinematic tree of joints, parents first. Without free joints nq = nv = number of joints and the floating
// base is a chain of joints (its chart and range are the model's); the optimal control stack takes such trees only. Any
// thread may share it.
class Model {
 public:
  // Refuses: a parent that does not precede its joint, an axis that is not unit, non-finite numbers, negative mass, an
  // inertia that no rigid body has (not symmetric positive semidefinite, triangle inequality of the principal moments),
  // inertia without mass, a leaf without mass, empty or repeated names, ranges with min > max, an effort range on a
  // joint that is not actuated, a stiffness or damping below 0, a mirror that is not an involution, a free joint that
  // has ranges or a stiffness, is actuated or is mirrored; a role that two joints have on the same side. Violations
  // name "joints[i].field".
  static Result<Model> Create(std::vector<Joint> joints);

  int size() const { return static_cast<int>(joints_.size()); }
  // Length of q and of v, and where the numbers of joint i begin in them.
  int nq() const { return nq_; }
  int nv() const { return nv_; }
  int q_index(int i) const { return q_index_[i]; }
  int v_index(int i) const { return v_index_[i]; }
  bool HasFreeJoint() const { return nq_ != nv_; }
  const std::vector<Joint>& joints() const { return joints_; }
  const Joint& joint(int i) const { return joints_[i]; }
  int parent(int i) const { return joints_[i].parent; }
  // Indices of the actuated joints, ascending.
  const std::vector<int>& actuated() const { return actuated_; }
  // True if a == b or a lies on the path from b to the world.
  bool IsAncestor(int a, int b) const { return ancestor_[static_cast<size_t>(b) * joints_.size() + a] != 0; }
  // True if one of the two is an ancestor of the other.
  bool Related(int a, int b) const { return IsAncestor(a, b) || IsAncestor(b, a); }
  double total_mass() const { return total_mass_; }
  // For each column of v: the one before it on its path to the world, -1 if there is none. Columns of a joint follow
  // each other.
  std::vector<int> ColumnParents() const;
  // Index of a joint by name, -1 if there is none.
  int Find(const std::string& name) const;
  // Index of the joint that has a role, -1 if none has. Contract: role is not kNone.
  int Find(JointRole role, BodySide side = BodySide::kMidline) const;
  // 1 if a positive position of the joint flexes (hip, shoulder, elbow: about -y; knee: about +y; ankle: dorsiflexes,
  // about -y; trunk and base pitch: lean forward, about +y) when all positions are zero, -1 if it does the opposite.
  // Contract: a revolute joint with one of these roles.
  double FlexionSign(int joint) const;

 private:
  explicit Model(std::vector<Joint> joints);
  std::vector<Joint> joints_;
  std::vector<int> actuated_, q_index_, v_index_;
  int nq_ = 0, nv_ = 0;
  std::vector<char> ancestor_;
  double total_mass_ = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MULTIBODY_MODEL_H_
