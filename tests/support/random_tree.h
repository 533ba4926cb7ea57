#ifndef ROLLGAIT_TESTS_SUPPORT_RANDOM_TREE_H_
#define ROLLGAIT_TESTS_SUPPORT_RANDOM_TREE_H_

#include <Eigen/Geometry>
#include <initializer_list>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/multibody/joint_number.h"
#include "core/multibody/model.h"

namespace rollgait::testing {

// Along no axis, m/s^2.
inline const Vector3 kGravity(1.7, -0.4, -9.6);

inline VectorX RandomVector(std::mt19937& random, int n, double scale = 1) {
  std::uniform_real_distribution<double> uniform(-scale, scale);
  VectorX x(n);
  for (double& value : x) value = uniform(random);
  return x;
}

inline Matrix3 RandomRotation(std::mt19937& random) {
  const Eigen::Vector4d w = RandomVector(random, 4);
  return Eigen::Quaterniond(w.normalized()).toRotationMatrix();
}

// Types with one degree of freedom.
inline std::vector<JointType> OneDegreeTypes() {
  std::vector<JointType> types;
  for (const JointKind& kind : kJointKinds) {
    if (!kind.is_free()) types.push_back(kind.type);
  }
  return types;
}

// Makes the joint one of this type; numbers that joints of it cannot leave as they are by default get a value.
inline void SetType(JointType type, Joint* joint) {
  joint->type = type;
  for (const JointNumber& number : kJointNumbers) {
    if (Problem(number, *joint) != nullptr) joint->*number.member = 0.23;
    if (Problem(number, *joint) != nullptr) joint->*number.member = 0;
  }
}

// A branching tree of n joints, of every type of one degree of freedom in turn, with random placements and physical
// inertias; some inner links are massless.
inline Model RandomTree(std::mt19937& random, int n) {
  const std::vector<JointType> types = OneDegreeTypes();
  std::vector<Joint> joints(n);
  for (int i = 0; i < n; ++i) {
    Joint& joint = joints[i];
    joint.name = "joint" + std::to_string(i);
    joint.link = "link" + std::to_string(i);
    SetType(types[static_cast<size_t>(i % 3) % types.size()], &joint);
    joint.parent = i == 0 ? -1 : std::uniform_int_distribution<int>(i < n / 2 ? i - 1 : 0, i - 1)(random);
    joint.p_PJ = RandomVector(random, 3);
    joint.R_PJ = RandomRotation(random);
    joint.axis = Vector3(RandomVector(random, 3)).normalized();
    joint.actuated = i > 2;
    joint.effort_min = i > 2 ? -100 : 0;
    joint.effort_max = i > 2 ? 100 : 0;
    if (i == 1 && n > 3) continue;
    joint.mass = 1 + std::abs(RandomVector(random, 1)(0));
    joint.center_of_mass = RandomVector(random, 3);
    const Vector3 second_moments = RandomVector(random, 3).cwiseAbs() + Vector3::Constant(0.1);
    const Vector3 principal(second_moments.sum() - second_moments.x(), second_moments.sum() - second_moments.y(),
                            second_moments.sum() - second_moments.z());
    const Matrix3 R = RandomRotation(random);
    joint.inertia = R * principal.asDiagonal() * R.transpose();
    joint.inertia = (0.5 * (joint.inertia + joint.inertia.transpose())).eval();
  }
  // Every leaf carries mass.
  std::vector<bool> has_child(n, false);
  for (const Joint& joint : joints) {
    if (joint.parent >= 0) has_child[joint.parent] = true;
  }
  if (n > 3 && !has_child[1]) joints[2].parent = 1;
  return Model::Create(std::move(joints)).value();
}

// The same joints, those named by their index free; every link has mass.
inline Model WithFreeJoints(std::vector<Joint> joints, std::initializer_list<size_t> free) {
  for (const size_t i : free) {
    SetType(JointType::kFree, &joints[i]);
    joints[i].actuated = false;
    joints[i].effort_min = joints[i].effort_max = 0;
  }
  for (Joint& joint : joints) {
    joint.mirror_joint = -1;
    if (joint.mass > 0) continue;
    joint.mass = 0.7;
    joint.inertia = Vector3(0.2, 0.3, 0.4).asDiagonal();
  }
  return Model::Create(std::move(joints)).value();
}

}  // namespace rollgait::testing

#endif  // ROLLGAIT_TESTS_SUPPORT_RANDOM_TREE_H_
