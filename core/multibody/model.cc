#include "core/multibody/model.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "core/base/check.h"
#include "core/multibody/joint_number.h"

namespace rollgait {
namespace {

// Rounding allowed in a unit axis, a rotation and a symmetric tensor (relative to its largest entry).
constexpr double kUnitTolerance = 1e-9;
// A tensor on the border of what rigid bodies have (a lamina, a rod) may miss it by its rounding, relative to its
// trace.
constexpr double kInertiaTolerance = 1e-9;

class JointChecker {
 public:
  JointChecker(const std::vector<Joint>& joints, Violations* violations) : joints_(joints), violations_(violations) {}

  void Check(int index) {
    index_ = index;
    CheckTree();
    CheckFrame();
    CheckRanges();
    CheckLink();
    CheckMirror();
    CheckRole();
  }

 private:
  const Joint& joint() const { return joints_[index_]; }

  void Refuse(const char* field, const std::string& message) {
    violations_->push_back({"joints[" + std::to_string(index_) + "]." + field, message});
  }

  template <typename Value>
  void RefuseValue(const char* field, Value value, const char* rule) {
    std::ostringstream message;
    message << "is " << value << "; " << rule;
    Refuse(field, message.str());
  }

  void CheckTree() {
    if (joint().name.empty()) Refuse("name", "is empty; give every joint a name of its own");
    for (int i = 0; i < index_; ++i) {
      if (!joint().name.empty() && joints_[i].name == joint().name) {
        Refuse("name", "\"" + joint().name + "\" is also the name of joints[" + std::to_string(i) +
                           "]; give every joint a name of its own");
      }
    }
    if (joint().parent < -1 || joint().parent >= index_) {
      RefuseValue("parent", joint().parent, "must be -1 (the world) or the index of a joint before this one");
    }
  }

  void CheckFrame() {
    if (!joint().p_PJ.allFinite()) Refuse("p_PJ", "has a coordinate that is not finite");
    const Matrix3& rotation = joint().R_PJ;
    if (!rotation.allFinite() || !(rotation.transpose() * rotation).isIdentity(kUnitTolerance) ||
        rotation.determinant() < 0) {
      Refuse("R_PJ", "is not a rotation; its columns must be a right-handed orthonormal basis");
    }
    const bool is_unit = joint().axis.allFinite() && std::abs(joint().axis.norm() - 1) <= kUnitTolerance;
    if (!joint().kind().is_free() && !is_unit) {
      RefuseValue("axis", joint().axis.transpose(), "must be a finite vector of length 1");
    }
  }

  void CheckRanges() {
    if (joint().kind().is_free()) {
      if (joint().actuated) Refuse("actuated", "must be false: a free joint has no motor");
      if (joint().position_min != -kInfinity || joint().position_max != kInfinity) {
        Refuse("position_min", "must be left out like position_max: a free joint has no range");
      }
      if (joint().mirror_joint != index_ || joint().mirror_sign != 1) {
        Refuse("mirror_joint", "must be the joint itself with sign 1: a free joint has no mirror image");
      }
      if (joint().stiffness != 0) Refuse("stiffness", "must be 0: a free joint has no spring");
    }
    // Written so that NaN fails.
    if (!(joint().position_min <= joint().position_max)) {
      RefuseValue("position_min", joint().position_min, "must not be larger than position_max, and neither may be NaN");
    }
    if (!(joint().velocity_max > 0)) RefuseValue("velocity_max", joint().velocity_max, "must be larger than 0");
    if (!(joint().effort_min <= joint().effort_max)) {
      RefuseValue("effort_min", joint().effort_min, "must not be larger than effort_max, and neither may be NaN");
    }
    for (const JointNumber& number : kJointNumbers) {
      if (const char* problem = Problem(number, joint())) RefuseValue(number.name, joint().*number.member, problem);
    }
    if (!joint().actuated && (joint().effort_min != 0 || joint().effort_max != 0)) {
      Refuse("effort_max", "must be 0 like effort_min, because the joint is not actuated");
    }
  }

  void CheckLink() {
    if (!(std::isfinite(joint().mass) && joint().mass >= 0)) {
      RefuseValue("mass", joint().mass, "must be finite and at least 0 kg");
    }
    if (!joint().center_of_mass.allFinite()) Refuse("center_of_mass", "has a coordinate that is not finite");
    CheckInertia();
    const bool is_leaf =
        std::none_of(joints_.begin(), joints_.end(), [this](const Joint& other) { return other.parent == index_; });
    if (is_leaf && joint().mass == 0) {
      Refuse("mass", "is 0 kg on a link that carries no other; the last link of a chain must have mass");
    }
  }

  void CheckInertia() {
    const Matrix3& inertia = joint().inertia;
    if (!inertia.allFinite()) return Refuse("inertia", "has an entry that is not finite");
    const double largest = inertia.cwiseAbs().maxCoeff();
    if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() > kUnitTolerance * largest) {
      return Refuse("inertia", "is not symmetric");
    }
    if (joint().mass == 0 && largest > 0) return Refuse("inertia", "must be 0 because the mass of the link is 0 kg");
    // Ascending. A rigid body's satisfy 0 <= I1, I1 + I2 >= I3; the second implies the first.
    const Vector3 moments = Eigen::SelfAdjointEigenSolver<Matrix3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
    if (moments(0) + moments(1) < moments(2) - kInertiaTolerance * largest) {
      RefuseValue(
          "inertia", moments.transpose(),
          "(principal moments in kg m²) which no rigid body has: the sum of the two smaller must reach the largest");
    }
  }

  void CheckMirror() {
    const int mirror = joint().mirror_joint;
    if (mirror < 0 || mirror >= static_cast<int>(joints_.size())) {
      return RefuseValue("mirror_joint", mirror, "must be -1 (itself) or the index of a joint");
    }
    const Joint& image = joints_[mirror];
    if (image.mirror_joint != index_) {
      RefuseValue("mirror_joint", mirror, "but that joint is not mirrored back to this one");
    }
    if (image.type != joint().type || image.actuated != joint().actuated) {
      RefuseValue("mirror_joint", mirror, "but that joint differs in type or in being actuated");
    }
    if (std::abs(joint().mirror_sign) != 1 || image.mirror_sign != joint().mirror_sign) {
      RefuseValue("mirror_sign", joint().mirror_sign, "must be 1 or -1 and the same at both joints of the pair");
    }
  }

  void CheckRole() {
    if (joint().role == JointRole::kNone) return;
    for (int i = 0; i < index_; ++i) {
      if (joints_[i].role != joint().role || joints_[i].side != joint().side) continue;
      Refuse("role", "is also the role of joint \"" + joints_[i].name +
                         "\" on the same side; give each role to one joint a side");
    }
  }

  const std::vector<Joint>& joints_;
  Violations* violations_;
  int index_ = 0;
};

}  // namespace

Result<Model> Model::Create(std::vector<Joint> joints) {
  Violations violations;
  if (joints.empty()) {
    violations.push_back({"joints", "is empty; a model needs at least one joint"});
    return violations;
  }
  for (size_t i = 0; i < joints.size(); ++i) {
    if (joints[i].mirror_joint == -1) joints[i].mirror_joint = static_cast<int>(i);
  }
  JointChecker checker(joints, &violations);
  for (int i = 0; i < static_cast<int>(joints.size()); ++i) checker.Check(i);
  if (!violations.empty()) return violations;
  return Model(std::move(joints));
}

Model::Model(std::vector<Joint> joints) : joints_(std::move(joints)) {
  const size_t n = joints_.size();
  ancestor_.assign(n * n, 0);
  for (size_t i = 0; i < n; ++i) {
    q_index_.push_back(nq_);
    v_index_.push_back(nv_);
    nq_ += PositionCount(joints_[i].type);
    nv_ += VelocityCount(joints_[i].type);
    if (joints_[i].actuated) actuated_.push_back(static_cast<int>(i));
    total_mass_ += joints_[i].mass;
    for (int a = static_cast<int>(i); a >= 0; a = joints_[a].parent) ancestor_[i * n + a] = 1;
  }
}

std::vector<int> Model::ColumnParents() const {
  std::vector<int> parents;
  for (int i = 0; i < size(); ++i) {
    const int p = parent(i);
    parents.push_back(p < 0 ? -1 : v_index(p) + VelocityCount(joint(p).type) - 1);
    for (int c = 1; c < VelocityCount(joint(i).type); ++c) parents.push_back(v_index(i) + c - 1);
  }
  return parents;
}

int Model::Find(const std::string& name) const {
  for (int i = 0; i < size(); ++i) {
    if (joints_[i].name == name) return i;
  }
  return -1;
}

int Model::Find(JointRole role, BodySide side) const {
  ROLLGAIT_CHECK(role != JointRole::kNone);
  for (int i = 0; i < size(); ++i) {
    if (joints_[i].role == role && joints_[i].side == side) return i;
  }
  return -1;
}

double Model::FlexionSign(int joint) const {
  Vector3 axis = joints_[joint].axis;
  for (int j = joint; j >= 0; j = joints_[j].parent) axis = joints_[j].R_PJ * axis;
  switch (joints_[joint].role) {
    case JointRole::kHipFlexion:
    case JointRole::kAnkleDorsiflexion:
    case JointRole::kShoulderFlexion:
    case JointRole::kElbowFlexion:
      return axis.y() <= 0 ? 1 : -1;
    case JointRole::kKneeFlexion:
    case JointRole::kTrunkFlexion:
    case JointRole::kBasePitch:
      return axis.y() >= 0 ? 1 : -1;
    default:
      ROLLGAIT_CHECK(false);
  }
}

}  // namespace rollgait
