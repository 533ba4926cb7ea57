#include "client/import/tree_limits.h"

#include <cmath>
#include <limits>

#include "client/formats/urdf.h"
#include "client/import/side_file.h"
#include "client/joint_kinds.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

// Of joints whose format states none: what human29's fastest joints have, well above walking.
constexpr double kAssumedTurn_rad_s = 20, kAssumedSlide_m_s = 2;

}  // namespace

void RequireReference(const LinkTree& tree, const TreeJoint& joint, const std::string& side_path,
                      const v1::SideJoint& said, double least, double most) {
  const bool bounded = joint.type == TreeJoint::Type::kRevolute || joint.type == TreeJoint::Type::kPrismatic;
  const double at = said.reference();
  if (bounded ? at >= least && at <= most : std::abs(at) <= 2 * kPi) return;
  tree.RefuseJoint(joint.name, "its reference in " + side_path + " is " + FormatNumber(at) + ", out of its range " +
                                   (bounded ? FormatNumber(least) + " to " + FormatNumber(most) : std::string("±2π")));
}

void SetLimits(const LinkTree& tree, const TreeJoint& joint, const std::string& side_path, const v1::SideJoint& said,
               v1::Joint* to, ImportedModel* result) {
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  const bool base = IsBaseRole(said.role());
  double least = joint.lower, most = joint.upper;
  if (joint.type == TreeJoint::Type::kContinuous) {
    least = base ? -kUnbounded : said.reference() - kPi;
    most = base ? kUnbounded : said.reference() + kPi;
    if (!base && !(said.has_position_min() && said.has_position_max())) {
      result->assumed.push_back("range of joint \"" + joint.name + "\", which is continuous: ±π around the reference");
    }
  }
  const auto unlimited = [base](double value) { return base && std::abs(value) >= kUrdfUnlimited; };
  if (unlimited(least)) least = -kUnbounded;
  if (unlimited(most)) most = kUnbounded;
  if (said.has_position_min()) least = said.position_min();
  if (said.has_position_max()) most = said.position_max();
  if (!(least < most)) {
    tree.RefuseJoint(joint.name, "its range with " + side_path + " is " + FormatNumber(least) + " to " +
                                     FormatNumber(most) + "; the lower end must be below the upper");
  }
  RequireReference(tree, joint, side_path, said, least, most);
  to->set_position_min(least - said.reference());
  to->set_position_max(most - said.reference());
  const bool actuated = said.has_actuated() ? said.actuated() : !base && joint.driven;
  to->set_actuated(actuated);
  double velocity = said.has_velocity_max() ? said.velocity_max() : joint.velocity;
  if (!said.has_velocity_max() && !base && !tree.states_velocity) {
    velocity = IsSlide(*to) ? kAssumedSlide_m_s : kAssumedTurn_rad_s;
  }
  if (!said.has_velocity_max() && (unlimited(velocity) || (!actuated && velocity == 0))) velocity = kUnbounded;
  to->set_velocity_max(velocity);
  if (actuated) {
    to->set_effort_min(said.has_effort_min() ? said.effort_min() : joint.effort_min);
    to->set_effort_max(said.has_effort_max() ? said.effort_max() : joint.effort_max);
    if (!(to->effort_min() < 0 && to->effort_max() > 0 && velocity > 0)) {
      tree.RefuseJoint(joint.name, "effort is limited to " + FormatNumber(to->effort_min()) + " … " +
                                       FormatNumber(to->effort_max()) + " and velocity to " + FormatNumber(velocity) +
                                       "; give effortMin < 0 < effortMax and velocityMax > 0 in " + side_path +
                                       ", or \"actuated\": false");
    }
  }
  const bool range = said.has_position_min() || said.has_position_max();
  const bool limits = said.has_velocity_max() || said.has_effort_min() || said.has_effort_max();
  if (range || limits) {
    result->read.push_back((range && limits ? "range and limits"
                            : range         ? "range"
                                            : "limits") +
                           std::string(" of joint \"") + joint.name + "\" from the side file");
  }
}

}  // namespace rollgait::client
