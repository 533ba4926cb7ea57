#include "client/import/side_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>

#include "client/failure.h"
#include "client/json.h"
#include "client/report/surface_shape.h"
#include "client/text.h"
#include "core/base/nearest_word.h"

namespace rollgait::client {
namespace {

constexpr int kMaxSideJoints = 256, kMaxSideSources = 40;
constexpr size_t kMaxSideText = 2000, kMaxSideName = 64;

class SideCheck {
 public:
  SideCheck(const std::string& path, const v1::ModelSideFile& side, const LinkTree& tree)
      : path_(path), side_(side), tree_(tree) {}

  void Check() const {
    if (!side_.name().empty()) RequireName("name", side_.name());
    if (side_.description().size() > kMaxSideText) Refuse("description", "has more than 2000 bytes");
    RequireCount("sources", side_.sources_size(), 0, kMaxSideSources);
    RequireCount("joints", side_.joints_size(), 0, kMaxSideJoints);
    RequireCount("contacts", side_.contacts_size(), 2, 16);
    RequireCount("bodies", side_.bodies_size(), 0, 64);
    RequireCount("bodyPairs", side_.body_pairs_size(), 0, 512);
    if (!v1::ModelSideFile::Base_IsValid(side_.base())) Refuse("base", "is no value of this enum");
    if (!v1::ModelSideFile::Mirror_IsValid(side_.mirror())) Refuse("mirror", "is no value of this enum");
    if (side_.has_base_orientation()) RequireUnit("baseOrientation", side_.base_orientation());
    RequirePlace("basePositionM", side_.base_position_m());
    const double leg = side_.leg_length_m();
    if (leg != 0 && !(leg >= 0.05 && leg <= 3)) {
      Refuse("legLengthM", "is " + FormatNumber(leg) + " m; must be in [0.05, 3] m, or 0: measured");
    }
    CheckJoints();
    CheckParts("contacts", side_.contacts());
    CheckParts("bodies", side_.bodies());
    for (int i = 0; i < side_.contacts_size(); ++i) {
      const v1::SideContact& contact = side_.contacts(i);
      if (contact.side() != v1::BODY_SIDE_LEFT && contact.side() != v1::BODY_SIDE_RIGHT) {
        Refuse(At("contacts", i, "side"),
               "must be BODY_SIDE_LEFT or BODY_SIDE_RIGHT: which leg the surface belongs to");
      }
      if (!v1::ContactSurface::FootPart_IsValid(contact.part()))
        Refuse(At("contacts", i, "part"), "is no value of this enum");
    }
  }

 private:
  [[noreturn]] void Refuse(const std::string& field, const std::string& reason) const {
    throw Failure(ExitCode::kUsage, WithoutControls(path_ + ": " + field + " " + reason));
  }
  static std::string At(const char* list, int index, const char* field) {
    return std::string(list) + "[" + std::to_string(index) + "]." + field;
  }
  void RequireCount(const char* list, int count, int least, int most) const {
    if (count >= least && count <= most) return;
    Refuse(list, "are " + std::to_string(count) + "; " + std::to_string(least) + " to " + std::to_string(most) +
                     " are accepted");
  }
  void RequireName(const std::string& field, const std::string& name) const {
    const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
    if (!name.empty() && name.size() <= kMaxSideName && std::all_of(name.begin(), name.end(), allowed)) return;
    Refuse(field, "must be 1 to 64 letters, digits, \"_\", \"-\" or \".\"");
  }
  void RequireUnit(const std::string& field, const v1::Quaternion& q) const {
    const double length = std::sqrt(q.w() * q.w() + q.x() * q.x() + q.y() * q.y() + q.z() * q.z());
    if (!(std::abs(length - 1) <= 1e-6)) {
      Refuse(field, "is a quaternion of length " + FormatNumber(length) + "; must be 1 to 1e-6");
    }
  }
  void RequirePlace(const std::string& field, const v1::Vector3& v) const {
    if (ToVector(v).allFinite() && ToVector(v).cwiseAbs().maxCoeff() <= 10) return;
    Refuse(field, "is (" + FormatNumber(v.x()) + ", " + FormatNumber(v.y()) + ", " + FormatNumber(v.z()) +
                      ") m; every component must be within ±10 m");
  }
  void RequireFinite(const std::string& field, bool given, double value, bool infinite_too = false) const {
    if (given && (std::isnan(value) || (!infinite_too && std::isinf(value)))) {
      Refuse(field, "is " + FormatNumber(value) + "; must be finite");
    }
  }

  void CheckJoints() const {
    const bool own_base = HasOwnBase(side_, tree_);
    std::vector<std::string> known;
    for (const TreeJoint& joint : tree_.joints) known.push_back(joint.name);
    std::set<std::string> added, seen;
    if (!own_base) {
      for (const BaseJoint& joint : BaseJoints(side_.base())) added.insert(joint.name);
    } else {
      const std::string reason =
          "must not be given where joints of the file have base roles: they say where the body is";
      if (side_.base() != v1::ModelSideFile::BASE_UNSPECIFIED) Refuse("base", reason);
      if (side_.has_base_orientation()) Refuse("baseOrientation", reason);
      if (side_.has_base_position_m()) Refuse("basePositionM", reason);
    }
    for (int i = 0; i < side_.joints_size(); ++i) {
      const v1::SideJoint& joint = side_.joints(i);
      const int index = tree_.FindJoint(joint.name());
      const std::string shown = "\"" + joint.name().substr(0, 64) + "\" ";
      if (index < 0 && added.count(joint.name()) == 0) {
        Refuse(At("joints", i, "name"), shown + "is no joint of " + tree_.path + DidYouMean(joint.name(), known));
      }
      if (!seen.insert(joint.name()).second) Refuse(At("joints", i, "name"), shown + "stands twice");
      if (!v1::Joint::Role_IsValid(joint.role()))
        Refuse(At("joints", i, "role"), "of " + shown + "is no value of this enum");
      if (!v1::BodySide_IsValid(joint.side()))
        Refuse(At("joints", i, "side"), "of " + shown + "is no value of this enum");
      if (!v1::Joint::Passive_IsValid(joint.passive())) {
        Refuse(At("joints", i, "passive"), "of " + shown + "is no value of this enum");
      }
      if (IsBaseRole(joint.role()) && index < 0)
        Refuse(At("joints", i, "role"), "of " + shown + "is known; leave it out");
      const bool base = index < 0 || IsBaseRole(joint.role());
      RequireFinite(At("joints", i, "reference"), true, joint.reference());
      RequireFinite(At("joints", i, "positionMin"), joint.has_position_min(), joint.position_min(), base);
      RequireFinite(At("joints", i, "positionMax"), joint.has_position_max(), joint.position_max(), base);
      if (joint.has_velocity_max() && !(joint.velocity_max() > 0)) {
        Refuse(At("joints", i, "velocityMax"),
               "of " + shown + "is " + FormatNumber(joint.velocity_max()) + "; must be > 0");
      }
      RequireFinite(At("joints", i, "restPosition"), true, joint.rest_position());
      for (const auto& [field, value] : {std::pair("stiffness", joint.stiffness()), {"damping", joint.damping()}}) {
        if (!(value >= 0 && std::isfinite(value))) {
          Refuse(At("joints", i, field), "of " + shown + "is " + FormatNumber(value) + "; must be at least 0");
        }
      }
      if (index < 0 && (joint.stiffness() != 0 || joint.has_damping())) {
        Refuse(At("joints", i, "stiffness"), "or damping of " + shown + "cannot be given: the base floats");
      }
      if (joint.mirror_sign() != 0 && std::abs(joint.mirror_sign()) != 1) {
        Refuse(At("joints", i, "mirrorSign"),
               "of " + shown + "is " + FormatNumber(joint.mirror_sign()) + "; must be 1, -1 or 0");
      }
      if (index < 0 && (joint.locked() || joint.reference() != 0)) {
        Refuse(At("joints", i, "locked"), "or reference of " + shown + "cannot be given: the base floats");
      }
    }
  }

  template <typename Parts>
  void CheckParts(const char* list, const Parts& parts) const {
    std::vector<std::string> known;
    for (const TreeLink& link : tree_.links) known.push_back(link.name);
    std::set<std::string> seen;
    for (int i = 0; i < parts.size(); ++i) {
      const auto& part = parts[i];
      RequireName(At(list, i, "name"), part.name());
      if (!seen.insert(part.name()).second) Refuse(At(list, i, "name"), "\"" + part.name() + "\" stands twice");
      if (tree_.FindLink(part.link()) < 0) {
        Refuse(At(list, i, "link"), "of \"" + part.name() + "\" is \"" + part.link().substr(0, 64) + "\", no link of " +
                                        tree_.path + DidYouMean(part.link(), known));
      }
      // Other numbers are the server's to check.
      const Eigen::Vector3d axes =
          MayWalk(part.surface()) ? ShapeOf(part.surface()).semi_axes : Eigen::Vector3d(Eigen::Vector3d::Zero());
      if (!axes.allFinite() || axes.minCoeff() < 0.001 || axes.maxCoeff() > 1) {
        Refuse(At(list, i, "surface"),
               "of \"" + part.name() + "\" must be " + NamesOfWalkingShapes() + " with semi-axes in [0.001, 1] m");
      }
      RequirePlace(At(list, i, "centerM"), part.center_m());
      if (part.has_orientation()) RequireUnit(At(list, i, "orientation"), part.orientation());
    }
  }

  const std::string& path_;
  const v1::ModelSideFile& side_;
  const LinkTree& tree_;
};

}  // namespace

std::vector<BaseJoint> BaseJoints(v1::ModelSideFile::Base base) {
  constexpr double kFree = std::numeric_limits<double>::infinity(), kDegree = kPi / 180;
  const auto x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  const BaseJoint forward{"base_x", v1::Joint::ROLE_BASE_FORWARD, v1::Joint::TYPE_PRISMATIC, x, -kFree, kFree};
  const BaseJoint lateral{"base_y", v1::Joint::ROLE_BASE_LATERAL, v1::Joint::TYPE_PRISMATIC, y, -kFree, kFree};
  const BaseJoint vertical{"base_z", v1::Joint::ROLE_BASE_VERTICAL, v1::Joint::TYPE_PRISMATIC, z, -kFree, kFree};
  const BaseJoint yaw{"base_yaw", v1::Joint::ROLE_BASE_YAW, v1::Joint::TYPE_REVOLUTE, z, -20 * kDegree, 20 * kDegree};
  const BaseJoint roll{"base_roll", v1::Joint::ROLE_BASE_ROLL, v1::Joint::TYPE_REVOLUTE, x, -15 * kDegree,
                       15 * kDegree};
  const BaseJoint pitch{"base_pitch", v1::Joint::ROLE_BASE_PITCH, v1::Joint::TYPE_REVOLUTE, y, -35 * kDegree,
                        45 * kDegree};
  if (base == v1::ModelSideFile::BASE_PLANE) return {forward, vertical, pitch};
  return {forward, lateral, vertical, yaw, roll, pitch};
}

bool IsBaseRole(v1::Joint::Role role) {
  return role >= v1::Joint::ROLE_BASE_FORWARD && role <= v1::Joint::ROLE_BASE_PITCH;
}

bool HasOwnBase(const v1::ModelSideFile& side, const LinkTree& tree) {
  return std::any_of(side.joints().begin(), side.joints().end(), [&](const v1::SideJoint& joint) {
    return IsBaseRole(joint.role()) && tree.FindJoint(joint.name()) >= 0;
  });
}

void CheckSideFile(const std::string& path, const v1::ModelSideFile& side, const LinkTree& tree) {
  SideCheck(path, side, tree).Check();
}

v1::ModelSideFile ReadSideFile(const std::string& path, const LinkTree& tree) {
  v1::ModelSideFile side;
  ReadJsonFile(path, side, kModelFile);
  CheckSideFile(path, side, tree);
  return side;
}

}  // namespace rollgait::client
