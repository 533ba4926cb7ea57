#ifndef ROLLGAIT_TESTS_SUPPORT_RANDOM_TREE_H_
#define ROLLGAIT_TESTS_SUPPORT_RANDOM_TREE_H_

#include <Eigen/Geometry>
#include <initializer_list>
#include <random>
#include <string>
#include <utility>
#include <vector>

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

// A branching tree of n joints of both types with random placements and physical inertias; some inner links are
// massless.
inline Model RandomTree(std::mt19937& random, int n) {
  std::vector<Joint> joints(n);
  for (int i = 0; i < n; ++i) {
    Joint& joint = joints[i];
    joint.name = "joint" + std::to_string(i);
    joint.link = "link" + std::to_string(i);
    joint.type = i % 3 == 1 ? JointType::kPrismatic : JointType::kRevolute;
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
    joints[i].type = JointType::kFree;
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
